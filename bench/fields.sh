#!/bin/sh
# SPDX-License-Identifier: MIT
# Compares loft::fields with scipy and matplotlib on the same samples, in turn (Debian: python3-scipy,
# python3-matplotlib).
#   sh bench/fields.sh [SAMPLES] [RUNS] [HARNESS_DIR]      100000 samples, 3 runs by default
# HARNESS_DIR holds the program interpolate_cgal, if that is to be compared, too; see
# bench/README.md.
set -eu
samples=${1:-100000}
runs=${2:-3}
harness=
if [ $# -gt 2 ]; then harness=$(cd "$3" && pwd); fi
cd "$(dirname "$0")/.."

sh setup.sh bench
cmake --preset release -B build/bench -DLOFT_BENCH=ON -DLOFT_TESTS=OFF -DLOFT_SAMPLES=OFF > /dev/null
cmake --build build/bench --target fields_workload > /dev/null
loft=build/bench/bench/fields_workload
folder=build/bench/fields_samples
mkdir -p "$folder"
"$loft" make "$samples" "$folder"
# CGAL's program takes these, whatever was asked for.
if [ -n "$harness" ]; then
  for count in 1000 10000 100000; do "$loft" make "$count" "$folder"; done
fi

round=0
while [ "$round" -lt "$runs" ]; do
  round=$((round + 1))
  echo "Round $round of $runs"
  "$loft" ask "$samples"
  /usr/bin/python3 bench/fields_peers.py "$samples" "$folder"
  if [ -n "$harness" ]; then "$harness/interpolate_cgal" "$folder"; fi
  "$loft" move "$samples"
  "$loft" raster "$samples"
done
