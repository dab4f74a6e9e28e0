# SPDX-License-Identifier: MIT
"""Pictures of surfaces without a screen, by numpy alone."""

from __future__ import annotations

import struct
import zlib
from typing import Iterable, Tuple

import numpy as np
from numpy.typing import NDArray

Part = Tuple[NDArray[np.float64], NDArray[np.uint32], Tuple[int, int, int]]

_MOST_SAMPLES = 1 << 21
_LIGHT = np.array([-0.35, 0.45, 0.82])


def _view(azimuth: float, elevation: float) -> NDArray[np.float64]:
    """Rows: to the right, up, and towards the eye; z is up."""
    a, e = np.radians([azimuth, elevation])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    return np.stack([right, np.cross(eye, right), eye])


class _Canvas:
    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self.depth = np.full(width * height, -np.inf)
        self.colour = np.full((width * height, 3), 255, dtype=np.uint8)

    def draw(self, corners: NDArray[np.float64], shade: NDArray[np.uint8]) -> None:
        """Triangles (n, 3, 3) in pixels and depth, by classes of size."""
        low = np.floor(corners[:, :, :2].min(axis=1)).astype(np.int64)
        size = np.ceil(corners[:, :, :2].max(axis=1)).astype(np.int64) - low + 1
        side = np.maximum(size.max(axis=1), 1)
        power = np.ceil(np.log2(side)).astype(np.int64)
        for p in np.unique(power):
            chosen = np.flatnonzero(power == p)
            step = max(1, _MOST_SAMPLES >> int(2 * p))
            for begin in range(0, len(chosen), step):
                part = chosen[begin:begin + step]
                self._draw(corners[part], low[part], shade[part], 1 << int(p))

    def _draw(self, corners: NDArray[np.float64], low: NDArray[np.int64],
              shade: NDArray[np.uint8], side: int) -> None:
        dx, dy = (axis.ravel() for axis in np.meshgrid(np.arange(side), np.arange(side)))
        x = low[:, :1] + dx
        y = low[:, 1:] + dy
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (corners[:, i].T[:, :, None] for i in range(3))
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        with np.errstate(divide="ignore", invalid="ignore"):
            u = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
            v = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
        inside = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9)
        inside &= (x >= 0) & (x < self.width) & (y >= 0) & (y < self.height)
        face, sample = np.nonzero(inside)
        depth = (az + u * (bz - az) + v * (cz - az))[face, sample]
        pixel = (self.height - 1 - y[face, sample]) * self.width + x[face, sample]
        order = np.argsort(depth, kind="stable")
        order = order[depth[order] > self.depth[pixel[order]]]
        self.depth[pixel[order]] = depth[order]
        self.colour[pixel[order]] = shade[face[order]]


def render(parts: Iterable[Part], width: int = 480, height: int = 360, azimuth: float = -60.0,
           elevation: float = 25.0) -> NDArray[np.uint8]:
    """An (height, width, 3) picture of surfaces, seen from that direction in degrees, z up."""
    scale = 2  # so many samples a pixel and direction
    canvas = _Canvas(width * scale, height * scale)
    view = _view(azimuth, elevation)
    drawn = [(v @ view.T, f, c) for v, f, c in parts if len(f)]
    if drawn:
        low = np.min([v.min(axis=0) for v, _, _ in drawn], axis=0)
        high = np.max([v.max(axis=0) for v, _, _ in drawn], axis=0)
        extent = np.maximum(high - low, 1e-300)
        zoom = 0.92 * min(canvas.width / extent[0], canvas.height / extent[1])
        middle = (low + high) / 2
        centre = np.array([canvas.width / 2, canvas.height / 2, 0])
        for places, faces, colour in drawn:
            corners = ((places - middle) * zoom + centre)[faces.astype(np.int64)]
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            length = np.linalg.norm(normal, axis=1)
            light = (normal @ _LIGHT) / np.where(length > 0, length, 1)
            shade = np.clip(0.35 + 0.65 * np.abs(light), 0, 1)[:, None] * np.asarray(colour)
            canvas.draw(corners, shade.astype(np.uint8))
    fine = canvas.colour.reshape(height, scale, width, scale, 3)
    picture: NDArray[np.uint8] = fine.mean(axis=(1, 3)).astype(np.uint8)
    return picture


def png(picture: NDArray[np.uint8]) -> bytes:
    """The bytes of a PNG file."""
    height, width, _ = picture.shape
    rows = np.zeros((height, 1 + 3 * width), dtype=np.uint8)
    rows[:, 1:] = picture.reshape(height, -1)

    def chunk(kind: bytes, content: bytes) -> bytes:
        checksum = zlib.crc32(kind + content)
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", checksum)

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))
