# SPDX-License-Identifier: MIT
"""Ten thousand calls with what comes to hand: an exception is raised, or it works; nothing else."""

import os
import tempfile
import unittest

import numpy as np

import loft
from cases import SQUARE, ball, seeded

CALLS = int(os.environ.get("LOFT_CALLS", 10000))


def values(random):
    """Things that make no sense in most places."""
    square = np.array(SQUARE, dtype=float)
    return [
        None, True, 0, 1, -1, 2**70, 0.5, float("nan"), float("inf"), 1e300, "", "a", b"\0", "\udc80",
        (), [], {}, [[]], [()], object(), type, len, SQUARE, [SQUARE], [(0, [SQUARE])], square,
        square.astype(np.float32), square.T, square[::2], square[:0], np.zeros((3, 3, 3)),
        np.zeros((0, 2)), np.array(5), np.array(["x"]), np.array([None]), np.zeros(4, complex),
        np.ma.masked_array([1.0, 2.0], mask=[1, 0]), np.full((4, 2), np.nan), ball(6, 2),
        ball(6, 2).astype(int), np.array([(0, 0)], dtype=[("x", int), ("y", int)]),
        np.array([[0, 1, 2]], dtype=np.uint32), {"a": [SQUARE]}, {1: "x"}, range(3), iter([1, 2]),
        (square, [[0, 1, 2]]), lambda *_: False, random.normal(size=(5, 3)), "flat", 1e-320,
    ]


class RandomCalls(unittest.TestCase):
    def test_never_crash(self):
        random = seeded()
        good = loft.Stack([(0, [SQUARE]), (1, [SQUARE])])
        made = loft.reconstruct(good)
        from loft import _loft

        things = [
            (loft.Stack, ["unit"]), (loft.Stack.from_arrays, ["label", "unit"]),
            (loft.Stack.from_mask, ["spacing", "origin", "affine", "labels", "level", "outline"]),
            (loft.reconstruct, ["only", "fill", "cap", "smooth", "max_edge", "links", "threads",
                                "fair", "progress"]),
            (lambda *a, **k: loft.reconstruct(good, *a, **k),
             ["only", "leave_out", "fill", "keyhole_width", "tolerance", "cap", "link", "max_shift",
              "links", "smooth", "simplify", "slabs", "threads", "progress"]),
            (loft.check, []), (loft.measure, []), (loft.section, []),
            (lambda *a: loft.section(made.surface, *a), []),
            (good.only, ["leave_out"]), (made.surface.section, []), (made.__getitem__, []),
            (_loft.stack_from_arrays, []), (_loft.surface_from_arrays, []), (_loft.trace, []),
            (_loft.reconstruct, []), (_loft.check, []), (_loft.sections, []), (_loft.measure, []),
            (lambda *a: good._stack.set_frame(*a), []),
            (lambda *a: loft.Stack([(0, [SQUARE])])._stack.set_rest(*a), []),
            (lambda *a: made.write(os.path.join(folder, "a.glb"), **dict(zip(
                ["unit", "compress", "hide", "with_contours"], a))), []),
        ]
        worked = raised = 0
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(CALLS):
                call, names = things[random.integers(len(things))]
                pool = values(random)

                def pick():
                    return pool[random.integers(len(pool))]

                arguments = [pick() for _ in range(random.integers(0, 10 if not names else 4))]
                options = {n: pick() for n in names if random.random() < 0.3}
                try:
                    call(*arguments, **options)
                    worked += 1
                except Exception as error:  # what kind it is, is asked elsewhere
                    raised += 1
                    self.assertNotIsInstance(error, (SystemError, MemoryError), repr(error))
        self.assertEqual(worked + raised, CALLS)
        self.assertGreater(worked, CALLS // 200)
        self.assertGreater(raised, CALLS // 4)


if __name__ == "__main__":
    unittest.main()
