#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the surfaces of an archive under MPI: a study a task, one process leads.

    mpirun -n 3 python3 -m mpi4py.futures mpi_archive.py FOLDER STUDY...

Debian: python3-mpi4py, openmpi-bin.
"""

import os
import sys
from functools import partial

from mpi4py.futures import MPIPoolExecutor

from study import check_names, make, write_table


def main(folder, studies):
    check_names(studies)
    os.makedirs(folder, exist_ok=True)
    with MPIPoolExecutor() as pool:
        rows = [row for made in pool.map(partial(make, folder=folder), studies, unordered=True)
                for row in made]
    write_table(rows, folder)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
