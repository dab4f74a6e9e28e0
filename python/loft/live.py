# SPDX-License-Identifier: MIT
"""Surfaces whose slices come, change and go one at a time."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _loft
from .errors import Defect, InputError
from .rings import height_of, ring_of
from .stack import Slice, Stack
from .surface import Surface


class Slab(NamedTuple):
    """A part of a surface between two slices. An id is given once; a changed slab has a new one."""

    id: int
    low: float  #: heights of its slices
    high: float


@dataclass(frozen=True, eq=False)
class Change:
    """What an edit made of the surface. It is true if anything changed."""

    removed: Tuple[int, ...]  #: ids of the slabs that are gone
    added: Tuple[Slab, ...]  #: those in their place, from low to high
    resewn: Tuple[int, ...]  #: ids of slabs that stay, some of their faces being others now
    vertices_added: int
    vertices_removed: int
    faces_added: int
    faces_removed: int
    bounds: Optional[NDArray[np.float64]]  #: (2, 3) around all faces that came or went
    #: what was found in the edited slices and the slabs added; Defect.slice is the number of the
    #: slice in order of arrival
    repairs: Tuple[Defect, ...]

    def __bool__(self) -> bool:
        return bool(self.removed or self.added)


class Patch(NamedTuple):
    """Some slabs with the caps that they own, to be drawn: not closed by themselves."""

    vertices: NDArray[np.float64]  #: (n, 3)
    faces: NDArray[np.uint32]  #: (m, 3)
    kind: NDArray[np.uint8]  #: (n,) VertexKind
    origin: NDArray[np.int32]  #: (n, 3) slice (counted from below), contour, point; -1: none
    face_kind: NDArray[np.uint8]  #: (m,) FaceKind
    face_slab: NDArray[np.uint32]  #: (m,) number of the slab, counted from below


def _change(told: Any) -> Change:
    removed, added, resewn, v_added, v_removed, f_added, f_removed, bounds, repairs = told
    return Change(tuple(removed), tuple(Slab(*one) for one in added), tuple(resewn), v_added,
                  v_removed, f_added, f_removed, None if bounds is None else np.array(bounds),
                  tuple(Defect(*one) for one in repairs))


def _number(value: Any, what: str) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{what}: a whole number is wanted, not {value!r}") from None
    if not 0 <= number < 1 << 63:
        raise InputError(f"{what}: there is none of number {number}")
    return number


class Reconstruction:
    """The surface of one label through slices that come, change and go.

    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> live = Reconstruction()
    >>> live.insert(0, [square]).faces_added
    0
    >>> change = live.insert(1, [square])
    >>> change.faces_added, change.added
    (12, (Slab(id=0, low=0.0, high=1.0),))
    >>> live.volume
    1.0
    >>> live.surface
    <loft.Surface: 8 vertices, 12 faces>

    Law: after any edits in any order the surface is that of reconstruct() for the same slices, with
    the same vertices and faces, in another order. An edit makes the slabs beside the slice anew: at
    most two; four with `smooth`, and where a part ends or begins. Its cost is theirs, whatever the
    number of slices. While fewer than two slices have an area there is no surface.

    Options are those of reconstruct() and have the same defaults; `fair`, `simplify`, `links`,
    `height_tolerance` and cap="extend" need the whole stack and are not here.
    label: that of the contours that count. Rings are given without labels, and have this one then,
        or as {label: rings}, of which only this one counts.

    An edit that raises has changed nothing (InputError with all that is wrong). Threads may share
    one: each call is made as a whole, one after the other. Other Python threads go on meanwhile;
    Ctrl-C during an edit does not undo it: it is finished before the next call. It is pickled as
    its slices and options: ids of slabs are others then. Triangles are chosen by the exact
    triangulation of Kallmann, Bieri, Thalmann (2003), see loft.Triangulation.
    """

    def __init__(self, *, label: Optional[str] = None, fill: Optional[str] = None,
                 keyhole_width: Optional[float] = None, tolerance: Optional[float] = None,
                 cap: str = "flat", link: str = "auto", max_shift: Optional[float] = None,
                 smooth: bool = False, smooth_tolerance: Optional[float] = None,
                 max_edge: Optional[float] = None,
                 target_edge: Optional[float] = None, threads: int = 0, unit: str = "mm") -> None:
        options = {
            "fill": fill, "keyhole_width": keyhole_width, "tolerance": tolerance, "cap": cap,
            "link": link, "max_shift": max_shift, "smooth": smooth,
            "smooth_tolerance": smooth_tolerance, "max_edge": max_edge,
            "target_edge": target_edge, "threads": threads}
        self._begin(label, options, unit)
        self._live: Any = _loft.Reconstruction(options, self.label)

    def _begin(self, label: Optional[str], options: Dict[str, Any], unit: str) -> None:
        if label is not None and not isinstance(label, str):
            raise InputError(f"label: a name is wanted, not {label!r}")
        if options.get("cap") == "extend":
            raise InputError("cap: 'extend' needs the whole stack: use reconstruct()")
        #: of the contours that count, or None
        self.label = label
        #: those that the surface is made with
        self.options = options
        self.unit = str(unit)

    @classmethod
    def from_stack(cls, stack: Stack, *, label: Optional[str] = None,
                   **options: Any) -> Reconstruction:
        """One that begins with the slices of a stack; faster than inserting them one by one."""
        if not isinstance(stack, Stack):
            raise InputError(f"stack: a loft.Stack is wanted, not {type(stack).__name__}")
        options.setdefault("unit", stack.unit or "mm")
        made = cls(label=label, **options)
        made._live = _loft.reconstruction_of_stack(stack._stack, made.options, made.label)
        return made

    def _one(self, z: Any, rings: Any) -> Tuple[Any, Any]:
        return z, rings if isinstance(rings, Mapping) else {self.label or "": rings}

    def insert(self, z: float, rings: Any) -> Change:
        """Adds a slice at any height; where there is one already, its contours are added to it.

        rings: as Stack() takes them. Raises InputError for coordinates that are not usable, a
        height too near to another one, or a label that is not that of the contours there.
        """
        return _change(self._live.insert(Stack([self._one(z, rings)])._stack))

    def replace(self, z: float, rings: Any, new_z: Optional[float] = None) -> Change:
        """Puts other rings into the place of the slice at z, and the slice to another height.

        Raises InputError as insert(), where there is no slice at z, and where there is another one
        at the new height.
        """
        there = Stack([self._one(z if new_z is None else new_z, rings)])
        return _change(self._live.replace(height_of(z, "z"), there._stack))

    def replace_many(self, slices: Iterable[Tuple[float, Any]]) -> Change:
        """Puts each (z, rings) into the place of the slice at its height, all as one edit.

        Each slab is made once: about half the time of one after the other.
        """
        try:
            pairs = [(z, rings) for z, rings in slices]
        except (TypeError, ValueError):
            raise InputError("slices: (z, rings) of each is wanted") from None
        return _change(self._live.replace_many(Stack([self._one(*one) for one in pairs])._stack))

    def remove(self, z: float) -> Change:
        """Removes the slice at z. Raises InputError, with the nearest height, where there is none."""
        return _change(self._live.remove(height_of(z, "z")))

    def move_contour(self, z: float, contour: int, points: Any) -> Change:
        """Gives a contour of the slice at z other points; it keeps its label.

        contour: its number in the slice, as `slices` has them. Raises InputError where there is
        none.
        """
        number = _number(contour, "contour")
        ring = ring_of(points, "points", Defect("bad_ring", "", height_of(z, "z"), 0, number))
        return _change(self._live.move_contour(height_of(z, "z"), number, ring))

    @property
    def surface(self) -> Surface:
        """The present surface, as reconstruct() gives it: later edits do not change it.

        Slices and slabs are counted from below; without a surface it has no faces. Cost: linear.
        """
        made, slices = self._live.surface()
        return Surface(made, self.label or "", repairs=self.repairs, slices=slices,
                       unit=self.unit)

    def patch(self, first: int = 0, last: Optional[int] = None) -> Patch:
        """The slabs from number `first` up to but not `last`, as they are. Cost: that of these."""
        end = len(self.slabs) if last is None else _number(last, "last")
        return Patch(*self._live.patch(_number(first, "first"), end))

    @property
    def volume(self) -> float:
        """Enclosed; with cap="open" between the slices. Cost: the number of slabs."""
        return float(self._live.volume())

    @property
    def vertex_count(self) -> int:
        """Of the surface as it is; `surface` has more where parts only touch."""
        return int(self._live.counts()[2])

    @property
    def face_count(self) -> int:
        """Of the surface as it is."""
        return int(self._live.counts()[3])

    @property
    def stack(self) -> Stack:
        """All slices, from low to high, as a Stack of their own."""
        return Stack._of(self._live.stack())

    @property
    def slices(self) -> List[Slice]:
        """All slices, from low to high, with copies of their contours."""
        return self.stack.slices

    @property
    def heights(self) -> NDArray[np.float64]:
        """(slices,) ascending."""
        return self.stack.heights

    def slice(self, z: float) -> Optional[Slice]:
        """The slice at a height, or None."""
        found = self._live.slice(height_of(z, "z"))
        return None if found is None else Stack._of(found).slices[0]

    def __contains__(self, z: float) -> bool:
        return bool(self._live.has(height_of(z, "z")))

    def __len__(self) -> int:
        """The number of slices."""
        return int(self._live.counts()[0])

    @property
    def slabs(self) -> List[Slab]:
        """All slabs, from low to high; the first and the last one have the caps."""
        return [Slab(*one) for one in self._live.slabs()]

    @property
    def repairs(self) -> List[Defect]:
        """What was found in slices and slabs, from low to high; slices are counted from below."""
        return [Defect(*one) for one in self._live.repairs()]

    def __bool__(self) -> bool:
        return True

    def __repr__(self) -> str:
        slices, slabs, _, faces = self._live.counts()
        name = f" {self.label!r}" if self.label else ""
        return f"<loft.Reconstruction{name}: {slices} slices, {slabs} slabs, {faces} faces>"

    def __reduce__(self) -> Any:
        return (_restored, (self.stack, self.label, self.options, self.unit))


def _restored(stack: Stack, label: Optional[str], options: Dict[str, Any],
              unit: str) -> Reconstruction:
    return Reconstruction.from_stack(stack, label=label, unit=unit, **options)
