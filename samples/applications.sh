#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws what the triangulation is used for besides surfaces: a gasket whose hole moves, an island that
# is dragged over a border, the ways of discs through a town, of agents among polygons, and of one
# agent through a room whose boxes move.
# Builds what that needs; installs missing Debian packages first, fetches the map with npm.
set -eu
cd "$(dirname "$0")/.."

sh setup.sh npm
if [ ! samples/world/node_modules/.package-lock.json -nt samples/world/package-lock.json ]; then
  npm ci --prefix samples/world --no-audit --no-fund
fi
# A first build leaves the tests out; one that has them keeps them.
[ -f build/release/CMakeCache.txt ] && tests= || tests=-DLOFT_TESTS=OFF
cmake --preset release $tests
cmake --build --preset release -j "$(nproc)" --target loft agents gasket island room town

loft=build/release/app/loft
out=build/samples
mkdir -p $out

echo "== A gasket as a tree of operations, and one of its holes moves"
build/release/samples/gasket $out/gasket.svg

echo "== Sicily is dragged over the border of Tunisia and Algeria"
node samples/world/world.mjs 10m > $out/world_10m.geojson
build/release/samples/island $out/world_10m.geojson $out/island.svg

echo "== Ways through a town, for a point and two discs; 40 agents among polygons"
build/release/samples/town $out/town.svg
build/release/samples/agents $out/agents.svg

echo "== An agent goes through a room whose boxes move, and finds other ways"
build/release/samples/room $out/room.svg

echo "== Where the countries of the map overlap already, and where they leave gaps"
$loft coverage $out/world_10m.geojson --gap-width 0.01 -o $out/world_faults.csv > $out/world_faults.txt
tail -n 1 $out/world_faults.txt

cat << END

Done. The pictures are
  $PWD/$out/gasket.svg       for any browser
  $PWD/$out/island.svg
  $PWD/$out/town.svg
  $PWD/$out/agents.svg
  $PWD/$out/room.svg
and the table of overlaps and gaps is $PWD/$out/world_faults.csv. Next, try
  $loft overlay --help
  $loft query $out/world_10m.geojson --points points.csv
  $loft path $out/world_10m.geojson --from 13,39 --to 14,36 -o way.svg
END
