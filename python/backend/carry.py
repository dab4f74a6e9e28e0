# SPDX-License-Identifier: MIT
"""Makes a wheel that carries its libraries: see python/wheel.sh.

    python carry.py BUILD FOLDER

All libraries that the module needs lie in the wheel, but for those that each system of the tag has.
The module looks there first, for what its libraries need, too (DT_RPATH). They are those of this
system, so the wheel is for systems of its C library's version or a newer one.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import loft_backend as backend

# What PEP 600 takes for granted.
OF_THE_SYSTEM = re.compile(r"(linux-vdso|ld-linux.*|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+))\.so.*")


def told(*command):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout


def needed(module):
    """Path of each library that a module needs, by the name that it is looked for with."""
    found = re.findall(r"^\s*(\S+) => (\S+)", told("ldd", module), re.MULTILINE)
    missing = [name for name, path in found if path == "not"]
    if missing:
        raise SystemExit(f"not found: {', '.join(missing)}")
    return {name: Path(path) for name, path in found if not OF_THE_SYSTEM.fullmatch(name)}


def with_rpath(content, place):
    """A module or library that looks for others in a place first."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "library.so")
        path.write_bytes(content)
        path.chmod(0o755)
        told("patchelf", "--force-rpath", "--set-rpath", place, path)
        return path.read_bytes()


def licences(libraries):
    """What Debian says of the packages that the libraries are of, by package."""
    packages = set()
    for path in libraries:
        owner = subprocess.run(["dpkg-query", "-S", path.resolve()], text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
        packages.add(owner.split(":")[0])
    files = {name: Path("/usr/share/doc", name, "copyright") for name in sorted(packages - {""})}
    return {name: path.read_bytes() for name, path in files.items() if path.exists()}


def with_dictionary(files, libraries):
    """DCMTK reads the names of DICOM's elements from a file."""
    for name in libraries:
        version = re.fullmatch(r"libdcmdata\.so\.(\d+)", name)
        if not version:
            continue
        dictionary = Path(f"/usr/share/libdcmtk{version[1]}/dicom.dic")
        files["loft_surfaces.libs/dicom.dic"] = dictionary.read_bytes()
        files["loft/__init__.py"] += b"""
import os as _os

_os.environ.setdefault("DCMDICTPATH", _os.path.join(
    _os.path.dirname(_os.path.dirname(__file__)), "loft_surfaces.libs", "dicom.dic"))
"""


def carried(files):
    """The files of a wheel, and the libraries that they need."""
    libraries = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in [name for name in files if name.endswith(".so")]:
            path = Path(folder, "module.so")
            path.write_bytes(files[name])
            libraries.update(needed(path))
            files[name] = with_rpath(files[name], "$ORIGIN/../loft_surfaces.libs")
    for name, path in sorted(libraries.items()):
        files[f"loft_surfaces.libs/{name}"] = with_rpath(path.read_bytes(), "$ORIGIN")
    with_dictionary(files, libraries)
    return files, licences(libraries.values())


build, folder = sys.argv[1:]
version = os.confstr("CS_GNU_LIBC_VERSION").split()[1].replace(".", "_")
plain = backend.tag()
tag = plain.replace("-linux_", f"-manylinux_{version}_")
about = f"{backend.stem()}.dist-info"
files, copyrights = carried(backend.installed(build))
files.update(backend.about())
files[f"{about}/WHEEL"] = files[f"{about}/WHEEL"].replace(plain.encode(), tag.encode())
files.update({f"{about}/licences/{name}": text for name, text in copyrights.items()})
path = Path(folder, f"{backend.stem()}-{tag}.whl")
path.parent.mkdir(parents=True, exist_ok=True)
backend.write_wheel(path, files)
print(f"{path}: {path.stat().st_size / 2**20:.1f} MiB, "
      f"{sum(name.startswith('loft_surfaces.libs/lib') for name in files)} libraries")
