#!/bin/sh
# SPDX-License-Identifier: MIT
# Checks the sources against .clang-format and .clang-tidy.
#   sh tests/style.sh format         to repair: git ls-files '*.h' '*.cpp' | xargs clang-format -i
#   sh tests/style.sh tidy BUILD     BUILD is a folder for what it needs
set -eu
cd "$(dirname "$0")/.."

# ours PATTERN FOLDERS...: the files to check; installed packages are not ours.
ours() {
  pattern=$1
  shift
  find "$@" -name node_modules -prune -o -name "$pattern" -print | LC_ALL=C sort
}

case ${1:-} in
  format)
    { ours '*.h' cdt overlay paths mesh reconstruct io app tests samples bench
      ours '*.cpp' cdt overlay paths mesh reconstruct io app tests samples bench; } |
      xargs clang-format --dry-run -Werror
    ;;
  tidy)
    # Each file by itself: it must include what it needs.
    cmake -S . -B "$2/tidy" -G Ninja -DLOFT_UNITY=OFF -DLOFT_TESTS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON > "$2/tidy.txt" ||
      { cat "$2/tidy.txt"; exit 1; }
    ours '*.cpp' cdt overlay paths mesh reconstruct io app samples |
      xargs -n 1 -P "$(nproc)" clang-tidy-16 --quiet -p "$2/tidy"
    ;;
  *)
    echo "usage: sh tests/style.sh format | tidy BUILD" >&2
    exit 2
    ;;
esac
