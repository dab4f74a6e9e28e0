#!/bin/sh
# SPDX-License-Identifier: MIT
# `pip install .` without a network, in fresh environments: one that sees the system's packages, and
# one that has numpy alone. What it has installed works, and goes away again.
#   sh tests/python/pip.sh PYTHON BUILD SCRATCH
# BUILD has the module: nothing is compiled. Without it (''), all is.
set -eu
cd "$(dirname "$0")/../.."
python=$1 build=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
export PIP_NO_INDEX=1 PIP_CONFIG_FILE=/dev/null PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1
unset PYTHONPATH PIP_FIND_LINKS

"$python" -m venv --system-site-packages "$scratch/system"
"$python" -m venv --without-pip "$scratch/alone"
"$python" tests/python/numpy_alone.py "$scratch"/alone/lib/python3*/site-packages

pip=$scratch/system/bin/pip
for environment in system alone; do
  interpreter=$scratch/$environment/bin/python
  "$pip" --python "$interpreter" install ${build:+"--config-settings=build-dir=$build"} .
  [ "$environment" = system ] || "$pip" --python "$interpreter" check
  (cd "$scratch" && "$interpreter" -B - < "$OLDPWD/tests/python/try_loft.py" "$environment" "$OLDPWD/samples/data")
  "$pip" --python "$interpreter" uninstall -y loft-surfaces
  left=$(cd "$scratch/$environment" && find . -ipath '*loft*')
  [ -z "$left" ] || { echo "left behind: $left" >&2; exit 1; }
done
if "$scratch/alone/bin/python" -c 'import mypy' 2> /dev/null; then
  echo "that environment has more than numpy" >&2
  exit 1
fi
