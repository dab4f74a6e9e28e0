#!/bin/sh
# SPDX-License-Identifier: MIT
# Fuzzes the editing of triangulations, every reader and surfaces of small stacks with libFuzzer.
# Installs missing Debian packages first.
#   sh tests/fuzz.sh [SECONDS [SEED [TARGET...]]]
# SECONDS, 60 by default, are shared by the targets; another SEED each time. A TARGET is the name of
# a folder in tests/fuzz/corpus; all by default.
# A finding is printed, its bytes are kept in build/fuzz/findings. Put them in the target's corpus,
# under a name that says what it is, when it is mended. Exit code 0 only if nothing was found.
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-60}
seed=${2:-0}  # 0: drawn by libFuzzer, which prints it
[ $# -gt 2 ] && shift 2 || set -- $(ls tests/fuzz/corpus)

sh setup.sh fuzz
cmake --preset fuzz -DLOFT_TESTS=ON -DLOFT_SAMPLES=OFF
cmake --build --preset fuzz --target $(printf 'fuzz_%s ' "$@")

share=$((seconds / $#))
[ "$share" -gt 0 ] || share=1
found=0
for target in "$@"; do
  echo "== $target, $share s"
  # Inputs that reach something new are kept from run to run in the first folder.
  mkdir -p "build/fuzz/seen/$target" build/fuzz/findings
  build/fuzz/tests/fuzz_"$target" -max_total_time="$share" -seed="$seed" -max_len=4096 \
    -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=1024 -verbosity=1 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/findings/$target-" \
    "build/fuzz/seen/$target" "tests/fuzz/corpus/$target" ||
    { found=1; echo "$target: found something"; }
done
exit $found
