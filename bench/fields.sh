#!/bin/sh
# SPDX-License-Identifier: MIT
# Compares loft::fields with scipy and matplotlib on the same samples, in turn (Debian: python3-scipy,
# python3-matplotlib).
#   sh bench/fields.sh [SAMPLES] [RUNS]      100000 samples, 3 runs by default
set -eu
samples=${1:-100000}
runs=${2:-3}
cd "$(dirname "$0")/.."

sh setup.sh bench
cmake --preset release -B build/bench -DLOFT_BENCH=ON -DLOFT_TESTS=OFF -DLOFT_SAMPLES=OFF > /dev/null
cmake --build build/bench --target fields_workload > /dev/null
loft=build/bench/bench/fields_workload
"$loft" make "$samples" build/bench

round=0
while [ "$round" -lt "$runs" ]; do
  round=$((round + 1))
  echo "Round $round of $runs"
  "$loft" ask "$samples"
  /usr/bin/python3 bench/fields_peers.py build/bench
  "$loft" move "$samples"
  "$loft" raster "$samples"
done
