#!/bin/sh
# SPDX-License-Identifier: MIT
# A wheel that carries its libraries works in an environment with numpy alone, and takes none of the
# system's but those that every system has.
#   sh tests/python/wheel.sh PYTHON BUILD SCRATCH
set -eu
cd "$(dirname "$0")/../.."
python=$1 build=$2 scratch=$3
rm -rf "$scratch"
export PIP_NO_INDEX=1 PIP_CONFIG_FILE=/dev/null PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1
unset PYTHONPATH PIP_FIND_LINKS DCMDICTPATH
PYTHON=$python sh python/wheel.sh "$build" "$scratch"

"$python" -m venv "$scratch/env"
"$python" tests/python/numpy_alone.py "$scratch"/env/lib/python3*/site-packages
"$scratch/env/bin/pip" install "$scratch"/loft_surfaces-*manylinux*.whl
cd "$scratch"
env/bin/python -B - env "$OLDPWD/samples/data" << END
exec(open("$OLDPWD/tests/python/try_loft.py").read())
import os, re
assert os.environ["DCMDICTPATH"].startswith(str(prefix)) and loft.read(
    samples / "mim_7.0.3_four_rois.dcm").labels
loaded = {line.split(maxsplit=5)[5].strip() for line in open("/proc/self/maps") if ".so" in line}
carried = {path for path in loaded if re.search(
    "/lib(OpenMesh|tbb|tinygltf|csv|dcmdata|tiff|meshoptimizer|zip|icu|crypto|xml)", path)}
assert len(carried) > 5, loaded
assert all(path.startswith(str(prefix)) for path in carried), carried
END
