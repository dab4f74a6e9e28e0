#!/bin/sh
# SPDX-License-Identifier: MIT
# The labels of one stack by jobs of GNU parallel, on this machine; a job that fails is tried again.
# Start it again after an interrupt: what is done stays.
#   sh samples/jobs/parallel.sh STACK FOLDER [JOBS] [WORKERS]     20 jobs, a worker a core by default
set -eu
stack=$1
folder=$2
jobs=${3:-20}
workers=${4:-$(nproc)}
loft=${LOFT:-loft}

mkdir -p "$folder"
seq 0 $((jobs - 1)) |
  parallel --jobs "$workers" --retries 3 --joblog "$folder/jobs.log" --quote \
    "$loft" reconstruct "$stack" -o "$folder/{label}.ply" \
    --shard "{}/$jobs" --skip-existing --threads 1 --quiet
