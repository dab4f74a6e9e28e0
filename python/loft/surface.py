# SPDX-License-Identifier: MIT
"""Closed surfaces as arrays."""

from __future__ import annotations

import base64
import enum
import os
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _loft, picture
from .errors import Defect, InputError
from .mesh import Check, Measures, Section, section
from .stack import Colour, Path, Stack, matching

GREY = (176, 184, 196)


class VertexKind(enum.IntEnum):
    """How a vertex came about: `Surface.kind`."""

    CONTOUR = 0  #: a point of an input contour, unchanged
    CLEANING = 1  #: made in a slice, where its contours cross
    CROSSING = 2  #: where contour edges of two neighbouring slices cross in projection
    STEINER = 3  #: added between two slices


class FaceKind(enum.IntEnum):
    """What part of the surface a face belongs to: `Surface.face_kind`."""

    SHEET = 0  #: over a part that is inside one of its two slices only
    WALL = 1  #: upright on a contour edge
    BOTTOM_CAP = 2
    TOP_CAP = 3


@dataclass(frozen=True)
class Written:
    """What rounding did to surfaces in a file of floats, and what was mended."""

    faults: int
    moved: int
    collapsed: int
    left: int  #: faults that there still are
    origin: Optional[Tuple[float, float, float]]  #: of an STL that is not about 0


class Surface:
    """A closed, manifold, oriented surface without self-intersections, as arrays. It never changes.

    vertices (n, 3) float64 and faces (m, 3) uint32, counter-clockwise seen from outside, cannot be
    written to; vertices are the surface's own memory, without a copy. Copies of them live as long
    as they are used, whatever becomes of the surface. These names are what trimesh, pyvista and
    meshio look for.
    """

    def __init__(self, made: Any, label: str = "", *, repairs: Sequence[Any] = (),
                 slabs: Sequence[Dict[str, Any]] = (), slab_volume: Optional[float] = None,
                 slices: int = 0, colour: Optional[Colour] = None, id: str = "", kind: str = "",
                 source: str = "", unit: str = "mm") -> None:
        self._surface = made
        self.label = label
        #: what was found wrong in the contours and repaired, from low to high
        self.repairs: List[Defect] = [
            one if isinstance(one, Defect) else Defect(*one) for one in repairs]
        #: how sure the surface is in each slab; with slabs=True
        self.slabs: List[Dict[str, Any]] = list(slabs)
        #: the volume as planning systems have it: area times thickness of each slice
        self.slab_volume = slab_volume
        #: how many slices the label is in
        self.slices = slices
        self.colour = colour
        self.id = id
        self.category = kind
        self.source = source
        self.unit = unit

    @cached_property
    def vertices(self) -> NDArray[np.float64]:
        """(n, 3), a view of the surface's memory."""
        array: NDArray[np.float64] = self._surface.vertices()
        return array

    @cached_property
    def faces(self) -> NDArray[np.uint32]:
        """(m, 3), made when first asked for."""
        array: NDArray[np.uint32] = self._surface.faces()
        return array

    @cached_property
    def _origins(self) -> Tuple[NDArray[np.uint8], NDArray[np.int32]]:
        origins: Tuple[NDArray[np.uint8], NDArray[np.int32]] = self._surface.origins()
        return origins

    @property
    def origin(self) -> NDArray[np.int32]:
        """(n, 3): slice, contour and point of the input that each vertex is, -1 for none."""
        return self._origins[1]

    @property
    def kind(self) -> NDArray[np.uint8]:
        """(n,) VertexKind of each vertex."""
        return self._origins[0]

    @cached_property
    def _face_data(self) -> Tuple[NDArray[np.uint8], NDArray[np.uint32]]:
        data: Tuple[NDArray[np.uint8], NDArray[np.uint32]] = self._surface.face_data()
        return data

    @property
    def face_kind(self) -> NDArray[np.uint8]:
        """(m,) FaceKind of each face."""
        return self._face_data[0]

    @property
    def face_slab(self) -> NDArray[np.uint32]:
        """(m,) the slab of each face: number of slices below it, less one."""
        return self._face_data[1]

    @cached_property
    def measures(self) -> Measures:
        """Size and shape."""
        return Measures(**self._surface.measures())

    @property
    def volume(self) -> float:
        return self.measures.volume

    @property
    def area(self) -> float:
        return self.measures.area

    @property
    def bounds(self) -> NDArray[np.float64]:
        """(2, 3): least and largest coordinates."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    def check(self) -> Check:
        """All faults of the surface; there should be none."""
        return Check.of({self.label: self._surface.check()})

    def section(self, heights: Any) -> List[Section]:
        """Its outlines at some heights."""
        return section(self, heights)

    def write(self, path: Path, **options: Any) -> Written:
        """Writes the surface; the extension chooses the format. See Reconstructed.write()."""
        return write({self.label: self}, path, **options)

    def render(self, width: int = 480, height: int = 360, azimuth: float = -60.0,
               elevation: float = 25.0) -> NDArray[np.uint8]:
        """A picture, (height, width, 3), seen from that direction in degrees; no screen needed."""
        return render({self.label: self}, width, height, azimuth, elevation)

    def to_trimesh(self) -> Any:
        """A trimesh.Trimesh with the same vertices and faces."""
        try:
            import trimesh  # type: ignore
        except ImportError as error:
            raise ImportError("to_trimesh() needs trimesh: pip install trimesh") from error
        return trimesh.Trimesh(self.vertices, self.faces, process=False)

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with the same points and faces."""
        try:
            import pyvista  # type: ignore
        except ImportError as error:
            raise ImportError("to_pyvista() needs pyvista: pip install pyvista") from error
        return pyvista.PolyData.from_regular_faces(self.vertices, self.faces.astype(np.int64))

    def to_meshio(self) -> Any:
        """A meshio.Mesh with the same points and triangles."""
        try:
            import meshio  # type: ignore
        except ImportError as error:
            raise ImportError("to_meshio() needs meshio: pip install meshio") from error
        return meshio.Mesh(self.vertices, [("triangle", self.faces)])

    def __repr__(self) -> str:
        name = f" {self.label!r}" if self.label else ""
        return (f"<loft.Surface{name}: {self._surface.vertex_count()} vertices, "
                f"{self._surface.face_count()} faces>")

    def _repr_html_(self) -> str:
        return html({self.label: self})

    def __reduce__(self) -> Any:
        arrays = (self.vertices, self.faces, self.kind, self.origin, self.face_kind, self.face_slab)
        told = dict(repairs=self.repairs, slabs=self.slabs, slab_volume=self.slab_volume,
                    slices=self.slices, colour=self.colour, id=self.id, kind=self.category,
                    source=self.source, unit=self.unit)
        return (_restored, (arrays, self.label, told))


