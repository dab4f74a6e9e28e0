# SPDX-License-Identifier: MIT
"""Laws of loft.Reconstruction."""

import collections
import doctest
import math
import pickle
import random
import unittest

import numpy as np

from cases import failures_in_threads, seeded

import loft
from loft import live as live_module

ERRORS = (loft.Error, TypeError, ValueError, OverflowError)
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def blob(random_, points=14):
    """A star-shaped ring somewhere near the origin."""
    x, y, size = random_.uniform(-2, 2), random_.uniform(-2, 2), random_.uniform(1, 3)
    return np.array([(x + size * random_.uniform(0.6, 1) * math.cos(2 * math.pi * i / points),
                      y + size * random_.uniform(0.6, 1) * math.sin(2 * math.pi * i / points))
                     for i in range(points)])


def blobs(random_):
    return [blob(random_) for _ in range(random_.choice([0, 1, 1, 1, 2, 3]))]


def edit(live, random_, known):
    """One random edit; `known`: the rings at each height."""
    choice = random_.random()
    free = [float(z) for z in range(12) if z not in known]
    if (choice < 0.4 or len(known) < 2) and free:
        z = random_.choice(free)
        known[z] = blobs(random_)
        return live.insert(z, known[z])
    z = random_.choice(sorted(known))
    if choice < 0.55:
        del known[z]
        return live.remove(z)
    if choice < 0.7 or not known[z]:
        known[z] = blobs(random_)
        return live.replace(z, known[z])
    if choice < 0.8 and free:
        new = random_.choice(free)
        del known[z]
        known[new] = blobs(random_)
        return live.replace(z, known[new], new)
    if choice < 0.9:
        some = random_.sample(sorted(known), random_.randint(1, len(known)))
        for one in some:
            known[one] = blobs(random_)
        return live.replace_many([(one, known[one]) for one in some])
    number = random_.randrange(len(known[z]))
    known[z] = list(known[z])
    known[z][number] = blob(random_)
    return live.move_contour(z, number, known[z][number])


def shape(surface):
    """Faces by the places of their corners, the least one first."""
    places = [tuple(place) for place in surface.vertices.tolist()]
    faces = collections.Counter()
    for corners in surface.faces.tolist():
        face = [places[i] for i in corners]
        least = face.index(min(face))
        faces[tuple(face[least:] + face[:least])] += 1
    return faces


def batch(known, **options):
    return loft.reconstruct(sorted(known.items(), key=lambda one: one[0]), height_tolerance=0.0,
                            **options).surface


