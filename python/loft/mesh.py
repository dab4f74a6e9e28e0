# SPDX-License-Identifier: MIT
"""Checks, measures and sections of any mesh."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Dict, List, NamedTuple, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _loft
from .errors import InputError
from .rings import Points, numbers, plain_array

Arrays = Tuple[NDArray[np.float64], NDArray[np.uint32]]


class Finding(NamedTuple):
    """A fault of a mesh, and the faces and vertices that show it."""

    fault: str
    faces: List[int]
    vertices: List[int]


@dataclass(frozen=True)
class Check:
    """Whether meshes bound valid solids, and what is wrong with them: of each label."""

    findings: Dict[str, List[Finding]]

    @classmethod
    def of(cls, found: Dict[str, Any]) -> Check:
        return cls({label: [Finding(*one) for one in all_] for label, all_ in found.items()})

    @property
    def valid(self) -> bool:
        return not any(self.findings.values())

    @property
    def faults(self) -> Dict[str, int]:
        """How many there are of each kind."""
        counts: Dict[str, int] = {}
        for found in self.findings.values():
            for one in found:
                counts[one.fault] = counts.get(one.fault, 0) + 1
        return counts

    def __bool__(self) -> bool:
        return self.valid


@dataclass(frozen=True)
class Measures:
    """Size and shape of a mesh, in its own unit; angles in degrees, each face by its smallest."""

    vertices: int
    edges: int
    faces: int
    components: int
    genus: int
    area: float
    volume: float
    smallest_angle: float
    fifth_percentile_angle: float
    median_angle: float
    worst_aspect: float


class Section(NamedTuple):
    """Where a mesh meets a plane of constant z: closed outlines, the inside on their left."""

    z: float
    outlines: List[Points]
    open: int  #: lines that end where the mesh has a rim; they are left out


def arrays_of(mesh: Any) -> Arrays:
    """Vertices and faces of anything that has them."""
    if isinstance(mesh, tuple) and len(mesh) == 2:
        vertices, faces = mesh
    elif hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        vertices, faces = mesh.vertices, mesh.faces
    elif hasattr(mesh, "points") and hasattr(mesh, "regular_faces"):
        vertices, faces = mesh.points, mesh.regular_faces
    else:
        raise InputError("mesh: a path, (vertices, faces) or an object that has these is wanted, "
                         f"not {type(mesh).__name__}")
    places = numbers(vertices, "vertices")
    corners = plain_array(faces, "faces")
    if corners.size == 0:
        corners = np.empty((0, 3), dtype=np.uint32)
    if corners.dtype.kind not in "ui":
        raise InputError(f"faces: whole numbers are wanted, not {corners.dtype}")
    if corners.size and (int(corners.min()) < 0 or int(corners.max()) > 0xFFFFFFFF):
        raise InputError("faces: one names a vertex below 0 or beyond 2^32")
    return places, np.ascontiguousarray(corners, dtype=np.uint32)


def _is_path(mesh: Any) -> bool:
    return isinstance(mesh, (str, os.PathLike))


def read_meshes(path: Any) -> Dict[str, Arrays]:
    """The meshes in a file, by label: vertices (n, 3) and faces (m, 3). Raises FileError and
    InputError."""
    meshes: Dict[str, Arrays] = {}
    for label, vertices, faces in _loft.read_meshes(os.fsencode(path)):
        name, copy = label, 2
        while name in meshes:
            name, copy = f"{label} ({copy})", copy + 1
        meshes[name] = (vertices, faces)
    return meshes


def check(mesh: Any) -> Check:
    """All faults of a mesh, decided exactly: a file, (vertices, faces), or an object with these.

    >>> check(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])).faults
    {'boundary_edge': 3}
    """
    if _is_path(mesh):
        return Check.of({label: _loft.check(*one) for label, one in read_meshes(mesh).items()})
    return Check.of({"": _loft.check(*arrays_of(mesh))})


def measure(mesh: Any) -> Measures:
    """Size and shape of a mesh: a file with one, (vertices, faces), or an object with these."""
    if _is_path(mesh):
        parts = read_meshes(mesh)
        if len(parts) != 1:
            raise InputError(f"{os.fspath(mesh)}: it has {len(parts)} meshes; measure those of "
                             "read_meshes() one by one")
        mesh = next(iter(parts.values()))
    return Measures(**_loft.measure(*arrays_of(mesh)))


def section(mesh: Any, heights: Any) -> List[Section]:
    """The outlines of a mesh at some heights, decided exactly; one height or a list."""
    levels = np.atleast_1d(numbers(heights, "heights"))
    return [Section(*one) for one in _loft.sections(*arrays_of(mesh), levels)]
