"""A run that goes on gives what one in a single go would have given, whatever has ended it; what is not ours is left."""

import errno
import os
import shutil
from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import netCDF4
import pytest
from click.testing import Result

from gradhesion.cli.work.folder import Parts, claimed, folder_of
from gradhesion.cli.work.solve.scenes import solve as real_solve
from tests.cli.conftest import Call, Patch, Told
from tests.faults.trials import values_of

pytestmark = pytest.mark.usefixtures("small_blocks")

SOLVE = "gradhesion.cli.work.solve.scenes.solve"
BLOCKS = 6
Begun = Callable[..., int]
Values = dict[str, bytes]
CHANGES = ["parameters.nu=0.3", "parameters.k=[0.1, 0.31]", "method.check_contact=false", "SOURCES", "FORMAT"]
DAMAGES: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda _: b"",
    "cut short": lambda content: content[:-1],
    "one bit of a value": lambda content: content[:1000] + bytes([content[1000] ^ 1]) + content[1001:],
    "something else": lambda _: b"precious" * 100,
}


@pytest.fixture
def begun(run: Call, output: Path, monkeypatch: Patch) -> Begun:
    """Interrupt a run after some blocks; tells how many are kept."""

    def begin(number: int, *options: str) -> int:
        calls, interrupted = count(), Mock(side_effect=KeyboardInterrupt)
        with monkeypatch.context() as patch:
            patch.setattr(SOLVE, lambda *a, **b: real_solve(*a, **b) if next(calls) < number else interrupted())
            assert run(*options).exit_code == 130
        kept = len(list(output.parent.glob("out.nc.parts/*.npz")))
        assert kept in {number - 1, number}, "the last one may have been on its way to the disk"
        return kept

    return begin


@pytest.fixture
def resumed(run: Call, output: Path, whole: Values) -> Call:
    """Give the same command again, to its end."""

    def resume(kept: int, *options: str) -> Result:
        result = run(*options, code=0)
        assert ("reused" in result.stderr) == (kept > 0)
        assert not kept or f"reused {kept} block{'s' * (kept > 1)}, computed {BLOCKS - kept}" in result.stderr
        assert values_of(output) == whole
        assert os.listdir(output.parent) == ["out.nc"]
        return result

    return resume


def test_an_old_output_stays_until_the_new_one_is_whole_and_another_title_goes_on(
    run: Call, begun: Begun, resumed: Call, study_file: Path, output: Path
) -> None:
    output.parent.mkdir()
    output.write_text("precious")
    kept = begun(3, "--overwrite")
    assert run().exit_code == 4, "it exists"
    assert output.read_text() == "precious"
    study_file.write_text("# another way to write it\n" + study_file.read_text())
    resumed(kept, "--overwrite", "--set=title='Another'")
    with netCDF4.Dataset(output) as file:
        assert file.title == "Another"


@pytest.mark.parametrize("change", CHANGES)
def test_blocks_of_another_study_or_version_are_refused_and_kept_until_they_are_dropped(
    run: Call, change: str, begun: Begun, output: Path, monkeypatch: Patch
) -> None:
    kept = begun(4)
    command = ["--set", change] if "=" in change else []
    if not command:
        monkeypatch.setattr(f"gradhesion.cli.work.folder.{change}", "another")
    assert "--fresh" in run(*command, code=4).stderr
    assert len(list(output.parent.glob("out.nc.parts/*.npz"))) == kept
    assert "reused" not in run(*command, "--fresh").stderr
    assert os.listdir(output.parent) == ["out.nc"]


@pytest.mark.parametrize("damage", [*DAMAGES, "another block"])
def test_a_damaged_block_is_computed_again(damage: str, begun: Begun, resumed: Call, output: Path) -> None:
    kept = begun(5)
    first, part, *_ = sorted(folder_of(output).glob("*.npz"))
    part.write_bytes(DAMAGES[damage](part.read_bytes()) if damage in DAMAGES else first.read_bytes())
    resumed(kept - 1)


def test_one_block_is_not_kept(run: Call, output: Path, monkeypatch: Patch) -> None:
    """And a second run is refused."""
    output.parent.mkdir()
    with claimed(output):
        assert run().exit_code == 4
    assert os.listdir(output.parent) == []
    monkeypatch.setenv("GRADHESION_CHUNK", "100")
    monkeypatch.setattr(Parts, "write", lambda *_: pytest.fail("there is none"))
    assert run().exit_code == 0


