#!/bin/sh
# run.sh PROGRAM [OPTIONS]: reports written by PROGRAM, opened in headless Chromium; OPTIONS go to pytest. Exit code 77:
# skipped, what they cannot do without is not installed.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../support/debian_python.sh"
WEAVEFORM=$1
shift
need_modules selenium pytest
need_programs chromium chromedriver
export WEAVEFORM
exec "$python" -m pytest -q -p no:cacheprovider "$here" "$@"
