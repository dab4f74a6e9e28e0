# SPDX-License-Identifier: MIT
"""The dynamic constrained Delaunay triangulation."""

from __future__ import annotations

import operator
from typing import Any, Iterable, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _loft
from .errors import InputError
from .rings import Points, numbers, plain_array, rings_of

_FILLS = ("evenodd", "nonzero")


class Triangles(NamedTuple):
    """A triangulation at one time. Ids stay as they are, numbers change with the next edit."""

    vertices: Points  #: (n, 2) places
    triangles: NDArray[np.uint32]  #: (m, 3) numbers of vertices, counter-clockwise
    vertex_ids: NDArray[np.uint32]  #: (n,) the id of each vertex
    triangle_ids: NDArray[np.uint32]  #: (m,) the id of each triangle, until the next edit


class Edges(NamedTuple):
    """Constrained edges; along edge i are `constraints[offsets[i]:offsets[i + 1]]`."""

    edges: NDArray[np.uint32]  #: (k, 2) numbers of vertices
    offsets: NDArray[np.int64]  #: (k + 1,)
    constraints: NDArray[np.uint32]  #: (offsets[-1],) ids, for each edge sorted

    def of(self, edge: int) -> NDArray[np.uint32]:
        """The ids of the constraints along one edge."""
        return self.constraints[self.offsets[edge]:self.offsets[edge + 1]]


class TriangleChanges(NamedTuple):
    """Ids of triangles, sorted, those beyond the hull included; ids are used again."""

    unmade: NDArray[np.uint32]  #: were there before the edit, are not there as they were
    made: NDArray[np.uint32]  #: are there now, were not, or had other corners or edges before


class Snaps(NamedTuple):
    """Where rounding decides: constraints that lead through a vertex beside them."""

    constraints: NDArray[np.uint32]  #: (k,) ids
    places: Points  #: (k, 2)


class Fault(NamedTuple):
    """Something that is wrong with a triangulation. There should never be one."""

    fault: str  #: topology, inverted, delaunay, uncovered or astray
    message: str


def _points(values: Any, what: str) -> Points:
    if hasattr(values, "coords"):
        values = np.asarray(values.coords)
    array = numbers(values, what)
    return np.empty((0, 2)) if array.size == 0 else array


def _joined(lines: Any) -> Tuple[Points, NDArray[np.int64]]:
    """Points of lines one behind the other, and where each begins; and their number."""
    if isinstance(lines, np.ndarray) and lines.ndim == 3:
        array = numbers(lines, "lines")
        count, size, columns = array.shape
        if columns != 2:
            raise InputError(f"lines: an array of shape (lines, n, 2) is wanted, not {array.shape}")
        return array.reshape(-1, 2), np.arange(count + 1, dtype=np.int64) * size
    arrays = rings_of(lines, "lines")
    offsets = np.concatenate([[0], np.cumsum([len(one) for one in arrays])]).astype(np.int64)
    return np.concatenate(arrays) if arrays else np.empty((0, 2)), offsets


def _pair(values: Any, what: str) -> Tuple[float, float]:
    array = numbers(values, what)
    if array.shape != (2,):
        raise InputError(f"{what}: two numbers are wanted, not an array of shape {array.shape}")
    return float(array[0]), float(array[1])


def _id(value: Any, what: str = "constraint") -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{what}: an id is a whole number, not {value!r}") from None
    if not 0 <= number < 0xFFFFFFFF:
        raise InputError(f"there is no {what} {number}")
    return number


def _ids(constraints: Optional[Iterable[Any]]) -> Optional[List[int]]:
    if constraints is None:
        return None
    try:
        return [_id(one) for one in constraints]
    except TypeError:
        raise InputError(f"constraints: a list of ids is wanted, not {constraints!r}") from None


def _flag(value: Any, what: str) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise InputError(f"{what}: True or False is wanted, not {value!r}")
    return bool(value)


def _flags(closed: Any, count: int) -> NDArray[np.uint8]:
    flags = plain_array(closed, "closed")
    if flags.dtype.kind != "b" and flags.size:
        raise InputError("closed: True or False, or one of these for each line, is wanted, not "
                         f"{flags.dtype}")
    if flags.shape not in ((), (count,)):
        raise InputError(f"closed: one for each of {count} lines is wanted, not {flags.shape}")
    return np.ascontiguousarray(np.broadcast_to(flags.astype(bool), (count,)), dtype=np.uint8)


