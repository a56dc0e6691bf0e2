#!/bin/sh
# pack.sh: rebuilds packed/ (report.js, report.css, LICENSES.txt) from src/, and core/chart/echarts/packed from its sources, with
# the versions that package-lock.json names, and prints the sizes. Needs npm and, for what is not in its cache, the npm registry; the same sources give the same bytes.
set -eu
cd "$(dirname "$0")"
npm ci --no-audit --no-fund --loglevel=error >&2
npm run --silent build
wc -c packed/report.js packed/report.css packed/LICENSES.txt ../../../core/chart/echarts/packed/draw_charts.js
