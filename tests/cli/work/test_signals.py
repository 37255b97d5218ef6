"""Interrupts at any moment, and files that appear whole or not at all: the old output stays, nothing but finished parts is left."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType
from typing import Any
from unittest.mock import Mock

import pytest
from filelock import FileLock

from gradhesion.cli import disk
from gradhesion.cli.dataset.writer import write
from gradhesion.cli.disk import replacement
from gradhesion.cli.errors import OutputError
from gradhesion.cli.study.reading import load_study
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import interrupts
from gradhesion.cli.work.folder import folder_of, parts_in
from gradhesion.cli.work.solve.blocks import solve_block
from gradhesion.cli.work.solve.scenes import Arrays
from tests.cli.conftest import Patch

HUGE = """\
outputs = ["pull_off_force", "dissipated_energy"]
[parameters]
k = { start = 0.0, stop = 0.95, num = 200 }
nu = 0.27
modulus = { start = 100.0, stop = 1e4, num = 10 }
c0_over_R = { start = 0.01, stop = 1.0, num = 50, spacing = "log" }
lambda_over_R = { start = 0.05, stop = 1.0, num = 100, spacing = "log" }
A = { start = 0.01, stop = 0.2, num = 10 }
a_max_over_R = inf
"""


@pytest.mark.parametrize(
    ("number", "delay", "times"), [(signal.SIGINT, 0.3, 1), (signal.SIGTERM, 0.0, 1), (signal.SIGINT, 0.0, 20)]
)
def test_interrupts_leave_nothing_behind(number: signal.Signals, delay: float, times: int, tmp_path: Path) -> None:
    """Once there are blocks; those that follow the first do not disturb the tidying up."""
    folder, study = tmp_path / "data", tmp_path / "huge.toml"
    folder.mkdir()
    old = folder / "huge.nc"
    old.write_text("precious")
    study.write_text(HUGE)
    command = [sys.executable, "-m", "gradhesion.cli", "run", study, "-o", old, "--overwrite"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 120
        while len(os.listdir(folder)) < 2 and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(delay)
        for _ in range(times):
            process.send_signal(number)
        stdout, stderr = process.communicate(timeout=60)
    assert process.returncode == 130, stderr
    assert stdout == ""
    assert "Traceback" not in stderr
    assert old.read_text() == "precious"
    assert times > 1 or stderr.splitlines()[-1].startswith("interrupted; ")
    if (folder / "huge.nc.parts").exists():
        assert times > 1 or list(folder.glob("huge.nc.parts/*.npz"))
        assert times > 1 or "finished blocks are kept" in stderr
        assert not [*folder.glob("huge.nc.parts/*.nc"), *folder.glob("huge.nc.parts/*.tmp")]
    else:
        assert os.listdir(folder) == ["huge.nc"]


def test_an_interrupt_that_others_swallow_is_heard(study_file: Path, tmp_path: Path, monkeypatch: Patch) -> None:
    """A library while blocks are solved here, and the engine of a cluster."""
    with monkeypatch.context() as patch:
        patch.setattr(interrupts, "_heard", [0.0])
        patch.setattr("gradhesion.cli.work.solve.scenes.solve", lambda *_, **__: time.sleep(0.5))
        with pytest.raises(KeyboardInterrupt):
            write(load_study(study_file), tmp_path / "out" / "out.nc", history="")
    assert os.listdir(tmp_path / "out") == []

    def engine(study: Study, numbers: Sequence[int]) -> Iterator[tuple[int, Arrays]]:
        for number in numbers:
            monkeypatch.setattr(interrupts, "_heard", [0.0])
            yield number, solve_block(study, study.tiling[number], 1)

    monkeypatch.setenv("GRADHESION_CHUNK", "2")
    with pytest.raises(KeyboardInterrupt):
        write(load_study(study_file), tmp_path / "out.nc", history="", engine=engine)
    assert len(parts_in(folder_of(tmp_path / "out.nc"))) == 1


def test_an_interrupt_while_the_lock_is_taken_leaves_nothing(
    study_file: Path, tmp_path: Path, monkeypatch: Patch
) -> None:
    class Interrupted(FileLock):
        """A lock whose file is there when the signal comes."""

        def _acquire(self) -> None:
            Path(self.lock_file).touch()
            interrupts._hear(signal.SIGTERM, None)
            super()._acquire()

    monkeypatch.setattr(interrupts, "_heard", [])
    monkeypatch.setattr("gradhesion.cli.work.folder.FileLock", Interrupted)
    with pytest.raises(KeyboardInterrupt):
        write(load_study(study_file), tmp_path / "out" / "out.nc", history="")
    assert os.listdir(tmp_path / "out") == []


def test_a_reader_that_has_gone_ends_it_quietly_but_for_a_mistake(dataset_file: Path, tmp_path: Path) -> None:
    reader, unread = os.pipe()
    os.close(reader)
    with os.fdopen(unread, "w") as pipe, (tmp_path / "stderr").open("w") as heard:
        for words, stderr, code in (([dataset_file], heard, 141), (["--help"], heard, 141), (["none.nc"], pipe, 2)):
            command = [sys.executable, "-m", "gradhesion.cli", "info", *words]
            assert subprocess.run(command, stdout=pipe, stderr=stderr, timeout=60, check=False).returncode == code
    assert (tmp_path / "stderr").read_text() == ""


def test_an_interrupt_at_the_end_of_an_object_prints_no_traceback() -> None:
    """Python cannot raise it there: it is raised by the next look at what has been heard."""
    code = """
