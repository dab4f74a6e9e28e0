#!/bin/sh
# SPDX-License-Identifier: MIT
# Checks that the layers include each other in one direction only, app -> io -> reconstruct -> cdt,
# and that the lower ones keep away from the world outside.
#   sh tests/layers.sh [ROOT]
# Prints every #include line that should not be there; exit code 1 if there is one.
set -u
cd "${1:-$(dirname "$0")/..}" || exit 2

# All #include lines of a folder, as file:line:#include "header", without blanks.
includes() {
  grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.h' --include='*.cpp' "$@" |
    sed 's/[[:space:]]//g'
}

# forbid FOLDER HEADERS: no file in FOLDER may include what matches HEADERS.
forbid() {
  includes "$1" | grep -E "#include[\"<](loft/)?($2)"
}

offenders=$(
  # cdt stands alone: standard headers (neither slash nor dot in their names) and its own.
  includes cdt | grep -vE '#include("cdt/[a-z_]+\.h"|<[a-z_0-9]+>)'
  forbid cdt '(fstream|filesystem|iostream|chrono|thread|mutex)>'

  forbid reconstruct '(io|app|tests|samples|bench)/'
  forbid reconstruct '(fstream|filesystem|iostream|chrono)>|nlohmann|tiny_gltf|CLI'

  forbid io '(app|tests|samples|bench)/|chrono>|CLI'
  forbid app '(tests|samples|bench)/|tiny_gltf'

  # Our own headers are named from the root of the project, so that their layer can be seen.
  includes cdt reconstruct io app tests samples bench |
    grep '#include"' | grep -vE '#include"(cdt|reconstruct|io|app|tests|bench)/'
)
if [ -n "$offenders" ]; then
  echo "These lines include what their layer must not know (app -> io -> reconstruct -> cdt):"
  echo "$offenders" | sort -u
  exit 1
fi
echo "The layers are kept."
