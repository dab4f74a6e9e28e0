#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the recipes of docs/scale.md: jobs that share the labels of a stack give the files of one.
#   sh tests/recipes.sh LOFT             GNU parallel, and a Slurm array by hand
#   sh tests/recipes.sh container        the container file, where there is a builder
set -eu
cd "$(dirname "$0")/.."
jobs=$PWD/samples/jobs
stack=$PWD/samples/data/slicer_chest.seg.nrrd

fail() {
  echo "recipes.sh: $1" >&2
  exit 1
}

if [ "$1" = container ]; then
  for builder in podman docker; do
    "$builder" info > /dev/null 2>&1 || continue
    "$builder" build -f samples/jobs/Containerfile -t loft-recipe .
    "$builder" run --rm -v "$PWD/samples/data:/work" loft-recipe info vessels.ndjson
    exit 0
  done
  echo "neither podman nor docker works here: not built"
  exit 0
fi

LOFT=$1
export LOFT
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for name in whole parallel slurm; do mkdir "$folder/$name"; done
"$LOFT" reconstruct "$stack" --quiet -o "$folder/whole/{label}.ply"

# same FOLDER: whether it has the meshes of the one job, and no others.
same() {
  (cd "$folder/whole" && sha256sum ./*.ply) > "$folder/wanted"
  (cd "$folder/$1" && sha256sum ./*.ply) > "$folder/made"
  cmp -s "$folder/wanted" "$folder/made" || fail "$1: not the files of one job"
  [ -z "$(find "$folder/$1" -name '*.part')" ] || fail "$1: a file that is not whole"
}

if command -v parallel > /dev/null; then
  sh "$jobs/parallel.sh" "$stack" "$folder/parallel" 3 2
  same parallel
else
  echo "GNU parallel is missing: not run"
fi

# What sbatch does with an array of three jobs; the first attempts come to their time limit.
bash -n "$jobs/slurm_array.sh"
mkdir "$folder/bin"
printf '#!/bin/sh\necho "$@" >> "%s/requeued"\n' "$folder" > "$folder/bin/scontrol"
chmod +x "$folder/bin/scontrol"
PATH=$folder/bin:$PATH
array() {
  STACK=$stack FOLDER=$folder/slurm SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=$1 \
    SHARDS=3 SLURM_CPUS_PER_TASK=1 exec bash "$jobs/slurm_array.sh"
}
for task in 0 1 2; do
  (array $task) 2> "$folder/words" &
  job=$!
  until [ -e "$folder/slurm/job-$task-0.json" ]; do sleep 0.02; done
  sleep 0.2
  kill -TERM $job
  code=0
  wait $job || code=$?
  case $code in
    0 | 130 | 143) ;;
    *) cat "$folder/words" >&2; fail "a job that was told to end said $code" ;;
  esac
  [ "$code" = 0 ] || grep -qx "requeue 7_$task" "$folder/requeued" || fail "not requeued"
done
[ -s "$folder/requeued" ] || fail "no job was interrupted"
for task in 0 1 2; do (array $task); done
same slurm
echo "recipes give the files of one job"
