#!/bin/sh
# SPDX-License-Identifier: MIT
# Compares loft::paths with Detour on the same triangles and queries, in turn, and prints a table of
# medians.
#   sh bench/paths.sh HARNESS_DIR WORKLOAD_DIR [RUNS]      3 runs by default
# HARNESS_DIR holds the program path_detour, WORKLOAD_DIR for each map NAME.mesh, NAME.scen and
# NAME.ref; see bench/README.md. Every line that a program printed is kept in build/bench/paths.log.
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
cmake --build build/bench --target paths_workload > /dev/null
loft=build/bench/bench/paths_workload

log=build/bench/paths.log
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
  for scenario in "$workloads"/*.scen; do
    name=$(basename "$scenario" .scen)
    [ -f "$workloads/$name.ref" ] || continue
    set -- "$workloads/$name.mesh" "$scenario" "$workloads/$name.ref"
    run "$name" "$harness/path_detour" "$@"
    run "$name" "$loft" queries "$@"
    run "$name" "$loft" unreachable "$1" "$2"
  done
  run obstacles "$loft" move 1000 5000
  run gaps "$loft" move 1000 5000 gaps
done

# Lines: `MAP detour: N queries, median X us, p99 X us, mean X us; ... 0.1%: N of N`,
# `MAP shortest|channel median=X mean=X p99=X us; ... longer=N of N, none=N`,
# `MAP unreachable ... times=X; ...`, `obstacles|gaps step|jump median=X p99=X us; ...`.
awk '
function median(key,   values, count, i, j, value) {
  count = split(all[key], values, " ")
  for (i = 2; i <= count; i++) {
    value = values[i]
    for (j = i - 1; j > 0 && values[j] + 0 > value + 0; j--) values[j + 1] = values[j]
    values[j + 1] = value
  }
  return count == 0 ? "" : (values[int((count + 1) / 2)] + values[int(count / 2) + 1]) / 2
}
function after(word,   at) {
  at = index($0, word)
  return at == 0 ? "" : substr($0, at + length(word)) + 0
}
function note(key, value) { all[key] = all[key] " " value + 0 }
function or_dash(value, format) { return value == "" ? "-" : sprintf(format, value) }
function ratio(value, peer) { return peer == "" ? "-" : sprintf("%.3f", value / peer) }
!($1 in known) { known[$1] = 1; if ($1 != "obstacles" && $1 != "gaps") names[++maps] = $1 }
$2 == "detour:" && /queries/ { note($1 " peer", after(", mean ")); note($1 " peer longer", after("0.1%: ")) }
$2 == "shortest" || $2 == "channel" {
  note($1 " " $2, after("mean="))
  note($1 " " $2 " longer", after("longer="))
  note($1 " " $2 " worst", after("worst="))
}
$2 == "unreachable" { note($1 " unreachable", after("times=")) }
$1 == "obstacles" || $1 == "gaps" { note($1 " " $2, after("median=")); note($1 " " $2 " p99", after("p99=")) }
function moves(of, title) {
  printf "%s: median %.1f, p99 %.1f us; is somewhere else: %.1f, %.1f us\n", title, median(of " step"), median(of " step p99"), median(of " jump"), median(of " jump p99")
}
END {
  printf "%-18s %9s %9s %7s %9s %7s %8s %8s %8s %6s\n", "mean, us a query", "Detour", "shortest", "ratio", "channel", "ratio", "longer:", "Detour", "channel", "none*"
  for (m = 1; m <= maps; m++) {
    name = names[m]
    peer = median(name " peer")
    printf "%-18s %9s %9.2f %7s %9.2f %7s %8s %8s %8d %6.2f\n", name, or_dash(peer, "%.2f"), median(name " shortest"), ratio(median(name " shortest"), peer), median(name " channel"), ratio(median(name " channel"), peer), "", or_dash(median(name " peer longer"), "%d"), median(name " channel longer"), median(name " unreachable")
  }
  print "longer: than the shortest by 0.1 %; none*: no way leads there, in times of locating a point"
  moves("obstacles", "one of 1,000 obstacles moves a step")
  moves("gaps", "the same, gaps kept for discs")
}' "$log"
