"""Clocks that are set during a run: what is written, reused and removed does not depend on them, and what is printed stays sensible."""

import json
import os
import re
import time
from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from gradhesion.cli.study.reading import study_from
from gradhesion.cli.work.parts.folder import claimed, folder_of
from gradhesion.cli.work.parts.manifest import adopt
from gradhesion.cli.work.parts.records import Keeper, State, read_record
from tests.cli.engines.orders import values_of

Call = Callable[..., Result]
YEAR = 365.25 * 86_400.0
REAL = time.time


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


def clock(*offsets: float) -> Callable[[], float]:
    """Make a clock that is set anew each time that somebody looks."""
    looks = count()
    return lambda: REAL() + offsets[next(looks) % len(offsets)]


@pytest.mark.parametrize(
    "offsets", [(0.0, -86_400.0), (0.0, 10 * YEAR), (10 * YEAR, 0.0, -40 * YEAR), (-80 * YEAR,), (3000 * YEAR,)]
)
def test_a_run_resumes_whatever_the_clock_says(
    offsets: tuple[float, ...], gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole, output = tmp_path / "whole.nc", tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", whole, "--quiet").exit_code == 0
    monkeypatch.setattr("gradhesion.cli.work.parts.records.PERIOD", 0.0)
    monkeypatch.setattr(time, "time", clock(*offsets))
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/2").exit_code == 0
    (run,) = json.loads(gradhesion("status", output, "--json").stdout)["runs"]
    assert (run["blocks_done"], run["scenes_done"]) == (3, 12)
    assert 0.0 < run["seconds"] < 60.0
    assert 0.2 < run["rate"] * run["seconds"] / 12 < 5.0
    assert run["seconds_left"] >= 0.0
    words = gradhesion("status", output).stdout
    assert re.search(r"12 of 12 scenes \(100%\), 0 failed, [\d,.]+ per s \(reported \d+ s ago\)", words)
    assert "reused 3 blocks, computed 3" in gradhesion("run", study_file, "-o", output).stderr
    assert values_of(output) == values_of(whole)


def test_a_state_of_an_earlier_version_has_no_negative_rate(
    gradhesion: Call, data: dict[str, Any], tmp_path: Path
) -> None:
    output = tmp_path / "out.nc"
    with claimed(output, "1-of-2") as folder:
        adopt(study_from(data), folder, output)
        keeper = Keeper(folder.path / "state-1-of-2.json", scenes=100, blocks=4)
        keeper.add(scenes=60, failed=0, reused=False, raised=False)
        keeper.write()
        path = folder.path / "state-1-of-2.json"
        written = json.loads(path.read_text())
        del written["seconds"]
        path.write_text(json.dumps(written | {"updated": written["started"] - 7200.0}))
    found = json.loads(gradhesion("status", output, "--json").stdout)["runs"][0]
    assert (found["seconds"], found["rate"], found["seconds_left"]) == (0.0, 0.0, 0.0)


def test_a_clock_before_1970_leaves_a_state_that_is_read(tmp_path: Path) -> None:
    with claimed(tmp_path / "out.nc", "1-of-2") as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(time, "time", lambda: -1e9)
        keeper = Keeper(folder.path / "state.json", scenes=100, blocks=4)
        state = read_record(folder.path / "state.json", State)
    assert state is not None
    assert (state.started, state.pid) == (0.0, keeper.state.pid)


@pytest.mark.parametrize("when", [-(10**10), 0, 10**10, 10**17])
def test_a_dataset_of_any_date(
    when: int, gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", output, "--quiet").exit_code == 0
    really = Path.stat

    def dated(path: Path, **options: Any) -> os.stat_result:
        found = list(really(path, **options))
        found[8] = when
        return os.stat_result(found)

    monkeypatch.setattr(Path, "stat", dated)
    told = gradhesion("status", output)
    assert told.exit_code == 0
    assert re.search(r"complete, [\d.]+ kB, written (-?\d+-\d\d-\d\d \d\d:\d\d:\d\d|at an unknown date)\n", told.stdout)
    assert not folder_of(output).path.exists()
