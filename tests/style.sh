#!/bin/sh
# SPDX-License-Identifier: MIT
# Checks the sources against .clang-format and .clang-tidy, and that each names what it needs.
#   sh tests/style.sh format         to repair: git ls-files '*.h' '*.cpp' | xargs clang-format -i
#   sh tests/style.sh tidy BUILD     BUILD is a folder for what it needs
#   sh tests/style.sh alone BUILD    every source and every header compiles by itself; with
#                                    ALONE_OF=K every K-th, others at another commit
#   sh tests/style.sh names          no two types of one namespace have one name
set -eu
cd "$(dirname "$0")/.."

# ours PATTERN FOLDERS...: the files to check; installed packages are not ours.
ours() {
  pattern=$1
  shift
  find "$@" -name node_modules -prune -o -name "$pattern" -print | LC_ALL=C sort
}
libraries="cdt overlay paths fields mesh reconstruct io"

# The binding of the Python module, where BUILD has it, and with which options.
binding=
with_python=
if [ -n "${2:-}" ] && grep -q '^LOFT_PYTHON:BOOL=ON' "$2/CMakeCache.txt" 2> /dev/null; then
  binding=python/binding
  interpreter=$(sed -n 's/^Python_EXECUTABLE:[A-Z]*=//p' "$2/CMakeCache.txt")
  with_python="-DLOFT_PYTHON=ON -DPython_EXECUTABLE=${interpreter:-/usr/bin/python3}"
fi

# The files that are compiled, in the order of a build: sources, and folders of them joined.
compiled() {
  sed -n 's/^ *"file": "\(.*\)",*$/\1/p' "$1/compile_commands.json"
}

# Our sources that no folder joins.
single() {
  compiled "$1" | grep '/Unity/' | xargs sed -n 's/^#include "\(.*\)"$/\1/p' > "$1/joined.txt"
  ours '*.cpp' $libraries app samples $binding | sed "s|^|$PWD/|" | grep -vxFf "$1/joined.txt"
}

# A header that is what its source includes first is compiled by itself with that.
untried_headers() {
  for header in $(ours '*.h' $libraries app samples $binding); do
    source=${header%.h}.cpp
    [ -f "$source" ] && grep -m 1 '^#include' "$source" | grep -qF "\"$header\"" || echo "$header"
  done
}

# The standard headers as one module, so that they are read once, and each shows only what it says.
standard_module() {
  folder=$(echo '#include <vector>' | clang++-16 -x c++ -M - | grep -m 1 -o '[^ ]*/vector')
  folder=${folder%/vector}
  echo 'module standard [system] {'
  grep -rhoE --include='*.h' --include='*.cpp' --exclude-dir=node_modules '^#include <[a-z_]+>' $libraries app samples $binding |
    sort -u | sed 's/.*<\(.*\)>/\1/' | grep -vx cassert | while read -r header; do
      [ ! -f "$folder/$header" ] || echo "  module _$header { header \"$folder/$header\" export * }"
    done
  echo '}'
}

# Every K-th line; which ones the commit decides.
turn() {
  commit=$(git rev-parse --short=6 HEAD 2> /dev/null || echo 0)
  awk -v of="${ALONE_OF:-1}" -v turn="$((0x$commit))" '(NR + turn) % of == 0'
}

# The types that headers define, with their namespaces: NAME HEADER.
types() {
  for header in $(ours '*.h' $libraries app); do
    awk '/^namespace / { space = $2 }
         /^(struct|class|enum class) [A-Za-z0-9]+( final)?( :.*)? [{]$/ {
           sub(/^enum /, ""); print space "::" $2, FILENAME }' "$header"
  done
}

case ${1:-} in
  format)
    { ours '*.h' $libraries app tests samples bench python
      ours '*.cpp' $libraries app tests samples bench python; } |
      xargs clang-format --dry-run -Werror
    ;;
  tidy)
    # Folders are joined as they are for building, so that headers are read once a folder.
    # What the flags of a build warn of is that build's concern.
    cmake -S . -B "$2/tidy" -G Ninja -DLOFT_UNITY=ON -DLOFT_TESTS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON $with_python > "$2/tidy.txt" ||
      { cat "$2/tidy.txt"; exit 1; }
    { compiled "$2/tidy" | grep '/Unity/'; single "$2/tidy"; } |
      xargs -n 1 -P "$(nproc)" clang-tidy-16 --quiet --extra-arg=-w -p "$2/tidy"
    ;;
  alone)
    mkdir -p "$2/alone"
    includes=
    [ -z "$binding" ] || includes="-isystem $("${interpreter:-/usr/bin/python3}" -c "import sysconfig; print(sysconfig.get_path('include'))")"
    standard_module > "$2/alone/modules.txt"
    { ours '*.cpp' $libraries app samples $binding; untried_headers; } | turn |
      xargs -n 4 -P "$(nproc)" clang++-16 -std=c++20 -DNDEBUG -fsyntax-only -w -I. $(pkg-config --cflags eigen3 cpp-httplib) $includes \
        -fmodules -fmodule-map-file="$2/alone/modules.txt" -fmodules-cache-path="$2/alone"
    ;;
  names)
    # The linker would take them for one, whatever they hold.
    twice=$(types | LC_ALL=C sort | awk '$1 == name { print $1 ": " header ", " $2 } { name = $1; header = $2 }')
    [ -z "$twice" ] || { echo "$twice"; exit 1; }
    ;;
  *)
    echo "usage: sh tests/style.sh format | tidy BUILD | alone BUILD | names" >&2
    exit 2
    ;;
esac
