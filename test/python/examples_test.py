# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of the guide: each prints, byte for byte, what is in the file beside it."""
import json
import os
import pathlib
import subprocess
import sys

import pytest

import kinetri

EXAMPLES = pathlib.Path(os.environ["KINETRI_SOURCE_DIR"], "examples", "python")
WITH_ARGUMENTS = {"check_certificates", "gallery", "slurm_array", "video_clip"}


def started(name, *arguments, **environment):
    return subprocess.run([sys.executable, EXAMPLES / f"{name}.py", *arguments], capture_output=True,
                          text=True, timeout=300, env={**os.environ, **environment}, check=False)


def output(name, *arguments, **environment):
    """What an example prints, with nothing to standard error."""
    run = started(name, *arguments, **environment)
    assert (run.returncode, run.stderr) == (0, "")
    return run.stdout


def expected(name):
    return (EXAMPLES / f"{name}.txt").read_text()


@pytest.mark.parametrize("name", sorted(
    {file.stem for file in EXAMPLES.glob("*.txt")} - WITH_ARGUMENTS))
def test_an_example_prints_what_is_beside_it(name):
    assert output(name) == expected(name)


def test_every_example_is_tested():
    programs = {file.stem for file in EXAMPLES.glob("*.py")}
    assert programs == {file.stem for file in EXAMPLES.glob("*.txt")} | WITH_ARGUMENTS


def test_a_study_on_a_cluster_gives_the_same_table():
    pytest.importorskip("distributed")
    run = started("many_runs", "--dask")
    # Dask may log that it hears from a worker while its cluster is being closed.
    errors = [line for line in run.stderr.splitlines() if " - distributed." not in line]
    assert (run.returncode, run.stdout, errors) == (0, expected("many_runs"), [])


def test_a_job_array_gives_the_same_table(tmp_path):
    for task in (4, 1, 3, 0, 2):
        text = output("slurm_array", "run", str(tmp_path), SLURM_ARRAY_TASK_ID=str(task),
                      SLURM_ARRAY_TASK_COUNT="5")
        assert text == f"task {task} of 5: {len(range(task, 12, 5))} runs\n"
    assert output("slurm_array", "gather", str(tmp_path)) == expected("many_runs")


def test_a_job_array_with_a_task_that_has_not_finished_gives_no_table(tmp_path):
    for task in (0, 2):
        (tmp_path / f"part_{task}_of_3.json").write_text(json.dumps([{"collisions": 1}] * 4))
    run = started("slurm_array", "gather", str(tmp_path))
    assert run.returncode == 1
    assert "part_1_of_3.json" in run.stderr


def test_a_table_has_a_result_for_each_run():
    runs = kinetri.parameter_list({"a": [1, 2]})
    assert kinetri.result_table(runs, [{"b": 3}, {"b": 4}]).to_dict("records") == [
        {"a": 1, "b": 3}, {"a": 2, "b": 4}]
    with pytest.raises(kinetri.PreconditionError, match="1 results; expected one for each of 2 runs"):
        kinetri.result_table(runs, [{"b": 3}])


def test_a_script_that_begins_again_in_each_process_gets_told_so(tmp_path):
    script = tmp_path / "script.py"
    script.write_text("import kinetri\nkinetri.sweep(kinetri.scenario, [{'kind': 'uniform'}], workers=1)\n")
    run = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=300, check=False)
    assert run.returncode == 1
    assert "WorkerError: 1 of 1 runs" in run.stderr
    assert "the call below if __name__ == '__main__':" in run.stderr


def test_pictures_are_made(tmp_path):
    pytest.importorskip("matplotlib")
    assert output("gallery", str(tmp_path)) == ""
    sizes = {file.name: file.stat().st_size for file in tmp_path.iterdir()}
    assert sorted(sizes) == ["python_crowd.svg", "python_discs.svg", "python_shock.png"]
    assert all(10_000 < size < 150_000 for size in sizes.values()), sizes


def test_a_clip_is_written(tmp_path):
    assert output("video_clip", str(tmp_path / "a.y4m")) == expected("video_clip")
    assert (tmp_path / "a.y4m").stat().st_size == 49 + 40 * (6 + 160 * 120)
