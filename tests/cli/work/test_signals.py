"""Interrupts at any moment, and files that appear whole or not at all: the old output stays, nothing but finished parts is left."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

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


@contextmanager
def started(tmp_path: Path, output: Path, files: int) -> Iterator[subprocess.Popen[str]]:
    """Start a long run, and wait until so many files are in the folder of its output."""
    study = tmp_path / "huge.toml"
    study.write_text(HUGE)
    command = [sys.executable, "-m", "gradhesion.cli", "run", study, "-o", output, "--overwrite"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 120
        while len(os.listdir(output.parent)) < files and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        yield process


@pytest.mark.parametrize(("number", "delay"), [(signal.SIGINT, 0.3), (signal.SIGTERM, 0.0)])
def test_an_interrupt_leaves_nothing_behind(number: signal.Signals, delay: float, tmp_path: Path) -> None:
    folder = tmp_path / "data"
    folder.mkdir()
    old = folder / "huge.nc"
    old.write_text("precious")
    with started(tmp_path, old, 2) as process:
        time.sleep(delay)
        process.send_signal(number)
        stdout, stderr = process.communicate(timeout=60)
    assert process.returncode == 130, stderr
    assert stdout == ""
    assert "Traceback" not in stderr
    assert old.read_text() == "precious"
    assert stderr.splitlines()[-1].startswith("interrupted; ")
    if (folder / "huge.nc.parts").exists():
        assert list(folder.glob("huge.nc.parts/*.npz"))
        assert f"kept in {old}.parts" in stderr
        assert not list(folder.glob("huge.nc.parts/*.nc"))
    else:
        assert os.listdir(folder) == ["huge.nc"]


def test_a_second_interrupt_does_not_disturb_the_tidying_up(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    folder.mkdir()
    with started(tmp_path, folder / "huge.nc", 1) as process:
        for _ in range(20):
            process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
    assert process.returncode == 130
    assert not list(tmp_path.glob("out/*/merged.nc"))
    assert not list(tmp_path.glob("out/*/*.tmp"))


def test_an_interrupt_that_a_library_swallows_is_heard(study_file: Path, tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.setattr(interrupts, "_heard", [0.0])
    monkeypatch.setattr("gradhesion.cli.work.solve.scenes.solve", lambda *_, **__: time.sleep(0.5))
    with pytest.raises(KeyboardInterrupt):
        write(load_study(study_file), tmp_path / "out" / "out.nc", history="")
    assert os.listdir(tmp_path / "out") == []


def test_an_interrupt_a_cluster_swallows_is_heard(study_file: Path, tmp_path: Path, monkeypatch: Patch) -> None:
    def engine(study: Study, numbers: Sequence[int]) -> Iterator[tuple[int, Arrays]]:
        for number in numbers:
            monkeypatch.setattr(interrupts, "_heard", [0.0])
            yield number, solve_block(study, study.tiling[number], 1)

    monkeypatch.setenv("GRADHESION_CHUNK", "2")
    with pytest.raises(KeyboardInterrupt):
        write(load_study(study_file), tmp_path / "out.nc", history="", engine=engine)
    assert len(parts_in(folder_of(tmp_path / "out.nc"))) == 1


@pytest.fixture
def unread() -> Iterator[int]:
    reader, pipe = os.pipe()
    os.close(reader)
    yield pipe
    os.close(pipe)


def test_a_reader_that_has_gone_ends_it_quietly(unread: int, dataset_file: Path) -> None:
    for arguments in (["info", dataset_file], ["info", "--help"]):
        command = [sys.executable, "-m", "gradhesion.cli", *arguments]
        done = subprocess.run(command, stdout=unread, stderr=subprocess.PIPE, text=True, timeout=60, check=False)
        assert (done.returncode, done.stderr) == (141, ""), arguments


def test_a_mistake_that_nobody_reads_keeps_its_exit_code(unread: int, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "gradhesion.cli", "info", tmp_path / "none.nc"]
    assert subprocess.run(command, stdout=unread, stderr=unread, timeout=60, check=False).returncode == 2


def test_an_interrupt_at_the_end_of_an_object_prints_no_traceback() -> None:
    """Python cannot raise it there: it is raised by the next look at what has been heard."""
    code = """
import os, signal
from gradhesion.cli.terminal import interrupts
interrupts.listen()

class Ends:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)
        for _ in range(1000):
            pass

one = Ends()
del one
try:
    interrupts.check()
except KeyboardInterrupt:
    print("interrupted")
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "interrupted\n", "")


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
def test_an_interrupt_at_any_line_leaves_the_old_or_the_new_file_alone(there: bool, tmp_path: Path) -> None:
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


def make(target: Path, meanwhile: Callable[[], object], *, overwrite: bool) -> None:
    """Make a file; something else happens before it is complete."""
    with replacement(target, overwrite=overwrite) as temporary:
        temporary.write_text("new")
        meanwhile()


@pytest.mark.parametrize("links", [True, False])
def test_a_file_that_appears_meanwhile_stays_beside_the_new(links: bool, tmp_path: Path, monkeypatch: Patch) -> None:
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
