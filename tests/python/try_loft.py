# SPDX-License-Identifier: MIT
"""Tries the installed module: python try_loft.py PREFIX SAMPLES. It lies below PREFIX."""

import sys
import tempfile
from pathlib import Path

import loft
import numpy as np

prefix, samples = (Path(word).resolve() for word in sys.argv[1:3])
for module in (loft, loft._loft):
    assert prefix in Path(module.__file__).parents, f"{module.__file__} is not in {prefix}"
assert not loft._loft.__file__.startswith(str(samples.parent)), "that is the source"

made = loft.reconstruct(loft.read(samples / "shells.ndjson"))
assert len(made) > 0
for label, surface in made.items():
    assert surface.vertices.dtype == np.float64 and surface.vertices.shape[1] == 3
    assert surface.check().valid and surface.volume > 0, label
with tempfile.TemporaryDirectory() as folder:
    made.write(Path(folder, "shells.glb"))
    assert loft.check(Path(folder, "shells.glb")).valid
print(f"loft {loft.__version__}, {Path(loft.__file__).parent}: {dict(made)}")
