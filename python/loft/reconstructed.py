# SPDX-License-Identifier: MIT
"""Surfaces through stacks."""

from __future__ import annotations

import os
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _loft
from . import surface as _surface
from .errors import Defect, InputError
from .mesh import Check
from .progress import Report, run
from .stack import Path, Stack, matching, read
from .surface import Surface, Written

Link = Tuple[Tuple[int, int], Tuple[int, int], bool]


class Reconstructed(Mapping[str, Surface]):
    """The surfaces of a stack by label, and what was found on the way.

    A stack without labels has one surface, `surface`, under the label ''.
    """

    def __init__(self, surfaces: Mapping[str, Surface], skipped: Mapping[str, str], stack: Stack,
                 settings: Mapping[str, str], unit: str) -> None:
        self._surfaces = dict(surfaces)
        #: labels with too few slices for a surface, and why
        self.skipped = dict(skipped)
        self.stack = stack
        self.settings = dict(settings)
        self.unit = unit

    def __getitem__(self, label: str) -> Surface:
        return self._surfaces[label]

    def __iter__(self) -> Iterator[str]:
        return iter(self._surfaces)

    def __len__(self) -> int:
        return len(self._surfaces)

    @property
    def surface(self) -> Surface:
        """The only surface. Raises InputError where there are several."""
        if len(self) != 1:
            raise InputError(f"there are {len(self)} surfaces: {', '.join(map(repr, self))}")
        return next(iter(self.values()))

    @property
    def repairs(self) -> Dict[str, List[Defect]]:
        """What was repaired, of each label."""
        return {label: one.repairs for label, one in self.items()}

    def table(self) -> Dict[str, List[Any]]:
        """Columns: label, slices, volume, slab_volume, area, triangles; for pandas.DataFrame()."""
        surfaces = list(self.values())
        return {
            "label": list(self),
            "slices": [one.slices for one in surfaces],
            "volume": [one.volume for one in surfaces],
            "slab_volume": [one.slab_volume for one in surfaces],
            "area": [one.area for one in surfaces],
            "triangles": [one.measures.faces for one in surfaces],
        }

    def check(self) -> Check:
        """All faults of all surfaces; there should be none."""
        return Check({label: one.check().findings[one.label] for label, one in self.items()})

    def write(self, path: Path, *, unit: Optional[str] = None, compress: Optional[str] = None,
              hide: Union[None, str, Sequence[str]] = None,
              with_contours: bool = False) -> Written:
        """Writes all surfaces into one file, whole or not at all; the extension chooses the format.

        unit: of the coordinates, for glTF's metres. compress, hide, with_contours: of glTF, as
        `loft reconstruct --help` says. The bytes are those that the program writes. Raises
        FileError and InputError.
        """
        return _surface.write(self, path, unit=unit or self.unit, compress=compress, hide=hide,
                              contours_of=self.stack if with_contours else None,
                              sources=self.stack._sources, settings=self.settings)

    def render(self, width: int = 480, height: int = 360, azimuth: float = -60.0,
               elevation: float = 25.0) -> NDArray[np.uint8]:
        """A picture of all, (height, width, 3); no screen needed."""
        return _surface.render(self, width, height, azimuth, elevation)

    def __repr__(self) -> str:
        return f"<loft.Reconstructed: {len(self)} surfaces>"

    def _repr_html_(self) -> str:
        return _surface.html(self)

    def __reduce__(self) -> Any:
        return (Reconstructed, (self._surfaces, self.skipped, self.stack, self.settings, self.unit))


def _stack_of(given: Any) -> Stack:
    if isinstance(given, Stack):
        return given
    if isinstance(given, (str, os.PathLike)):
        return read(given)
    return Stack(given)


def _source_of(stack: Stack, label: str) -> str:
    """The file that a label comes from, where that is known."""
    if len(stack._sources) == 1:
        return stack._sources[0]
    return stack._files.get(label, "")


def reconstruct(stack: Any, *, only: Any = None, leave_out: Any = None,
                fill: Optional[str] = None, keyhole_width: Optional[float] = None,
                tolerance: Optional[float] = None, height_tolerance: Optional[float] = None,
                fair: Optional[float] = None, cap: str = "flat", link: str = "auto",
                max_shift: Optional[float] = None, links: Sequence[Link] = (),
                smooth: bool = False, smooth_tolerance: Optional[float] = None,
                max_edge: Optional[float] = None,
                target_edge: Optional[float] = None, simplify: Optional[float] = None,
                slabs: bool = False, threads: int = 0,
                progress: Union[None, bool, Report] = None) -> Reconstructed:
    """The closed surfaces through all contours of a stack, one for each label.

    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> made = reconstruct([(0.0, [square]), (1.0, [square])])
    >>> round(made.surface.volume, 9)
    1.0

    stack: a Stack, the path of a file, or what Stack() takes.
    only, leave_out: labels or patterns of them.
    links: contours to join or keep apart: ((slice, contour), (slice, contour), True or False).
    smooth_tolerance: means smooth.
    slabs: fill in Surface.slabs.
    threads: 0: as many as the machine has; changes nothing but time.
    progress: True for a bar; or a function of stage and fraction, which may return False to stop
        (Cancelled is raised). It is called in the calling thread, at most ten times a second.
    The others are those of `loft reconstruct --help`, and so are their defaults.

    Every surface is closed (but for cap="open"), manifold, oriented and free of
    self-intersections, and every vertex of a clean contour is one of its vertices, with the same
    coordinates. Raises InputError with all that is wrong. Other Python threads go on meanwhile;
    Ctrl-C stops it. Cost: O(n log n) for n contour points, in practice.
    """
    whole = _stack_of(stack)
    labels = matching(whole.labels, only, leave_out)
    options = {
        "fill": fill, "keyhole_width": keyhole_width, "tolerance": tolerance,
        "height_tolerance": height_tolerance, "fair": fair, "cap": cap, "link": link,
        "max_shift": max_shift, "smooth": smooth,
        "smooth_tolerance": smooth_tolerance, "max_edge": max_edge,
        "target_edge": target_edge, "simplify": simplify, "slabs": slabs, "threads": threads}
    made, skipped, settings = run(
        progress,
        lambda report: _loft.reconstruct(whole._stack, labels, options, list(links), report))
    unit = whole.unit if _loft.is_unit(whole.unit) else "mm"
    told = {name: (colour, id_, kind) for name, colour, id_, kind, _ in whole._stack.told()}
    surfaces = {}
    for label, surface, repairs, reports, slab_volume, slices in made:
        colour, id_, kind = told.get(label, (None, "", ""))
        surfaces[label] = Surface(surface, label, repairs=repairs, slabs=reports,
                                  slab_volume=slab_volume, slices=slices, colour=colour, id=id_,
                                  kind=kind, source=_source_of(whole, label), unit=unit)
    return Reconstructed(surfaces, dict(skipped), whole, settings, unit)
