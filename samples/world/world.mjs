// SPDX-License-Identifier: MIT
// Prints the countries of the world as GeoJSON, from the npm package `world-atlas`:
//   npm ci --prefix samples/world && node samples/world/world.mjs [10m | 50m | 110m] > world.geojson
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { feature } from 'topojson-client';

const detail = process.argv[2] ?? '50m';
const file = createRequire(import.meta.url).resolve(`world-atlas/countries-${detail}.json`);
const topology = JSON.parse(readFileSync(file, 'utf8'));

// The package cuts no ring at the antimeridian, as befits a sphere: Russia leaps from 180 to -180.
// In the plane a ring goes on beyond 180 instead; one around a pole is closed along the pole.
function flatten(ring) {
  let turns = 0;
  const flat = ring.map(([x, y], i) => {
    const leap = i === 0 ? 0 : x - ring[i - 1][0];
    if (Math.abs(leap) > 180) turns -= Math.sign(leap);
    return [x + 360 * turns, y];
  });
  if (turns !== 0) {
    const pole = flat[0][1] < 0 ? -90 : 90;
    flat.push([flat.at(-1)[0], pole], [flat[0][0], pole], flat[0]);
  }
  return to_middle(flat);
}

// Moves a ring by whole turns until its middle is between -180 and 180.
function to_middle(ring) {
  const longitudes = ring.map(([x]) => x);
  const middle = (Math.min(...longitudes) + Math.max(...longitudes)) / 2;
  const shift = -360 * Math.round(middle / 360);
  return ring.map(([x, y]) => [x + shift, y]);
}

function flatten_geometry({ type, coordinates }) {
  const flatten_polygon = (rings) => rings.map(flatten);
  const is_single = type === 'Polygon';
  return {
    type,
    coordinates: is_single ? flatten_polygon(coordinates) : coordinates.map(flatten_polygon),
  };
}

// One feature a line.
const { features } = feature(topology, topology.objects.countries);
const lines = features.map(({ properties, geometry }) =>
  JSON.stringify({ type: 'Feature', properties, geometry: flatten_geometry(geometry) }),
);
process.stdout.write(`{"type":"FeatureCollection","features":[\n${lines.join(',\n')}\n]}\n`);
