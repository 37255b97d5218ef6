"""Files that appear whole or not at all, whatever comes in between."""

import os
import stat
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from gradhesion.cli import disk
from gradhesion.cli.disk import replacement
from gradhesion.cli.errors import OutputError


def is_of_interest(frame: FrameType) -> bool:
    """Tell where an interrupt is tried: at every line of ours, and of the making of a file."""
    return frame.f_code.co_filename == disk.__file__ or frame.f_code is Path.touch.__code__


@contextmanager
def interrupted_at(step: int) -> Iterator[Callable[[], int]]:
    """Raise KeyboardInterrupt at one line; gives the number of lines that were run by then."""
    count = 0

    def lines(_frame: FrameType, event: str, _: Any) -> Any:
        nonlocal count
        if event == "line":
            count += 1
            if count > step:
                raise KeyboardInterrupt
        return lines

    before = sys.gettrace()
    sys.settrace(lambda frame, *_: lines if is_of_interest(frame) else None)
    try:
        yield lambda: count
    finally:
        sys.settrace(before)


def without_links(_self: Path, _target: Path) -> None:
    """Refuse a link, as FAT does."""
    raise PermissionError(1, "Operation not permitted")


@pytest.mark.parametrize("there", [True, False])
def test_an_interrupt_at_any_line_leaves_what_was_there_or_the_new_file_and_nothing_else(
    there: bool, tmp_path: Path
) -> None:
    target = tmp_path / "out.nc"
    found = []
    for step in range(1000):
        target.unlink(missing_ok=True)
        if there:
            target.write_text("old")
        try:
            with interrupted_at(step) as lines, replacement(target, overwrite=there) as temporary:
                temporary.write_text("new")
        except KeyboardInterrupt:
            pass
        found.append({path.name: path.read_text() for path in tmp_path.iterdir()})
        if lines() <= step:
            break
    assert step > 20
    before = {"out.nc": "old"} if there else {}
    changed = found.index({"out.nc": "new"})
    assert found == changed * [before] + (len(found) - changed) * [{"out.nc": "new"}]
    assert changed > 0


def test_a_new_file_has_the_rights_that_the_user_gives_to_files(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        with replacement(tmp_path / "out.nc", overwrite=False) as temporary:
            assert temporary.parent == tmp_path
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "out.nc").stat().st_mode) == 0o640


def test_a_failure_leaves_nothing_behind(tmp_path: Path) -> None:
    with pytest.raises(MemoryError), replacement(tmp_path / "new" / "out.nc", overwrite=False):
        raise MemoryError
    assert os.listdir(tmp_path / "new") == []
    (tmp_path / "out.nc").touch()
    with pytest.raises(OutputError, match="exists already"), replacement(tmp_path / "out.nc", overwrite=False):
        pytest.fail("the body does not run")


def make(target: Path, meanwhile: Callable[[], object], *, overwrite: bool) -> None:
    """Make a file; something else happens before it is complete."""
    with replacement(target, overwrite=overwrite) as temporary:
        temporary.write_text("new")
        meanwhile()


@pytest.mark.parametrize("links", [True, False])
def test_a_file_that_appears_meanwhile_stays_and_the_new_one_is_kept_beside_it(
    links: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not links:
        monkeypatch.setattr(Path, "hardlink_to", without_links)
    target = tmp_path / "out.nc"
    for name in ("out-2.nc", "out-3.nc"):
        with pytest.raises(OutputError, match=f"kept as {tmp_path / name}"):
            make(target, lambda: target.write_text("precious"), overwrite=False)
        assert target.read_text() == "precious"
        assert (tmp_path / name).read_text() == "new"
        target.unlink()
    assert sorted(os.listdir(tmp_path)) == ["out-2.nc", "out-3.nc"]
    with replacement(target, overwrite=False) as temporary:
        temporary.write_text("new")
    assert target.read_text() == "new"
    with replacement(target, overwrite=True) as temporary:
        temporary.write_text("newer")
    assert target.read_text() == "newer"
    target.unlink()
    with pytest.raises(OutputError, match=r"kept as .*out-4\.nc"):
        make(target, target.mkdir, overwrite=True)


def test_a_failure_to_rename_takes_no_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(_self: Path, _target: Path) -> None:
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(Path, "hardlink_to", without_links)
    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(OutputError, match="Input/output error"), replacement(tmp_path / "out.nc", overwrite=False):
        pass
    assert os.listdir(tmp_path) == []
