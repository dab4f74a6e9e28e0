# SPDX-License-Identifier: MIT
"""Builds the wheel of loft (PEP 517) with nothing but CMake: `pip install .` needs no network.

pip install --config-settings=build-dir=FOLDER . builds there; a folder that CMake has configured
is taken as it is. By default it is build/python/cp311, or as Python's version is, and kept, so
that the next time is quick. CMAKE_ARGS in the environment: more for CMake, -DLOFT_DICOM=OFF.
"""

import ast
import base64
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile
from io import BytesIO
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHON = f"cp{sys.version_info.major}{sys.version_info.minor}"


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    folder = (config_settings or {}).get("build-dir")
    if not folder or not Path(folder, "CMakeCache.txt").exists():
        folder = folder or ROOT / "build" / "python" / PYTHON
        configure(folder)
    run("cmake", "--build", folder, "--target", "loft_python", "--parallel", str(os.cpu_count()))
    name = f"{stem()}-{tag()}.whl"
    write_wheel(Path(wheel_directory, name), {**installed(folder), **about()})
    return name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    for name, content in about().items():
        path = Path(metadata_directory, name)
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    return f"{stem()}.dist-info"


def build_sdist(sdist_directory, config_settings=None):
    name = f"{stem()}.tar.gz"
    with tarfile.open(Path(sdist_directory, name), "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in sources():
            archive.add(ROOT / file, f"{stem()}/{file}")
        told = tarfile.TarInfo(f"{stem()}/PKG-INFO")
        told.size = len(metadata().encode())
        archive.addfile(told, BytesIO(metadata().encode()))
    return name


def configure(folder):
    """The module alone, for the interpreter that runs this."""
    command = ["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
               "-DLOFT_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}",
               "-DBUILD_SHARED_LIBS=OFF", "-DLOFT_TESTS=OFF", "-DLOFT_SAMPLES=OFF",
               "-DLOFT_PROGRAM=OFF"]
    ninja = ["-G", "Ninja"] if shutil.which("ninja") else []
    run(*command, *ninja, *shlex.split(os.environ.get("CMAKE_ARGS", "")))


def installed(folder):
    """What CMake installs of the module, by its path in the wheel."""
    with tempfile.TemporaryDirectory() as stage:
        run("cmake", "--install", folder, "--component", "python", "--prefix", stage, "--strip")
        package = next(Path(stage).rglob("loft/__init__.py")).parent
        extension = "_loft" + sysconfig.get_config_var("EXT_SUFFIX")
        if not (package / extension).exists():
            raise SystemExit(f"{folder} was built for another Python: it has no {extension}")
        return {path.relative_to(package.parent).as_posix(): path.read_bytes()
                for path in sorted(package.rglob("*")) if path.is_file()}


def write_wheel(path, files):
    """The same bytes for the same files."""
    record = f"{stem()}.dist-info/RECORD"
    lines = []
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
        lines.append(f"{name},sha256={digest},{len(content)}\n")
    with zipfile.ZipFile(path, "w") as wheel:
        for name, content in {**files, record: "".join([*lines, f"{record},,\n"])}.items():
            entry = zipfile.ZipInfo(name)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if name.endswith(".so") else 0o100644) << 16
            wheel.writestr(entry, content)


def project(key):
    """A value of pyproject.toml; what is in one line of TOML reads as Python."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    return ast.literal_eval(re.search(rf"^{key} = (.*)$", text, re.MULTILINE).group(1))


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(loft VERSION ([0-9.]+)", text).group(1)


def stem():
    return f"{project('name').replace('-', '_')}-{version()}"


def tag():
    platform = re.sub("[-.]", "_", sysconfig.get_platform())
    return f"{PYTHON}-{PYTHON}{getattr(sys, 'abiflags', '')}-{platform}"


def about():
    """The files that tell of the wheel, but for RECORD."""
    wheel = f"Wheel-Version: 1.0\nGenerator: loft\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    return {f"{stem()}.dist-info/METADATA": metadata().encode(),
            f"{stem()}.dist-info/LICENSE": (ROOT / "LICENSE").read_bytes(),
            f"{stem()}.dist-info/WHEEL": wheel.encode()}


def metadata():
    readme = ROOT / project("readme")
    lines = ["Metadata-Version: 2.1", f"Name: {project('name')}", f"Version: {version()}",
             f"Summary: {project('description')}", "License: MIT",
             f"Requires-Python: {project('requires-python')}",
             *(f"Requires-Dist: {needed}" for needed in project("dependencies")),
             "Description-Content-Type: text/markdown", ""]
    return "\n".join([*lines, readme.read_text(encoding="utf-8") if readme.exists() else ""])


def sources():
    """The files that git knows; all but what was built where there is no git."""
    if (ROOT / ".git").exists():
        listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True,
                                stdout=subprocess.PIPE).stdout.decode().split("\0")
        return [file for file in listed if file and (ROOT / file).exists()]
    left_out = {"build", "node_modules", "__pycache__", "PKG-INFO"}
    found = (path.relative_to(ROOT) for path in sorted(ROOT.rglob("*")) if path.is_file())
    return [path.as_posix() for path in found if not left_out.intersection(path.parts)]


def run(*command):
    try:
        failed = subprocess.run(command).returncode != 0
    except FileNotFoundError:
        failed = True
    if failed:
        told = subprocess.run(["sh", ROOT / "setup.sh", "python", "missing"], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout.strip()
        words = shlex.join(str(word) for word in command)
        raise SystemExit(f"loft could not be built: {words} failed.\n{told}")
