# SPDX-License-Identifier: MIT
"""What goes wrong, with its place in fields."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, Optional, Tuple


@dataclass(frozen=True)
class Defect:
    """One thing that is or was wrong with the input, and where.

    Indices are those of the input; None where they do not apply. `area` is how much of the slice a
    repair decided, in square units.
    """

    kind: str
    message: str
    z: float = 0.0
    slice: int = 0
    contour: Optional[int] = None
    point: Optional[int] = None
    place: Optional[Tuple[float, float]] = None
    area: float = 0.0


class Error(Exception):
    """Base of every exception that loft raises on purpose."""


class InputError(Error, ValueError):
    """The input cannot be worked on. The text and `defects` have all that is wrong, not the first.

    `slice`, `contour`, `point` and `z` are those of the first defect, None without one.
    """

    def __init__(self, message: str, defects: Iterable[Any] = ()) -> None:
        self.message = message
        self.defects: Tuple[Defect, ...] = tuple(
            defect if isinstance(defect, Defect) else Defect(*defect) for defect in defects
        )
        super().__init__(message, self.defects)

    def __str__(self) -> str:
        return self.message

    @property
    def slice(self) -> Optional[int]:
        return self.defects[0].slice if self.defects else None

    @property
    def z(self) -> Optional[float]:
        return self.defects[0].z if self.defects else None

    @property
    def contour(self) -> Optional[int]:
        return self.defects[0].contour if self.defects else None

    @property
    def point(self) -> Optional[int]:
        return self.defects[0].point if self.defects else None


class FileError(Error, OSError):
    """A file cannot be read or written; `filename` is its path."""

    def __init__(self, message: str, filename: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.filename = filename

    def __str__(self) -> str:
        return self.message

    def __reduce__(self) -> Any:
        return (type(self), (self.message, self.filename))


class Cancelled(Error):
    """The progress function returned False."""
