#!/bin/sh
# run.sh PROGRAM [OPTIONS]: follows docs/tutorial.md with PROGRAM as `weaveform` (follow.py says how; OPTIONS go to it). Exit
# code 77: skipped, another program that the tutorial calls is not installed.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../support/debian_python.sh"
need_programs gmsh ccx awk
need_modules numpy vtkmodules.vtkIOXML
PATH=/usr/bin:$PATH # the tutorial's lines call python3
exec "$python" "$here/follow.py" "$@"
