#!/bin/sh
# run.sh PROGRAM [OPTIONS]: the tests of the Python package against PROGRAM; OPTIONS go to pytest. Exit code 77: skipped,
# what they cannot do without is not installed.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../support/debian_python.sh"
WEAVEFORM=$1
shift
need_modules numpy vtkmodules.vtkIOXML meshio pytest
export WEAVEFORM PYTHONPATH="$here/../../python"
exec "$python" -m pytest -q -p no:cacheprovider "$here" "$@"
