"""Network file systems, simulated: files that are seen late, and changes of names that fail, are refused or are asked for twice."""

import errno
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from gradhesion.cli.engines import worker
from gradhesion.cli.work.parts.folder import folder_of
from tests.cli.engines.orders import values_of

Call = Callable[..., Result]


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


@pytest.fixture
def whole(gradhesion: Call, study_file: Path, tmp_path: Path) -> dict[str, bytes]:
    """What a run on a disk gives."""
    path = tmp_path / "whole.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return values_of(path)


def failing(really: Callable[..., Any], number: int, code: int) -> Callable[..., Any]:
    """Have the n-th call fail with an error of the system."""
    calls = []

    def call(*arguments: Any, **options: Any) -> Any:
        calls.append(None)
        if len(calls) == number:
            raise OSError(code, os.strerror(code))
        return really(*arguments, **options)

    return call


@pytest.mark.parametrize("code", [errno.EIO, errno.ESTALE, errno.EBUSY, errno.EDQUOT])
@pytest.mark.parametrize("name", ["replace", "hardlink_to", "mkdir"])
def test_a_change_of_a_name_that_fails(
    name: str, code: int, gradhesion: Call, study_file: Path, whole: dict[str, bytes], tmp_path: Path
) -> None:
    """Whichever it is, the run ends in a sentence or goes on without, and the same command makes the dataset."""
    folder, ended = tmp_path / "data", []
    folder.mkdir()
    output = folder / "out.nc"
    for number in range(1, 40):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Path, name, failing(getattr(Path, name), number, code))
            result = gradhesion("run", study_file, "-o", output, "--quiet")
        ended.append(result.exit_code)
        assert result.exit_code in (0, 3, 4), result.stderr
        if result.exit_code == 4:
            assert result.stderr.count("\n") == 1
            assert os.strerror(code) in result.stderr
            assert not output.exists()
        again = gradhesion("run", study_file, "-o", output, "--quiet", *(["--overwrite"] if output.exists() else []))
        assert again.exit_code == 0, again.stderr
        assert values_of(output) == whole
        assert os.listdir(folder) == ["out.nc"]
        output.unlink()
        if number > 3 and ended[-3:] == [0, 0, 0]:
            break
    assert name == "hardlink_to" or 4 in ended


@pytest.mark.parametrize("code", [errno.EBUSY, errno.ESTALE])
def test_files_that_cannot_be_removed(
    code: int, gradhesion: Call, study_file: Path, whole: dict[str, bytes], tmp_path: Path
) -> None:
    """What is left of a run that has written its dataset does no harm, and goes with the next one."""
    output = tmp_path / "out.nc"

    def refuse(*_arguments: Any, **_options: Any) -> None:
        raise OSError(code, os.strerror(code))

    with pytest.MonkeyPatch.context() as patch:
        for name in ("unlink", "rmdir"):
            patch.setattr(Path, name, refuse)
        result = gradhesion("run", study_file, "-o", output, "--quiet")
        assert result.exit_code in (0, 4), result.stderr
    assert gradhesion("run", study_file, "-o", output, "--overwrite").exit_code == 0
    assert values_of(output) == whole
    assert not folder_of(output).path.exists()


def test_a_lock_that_is_removed_and_still_open_is_not_somebody_elses(
    gradhesion: Call, study_file: Path, whole: dict[str, bytes], tmp_path: Path
) -> None:
    output = tmp_path / "out.nc"
    folder = folder_of(output).path
    folder.mkdir()
    (folder / ".nfs00000000032a51d800000001").touch()
    assert gradhesion("run", study_file, "-o", output, "--quiet").exit_code == 0
    assert values_of(output) == whole


def test_parts_that_are_seen_late(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A file of another machine is looked for until it is seen, and no longer than that may take."""
    looks = iter(["not computed yet", "damaged", {"status": 0}])
    monkeypatch.setattr(worker, "SIGHT", 1.0)
    assert worker.seen(lambda: next(looks), tmp_path) == {"status": 0}
    monkeypatch.setattr(worker, "SIGHT", 0.1)
    assert worker.seen(lambda: "not computed yet", tmp_path / "none") == "not computed yet"
