"""The short form of the faults: every change of a name, and some random moments."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]


def test_a_killed_run_loses_nothing_and_leaves_nothing_behind() -> None:
    command = [sys.executable, "-m", "tests.faults.trials", "--random", "6", "--seed", "5"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    told = re.match(
        r"killed before and after each of (\d+) changes .*: (\d+) runs ended early, (\d+) parts", done.stdout
    )
    assert told, done.stdout
    changes, ended, kept = map(int, told.groups())
    assert changes >= 6 + 3, "a rename a part, those of the study, the state and the dataset"
    assert ended >= 2 * changes
    assert kept >= 2 * changes
