#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes a wheel that carries its libraries, for Linux systems with this one's C library or a newer
# one: pip install it where nothing but numpy is.
#   sh python/wheel.sh [BUILD [FOLDER]]
# BUILD: a build folder with LOFT_PYTHON=ON; by default one is made. FOLDER: build/wheel by default.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/python/wheel}
folder=${2:-build/wheel}
export PYTHONPATH=python/backend PYTHONDONTWRITEBYTECODE=1
python=${PYTHON:-$(sed -n 's/^Python_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt" 2> /dev/null || true)}
python=${python:-/usr/bin/python3}

if ! command -v patchelf > /dev/null || ! command -v ldd > /dev/null; then
  echo "wheel.sh: patchelf is needed: apt-get install patchelf" >&2
  exit 1
fi
if [ ! -f "$build/CMakeCache.txt" ]; then
  "$python" -c "import loft_backend, sys; loft_backend.configure(sys.argv[1])" "$build"
fi
cmake --build "$build" --target loft_python --parallel "$(nproc)"
"$python" python/backend/carry.py "$build" "$folder"
