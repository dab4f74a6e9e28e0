# SPDX-License-Identifier: MIT
import gc
import glob
import io
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from unittest import mock

import numpy as np

import loft
from cases import IS_SANITIZED, SAMPLES, SQUARE, ball, random_slices, seeded


def same(a, b):
    """Whether two surfaces are, number for number."""
    return np.array_equal(a.vertices, b.vertices) and np.array_equal(a.faces, b.faces)


def large(random, rings=16, points=150):
    """A stack that takes some tenths of a second."""
    if IS_SANITIZED:
        rings = max(4, rings // 6)
    angles = np.arange(points) * (2 * np.pi / points)
    circle = np.stack([np.cos(angles), np.sin(angles)], 1)
    return loft.Stack([(float(z), [circle * random.uniform(0.8, 1.2, (points, 1)) + (4 * i, 0)
                                   for i in range(8)]) for z in range(rings)])


def volume_of(stack):
    return loft.reconstruct(stack).surface.volume


class ASurface(unittest.TestCase):
    def test_is_valid_and_keeps_contours(self):
        random = seeded()
        for _ in range(10):
            stack = loft.Stack(random_slices(random))
            surface = loft.reconstruct(stack, smooth=bool(random.integers(2))).surface
            self.assertTrue(surface.check())
            slices = stack.slices
            ours = surface.kind == loft.VertexKind.CONTOUR
            for place, (i, k, p) in zip(surface.vertices[ours], surface.origin[ours]):
                self.assertEqual(tuple(place[:2]), tuple(slices[i].contours[k].points[p]))
                self.assertEqual(place[2], slices[i].z)
            self.assertTrue((surface.origin[~ours, 1:] == -1).all())

    def test_has_arrays_that_outlive_it_and_cannot_be_written(self):
        surface = loft.reconstruct([(0, [SQUARE]), (1, [SQUARE])]).surface
        vertices, faces = surface.vertices, surface.faces
        expected = vertices.copy()
        self.assertEqual((vertices.dtype, faces.dtype), (np.float64, np.uint32))
        self.assertIs(surface.vertices, vertices)
        del surface
        gc.collect()
        np.testing.assert_array_equal(vertices, expected)
        for array in (vertices, faces):
            with self.assertRaises(ValueError):
                array[0] = 0

    def test_has_vertices_without_a_copy(self):
        surface = loft.reconstruct(large(seeded(), 8)).surface
        first = surface._surface.vertices()
        again = surface._surface.vertices()
        self.assertEqual(first.__array_interface__["data"], again.__array_interface__["data"])

    def test_pickles(self):
        random = seeded()
        stack = loft.Stack(random_slices(random, labels=("a", "b")))
        for cap in ("flat", "open", "dome"):
            made = loft.reconstruct(stack, cap=cap, slabs=True)
            again = pickle.loads(pickle.dumps(made))
            for label, surface in made.items():
                other = again[label]
                self.assertTrue(same(surface, other))
                for name in ("origin", "kind", "face_kind", "face_slab", "slabs", "repairs"):
                    np.testing.assert_array_equal(getattr(surface, name), getattr(other, name))
                self.assertEqual(surface.measures, other.measures)
            with tempfile.TemporaryDirectory() as folder:
                made.write(f"{folder}/a.ply")
                again.write(f"{folder}/b.ply")
                self.assertEqual(*(Path(folder, f"{x}.ply").read_bytes() for x in "ab"))

    def test_goes_into_other_libraries(self):
        surface = loft.reconstruct([(0, [SQUARE]), (1, [SQUARE])]).surface
        for name in ("trimesh", "pyvista", "meshio"):
            with mock.patch.dict("sys.modules", {name: None}):
                with self.assertRaisesRegex(ImportError, f"pip install {name}"):
                    getattr(surface, f"to_{name}")()
        fake = mock.Mock()
        with mock.patch.dict("sys.modules", trimesh=fake):
            surface.to_trimesh()
        fake.Trimesh.assert_called_once_with(surface.vertices, surface.faces, process=False)

    def test_is_not_made_of_faces_that_meet_in_a_vertex_alone(self):
        from loft import _loft

        faces = np.array([[0, 1, 2], [0, 3, 4]], dtype=np.uint32)
        with self.assertRaisesRegex(loft.InputError, "vertex 0"):
            _loft.surface_from_arrays(np.eye(5, 3), faces, np.zeros(5, np.uint8),
                                      np.zeros((5, 3), np.int32), np.zeros(2, np.uint8),
                                      np.zeros(2, np.uint32))

    def test_shows_itself(self):
        made = loft.reconstruct(loft.Stack.from_mask({"<b>": ball()}, (1, 1, 1)))
        self.assertIn("data:image/png;base64,", made._repr_html_())
        self.assertIn("&lt;b&gt;", made._repr_html_())
        picture = made.render(120, 90)
        self.assertEqual(picture.shape, (90, 120, 3))
        drawn = (picture != 255).any(axis=2).mean()
        self.assertTrue(0.3 < drawn < 0.8, drawn)


class Reconstructing(unittest.TestCase):
    def test_gives_a_mapping_of_labels(self):
        made = loft.reconstruct(random_slices(seeded(), labels=("a", "b", "c")), only=["a", "c"])
        self.assertEqual(list(made), ["a", "c"])
        self.assertEqual(made.table()["label"], ["a", "c"])
        self.assertTrue(made.check())
        with self.assertRaisesRegex(loft.InputError, "there are 2 surfaces"):
            made.surface

    def test_skips_labels_with_too_little_and_says_so(self):
        line = [(0, 0), (1, 0)]
        slices = [(0, {"a": [SQUARE], "b": [line]}), (1, {"a": [SQUARE], "b": [line]})]
        made = loft.reconstruct(slices)
        self.assertEqual(list(made), ["a"])
        self.assertEqual(list(made.skipped), ["b"])
        with self.assertRaises(loft.InputError) as raised:
            loft.reconstruct([(0, {"a": [line], "b": [line]})])
        self.assertGreaterEqual(len(raised.exception.defects), 2)

    def test_refuses_what_is_no_option(self):
        stack = loft.Stack([(0, [SQUARE]), (1, [SQUARE])])
        for options in (dict(cap="round"), dict(fill=3), dict(link=""[:0] or "x"), dict(threads=-1),
                        dict(threads="all"), dict(max_edge=-1), dict(max_edge="long"),
                        dict(tolerance=1), dict(max_edge=1, simplify=1), dict(smooth="yes"),
                        dict(fair=float("nan")), dict(only="heart")):
            with self.subTest(str(options)):
                self.assertRaises(loft.InputError, lambda: loft.reconstruct(stack, **options))
        with self.assertRaisesRegex(loft.InputError, "'flat', 'dome', 'open', 'extend'"):
            loft.reconstruct(stack, cap="round")

    def test_makes_contours_without_a_label_beside_others(self):
        slices = [(z, {"": [SQUARE], "h": [SQUARE]}) for z in range(2)]
        self.assertEqual(list(loft.reconstruct(slices, only="")), [""])

    def test_keeps_apart_or_joins_what_links_say(self):
        slices = [(0, [SQUARE]), (1, [SQUARE])]
        made = loft.reconstruct(slices, links=[((0, 0), (1, 0), False)])
        self.assertEqual(made.surface.measures.components, 2)
        with self.assertRaises(loft.InputError):
            loft.reconstruct(slices, links=[((0, 0), (1, 5), True)])

    def test_tells_how_far_it_is_from_the_calling_thread(self):
        told = []
        stack = large(seeded())
        loft.reconstruct(stack, progress=lambda stage, fraction: told.append(
            (stage, fraction, threading.get_ident())))
        self.assertTrue(told)
        self.assertEqual([f for _, f, _ in told], sorted(f for _, f, _ in told))
        self.assertEqual({thread for *_, thread in told}, {threading.get_ident()})

    def test_stops_when_progress_says_so_or_raises(self):
        stack = large(seeded())
        with self.assertRaises(loft.Cancelled):
            loft.reconstruct(stack, progress=lambda stage, fraction: False)
        with self.assertRaises(ZeroDivisionError):
            loft.reconstruct(stack, progress=lambda stage, fraction: 1 / 0)
        with mock.patch.object(sys, "stderr", io.StringIO()), mock.patch.dict(
                "sys.modules", {"tqdm": None, "tqdm.auto": None}):
            loft.reconstruct(stack, progress=True)
            self.assertIn("%", sys.stderr.getvalue())

    def test_lets_other_threads_run(self):
        ticks = 0
        is_done = threading.Event()

        def tick():
            nonlocal ticks
            while not is_done.wait(0.001):
                ticks += 1

        ticker = threading.Thread(target=tick)
        ticker.start()
        loft.reconstruct(large(seeded()), smooth=True, threads=1)
        is_done.set()
        ticker.join()
        self.assertGreater(ticks, 20)

    def test_works_in_eight_threads_at_once(self):
        random = seeded()
        stacks = [loft.Stack(random_slices(random, 12)) for _ in range(8)]
        expected = [loft.reconstruct(stack).surface for stack in stacks]
        with ThreadPoolExecutor(8) as pool:
            for _ in range(5):
                made = list(pool.map(lambda stack: loft.reconstruct(stack).surface, stacks))
                for one, other in zip(made, expected):
                    self.assertTrue(same(one, other))

    def test_is_the_same_whatever_the_threads(self):
        stack = large(seeded(), 8)
        alone = loft.reconstruct(stack, smooth=True, threads=1).surface
        for threads in (2, 3, 8):
            self.assertTrue(same(alone, loft.reconstruct(stack, smooth=True, threads=threads).surface))

    def test_hears_control_c(self):
        stack = large(seeded(), 120)
        began = []

        def interrupt():
            time.sleep(0.3)
            began.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            while True:
                loft.reconstruct(stack, smooth=True)
        took = time.monotonic() - began[0]
        thread.join()
        self.assertLess(took, 0.5)  # about 0.05; machines of tests may be busy

    def test_works_after_a_fork_and_in_processes_begun_anew(self):
        stack = loft.Stack(random_slices(seeded(), 12))
        expected = volume_of(stack)  # threads have begun
        for method in ("fork", "spawn"):
            with self.subTest(method):
                with multiprocessing.get_context(method).Pool(2) as pool:
                    made = pool.map_async(volume_of, [stack] * 4).get(60)
                self.assertEqual(made, [expected] * 4)

    def test_with_threads_after_a_fork_is_a_clear_error(self):
        stack = loft.Stack(random_slices(seeded(), 12))
        loft.reconstruct(stack)
        if os.cpu_count() == 1:
            self.skipTest("needs two processors")
        child = os.fork()
        if child == 0:
            try:
                loft.reconstruct(stack, threads=2)
                os._exit(1)
            except loft.Error as error:
                os._exit(0 if "forked" in str(error) else 2)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


class Writing(unittest.TestCase):
    def test_gives_the_bytes_of_the_program(self):
        program = os.environ.get("LOFT")
        if not program:
            self.skipTest("LOFT, the program, is not set")
        samples = [p for p in sorted(glob.glob(os.path.join(SAMPLES, "data", "*.ndjson")))]
        self.assertTrue(samples)
        if IS_SANITIZED:
            samples = [min(samples, key=os.path.getsize)]
        with tempfile.TemporaryDirectory() as folder:
            for sample in samples:
                for name, words, options in (("a.ply", [], {}), ("a.glb", ["--smooth"], dict(smooth=True)),
                                             ("a.stl", ["--cap", "dome"], dict(cap="dome"))):
                    ours, theirs = f"{folder}/ours-{name}", f"{folder}/theirs-{name}"
                    subprocess.run([program, "reconstruct", sample, "-q", "-o", theirs, *words],
                                   check=True)
                    loft.reconstruct(sample, **options).write(ours)
                    with open(ours, "rb") as a, open(theirs, "rb") as b:
                        self.assertEqual(a.read(), b.read(), f"{sample} {name}")

    def test_of_several_files_gives_the_bytes_of_the_program(self):
        program = os.environ.get("LOFT")
        if not program:
            self.skipTest("LOFT, the program, is not set")
        with tempfile.TemporaryDirectory() as folder:
            files = [f"{folder}/{name}" for name in ("a.b.ndjson", "c.ndjson")]
            for name in files:
                loft.Stack([(0, [SQUARE]), (1, [SQUARE])]).write(name)
            subprocess.run([program, "reconstruct", *files, "-q", "-o", f"{folder}/theirs.glb"],
                           check=True)
            loft.reconstruct(loft.read(files)).write(f"{folder}/ours.glb")
            self.assertEqual(*(Path(folder, f"{x}.glb").read_bytes() for x in ("ours", "theirs")))

    def test_takes_names_that_are_not_utf_8(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(os.fsencode(folder), b"caf\xe9.ndjson")
            stack = loft.Stack([(0, [SQUARE]), (1, [SQUARE])])
            stack.write(name)
            self.assertEqual(loft.read(os.fsdecode(name)), stack)
            loft.reconstruct(os.fsdecode(name)).write(name[:-7] + b".glb")
            with self.assertRaises(loft.FileError) as raised:
                loft.read(os.fsdecode(name) + "x.ndjson")
            self.assertIn("caf\udce9", raised.exception.filename)

    def test_is_refused_where_it_makes_no_sense(self):
        made = loft.reconstruct(random_slices(seeded(), labels=("a", "b")))
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(loft.InputError, "one solid of 2 labels"):
                made.write(f"{folder}/a.stl")
            with self.assertRaises(loft.InputError):
                made.write(f"{folder}/a.xyz")
            with self.assertRaisesRegex(loft.InputError, "'quantize', 'meshopt'"):
                made.write(f"{folder}/a.glb", compress="zip")
            with self.assertRaises(loft.InputError):
                made.write(f"{folder}/a.glb", unit="mile")
            self.assertEqual(os.listdir(folder), [])
        with self.assertRaises(loft.FileError) as raised:
            made.write("/nowhere/at/all.ply")
        self.assertIsInstance(raised.exception, OSError)
        self.assertTrue(raised.exception.filename)


class AMesh(unittest.TestCase):
    def test_is_checked_measured_and_cut(self):
        surface = loft.reconstruct([(0, [SQUARE]), (2, [SQUARE])]).surface
        for mesh in (surface, (surface.vertices, surface.faces),
                     (surface.vertices.tolist(), surface.faces.tolist())):
            self.assertTrue(loft.check(mesh).valid)
            self.assertAlmostEqual(loft.measure(mesh).volume, 32)
            cut = loft.section(mesh, [0.5, 3])
            self.assertEqual([len(one.outlines) for one in cut], [1, 0])
            self.assertEqual({tuple(p) for p in cut[0].outlines[0]} & set(SQUARE), set(SQUARE))
        flipped = (surface.vertices, surface.faces[:, ::-1])
        self.assertEqual(list(loft.check(flipped).faults), ["inside_out"])

    def test_in_a_file_is_checked(self):
        with tempfile.TemporaryDirectory() as folder:
            loft.reconstruct(random_slices(seeded(), labels=("a", "b"))).write(f"{folder}/a.glb")
            found = loft.check(f"{folder}/a.glb")
            self.assertTrue(found)
            self.assertEqual(list(found.findings), ["a", "b"])
            with self.assertRaisesRegex(loft.InputError, "2 meshes"):
                loft.measure(f"{folder}/a.glb")

    def test_that_names_no_vertices_is_refused(self):
        places = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
        for faces in ([(0, 1, 3)], [(0, 1, -1)], [(0.5, 1, 2)], [(0, 1)], "abc"):
            with self.subTest(str(faces)):
                self.assertRaises(loft.InputError, lambda: loft.measure((places, faces)))
                self.assertRaises(loft.InputError, lambda: loft.section((places, faces), 0))
        self.assertIn("bad_index", loft.check((places, [(0, 1, 3)])).faults)


if __name__ == "__main__":
    unittest.main()
