# SPDX-License-Identifier: MIT
"""One job of an archive: a study in, its surfaces and a row for each label out."""

import os

import loft


def make(path, folder):
    """Writes FOLDER/STUDY.glb whole or not at all, and returns [study, label, volume, area] of each
    label. Started again, it makes the same bytes."""
    study = os.path.splitext(os.path.basename(path))[0]
    made = loft.reconstruct(path, threads=1)  # the engine deals with processors
    made.write(os.path.join(folder, study + ".glb"))
    return [[study, label, surface.volume, surface.area] for label, surface in made.items()]


def check_names(studies):
    """Ends the program where two studies would have one name."""
    names = {}
    for path in studies:
        name = os.path.splitext(os.path.basename(path))[0]
        other = names.setdefault(name, path)
        if other is not path:
            raise SystemExit(f"{other} and {path}: both would be {name}.glb; rename one of them")


def write_table(rows, folder):
    """All rows in the order of studies and labels, as volumes.csv."""
    import csv

    with open(os.path.join(folder, "volumes.csv"), "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["study", "label", "volume", "area"])
        table.writerows(sorted(rows))
