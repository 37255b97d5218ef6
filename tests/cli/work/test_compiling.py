"""The first run of a version says that it compiles, once; what starts meanwhile waits, and nothing is compiled twice."""

import threading
from pathlib import Path
from typing import Any

import pytest
from filelock import FileLock

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from
from gradhesion.cli.work import compiling
from gradhesion.core.jit import Place
from tests.cli.conftest import Call, Patch

Printed = pytest.CaptureFixture[str]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: Patch) -> Path:
    """A folder for compiled code, in which no process has compiled yet."""
    folder = tmp_path / "kernels"
    folder.mkdir()
    monkeypatch.setattr(compiling, "place", lambda: Place(folder, ""))
    return folder


@pytest.mark.usefixtures("folder")
def test_the_first_run_alone_says_that_it_compiles(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    run = ("run", study_file, "--quiet")
    assert len(gradhesion(*run, "-o", tmp_path / "first.nc").stderr.splitlines()) == 1, "also where it is quiet"
    assert gradhesion(*run, "-o", tmp_path / "second.nc").stderr == ""
    assert gradhesion("plan", study_file).stderr == ""


def test_a_plan_and_python_say_it_as_well_and_another_process_does_not_say_it_again(
    folder: Path, gradhesion: Call, study_file: Path, data: dict[str, Any], monkeypatch: Patch, capsys: Printed
) -> None:
    assert len(gradhesion("plan", study_file, "--json").stderr.splitlines()) == 1
    (folder / "another").mkdir()
    monkeypatch.setattr(compiling, "place", lambda: Place(folder / "another", ""))
    scene = dict.fromkeys(data["parameters"], 0.3) | {"A": 0.01}
    for said in (1, 0):
        for call in (lambda: gr.solve(scene, "pull_off_force"), lambda: gr.curves(scene, "path")):
            call()  # each compiles something else
            assert len(capsys.readouterr().err.splitlines()) == said
        monkeypatch.setattr(compiling, "_begun", set())
    compute(study_from(data | {"outputs": ["pull_off_force"]}))
    assert capsys.readouterr().err == ""
    compute(study_from(data | {"outputs": ["dissipated_energy"]}))
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_why_nothing_is_kept_is_said_once(data: dict[str, Any], monkeypatch: Patch, capsys: Printed) -> None:
    monkeypatch.setattr(compiling, "place", lambda: Place(None, "a folder is not used, and why"))
    monkeypatch.setattr(compiling, "_begun", set())
    for is_first in (True, False):
        compute(study_from(data))
        assert ("a folder is not used, and why" in capsys.readouterr().err) == is_first


def test_what_starts_while_another_process_compiles_waits_for_it(folder: Path) -> None:
    """The other process is this one: it holds the lock."""
    waiting = threading.Thread(target=compiling.prepare)
    with FileLock(folder / "lock"):
        waiting.start()
        waiting.join(0.3)
        assert waiting.is_alive()
    waiting.join(60)
    assert not waiting.is_alive()


@pytest.mark.usefixtures("folder")
def test_a_map_compiles_what_it_needs_before_it_is_solved(data: dict[str, Any], monkeypatch: Patch) -> None:
    """A scene at either end of its axes is solved; blocks that raise are left to the run."""
    solved: list[Any] = []

    def solve_block(_study: Any, block: Any, _threads: Any) -> None:
        solved.append(block)
        raise ZeroDivisionError

    monkeypatch.setattr(compiling, "solve_block", solve_block)
    study = study_from(data)
    compiling.prepare(study)
    ends = [tuple((part.start, part.stop) for part in block) for block in solved]
    assert ends == [tuple((0, 1) for _ in study.shape), tuple((size - 1, size) for size in study.shape)]


@pytest.mark.usefixtures("folder")
def test_a_warmup_takes_the_options_of_earlier_versions(gradhesion: Call, monkeypatch: Patch) -> None:
    asked: list[bool] = []
    monkeypatch.setattr("gradhesion.core.warm_up", lambda _report, *, everything: asked.append(everything))
    for arguments in ([], ["--all"], ["--all", "--workers", "2", "--quiet"]):
        assert ("--quiet" in arguments) == (gradhesion("warmup", *arguments, code=0).stderr == "")
    assert asked == [False, True, True]
