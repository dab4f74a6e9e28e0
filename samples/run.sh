#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes a closed surface of a skull from its contours in a CT scan, then does the other samples.
# Builds what that needs; installs missing Debian packages first.
set -eu
cd "$(dirname "$0")/.."

sh setup.sh
# A first build leaves the tests out; one that has them keeps them.
[ -f build/release/CMakeCache.txt ] && tests= || tests=-DLOFT_TESTS=OFF
cmake --preset release $tests
cmake --build --preset release -j "$(nproc)" --target loft surface_from_circles make_stacks

loft=build/release/app/loft
out=build/samples
mkdir -p $out

echo "== The skull"
$loft reconstruct samples/data/skull.ndjson -o $out/skull.glb -o $out/skull.ply
$loft check $out/skull.ply --stack samples/data/skull.ndjson

echo "== The other stacks"
for name in bunny vessels shells; do
  $loft reconstruct samples/data/$name.ndjson -o $out/$name.glb -o $out/$name.ply --quiet
  $loft check $out/$name.ply --stack samples/data/$name.ndjson
done

echo "== The same, bent between the slices"
for name in bunny vessels shells; do
  $loft reconstruct samples/data/$name.ndjson --smooth -o $out/${name}_smooth.glb -o $out/${name}_smooth.ply \
    --quiet
  $loft check $out/${name}_smooth.ply --stack samples/data/$name.ndjson
done

echo "== From 3D Slicer: a chest in seven colours, a file a segment, and their volumes"
chest=samples/data/slicer_chest.seg.nrrd
mkdir -p $out/chest
$loft reconstruct $chest -o $out/chest.glb -o $out/chest.ply -o "$out/chest/{label}.stl" --csv $out/chest.csv
$loft check $out/chest.ply --stack $chest > $out/chest.txt
tail -n 1 $out/chest.txt

echo "== From TotalSegmentator: 41 organs, as thick as their slices"
organs=samples/data/totalsegmentator_example_seg.nii.gz
$loft reconstruct $organs -o $out/organs.glb -o $out/organs.ply --unit mm --cap extend --csv $out/organs.csv --quiet
$loft check $out/organs.ply --stack $organs > $out/organs.txt
tail -n 1 $out/organs.txt

echo "== From a planning system, a file a structure"
structures=samples/data/mim_7.0.3_four_rois.dcm
if $loft info $structures; then  # Loft may have been built without DCMTK
  $loft reconstruct $structures -o "$out/{label}.stl" -o $out/structures.glb
  $loft check $out/structures.glb
fi

echo "== A program that uses the library"
build/release/samples/surface_from_circles $out/vase.glb

cat << END

Done. The skull is in
  $PWD/$out/skull.glb    for any glTF viewer: Blender, f3d, a browser
  $PWD/$out/skull.ply    with each vertex's slice, contour and point: MeshLab, ParaView
The others lie beside it: $out/chest.glb has seven segments, chest.csv their volumes. Next, try
  $loft info samples/data/skull.ndjson
  $loft reconstruct samples/data/skull.ndjson -o $out/skull.stl --smooth --cap dome --json
  $loft reconstruct samples/data/bunny.ndjson -o $out/small.glb --simplify 0.5
  $loft --help
END