import contextlib, os, signal
from gradhesion.cli.terminal import interrupts
interrupts.listen()

class Ends:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)
        for _ in range(1000):
            pass

Ends()
with contextlib.suppress(KeyboardInterrupt):
    interrupts.check()
    print("it was not heard")
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@contextmanager
def interrupted_at(step: int) -> Iterator[Callable[[], int]]:
    """Raise KeyboardInterrupt at one line, of disk.py or the making of a file; gives the number of lines run by then."""
    count = 0

    def lines(_frame: FrameType, event: str, _: Any) -> Any:
        nonlocal count
        if event == "line":
            count += 1
            if count > step:
                raise KeyboardInterrupt
        return lines

    def calls(frame: FrameType, *_: Any) -> Any:
        return lines if frame.f_code.co_filename == disk.__file__ or frame.f_code is Path.touch.__code__ else None

    before = sys.gettrace()
    sys.settrace(calls)
    try:
        yield lambda: count
    finally:
        sys.settrace(before)


def make(target: Path, text: str, meanwhile: Callable[[], object] = lambda: None, *, overwrite: bool) -> None:
    """Make a file; something else happens before it is complete."""
    with replacement(target, overwrite=overwrite) as temporary:
        temporary.write_text(text)
        meanwhile()


@pytest.mark.parametrize("there", [True, False])
def test_an_interrupt_at_any_line_leaves_the_old_or_the_new_file_alone(there: bool, tmp_path: Path) -> None:
    target = tmp_path / "out.nc"
    found = []
    for step in range(1000):
        target.unlink(missing_ok=True)
        if there:
            target.write_text("old")
        with suppress(KeyboardInterrupt), interrupted_at(step) as lines:
            make(target, "new", overwrite=there)
        found.append({path.name: path.read_text() for path in tmp_path.iterdir()})
        if lines() <= step:
            break
    assert step > 20
    before = {"out.nc": "old"} if there else {}
    changed = found.index({"out.nc": "new"})
    assert found == changed * [before] + (len(found) - changed) * [{"out.nc": "new"}]
    assert changed > 0


@pytest.mark.parametrize("links", [True, False])
def test_a_file_that_appears_meanwhile_stays_beside_the_new(links: bool, tmp_path: Path, monkeypatch: Patch) -> None:
    if not links:  # as FAT refuses them
        monkeypatch.setattr(Path, "hardlink_to", Mock(side_effect=PermissionError(1, "Operation not permitted")))
    target = tmp_path / "out.nc"
    for name in ("out-2.nc", "out-3.nc"):
        with pytest.raises(OutputError, match=f"kept as {tmp_path / name}"):
            make(target, "new", lambda: target.write_text("precious"), overwrite=False)
        assert target.read_text() == "precious"
        assert (tmp_path / name).read_text() == "new"
        target.unlink()
    assert sorted(os.listdir(tmp_path)) == ["out-2.nc", "out-3.nc"]
    for text in ("first", "newer"):
        make(target, text, overwrite=text == "newer")
        assert target.read_text() == text
    target.unlink()
    with pytest.raises(OutputError, match=r"kept as .*out-4\.nc"):
        make(target, "new", target.mkdir, overwrite=True)
