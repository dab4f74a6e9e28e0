#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the surfaces of an archive by Dask: a study a task, on this machine or on a cluster.

    python3 dask_archive.py FOLDER STUDY...                       two processes here
    SCHEDULER=tcp://host:8786 python3 dask_archive.py FOLDER STUDY...

A worker that dies takes nothing with it: its studies are done again by others.
Debian: python3-distributed.
"""

import os
import sys

from distributed import Client, LocalCluster, as_completed

from study import check_names, make, write_table


def main(folder, studies):
    check_names(studies)
    os.makedirs(folder, exist_ok=True)
    scheduler = os.environ.get("SCHEDULER")
    cluster = None if scheduler else LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    with Client(scheduler or cluster) as client:
        futures = client.map(make, studies, folder=folder, pure=False, retries=2)
        rows = []
        for done, future in enumerate(as_completed(futures), 1):
            rows += future.result()
            print(f"{done} of {len(studies)}", flush=True)
    if cluster is not None:
        cluster.close()
    write_table(rows, folder)


if __name__ == "__main__":  # workers are begun anew, not forked
    main(sys.argv[1], sys.argv[2:])