def test_files_of_users_are_left(run: Call, begun: Begun, gradhesion: Call, output: Path) -> None:
    """A folder that no run has made is refused; what is put beside blocks stays."""
    folder = folder_of(output)
    folder.mkdir(parents=True)
    (folder / "thesis.npz").write_text("mine")
    for options in ([], ["--fresh"], ["--overwrite"], ["--shard", "1/2"]):
        assert run(*options).exit_code == 4
    assert gradhesion("status", output).exit_code == gradhesion("merge", output).exit_code == 2
    assert [path.name for path in folder.iterdir()] == ["thesis.npz"]
    (folder / "thesis.npz").unlink()
    begun(3)
    (folder / "notes.txt").write_text("mine")
    assert run().exit_code == 0
    assert os.listdir(folder) == ["notes.txt"]


@pytest.mark.parametrize(("cells", "event"), [("2", "gone"), ("2", "appears"), ("100", "appears")])
def test_what_happens_to_the_folder_during_a_run_loses_nothing(
    cells: str, event: str, refusal: Told, study_file: Path, output: Path, whole: Values, monkeypatch: Patch
) -> None:
    """The folder of its blocks may be removed; a file may appear in the place of the output."""

    def happening(*arguments: Any, **options: Any) -> dict[str, Any]:
        monkeypatch.setattr(SOLVE, real_solve)
        if event == "appears":
            output.write_text("precious")
        else:
            shutil.rmtree(folder_of(output))
        return real_solve(*arguments, **options)

    monkeypatch.setenv("GRADHESION_CHUNK", cells)
    monkeypatch.setattr(SOLVE, happening)
    told = refusal("run", study_file, "-o", output, "--quiet", code=4)
    assert told.startswith(f"{output}: ")
    if event == "appears":
        assert str(output.with_name("out-2.nc")) in told
        assert output.read_text() == "precious"
        assert values_of(output.with_name("out-2.nc")) == whole


def failing(really: Callable[..., Any], number: int, code: int) -> Callable[..., Any]:
    """Have the n-th call fail with an error of the system."""
    calls = count(1)

    def call(*arguments: Any, **options: Any) -> Any:
        if next(calls) == number:
            raise OSError(code, os.strerror(code))
        return really(*arguments, **options)

    return call


@pytest.mark.parametrize("code", [errno.EROFS, errno.ENOSPC])
@pytest.mark.parametrize("name", ["replace", "hardlink_to", "mkdir"])
def test_a_change_of_a_name_that_fails_loses_nothing(
    run: Call, name: str, code: int, whole: Values, output: Path
) -> None:
    """Whichever it is, the run ends in a sentence or goes on without, and the same command makes the dataset."""
    ended = []
    for number in range(1, 40):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Path, name, failing(getattr(Path, name), number, code))
            result = run("--quiet")
        ended.append(result.exit_code)
        if result.exit_code:
            assert result.exit_code == 4
            assert result.stderr.count("\n") == 1
            assert os.strerror(code) in result.stderr
            assert not output.exists()
        again = run("--quiet", *(["--overwrite"] if output.exists() else []))
        assert again.exit_code == 0, again.stderr
        assert values_of(output) == whole
        assert os.listdir(output.parent) == ["out.nc"]
        output.unlink()
        if ended[-3:] == [0, 0, 0]:
            break
    assert name == "hardlink_to" or 4 in ended


def test_a_run_killed_before_it_tidied_up_is_complete(
    run: Call, output: Path, whole: Values, monkeypatch: Patch
) -> None:
    with monkeypatch.context() as patch:
        for module in ("work.folder", "dataset.writer"):
            patch.setattr(f"gradhesion.cli.{module}.clear", lambda *_: None)
        assert run().exit_code == 0
    assert folder_of(output).exists()
    monkeypatch.setattr(SOLVE, lambda *_, **__: pytest.fail("nothing is left to do"))
    assert "complete already" in run(code=0).stderr
    assert os.listdir(output.parent) == ["out.nc"]
    assert values_of(output) == whole
