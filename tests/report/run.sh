#!/bin/sh
# run.sh PROGRAM [OPTIONS]: reports written by PROGRAM, opened in headless Chromium; OPTIONS go to pytest. Exit code 77:
# skipped, what they cannot do without is not installed.
set -eu
python=/usr/bin/python3
[ -x $python ] || python=python3
here=$(cd "$(dirname "$0")" && pwd)
WEAVEFORM=$1
shift
for module in selenium pytest; do
  "$python" -c "import $module" 2>/dev/null || { echo "skipped: $python has no $module"; exit 77; }
done
for tool in chromium chromedriver; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
export WEAVEFORM PYTHONDONTWRITEBYTECODE=1 PYTHONNOUSERSITE=1
exec "$python" -m pytest -q -p no:cacheprovider "$here" "$@"
