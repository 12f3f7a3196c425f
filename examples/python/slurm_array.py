# SPDX-License-Identifier: GPL-3.0-or-later
"""The study of many_runs.py as a job array of Slurm.

usage: slurm_array.py run FOLDER      runs this task's share of the study, and writes it to a file
       slurm_array.py gather FOLDER   prints the table of all
"""
import json
import os
import pathlib
import sys

from many_runs import PARAMETERS, print_table, study

import kinetri


def run(folder, runs):
    task = int(os.environ["SLURM_ARRAY_TASK_ID"])  # from 0 on: --array=0-3
    tasks = int(os.environ["SLURM_ARRAY_TASK_COUNT"])
    mine = runs[task::tasks]
    results = [study(**arguments) for arguments in mine]
    # It gets its name when it is complete, so that a task that is killed leaves nothing to gather.
    file = folder / f"part_{task}_of_{tasks}.json"
    unfinished = file.with_suffix(".unfinished")
    unfinished.write_text(json.dumps(results))
    unfinished.replace(file)
    print(f"task {task} of {tasks}: {len(mine)} runs")


def gather(folder, runs):
    tasks = int(next(folder.glob("part_*.json")).stem.split("_")[-1])
    results = [None] * len(runs)
    for task in range(tasks):
        results[task::tasks] = json.loads((folder / f"part_{task}_of_{tasks}.json").read_text())
    return kinetri.result_table(runs, results)


def main():
    command, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    runs = kinetri.parameter_list(PARAMETERS)
    if command == "run":
        run(folder, runs)
    else:
        print_table(gather(folder, runs))


if __name__ == "__main__":
    main()
