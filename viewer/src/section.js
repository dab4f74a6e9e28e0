// SPDX-License-Identifier: MIT
// The way along a surface in a plane: the surface's triangles meet the plane in lines, which are
// followed from one place to the other. Places are arrays of three numbers.

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

// Where an edge crosses the plane; the same numbers whichever triangle asks.
function crossing(a, b, heights) {
  const isInOrder = a[0] - b[0] || a[1] - b[1] || a[2] - b[2];
  const [from, to, low, high] = isInOrder <= 0 ? [a, b, ...heights] : [b, a, heights[1], heights[0]];
  const share = low / (low - high);
  return from.map((value, axis) => value + share * (to[axis] - value));
}

// The piece of a triangle in the plane, as two places; undefined where it does not cross it.
function pieceOf(corners, { normal, offset }) {
  const heights = corners.map((corner) => dot(normal, corner) - offset);
  const places = [];
  for (let i = 0; i < 3; ++i) {
    const k = (i + 1) % 3;
    if (heights[i] < 0 === heights[k] < 0) continue;
    places.push(crossing(corners[i], corners[k], [heights[i], heights[k]]));
  }
  return places.length === 2 ? places : undefined;
}

// Ends of pieces by their numbers, with the pieces that meet there.
function linksOf(pieces) {
  const links = new Map();
  for (const [i, ends] of pieces.entries()) {
    for (const end of ends) {
      const key = end.join();
      if (!links.has(key)) links.set(key, []);
      links.get(key).push(i);
    }
  }
  return links;
}

// How far a place is from a piece, and the nearest place of it.
function nearestOn([a, b], place) {
  const way = minus(b, a);
  const square = dot(way, way);
  const share = square > 0 ? Math.min(Math.max(dot(minus(place, a), way) / square, 0), 1) : 0;
  const nearest = a.map((value, axis) => value + share * way[axis]);
  return { nearest, distance: distance(nearest, place) };
}

function pieceAt(pieces, place) {
  let best;
  for (const [i, piece] of pieces.entries()) {
    const found = { i, ...nearestOn(piece, place) };
    if (!best || found.distance < best.distance) best = found;
  }
  return best;
}

// From a place on a piece over its end `side` to another place; undefined where the line ends, or
// comes back, before.
function follow(pieces, links, start, goal, side) {
  const points = [start.nearest];
  let [piece, end] = [start.i, pieces[start.i][side]];
  for (let steps = 0; steps <= pieces.length; ++steps) {
    points.push(end);
    const next = links.get(end.join()).find((other) => other !== piece);
    if (next === undefined || next === start.i) return undefined;
    if (next === goal.i) return [...points, goal.nearest];
    const [a, b] = pieces[next];
    end = a.join() === end.join() ? b : a;
    piece = next;
  }
  return undefined;
}

function lengthOf(points) {
  return points.slice(1).reduce((sum, point, i) => sum + distance(points[i], point), 0);
}

// The shorter way from one place to another along what `triangles` (triples of places) and the
// plane { normal, offset } have in common, as { points, length }; undefined where there is none.
export function wayAlong(triangles, plane, from, to) {
  const pieces = [];
  for (const corners of triangles) {
    const piece = pieceOf(corners, plane);
    if (piece) pieces.push(piece);
  }
  const [start, goal] = [from, to].map((place) => pieceAt(pieces, place));
  if (!start || !goal) return undefined;
  if (start.i === goal.i) {
    return { points: [start.nearest, goal.nearest], length: distance(start.nearest, goal.nearest) };
  }
  const links = linksOf(pieces);
  const ways = [0, 1].map((side) => follow(pieces, links, start, goal, side)).filter(Boolean)
    .map((points) => ({ points, length: lengthOf(points) }));
  return ways.sort((a, b) => a.length - b.length)[0];
}

// The triangles of some pieces, as triples of places.
export function* trianglesOf(pieces) {
  for (const { positions, indices } of pieces) {
    const placeOf = (i) => [...positions.subarray(3 * i, 3 * i + 3)];
    for (let i = 0; i < indices.length; i += 3)
      yield [placeOf(indices[i]), placeOf(indices[i + 1]), placeOf(indices[i + 2])];
  }
}
