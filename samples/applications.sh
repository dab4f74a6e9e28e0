#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws what the triangulation is and what it is used for: the figures of the paper that it follows, a
# gasket whose hole moves, an island that is dragged over a border, the ways of discs through a town, of
# agents among polygons, and of one agent through a room whose boxes move, a valley from
# samples, and people in classes.
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
cmake --build --preset release -j "$(nproc)" --target \
  loft agents classes figures gasket island moving_agents moving_shapes room skull_slices terrain town

loft=build/release/app/loft
out=build/samples
mkdir -p $out

echo "== Constraints of all kinds, one that is removed, a rectangle that passes two triangles"
build/release/samples/figures $out

echo "== A star that is moved over shapes that overlap, forty agents on their ways"
build/release/samples/moving_shapes $out/figure_6_shapes.svg
build/release/samples/moving_agents $out/figure_6_agents.svg

echo "== 960 hexagons, contours of a skull, the countries of the world"
node samples/hexagons.mjs > $out/hexagons.txt
$loft triangulate $out/hexagons.txt -o $out/figure_7a.svg
build/release/samples/skull_slices samples/data/skull.ndjson $out/figure_7bc.svg
node samples/world/world.mjs 50m > $out/world.geojson
$loft triangulate $out/world.geojson -o $out/figure_7d.svg

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

echo "== A valley from samples, with a river and a wall; a road that moves over it"
build/release/samples/terrain $out

echo "== People by age and education, and two criteria that are moved"
build/release/samples/classes $out/classes.svg

echo "== Where the countries of the map overlap already, and where they leave gaps"
$loft coverage $out/world_10m.geojson --gap-width 0.01 -o $out/world_faults.csv > $out/world_faults.txt
tail -n 1 $out/world_faults.txt

cat << END

Done. The pictures, for any browser, are in $PWD/$out:
  figure_1.svg, figure_4.svg, figure_5.svg, figure_6_shapes.svg, figure_6_agents.svg
  figure_7a.svg, figure_7bc.svg, figure_7d.svg; 7e and 7f are town.svg and room.svg
  gasket.svg, island.svg, agents.svg, terrain.svg, road.svg, classes.svg
and the table of overlaps and gaps is $PWD/$out/world_faults.csv. Next, try
  $loft overlay --help
  $loft query $out/world_10m.geojson --points points.csv
  $loft path $out/world_10m.geojson --from 13,39 --to 14,36 -o way.svg
END
