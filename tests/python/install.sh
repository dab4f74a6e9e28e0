#!/bin/sh
# SPDX-License-Identifier: MIT
# cmake --install puts the module where an interpreter with that prefix looks, and nowhere else.
#   sh tests/python/install.sh PYTHON BUILD PREFIX
set -eu
cd "$(dirname "$0")/../.."
python=$1 build=$2 prefix=$3
rm -rf "$prefix"
cmake --install "$build" --component python --prefix "$prefix" > /dev/null
folder=$(dirname "$(dirname "$(find "$prefix" -name __init__.py -path '*/loft/__init__.py')")")

# The interpreter of a distribution has dist-packages or site-packages below /usr/local or /usr.
"$python" - "$prefix" "$folder" << 'END'
import os, sys, sysconfig
prefix, folder = sys.argv[1:]
place = os.path.relpath(folder, prefix)
assert place == os.path.relpath(sysconfig.get_path("platlib"), sysconfig.get_path("data")), place
assert os.path.join(sysconfig.get_path("data"), place) in sys.path or sys.prefix != sys.base_prefix, place
END
[ -f "$folder/loft/py.typed" ]
[ "$(find "$prefix" -type f | wc -l)" = "$(find "$folder/loft" -type f | wc -l)" ]
PYTHONPATH=$folder "$python" tests/python/try_loft.py "$prefix" samples/data
