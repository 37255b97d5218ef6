"""The short form of the adversary, and the files that it found."""

import random
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.adversary.names import faults_of_names
from tests.adversary.scenes import trials_of_scenes
from tests.adversary.trials import of_parts

pytestmark = pytest.mark.slow


def test_folders_of_parts_changed_at_random_end_in_a_sentence(tmp_path: Path) -> None:
    assert not of_parts(tmp_path, 15, random.Random(1))


def test_hostile_names_end_in_a_sentence(tmp_path: Path) -> None:
    assert not faults_of_names(tmp_path, 10, random.Random(1))


def test_scenes_keep_what_is_promised() -> None:
    words, worst = trials_of_scenes(80, 3)
    assert worst <= 1.0, words
    assert words.startswith("80 scenes")


@pytest.mark.skipif(shutil.which("strace") is None, reason="strace is not there")
def test_kills_at_system_calls_lose_nothing(root: Path) -> None:
    code = "from tests.adversary.kills import trials_of_kills; print(trials_of_kills(23))"
    done = subprocess.run([sys.executable, "-c", code], cwd=root, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    killed, calls = re.match(r"(\d+) runs killed at (\d+) system calls", done.stdout).groups()
    assert int(killed) >= 8
    assert int(calls) > 100


@pytest.mark.skipif(
    subprocess.run(
        ["unshare", "-m", "mount", "-t", "tmpfs", "none", "/mnt"], check=False, capture_output=True
    ).returncode
    != 0
    if shutil.which("unshare")
    else True,
    reason="no disk can be mounted here",
)
def test_disks_that_are_full_read_only_or_gone_lose_nothing(root: Path) -> None:
    """A run is stopped before its 1st, 8th ... change of a name; the dataset gets its name by the 12th."""
    command = [sys.executable, "-m", "tests.adversary.disks", "7", "2"]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    ended = {what: int(failed) for what, failed in re.findall(r"([^:;]+): [\d,]+ \((\d+) ended with", done.stdout)}
    assert ended.keys() == {
        "runs on full disks, page by page",
        *(f" {what} at a {when}" for what in ("read-only", "gone") for when in ("change of a name", "random moment")),
    }
    assert ended["runs on full disks, page by page"] > 0
    assert ended[" read-only at a change of a name"] > 0, "before the first nothing is open for writing"
    assert ended[" gone at a change of a name"] >= 2
