#!/bin/sh
# SPDX-License-Identifier: MIT
# Fuzzes the editing of triangulations with libFuzzer. Installs missing Debian packages first.
#   sh tests/fuzz.sh [SECONDS [SEED]]      60 by default; another seed each time
# A finding is printed as a script of edits, its bytes are kept in build/fuzz/findings. Put them in
# tests/fuzz/corpus/cdt_edits when it is mended. Exit code 0 only if nothing was found.
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-60}
seed=${2:-0}  # 0: drawn by libFuzzer, which prints it

sh setup.sh fuzz
cmake --preset fuzz -DLOFT_TESTS=ON -DLOFT_SAMPLES=OFF
cmake --build --preset fuzz --target fuzz_cdt_edits

# Inputs that reach something new are kept from run to run in the first folder.
mkdir -p build/fuzz/seen/cdt_edits build/fuzz/findings
build/fuzz/tests/fuzz_cdt_edits -max_total_time="$seconds" -seed="$seed" -max_len=400 -timeout=20 \
  -print_final_stats=1 -artifact_prefix=build/fuzz/findings/ \
  build/fuzz/seen/cdt_edits tests/fuzz/corpus/cdt_edits
