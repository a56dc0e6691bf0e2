# Read in by the test scripts: Debian's own python3, for which its packages (python3-vtk9, ...) are, and what to do without.
# CTest takes the exit code 77 as skipped.
python=/usr/bin/python3
[ -x $python ] || python=python3
export PYTHONDONTWRITEBYTECODE=1 PYTHONNOUSERSITE=1
skip() { echo "skipped: $*"; exit 77; }
need_modules() { for module; do "$python" -c "import $module" 2>/dev/null || skip "$python has no $module"; done; }
need_programs() { for program; do command -v "$program" >/dev/null || skip "no $program"; done; }
