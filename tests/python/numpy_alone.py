# SPDX-License-Identifier: MIT
"""Puts numpy, as this interpreter has it, and nothing else into a folder: numpy_alone.py FOLDER."""

import os
import sys
from pathlib import Path

import numpy

found = Path(numpy.__file__).parents[1]
for path in [found / "numpy", *found.glob("numpy[-.]*")]:
    os.symlink(path, Path(sys.argv[1], path.name))
