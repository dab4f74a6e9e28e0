#!/bin/sh
# SPDX-License-Identifier: MIT
# Compares loft::overlay with Clipper 6.4.2, GEOS, Boost.Polygon and CGAL on the same workloads, in
# turn, and prints a table of medians.
#   sh bench/overlay.sh HARNESS_DIR WORKLOAD_DIR [RUNS]      3 runs by default
# HARNESS_DIR holds the programs bool_clipper1 and gis_geos, and of bool_geos, bool_boost and
# bool_cgal those that are to be in the table; see bench/README.md.
# Every line that a program printed is kept in build/bench/overlay.log.
set -eu
if [ $# -lt 2 ]; then
  sed -n 's/^#   //p' "$0" >&2
  exit 2
fi
harness=$(cd "$1" && pwd)
workloads=$(cd "$2" && pwd)
runs=${3:-3}
cd "$(dirname "$0")/.."

sh setup.sh bench
cmake --preset release -B build/bench -DLOFT_BENCH=ON -DLOFT_TESTS=OFF -DLOFT_SAMPLES=OFF > /dev/null
cmake --build build/bench --target overlay_workload > /dev/null
loft=build/bench/bench/overlay_workload

log=build/bench/overlay.log
: > "$log"
# run ROW PROGRAM ARGUMENTS...: keeps what it prints as `ROW line`.
run() {
  row=$1
  shift
  { "$@" 2>&1 || echo "failed"; } | sed "s|^|$row |" >> "$log"
}

round=0
while [ "$round" -lt "$runs" ]; do
  round=$((round + 1))
  echo "Round $round of $runs" >&2
  run clipper "$harness/bool_clipper1" "$workloads"
  for peer in boost cgal geos; do
    [ -x "$harness/bool_$peer" ] || continue
    run "$peer" "$harness/bool_$peer" "$workloads"
  done
  for name in discs_1000 discs_10000 grid_100; do
    run "loft-$name-union" "$loft" union "$workloads/$name.txt" 3
  done
  for name in layer_1000 layer_5000; do
    run "loft-$name-four" "$loft" four "$workloads/${name}_a.txt" "$workloads/${name}_b.txt" 3
  done
  for name in soup_200 soup_500 soup_1000; do
    run "loft-$name-and" "$loft" and "$workloads/${name}_a.txt" "$workloads/${name}_b.txt" 5
  done
  run loft-move "$loft" move "$workloads/discs_2000.txt" 17 400 300 100
  for map in 50m 10m; do
    [ -f "$workloads/world_$map.rings" ] || continue
    run "geos-$map" "$harness/gis_geos" "$workloads" "$map"
    set -- "$workloads/world_$map.rings" "$workloads/world_$map.names"
    run "loft-$map-map" "$loft" map "$@" 3
    run "loft-$map-points" "$loft" points "$@" "$workloads/points_100000.xy"
    run "loft-$map-lines" "$loft" lines "$@" "$workloads/rivers_500.txt"
  done
done

# A line of a peer: `peer version workload what N ms ...`, whose name may have several words; of
# ours: `... median=N ...`.
awk '
function median(key,   values, count, i, j, value) {
  count = split(times[key], values, " ")
  for (i = 2; i <= count; i++) {
    value = values[i]
    for (j = i - 1; j > 0 && values[j] + 0 > value + 0; j--) values[j + 1] = values[j]
    values[j + 1] = value
  }
  return count == 0 ? "" : (values[int((count + 1) / 2)] + values[int(count / 2) + 1]) / 2
}
function note(key, value) { times[key] = times[key] " " value + 0 }
function compare(title, theirs, ours, scale,   a, b) {
  a = median(theirs)
  b = median(ours)
  if (a == "" || b == "") return
  printf "%-52s %12.3f %12.3f %8.4f\n", title, a, b * scale, b * scale / a
}
# One row for each peer that was run on this workload.
function compare_all(title, work, ours, scale,   i) {
  for (i = 1; i <= 4; i++) compare(title " (" names[i] ")", peers[i] " " work, ours, scale)
}
BEGIN {
  split("clipper boost cgal geos", peers, " ")
  split("Clipper 6.4.2,Boost.Polygon,CGAL,GEOS", names, ",")
}
{
  row = $1
  if (row ~ /^(clipper|boost|cgal|geos)$/) {
    work = ""
    for (i = 3; i <= NF; i++) {
      if (work == "" && $i ~ /^(discs|grid|layer|soup)_/) work = $i " " $(i + 1)
      if ($i == "ms") { note(row " " work, $(i - 1)); break }
    }
  } else if (row ~ /^geos-/ && / ms /) {
    map = substr(row, 6)
    for (i = 5; i <= NF; i++) if ($i == "ms") { words = $5; for (j = 6; j < i - 1; j++) words = words " " $j; note("geos " map " " words, $(i - 1)) }
  } else if (match($0, /median=[0-9.]+/)) note(row, substr($0, RSTART + 7, RLENGTH - 7))
}
END {
  printf "%-52s %12s %12s %8s\n", "median, ms", "peer", "loft", "ratio"
  compare_all("discs_1000, union", "discs_1000 union", "loft-discs_1000-union", 1)
  compare_all("discs_10000, union", "discs_10000 union", "loft-discs_10000-union", 1)
  compare_all("grid_100, union", "grid_100 union", "loft-grid_100-union", 1)
  split("1000 5000", sizes, " ")
  for (m = 1; m <= 2; m++) {
    work = "layer_" sizes[m]
    compare_all(work ", four operations against one", work " intersect", "loft-" work "-four", 1)
  }
  split("200 500 1000", sizes, " ")
  for (m = 1; m <= 3; m++) {
    work = "soup_" sizes[m]
    compare_all(work ", and", work " intersect", "loft-" work "-and", 1)
  }
  compare_all("one of discs_2000 moves", "discs_2000 move", "loft-move", 0.001)
  split("50m 10m", maps, " ")
  for (m = 1; m <= 2; m++) {
    compare("world " maps[m] ", owners, faults, borders (GEOS, dissolve)", "geos " maps[m] " dissolve", "loft-" maps[m] "-map", 1)
    compare("world " maps[m] ", 100,000 points (GEOS)", "geos " maps[m] " 100k points", "loft-" maps[m] "-points", 1)
    compare("world " maps[m] ", 500 lines (GEOS)", "geos " maps[m] " 500 rivers", "loft-" maps[m] "-lines", 1)
  }
}' "$log"
