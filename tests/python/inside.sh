#!/bin/sh
# inside.sh PROGRAM BUILD_TREE COMPILER [OPTIONS]: installs the libraries of the build tree into a temporary prefix, builds
# weaveform._inside over them as anybody would (python/bindings), and tests it against PROGRAM; OPTIONS go to pytest. Exit
# code 77: skipped, what it cannot do without is not installed.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../support/debian_python.sh"
WEAVEFORM=$1 tree=$2 compiler=$3
shift 3
need_modules numpy vtkmodules.vtkIOXML pytest
headers=$("$python" -c "import sysconfig; print(sysconfig.get_path('include'))")
for header in Python.h pybind11/pybind11.h; do
  echo "#include <$header>" | "$compiler" -std=c++20 -I"$headers" -E -x c++ -o /dev/null - 2>/dev/null ||
    skip "no $header (Debian: python3-dev, pybind11-dev)"
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# installed and built quietly, unless it fails; the tests ask little of the module's speed
{
  cmake --install "$tree" --prefix "$folder/library" --component development &&
    cmake -G Ninja -S "$here/../../python/bindings" -B "$folder/build" -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DPython_EXECUTABLE="$python" \
      -DCMAKE_PREFIX_PATH="$folder/library" -DCMAKE_INSTALL_PREFIX="$folder/site" &&
    cmake --build "$folder/build" --parallel 1 && cmake --install "$folder/build"
} >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
export WEAVEFORM PYTHONPATH="$folder/site" WEAVEFORM_INSIDE_BUILT=1
"$python" -m pytest -q -p no:cacheprovider "$here/test_inside.py" "$@"
