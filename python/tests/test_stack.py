# SPDX-License-Identifier: MIT
import pickle
import types
import unittest
import unittest.mock

import numpy as np

import loft
from cases import SQUARE, ball, random_slices, seeded


class AStack(unittest.TestCase):
    def test_takes_rings_of_all_kinds(self):
        points = np.array(SQUARE, dtype=float)
        wide = np.zeros((4, 4))
        wide[:, ::2] = points
        kinds = {
            "list": SQUARE,
            "float32": points.astype(np.float32),
            "whole": np.array(SQUARE, dtype=np.int16),
            "strided": wide[:, ::2],
            "columns first": np.asfortranarray(points),
            "big-endian": points.astype(">f8"),
            "with z": np.c_[points, np.full(4, 7.0)],
            "ring": types.SimpleNamespace(coords=SQUARE + SQUARE[:1]),
        }
        for name, ring in kinds.items():
            with self.subTest(name):
                made = loft.Stack([(0, [ring])]).slices[0].contours[0].points
                np.testing.assert_array_equal(made, points)

    def test_takes_polygons_with_holes(self):
        hole = types.SimpleNamespace(coords=[(1, 1), (2, 1), (2, 2), (1, 1)])
        outline = types.SimpleNamespace(coords=SQUARE + SQUARE[:1])
        polygon = types.SimpleNamespace(exterior=outline, interiors=[hole])
        both = types.SimpleNamespace(geoms=[polygon, polygon])
        self.assertEqual([len(c.points) for c in loft.Stack([(0, polygon)]).slices[0].contours],
                         [4, 3])
        self.assertEqual(len(loft.Stack([(0, [both])]).slices[0].contours), 4)

    def test_says_where_it_is_wrong(self):
        bad = [(0, 0), (1, float("nan")), (1, 1)]
        cases = [
            ([(0, [SQUARE]), (1, [SQUARE, bad])], 1, 1, 1),
            ([(0, [SQUARE]), (1, [SQUARE, [1, 2, 3]])], 1, 1, None),
            ([(0, [SQUARE]), (1, [np.zeros((3, 5))])], 1, 0, None),
            ([(0, [np.ma.masked_array(SQUARE, mask=np.eye(4, 2))])], 0, 0, None),
            ([(0, [[("a", "b")] * 3])], 0, 0, None),
            ([(0, [[(0, 0, 1), (1, 0, 1), (0, 1, 2)]])], 0, 0, None),
        ]
        for slices, number, contour, point in cases:
            with self.subTest(str(slices)[-60:]):
                with self.assertRaises(loft.InputError) as raised:
                    loft.Stack(slices)
                error = raised.exception
                self.assertEqual((error.slice, error.contour, error.point), (number, contour, point))
                self.assertEqual(str(pickle.loads(pickle.dumps(error))), str(error))

    def test_names_all_that_is_wrong(self):
        bad = [(0, 0), (float("inf"), 0), (1, float("nan"))]
        with self.assertRaises(loft.InputError) as raised:
            loft.Stack([(0, [bad]), (1, [bad])])
        self.assertEqual(len(raised.exception.defects), 4)

    def test_comes_from_flat_arrays_and_back(self):
        random = seeded()
        stack = loft.Stack(random_slices(random, labels=("a", "b")))
        columns = stack.to_arrays()
        again = loft.Stack.from_arrays(np.c_[columns["x"], columns["y"]], columns["z"],
                                       columns["contour"], columns["label"])
        self.assertEqual(again, stack)
        self.assertEqual(again.labels, ["a", "b"])

    def test_pickles_with_all_that_it_knows(self):
        affine = np.array([[0.0, -2, 0.1, 5], [1, 0, 0.2, 6], [0, 0, 3, 7], [0, 0, 0, 1]])
        for stack in (
            loft.Stack(random_slices(seeded(), labels=("a", "b")), unit="um"),
            loft.Stack.from_mask(ball().astype(int), affine=affine, labels={1: "ball"}),
        ):
            again = pickle.loads(pickle.dumps(stack))
            self.assertEqual(again, stack)
            self.assertEqual(again.unit, stack.unit)

    def test_chooses_labels_by_patterns(self):
        stack = loft.Stack([(0, {"Lung L": [SQUARE], "Lung R": [SQUARE], "Heart": [SQUARE]})])
        self.assertEqual(stack.only("Lung*").labels, ["Lung L", "Lung R"])
        self.assertEqual(stack.only(leave_out=["Lung*"]).labels, ["Heart"])
        with self.assertRaisesRegex(loft.InputError, "no label is called 'Liver'"):
            stack.only("Liver")


