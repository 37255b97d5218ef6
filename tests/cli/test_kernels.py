"""One process compiles at a time; those that find all compiled do not wait for each other."""

import fcntl
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from gradhesion.cli.study.study import study_from
from gradhesion.cli.work import kernels


@pytest.fixture
def solved(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[tuple[slice, ...]]:
    """The blocks that are solved in order to compile."""
    blocks: list[tuple[slice, ...]] = []
    monkeypatch.setattr(kernels, "solve_block", lambda _study, block, _threads: blocks.append(block))
    monkeypatch.setattr(kernels, "CACHE_FOLDER", tmp_path / "cache")
    monkeypatch.setattr(kernels, "PAUSE", 0.01)
    return blocks


def test_the_second_waits_for_the_first(data: dict[str, Any], solved: list[Any], tmp_path: Path) -> None:
    study = study_from(data)
    (tmp_path / "cache").mkdir()
    with (tmp_path / "cache" / "lock").open("wb") as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        thread = threading.Thread(target=kernels.compile_kernels, args=[study])
        thread.start()
        time.sleep(0.1)
        assert solved == []
    thread.join(10)
    assert solved == [(slice(0, 1),) * 4]
    with (tmp_path / "cache" / "lock").open("rb") as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        kernels.compile_kernels(study)
    assert len(solved) == 2, "all is compiled, and nobody waits"


def test_each_kind_of_study_and_every_solver(data: dict[str, Any], solved: list[Any], tmp_path: Path) -> None:
    kernels.compile_kernels(study_from(data))
    kernels.compile_kernels(study_from(data | {"title": "Another"}))
    assert len(list(tmp_path.glob("cache/compiled-*"))) == 1
    kernels.compile_kernels(
        study_from(data | {"outputs": ["pull_off_force"], "method": {"solver": ["exact", "envelope"]}})
    )
    assert len(list(tmp_path.glob("cache/compiled-*"))) == 2
    assert solved[-1] == (slice(0, 2), *(slice(0, 1),) * 4)


def test_without_a_place_for_the_lock(
    data: dict[str, Any], solved: list[Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setattr(kernels, "CACHE_FOLDER", tmp_path / "file" / "cache")
    kernels.compile_kernels(study_from(data))
    assert len(solved) == 1
