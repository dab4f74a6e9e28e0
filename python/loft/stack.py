# SPDX-License-Identifier: MIT
"""Stacks of planar contours: from files, rings, flat arrays and masks."""

from __future__ import annotations

import os
import sys
from fnmatch import fnmatchcase
from typing import (Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union)

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _loft
from .errors import InputError
from .rings import Points, height_of, numbers, plain_array, rings_of

Path = Union[str, "os.PathLike[str]"]
Colour = Tuple[int, int, int]


class Contour(NamedTuple):
    """A closed polygon in a slice; the last point joins the first."""

    points: Points
    label: str


class Slice(NamedTuple):
    """A height and the contours in it."""

    z: float
    contours: List[Contour]


def matching(labels: Sequence[str], only: Any, leave_out: Any) -> List[str]:
    """The labels that patterns with `*`, `?` and `[...]` choose, in their order."""
    wanted = _patterns(only)
    unwanted = _patterns(leave_out)
    for pattern in (wanted or []) + (unwanted or []):
        if not any(label == pattern or fnmatchcase(label, pattern) for label in labels):
            known = ", ".join(repr(label) for label in labels[:20])
            raise InputError(f"no label is called {pattern!r}; there are {known}")

    def fits(label: str, patterns: List[str]) -> bool:
        return any(label == pattern or fnmatchcase(label, pattern) for pattern in patterns)

    chosen = [
        label
        for label in labels
        if (wanted is None or fits(label, wanted)) and not fits(label, unwanted or [])
    ]
    if labels and not chosen:
        raise InputError("no label is left")
    return chosen


def _patterns(given: Any) -> Optional[List[str]]:
    if given is None:
        return None
    patterns = [given] if isinstance(given, str) else list(given)
    if not all(isinstance(pattern, str) for pattern in patterns):
        raise InputError("labels: names or patterns are wanted")
    return patterns


def _by_label(given: Any) -> Iterable[Tuple[str, Any]]:
    """Label and rings of a slice: {label: rings}, or rings without labels."""
    if isinstance(given, Mapping):
        return [(str(label), rings) for label, rings in given.items()]
    return [("", given)]


class _Builder:
    """Gathers contours one behind the other."""

    def __init__(self) -> None:
        self.points: List[Points] = []
        self.slices: List[int] = []
        self.labels: List[int] = []
        self.names: Dict[str, int] = {}
        self.heights: List[float] = []

    def add_slice(self, z: Any, given: Any) -> None:
        number = len(self.heights)
        self.heights.append(height_of(z, f"slice {number}"))
        place = f"slice {number} (z = {self.heights[-1]:g})"
        first = 0
        for label, rings in _by_label(given):
            arrays = rings_of(rings, place, number, self.heights[-1], first)
            first += len(arrays)
            self.points += arrays
            self.slices += [number] * len(arrays)
            self.labels += [self.names.setdefault(label, len(self.names))] * len(arrays)

    def build(self, unit: str) -> Any:
        sizes = [len(points) for points in self.points]
        return _loft.stack_from_arrays(
            np.concatenate(self.points) if self.points else np.empty((0, 2)),
            np.concatenate([[0], np.cumsum(sizes, dtype=np.int64)]).astype(np.int64),
            np.array(self.slices, dtype=np.int64),
            np.array(self.labels, dtype=np.int64),
            list(self.names),
            np.array(self.heights, dtype=np.float64),
            unit,
        )