class Laws(unittest.TestCase):
    def hold(self, edits, rounds, **options):
        random_ = random.Random(int(seeded().integers(1 << 30)))
        for round_ in range(rounds):
            with self.subTest(round=round_, options=options):
                live, known = loft.Reconstruction(**options), {}
                for _ in range(edits):
                    faces = live.face_count
                    slabs = {slab.id for slab in live.slabs}
                    change = edit(live, random_, known)
                    self.assertEqual(live.face_count,
                                     faces + change.faces_added - change.faces_removed)
                    slabs = slabs - set(change.removed) | {slab.id for slab in change.added}
                    self.assertEqual({slab.id for slab in live.slabs}, slabs)
                self.assertEqual([one.z for one in live.slices], sorted(known))
                self.assertEqual(len(live), len(known))
                if sum(bool(rings) for rings in known.values()) < 2:
                    continue
                surface, whole = live.surface, batch(known, **options)
                self.assertTrue(surface.check().valid)
                self.assertEqual(shape(surface), shape(whole))
                self.assertEqual(len(surface.vertices), len(whole.vertices))
                self.assertAlmostEqual(live.volume, whole.volume, delta=1e-9 * whole.volume)
                self.assertEqual([one.message for one in surface.repairs],
                                 [one.message for one in whole.repairs])

    def test_after_random_edits_it_is_the_surface_of_all_at_once(self):
        self.hold(25, 6)

    def test_so_it_is_with_other_options(self):
        self.hold(15, 2, smooth=True)
        self.hold(15, 2, fill="nonzero", cap="dome")
        self.hold(15, 2, max_edge=0.7, threads=1)

    def test_a_refused_edit_has_changed_nothing(self):
        live = loft.Reconstruction()
        random_ = random.Random(11)
        for z in range(4):
            live.insert(z, [blob(random_)])
        before, slabs = shape(live.surface), live.slabs
        for call in (
            lambda: live.insert(1, [[(0, 0), (float("nan"), 1), (1, 1)]]),
            lambda: live.insert(float("inf"), [SQUARE]),
            lambda: live.insert(1 + 1e-15, [SQUARE]),
            lambda: live.insert(9, {"other": [SQUARE]}),
            lambda: live.remove(0.5),
            lambda: live.remove(float("nan")),
            lambda: live.replace(7, [SQUARE]),
            lambda: live.replace(1, [SQUARE], 2),
            lambda: live.replace_many([(1, [SQUARE]), (1, [SQUARE])]),
            lambda: live.replace_many([(1, [SQUARE]), (1.5, [SQUARE])]),
            lambda: live.move_contour(1, 1, SQUARE),
            lambda: live.move_contour(1, 0, [(0, 1e300), (1, 1), (1, 0)]),
        ):
            with self.assertRaises(loft.InputError):
                call()
        self.assertEqual((shape(live.surface), live.slabs), (before, slabs))
        with self.assertRaises(loft.InputError) as caught:
            live.insert(1, [SQUARE, [(0, 0), (float("nan"), 1), (1, 1)]])
        self.assertEqual(caught.exception.point, 1)

    def test_snapshots_stay_as_they_are(self):
        live = loft.Reconstruction()
        live.insert(0, [SQUARE])
        self.assertEqual(len(live.surface.faces), 0)
        change = live.insert(2, [SQUARE])
        surface, faces = live.surface, shape(live.surface)
        self.assertEqual(change.bounds.tolist(), [[0, 0, 0], [1, 1, 2]])
        self.assertEqual((live.volume, surface.slices), (2.0, 2))
        self.assertAlmostEqual(surface.volume, 2.0)
        live.insert(1, [[(0, 0), (3, 0), (3, 3), (0, 3)]])
        self.assertEqual(shape(surface), faces)
        self.assertEqual(sorted(set(live.surface.origin[:, 0].tolist())), [0, 1, 2])
        self.assertTrue(live)
        self.assertIn(1, live)
        self.assertNotIn(1.5, live)
        self.assertIsNone(live.slice(1.5))
        self.assertEqual(live.slice(2).contours[0].points.tolist(), np.array(SQUARE).tolist())

    def test_patches_are_parts_of_the_surface(self):
        live, random_ = loft.Reconstruction(), random.Random(2)
        for z in range(5):
            live.insert(z, [blob(random_)])
        faces = collections.Counter()
        for number in range(len(live.slabs)):
            patch = live.patch(number, number + 1)
            self.assertEqual(set(patch.face_slab.tolist()), {number})
            self.assertEqual(len(patch.face_kind), len(patch.faces))
            self.assertEqual(patch.origin.shape, patch.vertices.shape)
            faces += shape(patch)
        self.assertEqual(faces, shape(live.surface))
        self.assertEqual(shape(live.patch()), faces)
        for first, last in ((3, 2), (0, 5), (-1, 2), (0, 1 << 70)):
            with self.assertRaises(loft.InputError):
                live.patch(first, last)

    def test_labels_are_one_an_object(self):
        other = [(0, 0), (2, 0), (2, 2), (0, 2)]
        live = loft.Reconstruction(label="heart")
        for z in (0, 1):
            live.insert(z, {"heart": [SQUARE], "lung": [other]})
        live.insert(2, [SQUARE])
        self.assertEqual((live.volume, live.surface.label), (2.0, "heart"))
        stack = loft.Stack([(z, {"heart": [SQUARE], "lung": [other]}) for z in (0, 1, 2)])
        self.assertEqual(loft.Reconstruction.from_stack(stack, label="lung").volume, 8.0)
        with self.assertRaises(loft.InputError):
            loft.Reconstruction.from_stack(stack)

    def test_slices_of_one_height_are_one(self):
        live = loft.Reconstruction()
        live.insert(0, [SQUARE])
        live.insert(1, [SQUARE])
        change = live.insert(1, [[(2, 0), (3, 0), (3, 1), (2, 1)]])
        self.assertEqual((len(live), len(live.slices[1].contours)), (2, 2))
        self.assertIn("merged_slices", [repair.kind for repair in change.repairs])

    def test_pickles_have_the_same_surface_and_options(self):
        live, known, random_ = loft.Reconstruction(cap="dome", unit="um"), {}, random.Random(5)
        for _ in range(12):
            edit(live, random_, known)
        twin = pickle.loads(pickle.dumps(live))
        self.assertEqual(shape(twin.surface), shape(live.surface))
        self.assertEqual((twin.options, twin.unit, twin.stack), (live.options, "um", live.stack))
        z = min(known)
        live.remove(z)
        self.assertEqual(len(twin), len(live) + 1)