class Triangulation:
    """A constrained Delaunay triangulation that stays one while lines come, move and go.

    >>> mesh = Triangulation()
    >>> ring = mesh.insert([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True)
    >>> line = mesh.insert([(-1, 2), (5, 2)])
    >>> mesh
    <loft.Triangulation: 8 vertices, 8 triangles, 2 constraints>
    >>> mesh.area()
    16.0
    >>> mesh.remove(line)
    >>> mesh
    <loft.Triangulation: 4 vertices, 2 triangles, 1 constraint>

    A constraint is a polyline, open or closed, or a single point; they may cross, overlap and
    repeat one another and themselves. Where they cross there are vertices; what is removed leaves
    no trace. After Kallmann, Bieri, Thalmann, "Fully Dynamic Constrained Delaunay Triangulations"
    (2003), with exact decisions: the result depends on what is in it, not on how it came there
    (but for `epsilon`, and for what `snaps` lists).

    epsilon: with one above 0, a point no further than that from a vertex is that vertex, and one
        no further than that from a line is on it.

    Constraints and vertices go by ids, which stay until what they name is removed; then they may
    be used again. Arrays number vertices and triangles without gaps instead, in the order of their
    ids: `vertex_ids` and `triangle_ids` say which is which. Arrays are copies of the present
    state: they cannot be written to, and later edits do not change them. They are made when first
    asked for after an edit, in time linear in the number of triangles.

    Coordinates are 0 or from 1e-50 to 1e75 in magnitude. What cannot be done raises InputError and
    changes nothing; where there is no room, MemoryError is raised and it is empty then. Threads
    may share one: each call is made as a whole, one after the other. Ctrl-C during a large edit
    does not undo it: it is finished before the next call. It can be pickled and copied, with all
    its ids.
    """

    def __init__(self, epsilon: float = 0.0) -> None:
        try:
            distance = float(epsilon)
        except (TypeError, ValueError):
            raise InputError(f"epsilon: a distance is wanted, not {epsilon!r}") from None
        self._mesh: Any = _loft.Triangulation(distance)

    @classmethod
    def _of(cls, mesh: Any) -> Triangulation:
        made = cls.__new__(cls)
        made._mesh = mesh
        return made

    @property
    def epsilon(self) -> float:
        """The distance within which points are the same."""
        return float(self._mesh.epsilon())

    # Edits.

    def insert(self, points: Any, closed: bool = False) -> int:
        """Inserts a polyline of (n, 2) points, or a single point; the id of the constraint.

        Cost: to find the first point, in practice constant; then constant a point and a crossing.
        Section 4 of the paper.
        """
        return int(self._mesh.insert(_points(points, "points"), _flag(closed, "closed")))

    def insert_many(self, lines: Iterable[Any],
                    closed: Union[bool, Sequence[bool]] = False) -> List[int]:
        """Inserts many polylines, the same as one after the other but faster; their ids.

        lines: arrays of shape (n, 2), lists of pairs or geometries as shapely has them; or, which
            is fastest, one array of shape (lines, n, 2).
        closed: of all, or of each.
        """
        points, offsets = _joined(lines)
        return list(self._mesh.insert_many(points, offsets, _flags(closed, len(offsets) - 1)))

    def insert_point(self, point: ArrayLike) -> int:
        """Inserts a vertex that belongs to no constraint, or finds the one there; its id."""
        return int(self._mesh.insert_point(*_pair(point, "point")))

    def move(self, constraint: int, points: Any) -> None:
        """Gives a constraint other points, as many as they are; it keeps its id.

        Vertices are moved in place where they can be. The result is that of remove() and insert().
        """
        self._mesh.move(_id(constraint), _points(points, "points"))

    def translate(self, constraint: int, by: ArrayLike) -> None:
        """Moves all points of a constraint by the same vector."""
        self._mesh.translate(_id(constraint), *_pair(by, "by"))

    def remove(self, constraint: int) -> None:
        """Removes a constraint, and the vertices that nothing else needs.

        Cost: in practice constant a vertex and a crossing. Section 5 of the paper.
        """
        self._mesh.remove(_id(constraint))

    def remove_point(self, vertex: int) -> None:
        """Undoes one insert_point(): the vertex goes if nothing else needs it.

        Raises InputError where there is no such vertex, or only points of constraints are there.
        """
        self._mesh.remove_point(_id(vertex, "vertex"))

    def clear(self) -> None:
        """Removes everything."""
        self._mesh.clear()

    # What there is.

    @property
    def state(self) -> Triangles:
        """Vertices and triangles with their ids, all of one moment."""
        return Triangles(*self._mesh.arrays())

    @property
    def vertices(self) -> Points:
        """(n, 2) places."""
        return self.state.vertices

    @property
    def vertex_ids(self) -> NDArray[np.uint32]:
        """(n,) the id of each vertex, ascending."""
        return self.state.vertex_ids

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """(m, 3) numbers of vertices, counter-clockwise; they cover the convex hull."""
        return self.state.triangles

    @property
    def triangle_ids(self) -> NDArray[np.uint32]:
        """(m,) the id of each triangle, ascending; `changes` has these."""
        return self.state.triangle_ids

    @property
    def edges(self) -> Edges:
        """The edges along constraints, each once, and which these are."""
        return Edges(*self._mesh.edges())

    @property
    def constraints(self) -> NDArray[np.uint32]:
        """The ids of all constraints, ascending."""
        ids: NDArray[np.uint32] = self._mesh.constraints()
        return ids

    def points(self, constraint: int) -> Points:
        """(n, 2) the points of a constraint: as given, but for those that epsilon merged."""
        places: Points = self._mesh.points(_id(constraint))
        return places

    def is_closed(self, constraint: int) -> bool:
        """Whether its last point is joined to its first."""
        return bool(self._mesh.is_closed(_id(constraint)))

    def path(self, constraint: int) -> NDArray[np.uint32]:
        """Numbers of the vertices that it leads through, crossings among them, in order.

        That of a closed one ends where it began.
        """
        numbers_: NDArray[np.uint32] = self._mesh.path(_id(constraint))
        return numbers_

    def constraints_at(self, vertex: int) -> List[int]:
        """The constraints that have a point at a vertex (by its id) or pass through it."""
        return list(self._mesh.constraints_at(_id(vertex, "vertex")))

    # Questions.

    def locate(self, points: Any) -> NDArray[np.int64]:
        """(n,) the number of the triangle that each of (n, 2) points is in, -1 beyond the hull.

        A point on an edge or a vertex is in one of the triangles there. Cost: in practice constant
        a point.
        """
        found: NDArray[np.int64] = self._mesh.locate(_points(points, "points"))
        return found

    def nearest(self, points: Any) -> NDArray[np.int64]:
        """(n,) the number of the vertex nearest to each of (n, 2) points; -1 if there is none."""
        found: NDArray[np.int64] = self._mesh.nearest(_points(points, "points"))
        return found

    def winding_numbers(self, constraints: Optional[Iterable[int]] = None) -> NDArray[np.int32]:
        """(m,) how often closed constraints wind around each triangle, counter-clockwise positive.

        constraints: ids of those that count; all closed ones by default. Raises InputError for an
        open one. Cost: linear in the number of triangles.
        """
        windings: NDArray[np.int32] = self._mesh.winding_numbers(_ids(constraints))[0]
        return windings

    def inside(self, fill: str = "evenodd",
               constraints: Optional[Iterable[int]] = None) -> NDArray[np.bool_]:
        """(m,) whether each triangle is inside closed constraints, as winding_numbers() has them.

        fill: `evenodd`: an odd number encloses it; `nonzero`: they wind around it.
        """
        _require_fill(fill)
        return _is_inside(self.winding_numbers(constraints), fill)

    def area(self, fill: str = "evenodd", constraints: Optional[Iterable[int]] = None) -> float:
        """The area of the triangles that inside() says."""
        _require_fill(fill)
        windings, places, corners = self._mesh.winding_numbers(_ids(constraints))
        a, b, c = (places[corners[_is_inside(windings, fill), i]] for i in range(3))
        u, v = b - a, c - a
        return float((u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum() / 2)

    def record_changes(self, on: bool = True) -> None:
        """From now on (or no longer) each edit notes the triangles that it makes and unmakes."""
        self._mesh.record_changes(_flag(on, "on"))

    @property
    def changes(self) -> TriangleChanges:
        """Those of the last edit that changed something; empty if they are not recorded."""
        return TriangleChanges(*self._mesh.changes())

    @property
    def snaps(self) -> Snaps:
        """The places where rounding decides; mostly none."""
        return Snaps(*self._mesh.snaps())

    def check(self) -> List[Fault]:
        """Everything that is wrong, by exact tests. Cost: linear in the number of triangles."""
        return [Fault(*one) for one in self._mesh.check()]

    def copy(self) -> Triangulation:
        """An independent one with the same ids. Cost: linear, but little."""
        return type(self)._of(self._mesh.copy())

    def __copy__(self) -> Triangulation:
        return self.copy()

    def __deepcopy__(self, memo: Any) -> Triangulation:
        return self.copy()

    def __reduce__(self) -> Any:
        return (_restored, (self._mesh.to_bytes(),))

    def __repr__(self) -> str:
        vertices, triangles, constraints = self._mesh.counts()
        return (f"<loft.Triangulation: {_counted(vertices, 'vertex', 'vertices')}, "
                f"{_counted(triangles, 'triangle', 'triangles')}, "
                f"{_counted(constraints, 'constraint', 'constraints')}>")


def _restored(state: bytes) -> Triangulation:
    return Triangulation._of(_loft.triangulation_of_bytes(state))


def _counted(count: int, one: str, many: str) -> str:
    return f"{count} {one if count == 1 else many}"


def _require_fill(fill: str) -> None:
    if not isinstance(fill, str) or fill not in _FILLS:
        raise InputError(f"fill: {fill!r} is none of 'evenodd', 'nonzero'")


def _is_inside(windings: NDArray[np.int32], fill: str) -> NDArray[np.bool_]:
    inside: NDArray[np.bool_] = windings % 2 != 0 if fill == "evenodd" else windings != 0
    return inside
