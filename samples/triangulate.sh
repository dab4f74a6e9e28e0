#!/bin/sh
# SPDX-License-Identifier: MIT
# Triangulates the countries of the world and 960 hexagons, and draws them.
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
cmake --build --preset release -j "$(nproc)" --target loft

loft=build/release/app/loft
out=build/samples
mkdir -p $out

echo "== The countries of the world"
node samples/world/world.mjs 50m > $out/world.geojson
$loft triangulate $out/world.geojson -o $out/world.svg

echo "== 960 hexagons"
node samples/hexagons.mjs > $out/hexagons.txt
$loft triangulate $out/hexagons.txt -o $out/hexagons.svg

cat << END

Done. The pictures are
  $PWD/$out/world.svg       for any browser; zoom in
  $PWD/$out/hexagons.svg
Next, try
  node samples/world/world.mjs 10m | $loft triangulate - -o $out/world.svg --json
  $loft triangulate $out/hexagons.txt -o $out/hexagons.json -o $out/hexagons.ply
  $loft triangulate --help
END
