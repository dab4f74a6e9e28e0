# SPDX-License-Identifier: MIT
# Checks what write_gltf.cpp wrote as 3MF, as another program reads it.
#   python3 check_3mf.py FILE
import sys
import xml.etree.ElementTree as xml
import zipfile

core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
package = "{http://schemas.openxmlformats.org/package/2006/relationships}"


def edges_are_matched(triangles):
    """Whether each edge has one triangle on each side."""
    sides = [(t[i], t[(i + 1) % 3]) for t in triangles for i in range(3)]
    return len(set(sides)) == len(sides) and all((b, a) in set(sides) for a, b in sides)


archive = zipfile.ZipFile(sys.argv[1])
assert archive.testzip() is None
assert archive.namelist() == ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
target = xml.fromstring(archive.read("_rels/.rels")).find(package + "Relationship").get("Target")
assert "model" in archive.read("[Content_Types].xml").decode()

model = xml.fromstring(archive.read(target.lstrip("/")))
assert model.tag == core + "model" and model.get("unit") == "micron"
bases = model.findall(f"{core}resources/{core}basematerials/{core}base")
assert [base.get("displaycolor") for base in bases][0] == "#d02030"
objects = model.findall(f"{core}resources/{core}object")
assert [o.get("name") for o in objects] == ['liver "1" & <2>', "lung \u00e9"], objects
assert [o.get("type") for o in objects] == ["model", "surface"]
ids = [o.get("id") for o in objects]
assert [item.get("objectid") for item in model.findall(f"{core}build/{core}item")] == ids
assert len(set(ids + ["1"])) == 3
for place, thing in enumerate(objects):
    assert thing.get("pid") == "1" and thing.get("pindex") == str(place)
    vertices = thing.findall(f"{core}mesh/{core}vertices/{core}vertex")
    triangles = [tuple(int(t.get(key)) for key in ("v1", "v2", "v3"))
                 for t in thing.iter(core + "triangle")]
    assert len(vertices) == 24 and max(map(max, triangles)) == 23
    assert edges_are_matched(triangles) == (thing.get("type") == "model")
third = objects[1].findall(f"{core}mesh/{core}vertices/{core}vertex")[0]
assert float(third.get("x")) == 2 + 1 / 3 + 2, "all digits"
