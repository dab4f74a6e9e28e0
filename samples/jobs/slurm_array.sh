#!/bin/bash
# SPDX-License-Identifier: MIT
# The labels of one stack by an array of Slurm jobs, each with its share. A job that comes to its
# time limit is told a minute before, ends with whole files, and goes back into the queue.
#   sbatch --export=ALL,STACK=cells.nrrd,FOLDER=meshes samples/jobs/slurm_array.sh
# For another number of jobs: SHARDS=N and --array=0-(N-1); some of them again: --array=5,17.
#SBATCH --job-name=loft
#SBATCH --array=0-99
#SBATCH --cpus-per-task=1
#SBATCH --mem=2G
#SBATCH --time=01:00:00
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
set -u
: "${STACK:?the stack to work on}" "${FOLDER:?where meshes go, on a disk that all nodes see}"
mkdir -p "$FOLDER"

# Every job deals out the same labels. A job that goes on later has a report of its own.
"${LOFT:-loft}" reconstruct "$STACK" -o "$FOLDER/{label}.ply" \
  --shard "$SLURM_ARRAY_TASK_ID/${SHARDS:-100}" --skip-existing \
  --threads "${SLURM_CPUS_PER_TASK:-1}" --quiet --json > \
  "$FOLDER/job-$SLURM_ARRAY_TASK_ID-${SLURM_RESTART_COUNT:-0}.json" &
job=$!
told=
trap 'told=1; kill -TERM "$job"' TERM
wait "$job"
code=$?
if [ -n "$told" ]; then # the first wait ended with the signal, not with the job
  wait "$job"
  code=$?
fi

# Interrupted (130; 143: before it had begun) is worth going on with. 2 and 3 would fail again.
if { [ "$code" = 130 ] || [ "$code" = 143 ]; } && command -v scontrol > /dev/null; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
fi
exit "$code"
