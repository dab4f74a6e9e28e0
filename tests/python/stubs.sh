#!/bin/sh
# SPDX-License-Identifier: MIT
# The types that the package declares are consistent, and the stubs are of what the module has.
#   sh tests/python/stubs.sh PYTHON FOLDER CACHE
# FOLDER: where the source of the package is; PYTHONPATH: where it is built.
set -eu
mkdir -p "$3"; cd "$3"  # not where the source is: that has no module
MYPYPATH=$2 "$1" -m mypy --strict --cache-dir "$3" -p loft
allowed=$2/tests/stubtest.txt
MYPYPATH=$2 "$1" -m mypy.stubtest loft._loft $([ ! -f "$allowed" ] || echo --allowlist "$allowed")
