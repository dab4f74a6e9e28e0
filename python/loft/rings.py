# SPDX-License-Identifier: MIT
"""Rings as people have them, as arrays."""

from __future__ import annotations

from typing import Any, Iterator, List

import numpy as np
from numpy.typing import NDArray

from .errors import Defect, InputError

Points = NDArray[np.float64]


def plain_array(values: Any, what: str) -> NDArray[Any]:
    """An array without a mask; InputError for what is none."""
    if isinstance(values, np.ma.MaskedArray):
        raise InputError(f"{what}: a masked array; fill it, or leave its masked points out")
    try:
        return np.asarray(values)
    except (ValueError, TypeError) as error:
        raise InputError(f"{what}: {error}") from None


def numbers(values: Any, what: str) -> Points:
    """The same as float64, rows one after the other."""
    array = plain_array(values, what)
    if array.dtype.kind not in "buif":
        raise InputError(f"{what}: numbers are wanted, not {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64)


def height_of(z: Any, what: str) -> float:
    """A height; InputError for what is none."""
    try:
        if isinstance(z, (complex, np.complexfloating)):
            raise TypeError
        return float(z)
    except (TypeError, ValueError):
        raise InputError(f"{what}: a height is wanted, not {z!r}") from None


def _lines(geometry: Any) -> Iterator[Any]:
    """The rings of a geometry as shapely has them, each without its repeated first point."""
    if hasattr(geometry, "geoms"):
        for part in geometry.geoms:
            yield from _lines(part)
    elif hasattr(geometry, "exterior"):
        for ring in (geometry.exterior, *geometry.interiors):
            yield from _lines(ring)
    else:
        points = np.asarray(geometry.coords)
        closed = len(points) > 1 and bool((points[0] == points[-1]).all())
        yield points[:-1] if closed else points


def _is_geometry(value: Any) -> bool:
    return any(hasattr(value, name) for name in ("geoms", "exterior", "coords"))


def ring_of(ring: Any, place: str, defect: Defect) -> Points:
    """One ring as an (n, 2) array. A third column is its height, the same for all points."""
    try:
        points = numbers(ring, place)
    except InputError as error:
        raise InputError(error.message, [defect]) from None
    if points.size == 0:
        return np.empty((0, 2))
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InputError(
            f"{place}: a ring is an array of shape (n, 2), not {points.shape}", [defect]
        )
    if points.shape[1] == 3 and not (points[:, 2] == points[0, 2]).all():
        raise InputError(f"{place}: its points have different heights", [defect])
    return np.ascontiguousarray(points[:, :2])


def rings_of(rings: Any, place: str, slice: int = 0, z: float = 0.0, first: int = 0) -> List[Points]:
    """All rings of one slice as (n, 2) float64 arrays.

    Each may be an array, a list of pairs, anything with `__array__`, or a shapely geometry: rings,
    polygons with their holes, multipolygons. One array of two dimensions, or one geometry, is taken
    for a list of one. `place` names the slice in messages; `first` is the number of the first ring.
    """
    if _is_geometry(rings):
        rings = [rings]
    elif isinstance(rings, np.ndarray) and rings.ndim == 2:
        rings = [rings]
    try:
        given = list(rings)
    except TypeError:
        raise InputError(f"{place}: a list of rings is wanted, not {type(rings).__name__}") from None
    lines: List[Any] = []
    for ring in given:
        if _is_geometry(ring):
            lines.extend(_lines(ring))
        else:
            lines.append(ring)
    return [
        ring_of(line, f"{place} contour {first + i}", Defect("bad_ring", "", z, slice, first + i))
        for i, line in enumerate(lines)
    ]
