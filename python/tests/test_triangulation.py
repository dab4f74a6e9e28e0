# SPDX-License-Identifier: MIT
"""Laws of loft.Triangulation."""

import copy
import doctest
import pickle
import random
import signal
import threading
import time
import unittest
from fractions import Fraction

import numpy as np

from cases import SQUARE, failures_in_threads, seeded

import loft
from loft import triangulation

ERRORS = (loft.Error, TypeError, ValueError, OverflowError)


def random_line(random_):
    """A few points, whole numbers now and then, so that lines meet and overlap."""
    count = random_.choice([1, 2, 3, 5, 8])
    if random_.random() < 0.5:
        return [(random_.randint(0, 12), random_.randint(0, 12)) for _ in range(count)]
    return [(random_.uniform(0, 12), random_.uniform(0, 12)) for _ in range(count)]


def edit(mesh, random_, known):
    """One random edit; `known`: points and closedness of each constraint."""
    choice = random_.random()
    if choice < 0.45 or not known:
        line, closed = random_line(random_), random_.random() < 0.5
        known[mesh.insert(line, closed)] = (line, closed)
    elif choice < 0.65:
        mesh.remove(one := random_.choice(sorted(known)))
        del known[one]
    elif choice < 0.85:
        one, line = random_.choice(sorted(known)), random_line(random_)
        mesh.move(one, line)
        known[one] = (line, known[one][1])
    else:
        one, by = random_.choice(sorted(known)), (random_.randint(-3, 3), random_.randint(-3, 3))
        mesh.translate(one, by)
        known[one] = ([(x + by[0], y + by[1]) for x, y in known[one][0]], known[one][1])


def shape(mesh, names=None):
    """Triangles, constrained edges and their constraints by places alone."""
    state, edges = mesh.state, mesh.edges
    places = [tuple(place) for place in state.vertices.tolist()]
    triangles = {frozenset(places[i] for i in corners) for corners in state.triangles}
    lines = {frozenset(places[i] for i in ends): sorted((names or {}).get(int(c), int(c))
                                                       for c in edges.of(number))
             for number, ends in enumerate(edges.edges)}
    return set(places), triangles, lines


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def in_circle(a, b, c, d):
    rows = [(p[0] - d[0], p[1] - d[1]) for p in (a, b, c)]
    rows = [(x, y, x * x + y * y) for x, y in rows]
    (a0, a1, a2), (b0, b1, b2), (c0, c1, c2) = rows
    return a0 * (b1 * c2 - b2 * c1) - a1 * (b0 * c2 - b2 * c0) + a2 * (b0 * c1 - b1 * c0)


