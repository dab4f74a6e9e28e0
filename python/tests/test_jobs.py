# SPDX-License-Identifier: MIT
"""The recipes of docs/scale.md with Dask and MPI: as the studies one by one, whatever is killed."""

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import loft
from cases import SAMPLES, random_slices, seeded

JOBS = os.path.join(SAMPLES, "jobs")


def contents(folder):
    """The bytes of each file."""
    made = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as file:
            made[name] = file.read()
    return made


def workers_of(pid):
    """Processes below one that run Dask's workers."""
    found, left = [], [pid]
    while left:
        parent = left.pop()
        for task in os.listdir(f"/proc/{parent}/task"):
            with open(f"/proc/{parent}/task/{task}/children") as file:
                left += [int(child) for child in file.read().split()]
        if parent != pid:
            with open(f"/proc/{parent}/cmdline") as file:
                if "spawn_main" in file.read():
                    found.append(parent)
    return found


class AnArchive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        random = seeded()
        cls.studies = []
        for i in range(24):
            path = os.path.join(cls.folder.name, f"study{i:02}.ndjson")
            loft.Stack(random_slices(random, 10, labels=("a", "b", "c"))).write(path)
            cls.studies.append(path)
        sys.path.insert(0, JOBS)
        from study import make, write_table

        alone = os.path.join(cls.folder.name, "alone")
        os.mkdir(alone)
        write_table([row for path in cls.studies for row in make(path, alone)], alone)
        cls.expected = contents(alone)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def begin(self, words, folder):
        return subprocess.Popen([*words, folder, *self.studies], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, cwd=JOBS)

    def finish(self, process, folder):
        said = process.communicate(timeout=180)[0]
        self.assertEqual(process.returncode, 0, said)
        self.assertEqual(contents(folder), self.expected)

    def test_is_made_by_dask(self):
        folder = os.path.join(self.folder.name, "dask")
        self.finish(self.begin([sys.executable, "dask_archive.py"], folder), folder)

    def test_is_whole_where_a_worker_is_killed(self):
        folder = os.path.join(self.folder.name, "killed")
        process = self.begin([sys.executable, "dask_archive.py"], folder)
        for line in process.stdout:
            if line.startswith("3 of"):
                break
        victims = workers_of(process.pid)
        self.assertTrue(victims)
        os.kill(victims[0], signal.SIGKILL)
        self.finish(process, folder)

    def test_is_made_under_mpi(self):
        folder = os.path.join(self.folder.name, "mpi")
        self.finish(self.begin(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2",
                                sys.executable, "-m", "mpi4py.futures", "mpi_archive.py"], folder),
                    folder)


if __name__ == "__main__":
    unittest.main()
