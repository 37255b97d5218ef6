"""The processors of a job are counted, not those of its machine."""

import math
import os
from pathlib import Path

import numpy as np
import pytest

from gradhesion.core import processors as module
from gradhesion.core.processors import processors


@pytest.fixture(autouse=True)
def _machine(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A machine of 96 processors without control groups, under Python 3.11."""
    monkeypatch.delattr(os, "process_cpu_count", raising=False)
    monkeypatch.setattr(os, "cpu_count", lambda: 96)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {*range(96)}, raising=False)
    monkeypatch.setattr(module, "_GROUPS", tmp_path / "groups")
    monkeypatch.setattr(module, "_GROUP_OF_PROCESS", tmp_path / "own")


def test_those_of_the_affinity(monkeypatch: pytest.MonkeyPatch) -> None:
    assert processors() == 96
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {3, 5, 70, 71})
    assert processors() == 4
    monkeypatch.setattr(os, "process_cpu_count", lambda: 3, raising=False)
    assert processors() == 3


def test_those_of_the_machine_where_nothing_else_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(os, "sched_getaffinity")
    assert processors() == 96
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert processors() == 1


@pytest.mark.parametrize(
    ("own", "limits", "expected"),
    [
        ("0::/\n", {"": "250000 100000"}, 3),
        ("0::/\n", {"": "20000 100000"}, 1),
        ("0::/a/b\n", {"a/b": "max 100000", "a": "700000 100000"}, 7),
        ("0::/a/b\n", {"a/b": "200000 100000", "a": "700000 100000"}, 2),
        ("1:cpu:/\n0::/\n", {"": "max 100000"}, 96),
        ("nonsense", {"": "200000 100000"}, 96),
        ("0::/\n", {"": "nonsense"}, 96),
    ],
)
def test_no_more_than_the_quota_of_the_group(own: str, limits: dict[str, str], expected: int, tmp_path: Path) -> None:
    (tmp_path / "own").write_text(own)
    for folder, limit in limits.items():
        (tmp_path / "groups" / folder).mkdir(parents=True, exist_ok=True)
        (tmp_path / "groups" / folder / "cpu.max").write_text(limit + "\n")
    assert processors() == expected


def test_the_quota_of_a_container_of_version_1(tmp_path: Path) -> None:
    folder = tmp_path / "groups" / "cpu"
    folder.mkdir(parents=True)
    (folder / "cpu.cfs_period_us").write_text("100000\n")
    for quota, expected in (("-1", 96), ("350000", 4)):
        (folder / "cpu.cfs_quota_us").write_text(quota + "\n")
        assert processors() == expected


def test_a_solve_has_as_many_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    from gradhesion.core import solve
    from gradhesion.core.arrays import tasks

    asked: list[int] = []

    class Pool(tasks.ThreadPoolExecutor):
        def __init__(self, workers: int) -> None:
            asked.append(workers)
            super().__init__(workers)

    monkeypatch.setattr(tasks, "ThreadPoolExecutor", Pool)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1, 2})
    scene = {"k": np.linspace(0.0, 0.5, 7), "nu": 0.3, "modulus": 430.0, "c0_over_R": 0.013}
    scene |= {"lambda_over_R": 0.11, "A": 0.023, "a_max_over_R": math.inf}
    solve(scene, ["pull_off_force"])
    assert asked == []  # solved sooner than threads begin
    wavelengths = np.linspace(0.1, 0.2, 100)[:, None]
    solve(scene | {"lambda_over_R": wavelengths}, ["pull_off_force"])
    assert asked == [3]