class Errors(unittest.TestCase):
    def test_options_that_are_none_raise(self):
        for wrong in (dict(fill="x"), dict(cap="extend"), dict(cap="round"), dict(link=3),
                      dict(max_edge=-1), dict(max_edge=1, target_edge=1), dict(threads=-1),
                      dict(smooth="yes"), dict(label=3), dict(tolerance=float("nan"))):
            with self.assertRaises(loft.InputError):
                loft.Reconstruction(**wrong)
        with self.assertRaises(TypeError):
            loft.Reconstruction(simplify=1)
        with self.assertRaises(loft.InputError):
            loft.Reconstruction.from_stack([(0, [SQUARE])])

    def test_random_calls_raise_but_never_crash(self):
        random_ = random.Random(int(seeded().integers(1 << 30)))
        things = [None, True, -1, 0, 1, 2, 3.0, 1 << 70, 0.5, float("nan"), float("inf"), 1e70,
                  1e-300, "x", b"", [], [0], [SQUARE], [SQUARE], SQUARE, {"": [SQUARE]},
                  {"x": [SQUARE]}, [(0, [SQUARE]), (1, [])], [(0, 0)], [[]], np.array(SQUARE),
                  np.zeros((0, 2)), np.full((3, 2), 1e70), np.array(SQUARE, dtype=complex),
                  np.array(SQUARE, dtype=np.int8), {}, object(), (1, 2), loft.Stack()]
        names = [name for name in dir(loft.Reconstruction) if not name.startswith("_")]
        names += ["__contains__", "__len__"]
        live = loft.Reconstruction()
        raised = 0
        for _ in range(3000):
            try:
                value = getattr(live, random_.choice(names))
                if callable(value):
                    value(*random_.choices(things, k=random_.choice([0, 1, 1, 2, 2, 3])))
            except ERRORS:
                raised += 1
        self.assertGreater(raised, 500)
        self.assertTrue(live.surface.check().valid)


class Threads(unittest.TestCase):
    def test_threads_may_share_one(self):
        live = loft.Reconstruction()

        def work(number):
            random_ = random.Random(number)
            for _ in range(12):
                z = 3.0 * random_.randrange(8) + number
                if z in live:
                    live.remove(z)
                else:
                    live.insert(z, [blob(random_)])
                assert live.surface.check().valid
                assert len(live.slabs) >= 0 and live.volume >= 0
                assert live.patch(0, 0).faces.shape == (0, 3)

        self.assertEqual(failures_in_threads(work, 3), [])
        known = {one.z: [contour.points for contour in one.contours] for one in live.slices}
        if len(known) > 1:
            self.assertEqual(shape(live.surface), shape(batch(known)))


def load_tests(loader, tests, pattern):
    tests.addTests(doctest.DocTestSuite(live_module))
    return tests


if __name__ == "__main__":
    unittest.main()
