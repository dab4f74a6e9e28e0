#!/bin/sh
# SPDX-License-Identifier: MIT
# Tests the viewer and the live page in Debian's Chromium. Installs what is missing first; LOFT names
# another program than that of build/release.
#   sh tests/viewer/run.sh [TEST...]
set -eu
cd "$(dirname "$0")"

[ -x "${CHROMIUM:-/usr/bin/chromium}" ] || sh ../../setup.sh tests
if [ ! node_modules/.package-lock.json -nt package-lock.json ]; then
  npm ci --no-audit --no-fund
fi
export LOFT="${LOFT:-$PWD/../../build/release/app/loft}"
[ $# -gt 0 ] || set -- viewer_test.mjs labels_test.mjs many_slabs_test.mjs contours_test.mjs cut_test.mjs measure_test.mjs live_test.mjs
for test; do node --test "$test"; done
