#!/bin/sh
# SPDX-License-Identifier: MIT
# Compares loft::cdt with CGAL on the same workloads, in turn, and prints a table of medians.
#   sh bench/compare.sh HARNESS_DIR WORKLOAD_DIR [RUNS]      3 runs by default
# HARNESS_DIR holds cgal_cdt.cpp, or the programs made of it; see bench/README.md.
# Every line that a program printed is kept in build/bench/compare.log.
set -eu
if [ $# -lt 2 ]; then
  sed -n 's/^#   //p' "$0" >&2
  exit 2
fi
harness=$(cd "$1" && pwd)
workloads=$(cd "$2" && pwd)
runs=${3:-3}
cd "$(dirname "$0")/.."

# --- The programs ---

sh setup.sh bench
cmake --preset release -B build/bench -DLOFT_BENCH=ON -DLOFT_TESTS=OFF -DLOFT_SAMPLES=OFF > /dev/null
cmake --build build/bench --target cdt_workload > /dev/null
loft=build/bench/bench/cdt_workload

temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
trap 'exit 130' INT TERM

# peer NAME FLAGS...: the path of a harness program, which is compiled if it is not there.
peer() {
  name=$1
  shift
  if [ -x "$harness/$name" ]; then
    echo "$harness/$name"
    return
  fi
  echo "Compiling $name" >&2
  g++ -std=c++17 -O2 -march=native -ffp-contract=off -DNDEBUG "$@" \
    "$harness/cgal_cdt.cpp" -o "$temporary/$name" -lgmp -lmpfr
  echo "$temporary/$name"
}
plus=$(peer cgal_plus -DPLUS=1)
plain=$(peer cgal_cdt -DPLUS=0)
hier=$(peer cgal_hier -DPLUS=1 -DHIER=1)

# --- The runs ---

log=build/bench/compare.log
: > "$log"

# run ROW SIDE PROGRAM MODE WORKLOAD ARGUMENTS...: keeps what it prints as `ROW SIDE line`.
# A workload is known by what its name begins with, up to a full stop or an underscore.
run() {
  row=$1
  side=$2
  program=$3
  mode=$4
  file=$workloads/$5.txt
  [ -f "$file" ] || file=$(echo "$workloads/$5"_*.txt)
  shift 5
  { "$program" "$mode" "$file" "$@" 2>&1 || echo "failed"; } | sed "s|^|$row $side |" >> "$log"
}

# both ROW PEER MODE WORKLOAD ARGUMENTS...: the same for CGAL and for us.
both() {
  row=$1
  program=$2
  shift 2
  run "$row" peer "$program" "$@"
  run "$row" loft "$loft" "$@"
}

round=0
while [ "$round" -lt "$runs" ]; do
  round=$((round + 1))
  echo "Round $round of $runs" >&2
  both build-w1 "$plus" build w1 5
  both build-w2s "$plus" build w2s 3
  both build-w2 "$plus" build w2 1
  for workload in w5b w4; do
    run "batch-$workload" peer "$plus" seg "$workload" 3
    run "batch-$workload" loft "$loft" batch "$workload" 3
    run "batch-$workload" online "$loft" build "$workload" 3
  done
  both batch-w3b "$plain" batch w3b 1
  both D1 "$plus" move w2 1455 200 0.002 0.001 2
  run D1 step "$loft" step w2 1455 200 0.0002 0.0001
  both D2 "$plus" move w1 17 500 0.0002 0.0001 2
  run D2 step "$loft" step w1 17 500 0.00002 0.00001
  both D3-w2s "$plus" all w2s 2
  run D3-w2 loft "$loft" all w2 2  # CGAL's crashes
  both D4-w3b "$hier" poly6 w3b 1000 1
  both D4-w3a "$hier" poly6 w3a 1000 1
done
for workload in r1 r2 r3 r4 r5 r6 r7 r8; do
  both "check-$workload" "$plus" check "$workload"
done

# --- The table ---

awk '
# The number in text behind each of the words in turn (separated by >); empty if they are not there.
function number(text, words,   word, count, i, at) {
  count = split(words, word, ">")
  for (i = 1; i <= count; i++) {
    at = index(text, word[i])
    if (at == 0) return ""
    text = substr(text, at + length(word[i]))
  }
  return text + 0
}
# What one line says: a number, or bytes per vertex.
function measured(text, words) {
  if (words != "memory") return number(text, words)
  if (index(text, "mem=") == 0) return ""
  return number(text, "mem=") * 1048576 / number(text, "nv=")
}
function median(row, side, words,   key, values, count, i, j, value) {
  key = row " " side
  count = 0
  for (i = 1; i <= lines[key]; i++) {
    value = measured(line[key, i], words)
    if (value == "") continue
    for (j = count++; j > 0 && values[j] > value; j--) values[j + 1] = values[j]
    values[j + 1] = value
  }
  if (count == 0) return ""
  return (values[int((count + 1) / 2)] + values[int(count / 2) + 1]) / 2
}
function shown(value) { return value == "" ? "-" : sprintf(value < 100 ? "%.2f" : "%.0f", value) }
function compare(title, row, side, words, our_side, our_words,   theirs, ours, ratio) {
  theirs = side == "" ? "" : median(row, side, words)
  ours = median(row, our_side, our_words)
  ratio = theirs == "" || ours == "" || theirs == 0 ? "" : ours / theirs
  printf "%-46s %10s %10s %7s\n", title, shown(theirs), shown(ours),
    ratio == "" ? "-" : sprintf("%.2f", ratio)
}
function with_peer(title, row, words) { compare(title, row, "peer", words, "loft", words) }
function remove_insert(title, row, remove, insert) {
  with_peer(title ", remove", row, remove)
  with_peer(title ", insert", row, insert)
}
function bad(row, side,   text) {
  text = line[row " " side, 1]
  if (index(text, "verify") == 0) return "failed"
  return number(text, "nv=") " " number(text, "bad_orient=") + number(text, "non_delaunay=") + \
    number(text, "nonmanifold=") + number(text, "constrained_edges_not_in_mesh=") " " \
    number(text, "uncovered_input_segments=")
}
{
  key = $1 " " $2
  line[key, ++lines[key]] = substr($0, length(key) + 2)
}
END {
  printf "%-46s %10s %10s %7s\n", "median", "CGAL", "loft", "ratio"
  with_peer("w1 online, ms (CDT+2)", "build-w1", "median=")
  with_peer("w2s online, ms (CDT+2)", "build-w2s", "median=")
  with_peer("w2 online, ms (CDT+2)", "build-w2", "median=")
  with_peer("w5b batch, ms (CDT+2 without polylines)", "batch-w5b", "median=")
  with_peer("w4 batch, ms (CDT+2 without polylines)", "batch-w4", "median=")
  with_peer("w3b batch, ms (CDT)", "batch-w3b", "median=")
  with_peer("w2 memory, bytes a vertex (CDT+2)", "build-w2", "memory")
  remove_insert("D1 w2 island moves, us", "D1", "remove >med=", "insert >med=")
  remove_insert("D2 w1 hexagon moves, us", "D2", "remove >med=", "insert >med=")
  remove_insert("D3 w2s all once, us a vertex", "D3-w2s", "remove >(", "insert >(")
  remove_insert("D3 w2 all once, us a vertex", "D3-w2", "remove >(", "insert >(")
  remove_insert("D4 w3b hexagons, us (CDT+2, hierarchy)", "D4-w3b", "remove >med=", "insert >med=")
  remove_insert("D4 w3a hexagons, us (CDT+2, hierarchy)", "D4-w3a", "remove >med=", "insert >med=")

  printf "\n%-46s %10s %10s %7s\n", "loft in two ways, median", "one", "other", "ratio"
  compare("w5b online and batch, ms", "batch-w5b", "online", "median=", "loft", "median=")
  compare("w4 online and batch, ms", "batch-w4", "online", "median=", "loft", "median=")
  compare("D1 remove and insert, and translate, us", "D1", "step", "remove+insert med=", "step",
    "translate med=")
  compare("D2 remove and insert, and translate, us", "D2", "step", "remove+insert med=", "step",
    "translate med=")

  printf "\n%-46s %20s %20s\n", "check: vertices, faults, uncovered segments", "CGAL", "loft"
  for (r = 1; r <= 8; r++)
    printf "%-46s %20s %20s\n", "r" r " (" line["check-r" r " loft", 2] ")", bad("check-r" r, "peer"),
      bad("check-r" r, "loft")

  print "\nafter the edits, compared with a fresh build"
  split("D1 D2 D3-w2s D3-w2", rows, " ")
  for (r = 1; r <= 4; r++)
    for (i = 1; i <= 3; i++)
      if (i > 1 && line[rows[r] " loft", i] != "") print rows[r] ": " line[rows[r] " loft", i]
}' "$log"
