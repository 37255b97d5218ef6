"""A part is trusted only if all of it is right; a run that goes on gives what one in a single go would have given."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from click.testing import Result

from gradhesion.cli.disk import writing
from gradhesion.cli.errors import OutputError
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.work.parts.folder import claimed, folder_of
from gradhesion.cli.work.parts.parts import PartError, key_of, read_part, write_part
from gradhesion.cli.work.parts.resume import blank
from gradhesion.cli.work.solve.scenes import solve as real_solve

Call = Callable[..., Result]


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


class Power:
    """Lets some blocks be solved, and interrupts or breaks the next."""

    def __init__(self, blocks: int, error: type[BaseException] = KeyboardInterrupt) -> None:
        self.left, self.calls, self.error = blocks, 0, error

    def solve(self, *arguments: Any, **options: Any) -> dict[str, Any]:
        self.calls += 1
        if self.left <= 0:
            raise self.error
        self.left -= 1
        return real_solve(*arguments, **options)


def values_of(path: Path) -> dict[str, bytes]:
    """Read all bytes of all variables."""
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        return {name: np.asarray(variable[...]).tobytes() for name, variable in file.variables.items()}


def attributes_of(path: Path) -> dict[str, Any]:
    """Read the global attributes but the history, which tells when the file was written."""
    with netCDF4.Dataset(path) as file:
        return {name: file.getncattr(name) for name in file.ncattrs() if name != "history"}


@pytest.fixture
def output(tmp_path: Path) -> Path:
    """Where the dataset goes."""
    return tmp_path / "data" / "out.nc"


@pytest.fixture
def begun(gradhesion: Call, study_file: Path, output: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., int]:
    """Interrupt a run after some blocks; tells the parts that are kept."""

    def begin(number: int, *options: str) -> int:
        with monkeypatch.context() as patch:
            patch.setattr("gradhesion.cli.work.solve.given.solve", Power(number).solve)
            assert gradhesion("run", study_file, "-o", output, *options).exit_code == 1, "click's, without main()"
        return len(list(output.parent.glob("out.nc.parts/*.part")))

    return begin


@pytest.fixture
def whole(gradhesion: Call, study_file: Path, tmp_path: Path) -> Path:
    """The dataset in a single go."""
    path = tmp_path / "whole.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return path


def test_the_study_has_six_blocks(data: dict[str, Any]) -> None:
    study = study_from(data).chunked(2)
    assert len(study.tiling) == len(list(study.tiling)) == 6


@pytest.mark.parametrize("number", range(1, 6))
def test_a_run_goes_on_where_it_was_interrupted(
    number: int, begun: Callable[..., int], whole: Path, gradhesion: Call, study_file: Path, output: Path
) -> None:
    kept = begun(number)
    assert kept in {number - 1, number}, "the last one may have been on its way to the disk"
    assert os.listdir(output.parent) == (["out.nc.parts"] if kept else [])
    result = gradhesion("run", study_file, "-o", output)
    assert result.exit_code == 0
    if kept:
        assert result.stderr.endswith(f"; reused {counted(kept, 'block')}, computed {6 - kept}\n")
    assert values_of(output) == values_of(whole)
    assert attributes_of(output) == attributes_of(whole)
    assert os.listdir(output.parent) == ["out.nc"]


def test_an_old_output_stays_until_the_new_one_is_whole(
    begun: Callable[..., int], whole: Path, gradhesion: Call, study_file: Path, output: Path
) -> None:
    output.parent.mkdir()
    output.write_text("precious")
    assert begun(3, "--overwrite") >= 2
    assert output.read_text() == "precious"
    assert gradhesion("run", study_file, "-o", output).exit_code == 4, "it exists"
    assert len(list(output.parent.glob("out.nc.parts/*.part"))) >= 2, "and the parts wait for --overwrite"
    assert gradhesion("run", study_file, "-o", output, "--overwrite").exit_code == 0
    assert values_of(output) == values_of(whole)


def test_a_changed_study_is_refused_with_the_difference(
    begun: Callable[..., int], gradhesion: Call, study_file: Path, output: Path
) -> None:
    kept = begun(4)
    changed = ["--set=parameters.nu=0.3", "--set=parameters.k=[0.1, 0.31]", "--set=method.solver='envelope'"]
    result = gradhesion("run", study_file, "-o", output, *changed)
    assert result.exit_code == 4
    sentence = (
        f"{output}: {kept} finished parts of another study or version in {output}.parts: "
        'method.solver is "exact" there and "envelope" here; '
        "parameters.k is 2 values from 0.0 to 0.31 there and 2 values from 0.1 to 0.31 here; "
        "parameters.nu is 0.27 there and 0.3 here; add --fresh to discard them, or name another output with -o\n"
    )
    assert result.stderr.endswith(sentence)
    assert len(list(output.parent.glob("out.nc.parts/*.part"))) == kept
    assert gradhesion("run", study_file, "-o", output, *changed, "--fresh").exit_code == 0
    with netCDF4.Dataset(output) as file:
        assert float(file["nu"][...]) == 0.3


def test_another_title_goes_on(begun: Callable[..., int], gradhesion: Call, study_file: Path, output: Path) -> None:
    kept = begun(4)
    result = gradhesion("run", study_file, "-o", output, "--set=title='Another'")
    assert f"reused {counted(kept, 'block')}" in result.stderr
    assert attributes_of(output)["title"] == "Another"


@pytest.mark.parametrize("change", [{"SOURCES": "0" * 64}, {"FORMAT": 0}])
def test_parts_of_another_version_are_refused(
    change: dict[str, Any],
    begun: Callable[..., int],
    gradhesion: Call,
    study_file: Path,
    output: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    begun(4)
    for name, value in change.items():
        monkeypatch.setattr(f"gradhesion.cli.work.parts.parts.{name}", value)
    result = gradhesion("run", study_file, "-o", output)
    assert result.exit_code == 4
    assert "the sources of the solver have changed" in result.stderr or "format version is 1 there" in result.stderr


def damages() -> dict[str, Callable[[bytes], bytes]]:
    """Ways to damage a part."""
    return {
        "empty": lambda _: b"",
        "cut short": lambda content: content[:-1],
        "longer": lambda content: content + b"\0",
        "one bit of a value": lambda content: content[:-20] + bytes([content[-20] ^ 1]) + content[-19:],
        "one bit of the key": lambda content: content[:80] + bytes([content[80] ^ 1]) + content[81:],
        "one bit of the sum": lambda content: bytes([content[0] ^ 1]) + content[1:],
        "not a part": lambda _: b"precious" * 100,
        "not text": lambda content: b"\xff" * 64 + content[64:],
    }


@pytest.mark.parametrize("damage", damages())
def test_a_damaged_part_is_computed_again(
    damage: str, begun: Callable[..., int], whole: Path, gradhesion: Call, study_file: Path, output: Path
) -> None:
    kept = begun(5)
    part = folder_of(output).part(1)
    part.write_bytes(damages()[damage](part.read_bytes()))
    result = gradhesion("run", study_file, "-o", output)
    assert f"reused {counted(kept - 1, 'block')}, computed {7 - kept}" in result.stderr
    assert values_of(output) == values_of(whole)


def test_a_part_in_the_place_of_another_is_computed_again(
    begun: Callable[..., int], whole: Path, gradhesion: Call, study_file: Path, output: Path
) -> None:
    begun(5)
    folder = folder_of(output)
    folder.part(0).write_bytes(folder.part(1).read_bytes())
    assert gradhesion("run", study_file, "-o", output).exit_code == 0
    assert values_of(output) == values_of(whole)


def test_a_part_gives_back_every_bit(data: dict[str, Any], tmp_path: Path) -> None:
    study = study_from(data)
    block = study.tiling[0]
    values = blank(study, block)
    values["pull_off_force"].view("u8").flat[:2] = [0x7FF8_0000_0000_0123, 0x8000_0000_0000_0000]  # a NaN, and -0
    write_part(tmp_path / "part", key_of(study, block), values, study)
    found = read_part(tmp_path / "part", key_of(study, block), study, block)
    assert list(found) == [*study.outputs, "steep_contact", "status"]
    assert all(found[name].tobytes() == values[name].tobytes() for name in values)
    assert all(found[name].dtype == values[name].dtype for name in values)


def test_the_key_has_all_that_values_depend_on(data: dict[str, Any], tmp_path: Path) -> None:
    def keys(study: Study) -> list[str]:
        return [key_of(study, block) for block in study.chunked(2).tiling]

    study = study_from(data).chunked(2)
    own = keys(study)
    assert len({*own}) == 6
    assert keys(study_from(data | {"title": "Another"})) == own
    others = [
        data | {"outputs": data["outputs"][::2]},
        data | {"method": {"solver": "asymptotic"}},
        data | {"method": {"check_contact": False}},
        data | {"method": {"solver": ["exact", "envelope"]}},
        data | {"parameters": data["parameters"] | {"modulus": np.nextafter(430.0, 1e3)}},
    ]
    for other in others:
        assert not {*keys(study_from(other))} & {*own}
    both = keys(study_from(others[3]))
    assert len({*both}) == len(both) == 12
    write_part(tmp_path / "part", own[0], blank(study, study.tiling[0]), study)
    with pytest.raises(PartError, match="of other scenes"):
        read_part(tmp_path / "part", own[1], study, study.tiling[0])


def test_one_block_needs_no_part(
    gradhesion: Call, study_file: Path, output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GRADHESION_CHUNK", "100")
    monkeypatch.setattr("gradhesion.cli.engines.threads.write_part", lambda *_: pytest.fail("there is none"))
    assert gradhesion("run", study_file, "-o", output).exit_code == 0


def test_a_second_run_is_refused(gradhesion: Call, study_file: Path, output: Path) -> None:
    output.parent.mkdir()
    with claimed(output):
        result = gradhesion("run", study_file, "-o", output)
    assert result.exit_code == 4
    assert f"{output}: another run is writing it" in result.stderr
    assert os.listdir(output.parent) == []


def test_a_folder_that_is_removed_under_way_is_told(
    gradhesion: Call, study_file: Path, output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def removing(*arguments: Any, **options: Any) -> dict[str, Any]:
        for path in folder_of(output).path.glob("*"):
            path.unlink()
        folder_of(output).path.rmdir()
        monkeypatch.setattr("gradhesion.cli.work.solve.given.solve", real_solve)
        return real_solve(*arguments, **options)

    monkeypatch.setattr("gradhesion.cli.work.solve.given.solve", removing)
    result = gradhesion("run", study_file, "-o", output, "--quiet")
    assert result.exit_code == 4
    assert result.stderr.startswith(f"{output}: cannot be written (No such file or directory)")
    assert len(result.stderr.splitlines()) == 1


def test_a_disk_that_fills_up_keeps_what_is_done(
    gradhesion: Call, study_file: Path, output: Path, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    left = iter([True] * 3)

    def until_full(*arguments: Any) -> None:
        if not next(left, False):
            raise OSError(28, "No space left on device")
        write_part(*arguments)

    with monkeypatch.context() as patch:
        patch.setattr("gradhesion.cli.engines.threads.write_part", until_full)
        result = gradhesion("run", study_file, "-o", output)
    assert result.exit_code == 4
    assert "No space left on device" in result.stderr
    result = gradhesion("run", study_file, "-o", output)
    assert "reused 3 blocks, computed 3" in result.stderr
    assert values_of(output) == values_of(whole)


def test_a_block_that_raises_once_is_tried_again(
    gradhesion: Call, study_file: Path, output: Path, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = iter([MemoryError])

    def once(*arguments: Any, **options: Any) -> dict[str, Any]:
        for error in calls:
            raise error
        return real_solve(*arguments, **options)

    monkeypatch.setattr("gradhesion.cli.work.solve.given.solve", once)
    assert gradhesion("run", study_file, "-o", output).exit_code == 0
    assert values_of(output) == values_of(whole)


def test_a_block_that_always_raises_has_no_value_and_its_neighbours_stay(
    gradhesion: Call, study_file: Path, output: Path, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    power = Power(4, MemoryError)
    with monkeypatch.context() as patch:
        patch.setattr("gradhesion.cli.work.solve.given.solve", power.solve)
        result = gradhesion("run", study_file, "-o", output, "--quiet")
    assert result.exit_code == 3
    assert power.calls == 4 + 2 * 2
    assert f"{output}: block 5 of 6 (4 scenes, index k 1, lambda_over_R 1) raised MemoryError\n" in result.stderr
    assert "2 blocks could not be solved" in result.stderr
    with netCDF4.Dataset(output) as file:
        assert int(np.sum(file["status"][...] == 64)) == 8
        assert int(np.sum(np.isnan(np.ma.filled(file["pull_off_force"][...], np.nan)))) == 8
    again = gradhesion("run", study_file, "-o", output, "--overwrite")
    assert again.exit_code == 0
    assert "reused 4 blocks, computed 2" in again.stderr
    assert values_of(output) == values_of(whole)
    assert os.listdir(output.parent) == ["out.nc"]


def test_if_no_block_can_be_solved_nothing_is_written(
    gradhesion: Call, study_file: Path, output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gradhesion.cli.work.solve.given.solve", Power(0, MemoryError).solve)
    result = gradhesion("run", study_file, "-o", output)
    assert result.exit_code == 3
    assert "raised MemoryError; nothing is written" in result.stderr
    assert os.listdir(output.parent) == []


def test_fail_fast_ends_at_the_first_failed_scene(gradhesion: Call, study_file: Path, output: Path) -> None:
    fails = "--set=parameters.modulus=1e300"
    result = gradhesion("run", study_file, "-o", output, fails, "--set=parameters.c0_over_R=1e-300", "--fail-fast")
    assert result.exit_code == 3
    assert "block 1 of 6 has 2 failed scenes; nothing is written" in result.stderr
    assert not output.exists()


def test_a_run_killed_after_the_last_rename_is_complete(
    gradhesion: Call, study_file: Path, output: Path, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr("gradhesion.cli.work.parts.folder._remove", lambda *_: None)
        patch.setattr("gradhesion.cli.work.parts.folder._give_up", lambda _, lock: os.close(lock))
        assert gradhesion("run", study_file, "-o", output).exit_code == 0
    assert json.loads(folder_of(output).finished.read_bytes())["failed"] == 0
    monkeypatch.setattr("gradhesion.cli.work.solve.given.solve", Power(0).solve)
    result = gradhesion("run", study_file, "-o", output)
    assert result.exit_code == 0
    assert result.stderr.endswith("were complete already\n")
    assert os.listdir(output.parent) == ["out.nc"]
    assert values_of(output) == values_of(whole)


@pytest.mark.parametrize("cells", ["2", "100"])
def test_a_file_that_appears_at_the_output_during_a_run_stays_and_the_dataset_is_kept_beside_it(
    cells: str, gradhesion: Call, study_file: Path, output: Path, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def beside(*arguments: Any, **options: Any) -> dict[str, Any]:
        output.write_text("precious")
        return real_solve(*arguments, **options)

    monkeypatch.setenv("GRADHESION_CHUNK", cells)
    with monkeypatch.context() as patch:
        patch.setattr("gradhesion.cli.work.solve.given.solve", beside)
        result = gradhesion("run", study_file, "-o", output, "--quiet")
    assert result.exit_code == 4
    assert result.stderr == (
        f"{output}: appeared during the run and is untouched; the new file is complete and kept as "
        f"{output.with_name('out-2.nc')}; move it where it belongs\n"
    )
    assert output.read_text() == "precious"
    assert values_of(output.with_name("out-2.nc")) == values_of(whole)
    assert sorted(os.listdir(output.parent)) == ["out-2.nc", "out.nc"]


def test_a_failure_to_write_is_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written"), writing(tmp_path / "x.nc"):
        raise OSError(30, "Read-only file system")