class Stack:
    """Slices of planar contours, as they came in: nothing is cleaned, sorted or merged.

    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> stack = Stack([(0.0, [square]), (1.0, {"heart": [square]})], unit="mm")
    >>> stack.labels
    ['', 'heart']

    Each slice is (z, rings) or (z, {label: rings}). A ring is an (n, 2) array, a list of pairs, an
    object with `__array__`, or a shapely geometry; it is closed without repeating its first point.
    Raises InputError that names slice, contour and point.
    """

    def __init__(self, slices: Iterable[Tuple[Any, Any]] = (), *, unit: str = "") -> None:
        builder = _Builder()
        for number, one in enumerate(slices):
            try:
                z, rings = one
            except (TypeError, ValueError):
                raise InputError(f"slice {number}: (z, rings) is wanted") from None
            builder.add_slice(z, rings)
        self._stack: Any = builder.build(str(unit))
        self._sources: List[str] = []
        self._files: Dict[str, str] = {}

    @classmethod
    def _of(cls, stack: Any, sources: Sequence[str] = (),
            files: Optional[Mapping[str, str]] = None) -> Stack:
        """sources: names of its files; files: the one that each label was named after."""
        made = cls.__new__(cls)
        made._stack = stack
        made._sources = list(sources)
        made._files = dict(files or {})
        return made

    @classmethod
    def from_arrays(cls, xy: ArrayLike, z: ArrayLike, contour: ArrayLike,
                    label: Optional[ArrayLike] = None, *, unit: str = "") -> Stack:
        """From one row a point: (n, 2) places, and (n,) heights, contour numbers and labels.

        Points of a contour follow one another; where number, label or height changes, another
        one begins. These are the columns of imodmodel's tables. Slices come in order of height.
        """
        points = numbers(xy, "xy")
        if points.ndim != 2 or points.shape[1] != 2:
            raise InputError(f"xy: an array of shape (n, 2) is wanted, not {points.shape}")
        count = len(points)
        heights = numbers(z, "z")
        contours = plain_array(contour, "contour")
        labels = plain_array(label if label is not None else np.full(count, ""), "label")
        for name, column in (("z", heights), ("contour", contours), ("label", labels)):
            if column.shape != (count,):
                raise InputError(f"{name}: one for each of {count} points is wanted")
        levels, level_of = np.unique(heights, return_inverse=True)
        names, name_of = np.unique(labels.astype(str), return_inverse=True)
        begins = np.ones(count, dtype=bool)
        begins[1:] = ((contours[1:] != contours[:-1]) | (name_of[1:] != name_of[:-1])
                      | (level_of[1:] != level_of[:-1]))
        firsts = np.flatnonzero(begins)
        return cls._of(_loft.stack_from_arrays(
            points, np.append(firsts, count).astype(np.int64), level_of[firsts].astype(np.int64),
            name_of[firsts].astype(np.int64), [str(name) for name in names], levels, str(unit)))

    @classmethod
    def from_mask(cls, volume: Any, spacing: Optional[Sequence[float]] = None, *,
                  origin: Optional[Sequence[float]] = None, affine: Optional[ArrayLike] = None,
                  labels: Optional[Mapping[int, str]] = None, level: Optional[float] = None,
                  outline: str = "iso", unit: str = "mm", threads: int = 0) -> Stack:
        """The outlines of masks in an array with axes **z, y, x**: `volume[z, y, x]`.

        volume: whole numbers are labels (0: outside), named by `labels`; bool is one mask; floats
            are shares or probabilities, inside from `level` on (default 0.5). A mapping
            {name: mask} has masks that may overlap.
        spacing, origin: distances of pixel centres, and the place of the first one, both in the
            order of the axes, z, y, x; or
        affine: a (4, 4) matrix from (column, row, slice, 1) to x, y, z, as nibabel has it for
            images with axes x, y, z.
        outline: `iso` (half way between pixel centres), `edges` (along the pixels' edges) or
            `fair` (as smooth as can be with the same pixels and the same area inside).
        """
        layers, told, is_share = _layers(volume, labels)
        if level is not None or is_share:
            level = 0.5 if level is None else float(level)
        matrix = _affine(spacing, origin, affine)
        made = _loft.trace(layers, matrix, told, level, str(unit),
                           {"outline": outline, "threads": threads})
        stack = cls._of(made)
        if isinstance(volume, Mapping) or level is None and layers[0].dtype != np.bool_:
            return stack
        return stack if labels else stack._unlabelled()

    @classmethod
    def from_sitk(cls, image: Any, **options: Any) -> Stack:
        """The outlines of a SimpleITK image of labels, in its world (LPS); options of from_mask."""
        package = sys.modules[type(image).__module__.partition(".")[0]]
        pixels = package.GetArrayFromImage(image)
        if np.ndim(pixels) != 3:
            raise InputError("image: one with three axes is wanted")
        matrix = np.eye(4)
        matrix[:3, :3] = np.reshape(image.GetDirection(), (3, 3)) * np.asarray(image.GetSpacing())
        matrix[:3, 3] = image.GetOrigin()
        return cls.from_mask(pixels, affine=matrix, **options)

    @classmethod
    def from_nibabel(cls, image: Any, **options: Any) -> Stack:
        """The outlines of a nibabel image of labels, in its world (RAS); options of from_mask."""
        pixels = np.asarray(image.dataobj)
        if pixels.ndim != 3:
            raise InputError("image: one with three axes is wanted")
        return cls.from_mask(pixels.transpose(2, 1, 0), affine=image.affine, **options)

    def _unlabelled(self) -> Stack:
        points, offsets, slices, labels, _, heights = self._stack.arrays()
        rest = list(self._stack.rest())
        rest[1] = []
        stack = _loft.stack_from_arrays(points, offsets, slices, labels * 0, [""], heights, self.unit)
        stack.set_rest(*rest)
        return Stack._of(stack, self._sources)

    @property
    def labels(self) -> List[str]:
        """The names of all structures, sorted; '' where contours have none."""
        return list(self._stack.labels())

    @property
    def colours(self) -> Dict[str, Colour]:
        """Red, green and blue from 0 to 255, of the labels whose source says so."""
        return {name: colour for name, colour, *_ in self._stack.told() if colour is not None}

    @property
    def heights(self) -> NDArray[np.float64]:
        """(slices,) z of each slice, in the order of the input."""
        heights: NDArray[np.float64] = self._stack.arrays()[5]
        return heights

    @property
    def unit(self) -> str:
        """`mm`, `um`, ...; empty where the source has none."""
        return str(self._stack.unit)

    @unit.setter
    def unit(self, unit: str) -> None:
        self._stack = self._stack.with_unit(str(unit))

    @property
    def notes(self) -> List[str]:
        """What was left out while reading, and why."""
        return list(self._stack.notes)

    @property
    def frame(self) -> Optional[NDArray[np.float64]]:
        """(4, 4) from x, y in a slice and its z to the world; None: they are the world's."""
        frame: Optional[NDArray[np.float64]] = self._stack.frame()
        return frame

    @property
    def slices(self) -> List[Slice]:
        """All slices with their contours, as arrays that cannot be written to."""
        points, offsets, numbers_, labels, names, heights = self._stack.arrays()
        slices = [Slice(float(z), []) for z in heights]
        for i, number in enumerate(numbers_):
            slices[number].contours.append(
                Contour(points[offsets[i]:offsets[i + 1]], names[labels[i]]))
        return slices

    def to_arrays(self) -> Dict[str, NDArray[Any]]:
        """One row a point: x, y, z, contour, label; `pandas.DataFrame(stack.to_arrays())`."""
        points, offsets, slices, labels, names, heights = self._stack.arrays()
        sizes = np.diff(offsets)
        return {
            "x": points[:, 0],
            "y": points[:, 1],
            "z": np.repeat(heights[slices], sizes),
            "contour": np.repeat(np.arange(len(sizes)), sizes),
            "label": np.repeat(np.array(names + [""], dtype=object)[labels], sizes),
        }

    def only(self, only: Any = None, *, leave_out: Any = None) -> Stack:
        """A stack with some labels alone, by names or patterns; all slices stay."""
        return Stack._of(self._stack.only(matching(self.labels, only, leave_out)), self._sources,
                         self._files)

    def write(self, path: Path) -> List[str]:
        """Writes the stack; the extension chooses the format. Returns what it cannot hold."""
        return list(self._stack.write(os.fsencode(path)))

    def __len__(self) -> int:
        return int(self._stack.slice_count())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Stack) and bool(self._stack == other._stack)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        labels = [label for label in self.labels if label]
        named = f", {len(labels)} labels" if labels else ""
        return f"<loft.Stack: {len(self)} slices{named}>"

    def __reduce__(self) -> Any:
        return (_restored, (self._stack.arrays(), self.unit, self._stack.rest(), self._sources,
                            self._files))


