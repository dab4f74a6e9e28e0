#!/bin/sh
# SPDX-License-Identifier: MIT
# Plays the skull's slices into a live surface, 20 a second, as a scanner would; then takes some out
# and puts them in again. Watch it in a browser at the address that is shown. In a terminal it goes
# on showing the surface until Enter.
# Builds what that needs; installs missing Debian packages first.
#   sh samples/stream.sh [PORT]      8337 by default
set -eu
cd "$(dirname "$0")/.."
port=${1:-8337}

sh setup.sh npm
[ -f build/release/CMakeCache.txt ] && tests= || tests=-DLOFT_TESTS=OFF
cmake --preset release $tests
cmake --build --preset release -j "$(nproc)" --target loft edit_by_edit pulsating_vessel

loft=build/release/app/loft
out=build/samples
stack=samples/data/skull.ndjson
mkdir -p $out
rm -f $out/skull.session*

echo "== A capture, live"
# Line by line: what the scanner sends, then what an operator changes.
play() {
  while read -r line; do
    printf '%s\n' "$line"
    sleep 0.05
  done < $stack
  sed -n '10p;20p;30p' $stack | while read -r line; do
    z=$(printf '%s' "$line" | sed 's/.*"z": *\([-0-9.e]*\).*/\1/')
    printf '{"op": "remove", "z": %s}\n' "$z"
    sleep 0.2
    printf '%s\n' "$line"
    sleep 0.2
  done
  if [ -t 0 ]; then
    echo "The capture is complete. Press Enter to end." >&2
    read -r line
  fi
}
# At the end of its input it goes on serving; then it is told to end.
mkfifo $out/edits.$$
trap 'rm -f $out/edits.$$' EXIT
$loft stream $out/edits.$$ --view --port "$port" --session $out/skull.session -o $out/skull_live.glb \
  -o $out/skull_live.ply --replay $out/skull_replay.glb --json > $out/stream.json &
capture=$!
play > $out/edits.$$
sleep 3
kill -INT $capture
wait $capture
sed -n '/"latency_ms"/,/}/p' $out/stream.json

echo "== The same surface as from the whole stack"
$loft check $out/skull_live.ply --stack $stack
$loft session verify $out/skull.session

echo "== Programs that use the library"
build/release/samples/edit_by_edit $out/part.glb
build/release/samples/pulsating_vessel $out/vessel.glb

cat << END2

Done. In $PWD/$out are
  skull_live.glb, skull_live.ply    the surface
  skull_replay.glb                  how it came about: an animation for any glTF viewer
  skull.session                     every edit, in order
Next, try
  $loft session list $out/skull.session
  $loft stream --no-input --session $out/skull.session --view
  $loft stream --help
END2
