# SPDX-License-Identifier: MIT
"""The wheel, the source archive, and what is said where something is missing."""

import base64
import hashlib
import os
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = os.environ["LOFT_PYTHON_BUILD"]
sys.path.insert(0, str(ROOT / "python" / "backend"))
import loft_backend as backend  # noqa: E402


def call(words, **environment):
    """A backend in a process of its own, as pip starts it."""
    done = subprocess.run([sys.executable, "-c", f"import loft_backend as b; {words}"], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=ROOT,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python" / "backend"),
                               **environment})
    done.words = " ".join(done.stdout.split())  # CMake breaks lines
    return done


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.name = backend.build_wheel(cls.folder.name, {"build-dir": BUILD})
        cls.path = Path(cls.folder.name, cls.name)
        with zipfile.ZipFile(cls.path) as wheel:
            cls.files = {name: wheel.read(name) for name in wheel.namelist()}
        cls.about = f"loft_surfaces-{backend.version()}.dist-info"

    def test_has_all_of_the_package_and_nothing_else(self):
        source = {f"loft/{path.name}" for path in (ROOT / "python" / "loft").iterdir()
                  if path.suffix in (".py", ".pyi", ".typed")}
        module = [name for name in self.files if name.endswith(".so")]
        about = {f"{self.about}/{name}" for name in ("LICENSE", "METADATA", "RECORD", "WHEEL")}
        self.assertEqual(len(module), 1)
        self.assertEqual(set(self.files), source | about | set(module))

    def test_record_has_each_file_with_its_sum(self):
        told = {}
        for line in self.files[f"{self.about}/RECORD"].decode().splitlines():
            name, digest, size = line.rsplit(",", 2)
            told[name] = (digest, size)
        self.assertEqual(set(told), set(self.files))
        self.assertEqual(told.pop(f"{self.about}/RECORD"), ("", ""))
        for name, (digest, size) in told.items():
            sum_ = base64.urlsafe_b64encode(hashlib.sha256(self.files[name]).digest())
            self.assertEqual(digest, "sha256=" + sum_.decode().rstrip("="), name)
            self.assertEqual(int(size), len(self.files[name]), name)

    def test_tag_is_that_of_this_interpreter(self):
        tag = self.name[len(f"loft_surfaces-{backend.version()}-"):-len(".whl")]
        self.assertIn(f"Tag: {tag}\n", self.files[f"{self.about}/WHEEL"].decode())
        try:
            from packaging import tags
        except ImportError:
            from pip._vendor.packaging import tags
        self.assertIn(tag, {str(one) for one in tags.sys_tags()})

    def test_metadata_says_what_is_needed(self):
        lines = self.files[f"{self.about}/METADATA"].decode().splitlines()
        for line in ("Name: loft-surfaces", f"Version: {backend.version()}",
                     "Requires-Dist: numpy>=1.21", "Requires-Python: >=3.9"):
            self.assertIn(line, lines)

    def test_again_is_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            again = Path(folder, backend.build_wheel(folder, {"build-dir": BUILD}))
            self.assertEqual(again.read_bytes(), self.path.read_bytes())


class Source(unittest.TestCase):
    def test_archive_has_what_a_build_needs(self):
        with tempfile.TemporaryDirectory() as folder:
            with tarfile.open(Path(folder, backend.build_sdist(folder))) as archive:
                names = set(archive.getnames())
        stem = f"loft_surfaces-{backend.version()}"
        self.assertTrue(all(name.startswith(f"{stem}/") for name in names))
        for file in ("PKG-INFO", "pyproject.toml", "CMakeLists.txt", "setup.sh", "LICENSE",
                     "python/CMakeLists.txt", "python/backend/loft_backend.py",
                     "python/loft/py.typed", "cdt/CMakeLists.txt", "io/version.cpp.in"):
            self.assertTrue(f"{stem}/{file}" in names, file)


class Configure(unittest.TestCase):
    def test_a_fresh_folder_has_the_module_for_this_interpreter_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            done = call(f"b.configure({folder!r})")
            self.assertEqual(done.returncode, 0, done.stdout)
            cache = Path(folder, "CMakeCache.txt").read_text().splitlines()
        self.assertIn("LOFT_PYTHON:BOOL=ON", cache)
        self.assertIn("LOFT_PROGRAM:BOOL=OFF", cache)
        self.assertIn("LOFT_TESTS:BOOL=OFF", cache)
        self.assertTrue(any(line.startswith("Python_EXECUTABLE:") and
                            line.endswith(f"={sys.executable}") for line in cache))

    def test_what_is_missing_is_named_by_its_package(self):
        with tempfile.TemporaryDirectory() as folder:
            done = call(f"b.configure({folder!r})",
                        CMAKE_ARGS="-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("install pybind11-dev", done.words)
        self.assertIn("Debian packages that are missing:", done.words)
        self.assertNotIn("Traceback", done.stdout)

    def test_without_cmake_it_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            os.symlink("/bin/sh", Path(folder, "sh"))
            done = call("b.configure('nowhere')", PATH=folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("cmake", done.words)
        self.assertNotIn("Traceback", done.stdout)

    def test_a_build_for_another_python_is_refused(self):
        done = call("b.sysconfig.get_config_var = lambda name: '.another.so'; "
                    f"b.installed({BUILD!r})")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("another Python", done.stdout)


if __name__ == "__main__":
    unittest.main()