class Laws(unittest.TestCase):
    def test_after_random_edits_it_is_what_all_at_once_gives(self):
        random_ = random.Random(int(seeded().integers(1 << 30)))
        for round_ in range(25):
            with self.subTest(round=round_):
                mesh, known = loft.Triangulation(), {}
                for _ in range(40):
                    edit(mesh, random_, known)
                self.assertEqual(mesh.check(), [])
                if len(mesh.snaps.constraints):
                    continue  # where the result may depend on the order
                batch = loft.Triangulation()
                order = random_.sample(sorted(known), len(known))
                ids = batch.insert_many([known[one][0] for one in order],
                                        [known[one][1] for one in order])
                self.assertEqual(shape(batch, dict(zip(ids, order))), shape(mesh))

    def test_every_edge_without_constraint_is_delaunay(self):
        random_ = random.Random(int(seeded().integers(1 << 30)))
        for round_ in range(8):
            with self.subTest(round=round_):
                mesh, known = loft.Triangulation(), {}
                for _ in range(25):
                    edit(mesh, random_, known)
                state = mesh.state
                places = [(Fraction(x), Fraction(y)) for x, y in state.vertices.tolist()]
                constrained = {frozenset(ends) for ends in mesh.edges.edges.tolist()}
                opposite = {}
                for triangle in state.triangles.tolist():
                    self.assertGreater(cross(*(places[i] for i in triangle)), 0)
                    for i in range(3):
                        side = (triangle[i - 2], triangle[i - 1])
                        self.assertNotIn(side, opposite)
                        opposite[side] = triangle[i]
                for (a, b), c in opposite.items():
                    d = opposite.get((b, a))
                    if d is not None and frozenset((a, b)) not in constrained:
                        self.assertLessEqual(
                            in_circle(places[a], places[b], places[c], places[d]), 0)

    def test_what_is_removed_leaves_no_trace(self):
        mesh = loft.Triangulation()
        mesh.insert(SQUARE, closed=True)
        before = shape(mesh)
        line = mesh.insert([(-1, 2), (5, 2.5)])
        self.assertNotEqual(shape(mesh), before)
        mesh.remove(line)
        self.assertEqual(shape(mesh), before)
        point = mesh.insert_point((1, 2))
        self.assertIn(point, mesh.vertex_ids)
        mesh.remove_point(point)
        self.assertEqual(shape(mesh), before)

    def test_regions_are_those_of_the_windings(self):
        mesh = loft.Triangulation()
        outer = mesh.insert(SQUARE, closed=True)
        inner = mesh.insert([(1, 1), (3, 1), (3, 3), (1, 3)], closed=True)
        mesh.insert([(-1, 2), (5, 2)])
        self.assertEqual(mesh.area(), 12)
        self.assertEqual(mesh.area("nonzero"), 16)
        self.assertEqual(mesh.area("evenodd", [inner]), 4)
        self.assertEqual(mesh.area("nonzero", [outer]), 16)
        self.assertEqual(int(mesh.winding_numbers().max()), 2)
        state = mesh.state
        centres = state.vertices[state.triangles].mean(axis=1)
        self.assertEqual(list(mesh.locate(centres)), list(range(len(state.triangles))))

    def test_points_are_located_by_brute_force(self):
        random_ = random.Random(7)
        mesh = loft.Triangulation()
        mesh.insert_many([random_line(random_) for _ in range(8)])
        state = mesh.state
        places = [tuple(map(Fraction, place)) for place in state.vertices.tolist()]
        points = [(random_.uniform(-2, 14), random_.uniform(-2, 14)) for _ in range(50)]
        points += state.vertices.tolist()[:50]
        nearest = mesh.nearest(points)
        for number, (point, found) in enumerate(zip(points, mesh.locate(points))):
            exact = tuple(map(Fraction, point))
            inside = {i for i, (a, b, c) in enumerate(state.triangles.tolist())
                      if min(cross(places[a], places[b], exact), cross(places[b], places[c], exact),
                             cross(places[c], places[a], exact)) >= 0}
            self.assertTrue(found in inside if inside else found == -1)
            away = [(x - exact[0]) ** 2 + (y - exact[1]) ** 2 for x, y in places]
            self.assertEqual(away[nearest[number]], min(away))

    def test_edges_know_their_constraints_and_paths_their_vertices(self):
        mesh = loft.Triangulation()
        one = mesh.insert([(0, 0), (4, 0)])
        two = mesh.insert([(2, 0), (6, 0)])
        self.assertEqual(mesh.vertices[mesh.path(one)].tolist(), [[0, 0], [2, 0], [4, 0]])
        both = [number for number in range(3) if len(mesh.edges.of(number)) == 2]
        self.assertEqual(len(both), 1)
        self.assertEqual(mesh.edges.of(both[0]).tolist(), [one, two])
        self.assertEqual(sorted(map(tuple, mesh.vertices[mesh.edges.edges[both[0]]].tolist())),
                         [(2, 0), (4, 0)])
        self.assertEqual(len(mesh.triangles), 0)
        self.assertEqual(mesh.locate([(1, 0)]).tolist(), [-1])
        ring = mesh.insert(SQUARE, closed=True)
        self.assertEqual(mesh.path(ring)[0], mesh.path(ring)[-1])
        self.assertTrue(mesh.is_closed(ring))
        vertex = int(mesh.vertex_ids[mesh.path(two)[0]])
        self.assertEqual(mesh.constraints_at(vertex), [one, two, ring])

    def test_changes_say_which_triangles_are_others(self):
        mesh = loft.Triangulation()
        mesh.record_changes()
        random_, known = random.Random(int(seeded().integers(1 << 30))), {}

        def corners():
            state = mesh.state
            places = [tuple(place) for place in state.vertices.tolist()]
            return {int(i): frozenset(places[v] for v in c)
                    for i, c in zip(state.triangle_ids, state.triangles.tolist())}

        after = corners()
        for _ in range(100):
            before, old = after, shape(mesh)
            edit(mesh, random_, known)
            after, changes = corners(), mesh.changes
            if shape(mesh) == old:
                continue  # these are of an edit before
            gone = {i for i, c in before.items() if after.get(i) != c}
            self.assertLessEqual(gone, set(changes.unmade.tolist()))
            come = {i for i, c in after.items() if before.get(i) != c}
            self.assertLessEqual(come, set(changes.made.tolist()))

    def test_a_copy_cannot_be_told_from_it(self):
        random_, known = random.Random(3), {}
        mesh = loft.Triangulation(epsilon=1e-3)
        for _ in range(60):
            edit(mesh, random_, known)
        for twin in (pickle.loads(pickle.dumps(mesh)), mesh.copy(), copy.deepcopy(mesh)):
            self.assertEqual(twin.epsilon, 1e-3)
            state = random_.getstate()
            mine, mine_known = mesh.copy(), dict(known)
            twin_known = dict(known)
            for _ in range(30):
                edit(mine, random_, mine_known)
            random_.setstate(state)
            for _ in range(30):
                edit(twin, random_, twin_known)
            for a, b in zip(mine.state, twin.state):
                self.assertTrue(np.array_equal(a, b))
            self.assertEqual(mine_known, twin_known)

    def test_arrays_stay_as_they_are(self):
        mesh = loft.Triangulation()
        mesh.insert(SQUARE, closed=True)
        state = mesh.state
        kept = [array.copy() for array in state]
        self.assertIs(type(state.vertices[0, 0]), np.float64)
        with self.assertRaises(ValueError):
            state.vertices[0, 0] = 1
        mesh.insert_point((1, 1))
        del mesh
        self.assertTrue(all(np.array_equal(a, b) for a, b in zip(state, kept)))

    def test_large_edits_are_the_same_as_small_ones(self):
        random_ = np.random.default_rng(5)
        angles = np.sort(random_.random(6000)) * 2 * np.pi
        points = np.column_stack([np.cos(angles), np.sin(angles)])
        large, small = loft.Triangulation(), loft.Triangulation()
        line = large.insert(points, closed=True)
        self.assertEqual(large.points(line).tolist(), points.tolist())
        large.remove(line)
        self.assertEqual(len(large.vertices), 0)
        large.insert_many(points[:, np.newaxis, :])
        listed = loft.Triangulation()
        listed.insert_many(list(points[:, np.newaxis, :]))
        self.assertEqual(shape(large), shape(listed))
        for point in points:
            small.insert_point(point)
        self.assertEqual(shape(large), shape(small))
        self.assertGreater(large.locate(random_.random((9000, 2))).min(), -2)


