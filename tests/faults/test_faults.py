"""The short form of the faults: every change of a name, and some random moments."""

import re
import shutil
import subprocess
import sys

import pytest

from tests.conftest import ROOT

pytestmark = pytest.mark.slow
MOUNT = ["unshare", "-m", "mount", "-t", "tmpfs", "none", "/mnt"]
CAN_MOUNT = shutil.which("unshare") and subprocess.run(MOUNT, check=False, capture_output=True).returncode == 0


def test_a_killed_run_loses_nothing_and_leaves_nothing_behind() -> None:
    command = [sys.executable, "-m", "tests.faults.trials", "--random", "6", "--seed", "5"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    words = r"killed before and after each of (\d+) changes .*: (\d+) runs ended early, (\d+) parts"
    told = re.match(words, done.stdout)
    assert told, done.stdout
    changes, ended, kept = map(int, told.groups())
    assert changes >= 6 + 3, "a rename a part, those of the study, the state and the dataset"
    assert ended >= 2 * changes
    assert kept >= 2 * changes


@pytest.mark.skipif(not CAN_MOUNT, reason="no disk can be mounted here")
def test_disks_that_are_full_read_only_or_gone_lose_nothing() -> None:
    """A run is stopped before its 1st, 8th ... change of a name."""
    command = [sys.executable, "-m", "tests.faults.disks", "7", "2"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    ended = {what: int(failed) for what, failed in re.findall(r"([^:;]+): [\d,]+ \((\d+) ended with", done.stdout)}
    assert ended["runs on full disks, page by page"] > 0
    assert ended[" read-only at a change of a name"] > 0, "before the first nothing is open for writing"
    assert ended[" gone at a change of a name"] > 0
