"""A lock is held by one handle at a time, dies with its process, and follows the name of its file."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gradhesion.cli import locks
from gradhesion.cli.locks import is_locked, try_lock


def test_one_handle_holds_it_at_a_time(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    assert not is_locked(path)
    assert not path.exists(), "a look makes no file"
    first = try_lock(path)
    assert first is not None
    assert try_lock(path) is None
    assert is_locked(path)
    os.close(first)
    assert not is_locked(path)
    second = try_lock(path)
    assert second is not None
    os.close(second)


def test_it_dies_with_its_process(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    code = f"""
import time
from pathlib import Path
from gradhesion.cli.locks import try_lock
handle = try_lock(Path({str(path)!r}))
print("held" if handle is not None else "not held", flush=True)
time.sleep(600)
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "held\n"
        assert is_locked(path)
        process.kill()
        process.wait(60)
    assert path.exists()
    assert not is_locked(path)


def test_a_lock_of_a_removed_file_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its holder removes the file between opening and locking: the next one is taken, on a file with the name."""
    path = tmp_path / "lock"
    removals = [path]

    def lock_descriptor(_handle: int, *, blocking: bool) -> bool:
        assert not blocking
        for removed in removals:
            removed.unlink()
        removals.clear()
        return True

    monkeypatch.setattr(locks, "lock_descriptor", lock_descriptor)
    handle = try_lock(path)
    assert handle is not None
    assert os.path.samestat(os.fstat(handle), path.stat())
    os.close(handle)


def test_without_locks_work_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def lock_descriptor(_handle: int, *, blocking: bool) -> bool:
        raise OSError(38, f"no locks, {blocking=}")

    monkeypatch.setattr(locks, "lock_descriptor", lock_descriptor)
    handles = [try_lock(tmp_path / "lock"), try_lock(tmp_path / "lock")]
    assert None not in handles
    assert not is_locked(tmp_path / "lock")
    for handle in handles:
        os.close(handle or -1)


def test_no_folder_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        try_lock(tmp_path / "none" / "lock")