def _restored(arrays: Any, label: str, told: Dict[str, Any]) -> Surface:
    return Surface(_loft.surface_from_arrays(*arrays), label, **told)


def write(surfaces: Mapping[str, Surface], path: Path, *, unit: Optional[str] = None,
          compress: Optional[str] = None, hide: Union[None, str, Sequence[str]] = None,
          contours_of: Optional[Stack] = None, sources: Sequence[str] = (),
          settings: Optional[Mapping[str, str]] = None) -> Written:
    name = os.fsdecode(path)
    hidden = matching(list(surfaces), hide, None) if hide else []
    if len(surfaces) > 1 and name.lower().endswith(".stl"):
        raise InputError(f"{name}: STL would make one solid of {len(surfaces)} labels; write .glb, "
                         ".ply or .obj, which keep them apart, or each by itself")
    parts = [(label, one._surface, one.colour, one.id, one.category, os.fsencode(one.source),
              one.slices,
              label in hidden) for label, one in surfaces.items()]
    units = {one.unit for one in surfaces.values()} or {"mm"}
    written = _loft.write(os.fsencode(name), parts, unit or units.pop(),
                          [os.fsencode(source) for source in sources], dict(settings or {}),
                          compress or "", contours_of._stack if contours_of is not None else None)
    return Written(**written)


def render(surfaces: Mapping[str, Surface], width: int, height: int, azimuth: float,
           elevation: float) -> NDArray[np.uint8]:
    parts = [(one.vertices, one.faces, one.colour or GREY) for one in surfaces.values()]
    return picture.render(parts, width, height, azimuth, elevation)


def html(surfaces: Mapping[str, Surface]) -> str:
    """A picture and a table of volumes."""
    shown = base64.b64encode(picture.png(render(surfaces, 480, 360, -60.0, 25.0))).decode()
    rows = "".join(
        f"<tr><td>{_escaped(label) or '(unlabelled)'}</td><td>{one.volume:.6g}</td>"
        f"<td>{one.area:.6g}</td><td>{one._surface.face_count()}</td></tr>"
        for label, one in list(surfaces.items())[:50])
    return (f'<img alt="surface" width="480" src="data:image/png;base64,{shown}">'
            "<table><tr><th>label</th><th>volume</th><th>area</th><th>triangles</th></tr>"
            f"{rows}</table>")


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