class Errors(unittest.TestCase):
    def test_what_names_nothing_raises(self):
        mesh = loft.Triangulation()
        line = mesh.insert([(0, 0), (1, 1)])
        for call in (mesh.remove, mesh.points, mesh.path, mesh.is_closed, mesh.remove_point,
                     mesh.constraints_at, lambda i: mesh.move(i, SQUARE),
                     lambda i: mesh.translate(i, (1, 1)), lambda i: mesh.winding_numbers([i])):
            for wrong in (-1, 5, 99, 0xFFFFFFFF, 1 << 40, 1 << 80, 1.5, "0", None, [0]):
                with self.assertRaises(loft.InputError):
                    call(wrong)
        with self.assertRaises(loft.InputError):
            mesh.winding_numbers([line])  # it is open
        with self.assertRaises(loft.InputError):
            mesh.remove_point(int(mesh.vertex_ids[0]))  # it belongs to the line

    def test_wrong_points_raise_and_change_nothing(self):
        mesh = loft.Triangulation()
        line = mesh.insert(SQUARE, closed=True)
        before = shape(mesh)
        for wrong in ([], [(0, 0, 0, 0)], [(0, float("nan"))], [(1e80, 0)], [(1e-60, 0)], "abc",
                      None, [(0, 0), (1,)], np.zeros((2, 2, 2)), np.ma.masked_array([[0, 0]], [[1, 0]]),
                      [("a", "b")], np.zeros((1, 2), dtype=complex), object()):
            for call in (mesh.insert, lambda w: mesh.move(line, w),
                         lambda w: mesh.insert_many([SQUARE, w]), mesh.insert_point):
                with self.assertRaises(loft.InputError):
                    call(wrong)
        for wrong in (-1, float("nan"), float("inf"), "x", None):
            with self.assertRaises(loft.InputError):
                loft.Triangulation(wrong)
        with self.assertRaises(loft.InputError):
            mesh.area("odd")
        with self.assertRaises(loft.InputError):
            mesh.insert_many([SQUARE], [True, False])
        for wrong in (np.zeros((2, 2, 3)), np.zeros((2, 0, 2)), np.full((1, 1, 2), np.nan)):
            with self.assertRaises(loft.InputError):
                mesh.insert_many(wrong)
        self.assertEqual(mesh.insert_many(np.zeros((0, 4, 2))), [])
        self.assertEqual(shape(mesh), before)

    def test_damaged_bytes_raise(self):
        mesh = loft.Triangulation()
        mesh.insert(SQUARE, closed=True)
        state = mesh.__reduce__()[1][0]
        for i in range(len(state)):
            with self.assertRaises(loft.InputError):
                triangulation._restored(state[:i] + bytes([state[i] ^ 1]) + state[i + 1:])
            with self.assertRaises(loft.InputError):
                triangulation._restored(state[:i])

    def test_random_calls_raise_but_never_crash(self):
        random_ = random.Random(int(seeded().integers(1 << 30)))
        things = [None, True, -1, 0, 1, 2, 3, 1 << 70, 0.5, float("nan"), 1e75, -1e75, 1e-50, 1e300,
                  5e-324, "evenodd", "nonzero", b"", [], [0], [[0, 1]], [(0, 0), (1, 1)], SQUARE,
                  [SQUARE, [(1, 1)]], np.zeros((0, 2)), np.zeros((3, 2), dtype=np.float32),
                  np.arange(12).reshape(6, 2)[::2], np.full((2, 2), 1e75), np.full((2, 2), 1e-50),
                  np.array([[1e75, -1e75], [-1e75, 1e75], [1e-50, 0.0]]), np.uint32(1),
                  np.zeros((2, 2), dtype=object), {}, object(), (1, 2)]
        names = [name for name in dir(loft.Triangulation) if not name.startswith("_")]
        mesh = loft.Triangulation()
        raised = 0
        for number in range(4000):
            name = random_.choice(names)
            try:
                value = getattr(mesh, name)
                if callable(value):
                    value(*random_.choices(things, k=random_.choice([0, 1, 1, 1, 2, 2, 3])))
            except ERRORS:
                raised += 1
            if number % 100 == 0:
                self.assertEqual(mesh.check(), [])
        self.assertGreater(raised, 500)
        self.assertEqual(mesh.check(), [])

    def test_places_of_no_usable_size_are_nowhere(self):
        mesh = loft.Triangulation()
        mesh.insert([(-1e75, -1e75), (1e75, -1e75), (0, 1e75)], closed=True)
        mesh.insert([(0, 0), (1e-50, 1e-50), (1, 0)])
        tiny = [(x, y) for x in (5e-324, 1e-60, -1e-55, 1e-50) for y in (5e-324, -1e-60, 1e-51)]
        self.assertGreaterEqual(mesh.locate(tiny).min(), 0)
        self.assertEqual(mesh.locate([(np.nan, 0), (np.inf, 0), (1e300, 0), (0, -2e75)]).tolist(),
                         [-1] * 4)
        with self.assertRaises(loft.InputError):
            mesh.nearest([(np.nan, 0)])

    def test_the_low_level_checks_what_it_is_given(self):
        for type_ in (loft._loft.Triangulation, loft._loft.Reconstruction):
            with self.assertRaises((TypeError, RuntimeError)):
                type_.__new__(type_).counts()  # which holds nothing
        mesh = loft._loft.Triangulation(0.0)
        points, flags = np.zeros((3, 2)), np.zeros(1, dtype=np.uint8)
        for offsets in ([0], [0, 4], [-1, 2], [2, 1], [[0, 1]], [0, 1, 2]):
            with self.assertRaises(loft.InputError):
                mesh.insert_many(points, np.array(offsets), flags)