class AMask(unittest.TestCase):
    def test_has_its_axes_in_the_order_z_y_x(self):
        volume = np.zeros((3, 4, 5), dtype=bool)
        volume[1, 2, 3] = True
        stack = loft.Stack.from_mask(volume, spacing=(100, 10, 1), origin=(1000, 200, 30))
        points = np.concatenate([c.points for s in stack.slices for c in s.contours])
        np.testing.assert_allclose(points.mean(axis=0), [30 + 3, 200 + 20])
        np.testing.assert_allclose(stack.heights, [1000, 1100, 1200])

    def test_is_traced_whatever_its_numbers_and_strides(self):
        mask = ball(16, 5)
        expected = loft.Stack.from_mask(mask.astype(np.uint8), (2, 1, 1))
        for kind in "i1 i2 i4 i8 u1 u2 u4 u8 >i2 >u4".split():
            with self.subTest(kind):
                self.assertEqual(loft.Stack.from_mask(mask.astype(kind), (2, 1, 1)), expected)
        wide = np.zeros((16, 32, 48), dtype=np.int32)
        wide[:, ::2, ::3] = mask
        for strided in (wide[:, ::2, ::3], np.asfortranarray(mask.astype(int)),
                        mask[::-1].astype(np.uint8)[::-1]):
            self.assertEqual(loft.Stack.from_mask(strided, (2, 1, 1)), expected)

    def test_keeps_apart_ids_beyond_what_doubles_hold(self):
        first = 720575940621039145  # and the next one is the same double
        volume = np.zeros((4, 6, 12), dtype=np.uint64)
        volume[:, 1:5, 1:5] = first
        volume[:, 1:5, 7:11] = first + 1
        stack = loft.Stack.from_mask(volume, (1, 1, 1), labels={first: "a"})
        self.assertEqual(stack.labels, [str(first + 1), "a"])

    def test_may_have_shares(self):
        z, y, x = np.mgrid[:24, :24, :24] - 11.5
        shares = np.clip(0.5 + (8 - np.sqrt(x * x + y * y + z * z)) / 4, 0, 1)
        for kind in (np.float16, np.float32, np.float64):
            made = loft.reconstruct(loft.Stack.from_mask(shares.astype(kind), (1, 1, 1)))
            self.assertAlmostEqual(made.surface.volume, 4 / 3 * np.pi * 512, delta=40)

    def test_may_overlap_others(self):
        masks = {"left": ball(), "right": np.roll(ball(), 3, axis=2)}
        made = loft.reconstruct(loft.Stack.from_mask(masks, (1, 1, 1)))
        self.assertEqual(list(made), ["left", "right"])
        self.assertAlmostEqual(made["left"].volume, made["right"].volume)

    def test_of_an_image_lies_where_the_image_says(self):
        mask = ball().astype(np.uint8)
        nibabel = types.SimpleNamespace(dataobj=mask.transpose(2, 1, 0),
                                        affine=np.diag([1.0, 2, 3, 1]))
        expected = loft.Stack.from_mask(mask, (3, 2, 1))
        self.assertEqual(loft.Stack.from_nibabel(nibabel), expected)

        class Image:
            def GetDirection(self):
                return (1, 0, 0, 0, 1, 0, 0, 0, 1)

            def GetSpacing(self):
                return (1, 2, 3)

            def GetOrigin(self):
                return (0, 0, 0)

        Image.__module__ = "fake_sitk"
        package = types.ModuleType("fake_sitk")
        package.GetArrayFromImage = lambda image: mask
        with unittest.mock.patch.dict("sys.modules", fake_sitk=package):
            self.assertEqual(loft.Stack.from_sitk(Image()), expected)

    def test_that_is_none_is_refused(self):
        good = ball()
        for arguments in (
            dict(volume=good[0], spacing=(1, 1, 1)),
            dict(volume=good.astype(complex), spacing=(1, 1, 1)),
            dict(volume=good),
            dict(volume=good, spacing=(1, 1)),
            dict(volume=good, spacing=(1, 0, 1)),
            dict(volume=good, spacing=(1, float("nan"), 1)),
            dict(volume=good, affine=np.zeros((4, 4))),
            dict(volume=good, affine=np.eye(3)),
            dict(volume=good, spacing=(1, 1, 1), affine=np.eye(4)),
            dict(volume=np.zeros((4, 4, 4), bool), spacing=(1, 1, 1)),
            dict(volume=-good.astype(int), spacing=(1, 1, 1)),
            dict(volume=np.ma.masked_array(good, mask=~good), spacing=(1, 1, 1)),
            dict(volume={}, spacing=(1, 1, 1)),
            dict(volume={"a": good, "b": good[1:]}, spacing=(1, 1, 1)),
            dict(volume=good, spacing=(1, 1, 1), outline="round"),
        ):
            with self.subTest(str(arguments)[-70:]):
                self.assertRaises(loft.InputError, lambda: loft.Stack.from_mask(**arguments))


if __name__ == "__main__":
    unittest.main()
