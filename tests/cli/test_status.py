"""`gradhesion status` tells what is so: running, stopped or complete."""

import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from gradhesion.cli.study.reading import study_from
from gradhesion.cli.work.parts.folder import claimed, folder_of
from gradhesion.cli.work.parts.manifest import adopt
from gradhesion.cli.work.parts.records import Keeper
from gradhesion.cli.work.solve.scenes import solve as real_solve

Call = Callable[..., Result]


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


def test_nothing_is_told_as_a_mistake(gradhesion: Call, tmp_path: Path) -> None:
    result = gradhesion("status", tmp_path / "out.nc")
    assert result.exit_code == 2
    assert "there is neither a dataset nor parts of one" in result.stderr


@pytest.mark.parametrize(("content", "what"), [("title = 1", "it is a study"), ("", "it does not begin as")])
def test_a_file_that_is_no_dataset_is_not_complete(gradhesion: Call, tmp_path: Path, content: str, what: str) -> None:
    path = tmp_path / ("study.toml" if content else "out.nc")
    path.write_text(content)
    result = gradhesion("status", path)
    assert result.exit_code == 2
    assert "is not the output of a run" in result.stderr
    assert what in result.stderr


def test_under_way_stopped_and_complete(
    gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output = tmp_path / "out.nc"
    seen: list[dict[str, Any]] = []
    calls = 0

    def spying(*arguments: Any, **options: Any) -> dict[str, Any]:
        nonlocal calls
        calls += 1
        if calls == 4:
            seen.append(json.loads(gradhesion("status", output, "--json").stdout))
            seen.append({"words": gradhesion("status", output).stdout})
        if calls > 4:
            raise KeyboardInterrupt
        return real_solve(*arguments, **options)

    with monkeypatch.context() as patch:
        patch.setattr("gradhesion.cli.work.solve.given.solve", spying)
        patch.setattr("gradhesion.cli.work.parts.records.PERIOD", 0.0)
        assert gradhesion("run", study_file, "-o", output).exit_code == 1
    running, words = seen
    assert running["state"] == "running"
    assert (running["blocks"], running["scenes"]) == (6, 24)
    (run,) = running["runs"]
    assert (run["pid"], run["blocks"], run["scenes"]) == (os.getpid(), 6, 24)
    assert 0 <= run["scenes_done"] <= 12
    assert words["words"].startswith(f"{output}: running; ")
    stopped = json.loads(gradhesion("status", output, "--json").stdout)
    assert stopped["state"] == "stopped"
    assert stopped["parts"] in {3, 4}
    told = gradhesion("status", output).stdout
    assert f"{output}: stopped; {stopped['parts']} of 6 blocks (24 scenes) are kept; the same command resumes" in told
    assert gradhesion("run", study_file, "-o", output, "--quiet").exit_code == 0
    complete = gradhesion("status", output).stdout
    assert re.match(rf"{re.escape(str(output))}: complete, \d+\.\d kB, written 2", complete)


def test_rate_and_time_left_leave_out_what_was_reused(gradhesion: Call, data: dict[str, Any], tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    with claimed(output) as folder:
        adopt(study_from(data), folder, output)
        keeper = Keeper(folder.path / "state-2-of-3.json", scenes=1000, blocks=10)
        keeper.add(scenes=600, failed=3, reused=True, raised=False)
        keeper.add(scenes=100, failed=0, reused=False, raised=False)
        keeper._begun -= 50.0
        keeper.write()
        told = gradhesion("status", output).stdout.splitlines()[1]
    assert told.startswith(f"  shard 2 of 3, process {os.getpid()} on ")
    assert "2 of 10 blocks done, 1 of them reused, 700 of 1,000 scenes (70%), 3 failed, 2 per s, 150 s left" in told


STATES = ["{", "[]", '{"pid": 1}', "null", '{"scenes": -1, "blocks": 1, "started": 1.0}', '{"scenes": 1e99, "blocks": [], "started": NaN}',
          '{"scenes": 8, "blocks": 2, "started": "1"}', '{"scenes": 8, "blocks": 2, "started": 1.0, "host": 7}', "[" * 100_000,
          '{"scenes": 8, "blocks": 2, "started": 1e300, "updated": 1e308}', '{"scenes": 8, "blocks": 2, "started": 1.0, "pid": 1' + "0" * 30 + "}"]  # fmt: skip


@pytest.mark.parametrize("state", STATES)
def test_a_damaged_state_is_no_error(state: str, gradhesion: Call, data: dict[str, Any], tmp_path: Path) -> None:
    folder = folder_of(tmp_path / "out.nc")
    folder.path.mkdir()
    adopt(study_from(data).chunked(2), folder, tmp_path / "out.nc")
    (folder.path / "state.json").write_text(state)
    for options in ([], ["--json"]):
        result = gradhesion("status", tmp_path / "out.nc", *options)
        assert result.exit_code == 0
    assert json.loads(result.stdout)["runs"] == []
    assert "stopped; 0 of 6 blocks (24 scenes) are kept" in gradhesion("status", tmp_path / "out.nc").stdout