def _restored(arrays: Any, unit: str, rest: Any, sources: List[str],
              files: Dict[str, str]) -> Stack:
    points, offsets, slices, labels, names, heights = arrays
    stack = _loft.stack_from_arrays(points, offsets, slices, labels, names, heights, unit)
    stack.set_rest(*rest)
    return Stack._of(stack, sources, files)


def _layers(volume: Any, labels: Any) -> Tuple[List[NDArray[Any]], List[Any], bool]:
    """Arrays, what is told of their values, and whether these are shares."""
    if isinstance(volume, Mapping):
        layers = [_pixels(mask, f"mask {name!r}") for name, mask in volume.items()]
        kinds = {layer.dtype.kind == "f" for layer in layers}
        if len(kinds) > 1:
            raise InputError("masks: all are shares, or none is")
        is_share = kinds == {True}
        if not is_share:
            layers = [layer.astype(bool) for layer in layers]
        return layers, [(str(name), i, 1.0) for i, name in enumerate(volume)], is_share
    pixels = _pixels(volume, "volume")
    if pixels.dtype.kind in "ui" and pixels.dtype.itemsize == 8:
        pixels, labels = _renumbered(pixels, labels)
    is_share = pixels.dtype.kind == "f" and not labels
    told = []
    for value, name in (labels or {}).items():
        try:
            told.append((str(name), 0, float(value)))
        except (TypeError, ValueError):
            raise InputError(f"labels: {value!r} is no value of a pixel") from None
    return [pixels], told, is_share


