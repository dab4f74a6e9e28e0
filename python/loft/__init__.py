# SPDX-License-Identifier: MIT
"""Closed surfaces from stacks of planar contours, exact and valid.

Axes of volumes are z, y, x; points are x, y; vertices are x, y, z.

>>> import loft
>>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
>>> loft.reconstruct([(0.0, [square]), (1.0, [square])]).surface
<loft.Surface: 8 vertices, 12 faces>
"""

import atexit as _atexit

from . import _loft
from .errors import Cancelled, Defect, Error, FileError, InputError
from .live import Change, Patch, Reconstruction, Slab
from .mesh import Check, Finding, Measures, Section, check, measure, read_meshes, section
from .reconstructed import Reconstructed, reconstruct
from .stack import Contour, Slice, Stack, read
from .surface import FaceKind, Surface, VertexKind, Written
from .triangulation import Edges, Fault, Snaps, TriangleChanges, Triangles, Triangulation

__version__: str = _loft.version
__all__ = [
    "Cancelled", "Change", "Check", "Contour", "Defect", "Edges", "Error", "FaceKind", "Fault",
    "FileError", "Finding", "InputError", "Measures", "Patch", "Reconstructed",
    "Reconstruction", "Section", "Slab", "Slice", "Snaps", "Stack", "Surface",
    "TriangleChanges", "Triangles", "Triangulation", "VertexKind", "Written", "check",
    "measure", "read", "read_meshes", "reconstruct", "section",
]

_atexit.register(_loft.wait_for_abandoned)
