"""`gradhesion status` tells what is so: running, stopped or complete."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from gradhesion.cli.work.folder import folder_of
from gradhesion.cli.work.solve.scenes import solve as real_solve

pytestmark = pytest.mark.usefixtures("small_blocks")

Call = Callable[..., Result]


def test_running_stopped_and_complete(
    gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output = tmp_path / "out.nc"
    seen: list[dict[str, Any]] = []
    calls = 0

    def status() -> dict[str, Any]:
        assert str(output) in gradhesion("status", output).stdout
        found: dict[str, Any] = json.loads(gradhesion("status", output, "--json").stdout)
        return found

    def spying(*arguments: Any, **options: Any) -> dict[str, Any]:
        nonlocal calls
        calls += 1
        if calls == 5:
            for path in folder_of(output).glob("*.npz"):
                os.utime(path, (date := (folder_of(output) / "study.json").stat().st_mtime + 100.0, date))
            seen.append(status())
            raise KeyboardInterrupt
        return real_solve(*arguments, **options)

    with monkeypatch.context() as patch:
        patch.setattr("gradhesion.cli.work.solve.scenes.solve", spying)
        assert gradhesion("run", study_file, "-o", output).exit_code == 1
    (running,) = seen
    assert running.items() >= {"state": "running", "blocks": 6, "scenes": 24}.items()
    assert running["kept"] in {3, 4}
    assert running["seconds_left"] == pytest.approx(100.0 / running["kept"] * (6 - running["kept"]))
    assert status().items() >= {"state": "stopped", "seconds_left": None}.items()
    assert gradhesion("run", study_file, "-o", output, "--quiet").exit_code == 0
    assert status()["state"] == "complete"
    for content in (output.read_bytes()[:-1000], b"", b"title = 1"):
        output.write_bytes(content)
        assert gradhesion("status", output).exit_code == 2
    output.unlink()
    assert gradhesion("status", output).exit_code == 2


@pytest.mark.parametrize("content", ["{", "[]", "null", "{}"])
def test_a_damaged_mark_is_no_error(content: str, gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/2").exit_code == 0
    (folder_of(output) / "study.json").write_text(content)
    assert gradhesion("status", output).exit_code == 2
    assert gradhesion("run", study_file, "-o", output).exit_code == 4, "nobody knows whose blocks these are"
    assert gradhesion("run", study_file, "-o", output, "--fresh").exit_code == 0