def _renumbered(pixels: NDArray[Any], labels: Any) -> Tuple[NDArray[Any], Any]:
    """Values beyond 32 bits, as segments of large volumes have, by small numbers in their order."""
    if pixels.size == 0 or int(pixels.max()) <= 0xFFFFFFFF or int(pixels.min()) < 0:
        return pixels, labels
    values, number_of = np.unique(pixels, return_inverse=True)
    names = {int(value): name for value, name in (labels or {}).items()}
    numbers_ = np.cumsum(values != 0) * (values != 0)
    told = {int(number): str(names.get(int(value), int(value)))
            for number, value in zip(numbers_, values) if number}
    return numbers_.astype(np.uint32)[number_of].reshape(pixels.shape), told


def _pixels(values: Any, what: str) -> NDArray[Any]:
    array = plain_array(values, what)
    if array.ndim != 3:
        raise InputError(f"{what}: axes z, y, x are wanted; it has {array.ndim}")
    if array.dtype.kind not in "buif":
        raise InputError(f"{what}: numbers are wanted, not {array.dtype}")
    if array.dtype == np.float16 or array.dtype.itemsize > 8:
        array = array.astype(np.float32 if array.dtype == np.float16 else np.float64)
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))


def _three(values: Any, what: str) -> NDArray[np.float64]:
    three = numbers(values, what)
    if three.shape != (3,):
        raise InputError(f"{what}: three numbers are wanted, (z, y, x)")
    return three


def _affine(spacing: Any, origin: Any, affine: Any) -> NDArray[np.float64]:
    matrix = np.eye(4)
    if affine is not None:
        if spacing is not None or origin is not None:
            raise InputError("affine: it says spacing and origin; leave these out")
        matrix = numbers(affine, "affine")
        if matrix.shape != (4, 4):
            raise InputError(f"affine: an array of shape (4, 4) is wanted, not {matrix.shape}")
        return matrix
    if spacing is None:
        raise InputError("spacing: the distances of pixel centres are wanted, (z, y, x)")
    distances = _three(spacing, "spacing")
    if not (distances > 0).all():
        raise InputError("spacing: lengths above 0 are wanted")
    matrix[[0, 1, 2], [0, 1, 2]] = distances[::-1]
    if origin is not None:
        matrix[:3, 3] = _three(origin, "origin")[::-1]
    return matrix


def read(path: Union[Path, Sequence[Path]], *, only: Any = None, leave_out: Any = None,
         merge: bool = False, spacing: Optional[Sequence[float]] = None, outline: str = "iso",
         level: Optional[float] = None, fill: Optional[str] = None,
         z_property: Optional[str] = None, close: Optional[str] = None,
         alignment: Optional[str] = None, threads: int = 0) -> Stack:
    """The stack in a file of any format that loft reads, or in several.

    only, leave_out: labels, or patterns of them; a name or a list.
    merge: several files are one stack; otherwise contours without a label take their file's name.
    spacing: distances of pixels along x and y, and of slices, for images that do not say them (in
        this order, as the program has it).
    outline, level, fill, z_property, close, alignment: as `loft reconstruct --help` says.
    Raises FileError, and InputError that lists all that is wrong.
    """
    paths = [path] if isinstance(path, (str, os.PathLike)) else list(path)
    names = [os.fspath(one) for one in paths]
    if not names or not all(isinstance(name, str) for name in names):
        raise InputError("path: a path, or a list of paths, is wanted")
    encoded = [os.fsencode(name) for name in names]
    stack = _loft.read(encoded, {
        "spacing": spacing, "outline": outline, "level": level, "fill": fill,
        "z_property": z_property, "close": close, "alignment": alignment,
        "label_by_file": not merge, "threads": threads})
    sources = [os.path.basename(os.path.normpath(os.fsdecode(name))) for name in names]
    files = {} if merge or len(names) == 1 else dict(zip(_loft.labels_of(encoded), sources))
    read_ = Stack._of(stack, sources, files)
    return read_.only(only, leave_out=leave_out) if only or leave_out else read_
