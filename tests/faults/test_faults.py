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


def told_by(module: str, *words: str) -> str:
    command = [sys.executable, "-m", f"tests.faults.{module}", *words]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_killed_run_loses_nothing_and_leaves_nothing_behind() -> None:
    words = r"killed before and after each of (\d+) changes .*: (\d+) runs ended early, (\d+) parts"
    told = re.match(words, told_by("trials", "--random", "6", "--seed", "5"))
    assert told
    changes, ended, kept = map(int, told.groups())
    assert changes >= 4 + 3, "a rename a part, those of the study, the state and the dataset"
    assert min(ended, kept) >= 2 * changes


@pytest.mark.skipif(not CAN_MOUNT, reason="no disk can be mounted here")
def test_disks_that_are_full_read_only_or_gone_lose_nothing() -> None:
    """A run is stopped before its 1st, 8th ... change of a name."""
    told = re.findall(r"([^:;]+): [\d,]+ \((\d+) ended with", told_by("disks", "7", "2"))
    ended = {what: int(failed) for what, failed in told}
    assert ended["runs on full disks, page by page"] > 0
    assert ended[" read-only at a change of a name"] > 0, "before the first nothing is open for writing"
    assert ended[" gone at a change of a name"] > 0
