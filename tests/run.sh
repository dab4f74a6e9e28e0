#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds everything and runs the tests. Installs missing Debian packages first.
#   sh tests/run.sh [PRESET]     release (default), dev, asan, tsan or fuzz: see CMakePresets.json
# Ends with a line `N passed, N failed`; exit code 0 only if all passed.
set -eu
cd "$(dirname "$0")/.."
preset=${1:-release}

[ "$preset" = fuzz ] && sh setup.sh fuzz || sh setup.sh tests
if [ ! tests/io/node_modules/.package-lock.json -nt tests/io/package-lock.json ]; then
  npm ci --prefix tests/io --no-audit --no-fund
fi

# The interpreter whose packages were just installed, whatever others there are.
python=/usr/bin/python3
[ -x "$python" ] || python=$(command -v python3)
# ThreadSanitizer cannot be loaded into a program that was built without it.
[ "$preset" = tsan ] && with_python=OFF || with_python=ON

cmake --preset "$preset" -DLOFT_TESTS=ON -DLOFT_PYTHON="$with_python" -DPython_EXECUTABLE="$python"
cmake --build --preset "$preset" -j "$(nproc)"

results=build/$preset/tests.xml
rm -f "$results"
outcome=0
ctest --preset "$preset" -j "$(nproc)" --output-junit "$PWD/$results" || outcome=$?

if [ ! -f "$results" ]; then
  echo "0 passed, 1 failed"
  exit 1
fi

# The first element of the report: <testsuite ... tests="12" failures="1" skipped="0" ...>
count() { sed -n "s/^[[:space:]]*$1=\"\([0-9]*\)\".*/\1/p" "$results" | head -n 1; }
failed=$(count failures)
echo "$(($(count tests) - failed - $(count skipped))) passed, $failed failed"
exit "$outcome"
