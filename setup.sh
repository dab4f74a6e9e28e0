#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs the Debian packages that loft needs, if any is missing; does nothing otherwise.
#   sh setup.sh          what the libraries, the program and most samples need
#   sh setup.sh npm      that, and npm, for the viewer of loft stream --view and loft view, and for
#                        the world map of samples/triangulate.sh
#   sh setup.sh tests    that, and what the tests need
#   sh setup.sh fuzz     that, and what fuzzing needs
#   sh setup.sh python   what the libraries and the Python module need: pip install .
#   sh setup.sh bench    what the libraries and the benchmarks need
# With `missing` behind it, it only says what is missing.
set -eu

packages="g++ cmake ninja-build pkg-config libopenmesh-dev libeigen3-dev libtbb-dev
  libtinygltf-dev libsqlite3-dev zlib1g-dev libcsv-dev libdcmtk-dev libtiff-dev libpng-dev libmeshoptimizer-dev libzip-dev libcpp-httplib-dev libcli11-dev
  nlohmann-json3-dev"
what=${1:-}
python="python3-dev python3-numpy python3-venv pybind11-dev"
if [ "$what" = fuzz ]; then
  packages="$packages libclang-rt-16-dev"
  what=tests
fi
if [ "$what" = bench ]; then
  packages="$packages libbenchmark-dev"
fi
if [ "$what" = python ]; then
  packages="$packages $python"
fi
if [ "$what" = tests ]; then
  packages="$packages $python python3-mypy patchelf python3-dask python3-distributed python3-mpi4py openmpi-bin"
  packages="$packages libgtest-dev libgmock-dev libboost-dev clang-format clang-16 clang-tidy-16
    chromium doxygen groff-base bsdutils python3 parallel"
fi
# Node.js often comes from elsewhere than Debian, npm with it.
if [ -n "$what" ] && [ "$what" != python ] && ! command -v npm > /dev/null; then
  packages="$packages nodejs npm ca-certificates"
fi

if ! command -v dpkg-query > /dev/null; then
  echo "setup.sh: not a Debian system; what is needed, by its Debian names:" $packages >&2
  exit 0
fi

missing=
for package in $packages; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
if [ "${2:-}" = missing ]; then
  echo "Debian packages that are missing:${missing:- none}"
  [ -z "$missing" ] || echo "sh setup.sh $1 installs them"
  exit 0
fi
[ -n "$missing" ] || exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo > /dev/null; then
  as_root=sudo
else
  echo "setup.sh: packages are missing; as root: apt-get install$missing" >&2
  exit 1
fi

echo "Installing$missing"
export DEBIAN_FRONTEND=noninteractive
if ! { $as_root apt-get update -q &&
       $as_root apt-get install -q -y --no-install-recommends $missing; }; then
  echo "setup.sh: apt-get failed; these packages are needed:$missing" >&2
  exit 1
fi
