"""The folder of a run: only one with our mark is used, in it only our files are removed, and what it records is checked."""

import json
import os
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from gradhesion.cli.dataset.writer import write, write_shard
from gradhesion.cli.engines.threads import Threads
from gradhesion.cli.errors import OutputError
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.work.parts.folder import claimed, folder_of
from gradhesion.cli.work.parts.manifest import adopt, manifest_of
from gradhesion.cli.work.parts.records import Finished, Manifest, read_record, write_record

Call = Callable[..., Result]

PRECIOUS = ("thesis.part", "000001.part", "study.json", "state.json", "finished.json", "merged.nc", "a.tmp", "lock", "lock-1", "notes.txt")  # fmt: skip
"""Names that a user may give to files, some of which a run gives too."""


@pytest.fixture
def output(tmp_path: Path) -> Path:
    """Where the dataset goes."""
    return tmp_path / "out.nc"


def contents(folder: Path) -> dict[str, bytes]:
    """Read all files of a folder."""
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def kept(data: dict[str, Any], output: Path) -> None:
    """Leave the parts of a study."""
    write_shard(study_from(data).chunked(2), output, (1, 2), engine=Threads(1))


@pytest.mark.parametrize("cells", ["2", "100"])
@pytest.mark.parametrize("name", PRECIOUS)
def test_a_folder_of_the_user_is_refused_and_not_touched(
    name: str, cells: str, gradhesion: Call, study_file: Path, output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GRADHESION_CHUNK", cells)
    folder = folder_of(output).path
    folder.mkdir()
    (folder / name).write_text('{"title": "my thesis"}')
    before = contents(folder)
    for options in ([], ["--fresh"], ["--overwrite"], ["--shard", "1/2"]):
        if cells == "100" and "--shard" in options:
            continue
        result = gradhesion("run", study_file, "-o", output, *options)
        assert result.exit_code == 4
        assert result.stderr == (
            f"{output}.parts: is a folder that gradhesion has not made, so it is left untouched; "
            "move it away, or name another output with -o\n"
        )
        assert contents(folder) == before
    assert f"run would refuse: {output}.parts is a folder" in gradhesion("plan", study_file, "-o", output).stdout
    assert gradhesion("status", output).exit_code == gradhesion("merge", output).exit_code == 2
    assert contents(folder) == before
    assert sorted(os.listdir(output.parent)) == ["out.nc.parts", "study.toml"]


def test_a_link_in_its_place_is_refused(gradhesion: Call, study_file: Path, data: dict[str, Any], output: Path) -> None:
    other = output.with_name("other.nc")
    kept(data, other)
    folder_of(output).path.symlink_to(folder_of(other).path)
    before = contents(folder_of(other).path)
    result = gradhesion("run", study_file, "-o", output)
    assert result.exit_code == 4
    assert result.stderr.startswith(f"{output}.parts: is a link, so it is left untouched")
    assert contents(folder_of(other).path) == before
    folder_of(output).path.unlink()
    folder_of(output).path.write_text("mine")
    assert f"{output}.parts: is a file" in gradhesion("run", study_file, "-o", output).stderr
    assert folder_of(output).path.read_text() == "mine"


def test_in_our_folder_only_our_files_go(
    gradhesion: Call, data: dict[str, Any], study_file: Path, output: Path
) -> None:
    kept(data, output)
    own = {
        name
        for name in PRECIOUS
        if name not in {"000001.part", "study.json", "state.json", "merged.nc", "lock", "finished.json"}
    }
    for name in own:
        (folder_of(output).path / name).write_text("mine")
    assert gradhesion("run", study_file, "-o", output, "--fresh").exit_code == 0
    assert {*os.listdir(folder_of(output).path)} == own


@pytest.mark.parametrize(
    "name", ["merged.nc", "000000.part", "state.json", "study.json", "finished.json", "lock", "lock-1-of-2"]
)
def test_a_link_among_our_files_is_not_followed(name: str, data: dict[str, Any], output: Path) -> None:
    outside = output.with_name("thesis.nc")
    outside.write_text("mine")
    kept(data, output)
    path = folder_of(output).path / name
    path.unlink(missing_ok=True)
    path.symlink_to(outside)
    with pytest.raises(OutputError) if name in {"lock", "study.json"} else nullcontext():
        write(study_from(data).chunked(2), output, history="")
    assert outside.read_text() == "mine"


def test_a_dangling_lock_makes_no_file_elsewhere(data: dict[str, Any], output: Path) -> None:
    kept(data, output)
    lock = folder_of(output).path / "lock"
    lock.unlink()
    lock.symlink_to(output.with_name("elsewhere"))
    with pytest.raises(OutputError, match="cannot be written"):
        write(study_from(data).chunked(2), output, history="")
    assert not output.with_name("elsewhere").exists()


def test_an_empty_folder_and_one_of_a_run_that_was_killed_at_once_are_used(
    gradhesion: Call, study_file: Path, output: Path
) -> None:
    folder = folder_of(output).path
    for names in ([], ["lock"], ["lock", "lock-1-of-2", f"study.json.{'0a' * 8}.tmp"]):
        folder.mkdir()
        for name in names:
            (folder / name).touch()
        assert gradhesion("run", study_file, "-o", output, "--overwrite", "--quiet").exit_code == 0
        assert not folder.exists()


def test_the_mark_is_written_first_and_removed_last(
    data: dict[str, Any], output: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    names: list[str] = []
    replace, unlink = Path.replace, Path.unlink

    def replaced(path: Path, target: Path) -> Path:
        names.append(f"+{target.name}")
        return replace(path, target)

    def unlinked(path: Path, *, missing_ok: bool = False) -> None:
        names.append(f"-{path.name}")
        unlink(path, missing_ok=missing_ok)

    monkeypatch.setattr(Path, "replace", replaced)
    monkeypatch.setattr(Path, "unlink", unlinked)
    write(study_from(data).chunked(2), output, history="")
    assert names[0] == "+study.json"
    last = [name for name in names if name.startswith("-")]
    assert last[-3:] == ["-study.json", "-lock", "-finished.json"]


FINISHED = ['{"file": null}', "{}", "[]", "null", "{", '{"file": [0, 0, 0, 0]}', '{"file": "x", "study": {}, "failed": "no"}', '{"file": null, "study": null}']  # fmt: skip


@pytest.mark.parametrize("content", FINISHED)
def test_what_says_that_a_run_has_finished_is_believed_only_if_it_is_right(
    content: str,
    gradhesion: Call,
    data: dict[str, Any],
    study_file: Path,
    output: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("GRADHESION_CHUNK", "2")
    kept(data, output)
    folder_of(output).finished.write_text(content)
    assert "3 of 6 blocks are missing" in gradhesion("merge", output).stderr
    assert "3 of 6 blocks" in gradhesion("status", output).stdout
    assert "reused 3 blocks, computed 3" in gradhesion("run", study_file, "-o", output).stderr
    assert sorted(os.listdir(output.parent)) == ["out.nc", "study.toml"]


def test_another_study_at_a_finished_output_keeps_its_own_parts(data: dict[str, Any], output: Path) -> None:
    first, second = study_from(data).chunked(2), study_from(data | {"outputs": ["pull_off_force"]}).chunked(2)
    with claimed(output) as folder:
        adopt(first, folder, output)
        folder.part(0).touch()  # so that the folder stays
        output.write_text("dataset")
        identity = output.stat()
        numbers = (identity.st_dev, identity.st_ino, identity.st_size, identity.st_mtime_ns)
        write_record(folder.finished, Finished(numbers, manifest_of(first)))

    class Killed(Threads):
        def results(self, work: Any) -> Any:
            for number, solved in super().results(work):
                if number == 3:
                    raise KeyboardInterrupt
                yield number, solved

    for parts in (3, 3):
        with pytest.raises(KeyboardInterrupt):
            write(second, output, history="", overwrite=True, engine=Killed(1))
        assert len(folder_of(output).parts()) >= parts


def test_a_manifest_is_read_as_it_was_written(data: dict[str, Any], tmp_path: Path) -> None:
    manifest = manifest_of(study_from(data))
    write_record(tmp_path / "study.json", manifest)
    assert read_record(tmp_path / "study.json", Manifest) == manifest
    content = json.loads((tmp_path / "study.json").read_bytes())
    for name, wrong in (("versions", []), ("blocks", "6"), ("blocks", -1), ("blocks", True), ("text", 1), ("chunk", 0), ("parameters", {"k": 1}), ("scenes", 1e9)):  # fmt: skip
        (tmp_path / "study.json").write_text(json.dumps(content | {name: wrong}))
        assert read_record(tmp_path / "study.json", Manifest) is None, name
