#!/bin/sh
# run.sh PROGRAM [OPTIONS]: follows docs/tutorial.md with PROGRAM as `weaveform` (follow.py says how; OPTIONS go to it). Exit
# code 77: skipped, another program that the tutorial calls is not installed.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
for other in gmsh ccx awk; do
  command -v $other >/dev/null || { echo "skipped: $other is not installed"; exit 77; }
done
PATH=/usr/bin:$PATH # Debian's python3, whose package python3-vtk9 is
for module in numpy vtkmodules.vtkIOXML; do
  python3 -c "import $module" 2>/dev/null || { echo "skipped: python3 has no $module"; exit 77; }
done
export PYTHONDONTWRITEBYTECODE=1 PYTHONNOUSERSITE=1
exec python3 "$here/follow.py" "$@"
