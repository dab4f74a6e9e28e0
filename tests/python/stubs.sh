#!/bin/sh
# SPDX-License-Identifier: MIT
# The types that the package declares are consistent, and those of the stubs are what is there.
#   sh tests/python/stubs.sh PYTHON FOLDER CACHE
# FOLDER: where the source of the package is; PYTHONPATH: where it is built.
set -eu
cd "$2"
MYPYPATH=$2 "$1" -m mypy --strict --cache-dir "$3" loft
MYPYPATH=$2 "$1" -m mypy.stubtest loft
