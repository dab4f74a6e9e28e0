#!/bin/sh
# SPDX-License-Identifier: MIT
# Time and peak memory of `loft reconstruct` for 10^3 to 10^7 contour vertices, as a table:
#   sh bench/scaling.sh [LARGEST]
# The largest stack and its surface need 2.5 GB of disk and 4 GB of memory for a while.
set -eu
cd "$(dirname "$0")/.."
sh setup.sh bench
cmake --preset release -B build/bench -DLOFT_BENCH=ON -DLOFT_TESTS=OFF -DLOFT_SAMPLES=OFF > /dev/null
cmake --build build/bench --target loft scaling > build/bench/build.log
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/bench/bench/scaling build/bench/app/loft "$folder" "$@"
