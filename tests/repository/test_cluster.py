"""The scripts of docs/large.md: an array of jobs and a Dask cluster give the same bytes as threads on one machine."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import ROOT
from tests.faults.trials import values_of

pytestmark = pytest.mark.slow

PAGE = (ROOT / "docs" / "large.md").read_text(encoding="utf-8")

STUDY = """\
outputs = ["pull_off_force"]
[parameters]
k = [0.0, 0.3]
nu = 0.3
modulus = 500.0
c0_over_R = 0.01
lambda_over_R = { start = 0.1, stop = 1.0, num = 10, spacing = "log" }
A = { start = 0.0, stop = 0.02, num = 30 }
a_max_over_R = inf
"""

JOBQUEUE = """
from distributed import LocalCluster

class SLURMCluster(LocalCluster):
    def __init__(self, *, queue, cores, processes, memory, walltime, worker_extra_args, job_script_prologue):
        assert processes == 1 and "--lifetime" in worker_extra_args
        super().__init__(n_workers=0, threads_per_worker=1, dashboard_address="127.0.0.1:0", silence_logs=60)

    def adapt(self, *, minimum_jobs, maximum_jobs):
        self.scale(1)
"""


@pytest.fixture
def machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """An environment with the command, small blocks, and with what stands for SLURM."""
    monkeypatch.setenv("GRADHESION_CHUNK", "50")
    stubs = tmp_path / "stubs"
    stubs.mkdir()
    (stubs / "gradhesion").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m gradhesion.cli "$@"\n')
    (stubs / "gradhesion").chmod(0o755)
    (stubs / "dask_jobqueue.py").write_text(JOBQUEUE)
    (tmp_path / "study.toml").write_text(STUDY)
    path = os.pathsep.join([str(stubs), *filter(None, [os.environ.get("PYTHONPATH")])])
    return os.environ | {"PATH": f"{stubs}:{os.environ['PATH']}", "PYTHONPATH": path}


def test_both_ways_give_the_bytes_of_one_machine(machine: dict[str, str], gradhesion: Any, tmp_path: Path) -> None:
    array, merge = re.findall(r"```bash\n(.*?)```", PAGE, flags=re.DOTALL)
    (script,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    first, last = map(int, re.findall(r"--array=(\d+)-(\d+)\n", array)[0])
    assert (first, last) == (1, 8), "SLURM counts as the command does"

    whole = tmp_path / "whole.nc"
    assert gradhesion("run", tmp_path / "study.toml", "-o", whole, "--quiet").exit_code == 0
    for number in ("2", "1"):
        job = {"SLURM_ARRAY_TASK_ID": number, "SLURM_ARRAY_TASK_COUNT": "2", "SLURM_CPUS_PER_TASK": "1"}
        subprocess.run(["bash", "-ec", array], cwd=tmp_path, env=machine | job, check=True, timeout=600)
    blocks = json.loads(gradhesion("plan", tmp_path / "study.toml", "--json").stdout)["blocks"]
    assert len(list(tmp_path.glob("big.nc.parts/*.npz"))) == blocks > 2
    gradhesion(*merge.split()[1:-1], tmp_path / "big.nc", code=0)
    assert values_of(tmp_path / "big.nc") == values_of(whole)

    (tmp_path / "sweep.py").write_text(script)
    command = [sys.executable, "sweep.py", "study.toml", "-o", "dask.nc"]
    done = subprocess.run(command, cwd=tmp_path, env=machine, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stderr
    *before, last_line = done.stderr.splitlines()
    assert last_line.startswith("dask.nc: 600 scenes in ")
    assert all(re.match(r"[\d,]+ of 600 scenes \(", line) for line in before), "progress, on a slow machine"
    assert values_of(tmp_path / "dask.nc") == values_of(whole)
