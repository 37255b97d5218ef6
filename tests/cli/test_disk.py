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


def test_an_interrupt_at_any_line_leaves_the_old_file_or_the_new_one_and_nothing_else(tmp_path: Path) -> None:
    target = tmp_path / "out.nc"
    found = []
    for step in range(1000):
        target.write_text("old")
        try:
            with interrupted_at(step) as lines, replacement(target, overwrite=True) as temporary:
                temporary.write_text("new")
        except KeyboardInterrupt:
            pass
        found.append(target.read_text())
        assert os.listdir(tmp_path) == ["out.nc"], f"after {step} lines"
        if lines() <= step:
            break
    else:
        pytest.fail("it never ends")
    assert step > 20
    assert found == sorted(found, reverse=True), "old first, then new"
    assert {*found} == {"old", "new"}


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