class Threads(unittest.TestCase):
    def test_ctrl_c_is_heard_and_the_edit_finished(self):
        mesh = loft.Triangulation()
        lines = np.random.default_rng(9).random((1200, 2, 2))
        begin = time.monotonic()
        threading.Timer(0.05, signal.raise_signal, [signal.SIGINT]).start()
        with self.assertRaises(KeyboardInterrupt):
            mesh.insert_many(lines)
            time.sleep(5)  # where the machine has been faster than that
        heard = time.monotonic() - begin
        self.assertEqual(len(mesh.constraints), len(lines))
        self.assertLess(heard, 2)

    def test_threads_may_share_one(self):
        mesh = loft.Triangulation()

        def work(number):
            random_ = random.Random(number)
            mine = []
            for step in range(60):
                if random_.random() < 0.6 or not mine:
                    mine.append(mesh.insert(random_line(random_), random_.random() < 0.5))
                elif random_.random() < 0.5:
                    mesh.remove(mine.pop(random_.randrange(len(mine))))
                else:
                    mesh.move(random_.choice(mine), random_line(random_))
                state = mesh.state
                assert state.triangles.size == 0 or state.triangles.max() < len(state.vertices)
                mesh.area()
                if step == 30:
                    mesh.insert_many(np.random.default_rng(step).random((5000, 1, 2)))
                    mesh.locate(np.random.default_rng(step).random((5000, 2)))

        self.assertEqual(failures_in_threads(work, 3), [])
        self.assertEqual(mesh.check(), [])


def load_tests(loader, tests, pattern):
    tests.addTests(doctest.DocTestSuite(triangulation))
    return tests


if __name__ == "__main__":
    unittest.main()
