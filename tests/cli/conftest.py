"""What tests of commands share: the small study and others as datasets, wrong studies, and a full disk."""

import math
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset.writer import write
from gradhesion.cli.study import load_study, study_from
from tests.conftest import SMALL, mistakes
from tests.faults.trials import values_of

Call = Callable[..., Result]
Made = Callable[..., Path]
Told = Callable[..., str]
Patch = pytest.MonkeyPatch
Called = Callable[..., subprocess.CompletedProcess[str]]

COLUMNS: Final = """indentation = { column = "depth", unit = "nm" }
load = { column = "force", unit = "nN" }
"""
BALL: Final = """[parameters]
k = 0.0
nu = 0.3
A = 0.0
[physical]
R = "5 um"
E_star = { start = "1 MPa", stop = "100 MPa" }
"""
WORK: Final = 'work_of_adhesion = { start = "5 mJ/m^2", stop = "200 mJ/m^2" }\n'
"""The study of a fit of a smooth ball, as parts of a text."""
PROFILE: Final = """outputs = ["pull_off_force"]
[parameters]
k = 0.0
nu = 0.3
[physical]
E_star = "50 MPa"
work_of_adhesion = "50 mJ/m^2"
a_max = "1.5 um"
[profile]
file = "table.csv"   # measured
terms = 1
"""


@pytest.fixture(scope="session")
def _written_once(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("small") / "small.nc"
    write(study_from(SMALL), path, history="made by the tests")
    return path


@pytest.fixture
def dataset_file(_written_once: Path, tmp_path: Path) -> Path:
    """The dataset of the small study, of 24 scenes; each test may spoil its own."""
    return Path(shutil.copy(_written_once, tmp_path / "out.nc"))


@pytest.fixture
def refusal(gradhesion: Call) -> Told:
    """What is said where a command is refused: one sentence, of options below their usage, and nothing else."""

    def refuse(*command: Any, code: int = 2) -> str:
        result = gradhesion(*command, code=code)
        said = result.stderr if result.stderr.startswith("Usage: ") else f"\n\n\n{result.stderr}"
        assert (result.stdout, said.count("\n")) == ("", 4), result.output
        return result.stderr

    return refuse


@pytest.fixture
def small_blocks(monkeypatch: Patch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


@pytest.fixture
def output(tmp_path: Path) -> Path:
    return tmp_path / "data" / "out.nc"


@pytest.fixture
def run(gradhesion: Call, study_file: Path, output: Path) -> Call:
    """Run the small study into that file."""
    return partial(gradhesion, "run", study_file, "-o", output)


@pytest.fixture
def whole(gradhesion: Call, study_file: Path, tmp_path: Path) -> dict[str, bytes]:
    """The values of a run of the small study in a single go."""
    path = tmp_path / "whole.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return values_of(path)


class Ran(NamedTuple):
    """A study that was run: what was said, the dataset, and where it stands."""

    said: str
    dataset: xarray.Dataset
    path: Path


Run = Callable[..., Ran]


@pytest.fixture
def made(ran: Run, data: dict[str, Any]) -> Made:
    """Write the dataset of the small study with other keys by the command."""

    def make(name: str = "out", exit_code: int = 0, parameters: dict[str, Any] | None = None, **changes: Any) -> Path:
        study = data | changes | {"parameters": data["parameters"] | (parameters or {})}
        return ran(study, "--quiet", "--overwrite", output=f"{name}.nc", exit_code=exit_code).path

    return make


@pytest.fixture
def ran(gradhesion: Call, write_study: Made, tmp_path: Path) -> Run:
    def run(study: dict[str, Any], *options: str, output: str = "out.nc", exit_code: int = 0) -> Ran:
        path = tmp_path / output
        result = gradhesion("run", write_study(study_from(study).text), "-o", path, *options, code=exit_code)
        with gr.open(path) as dataset:
            return Ran(result.stderr, dataset.load(), path)

    return run


def jkr(a: np.ndarray, R: float, E_star: float, work: float) -> tuple[np.ndarray, np.ndarray]:
    """Depth and load of a smooth ball by its contact radius, by Johnson, Kendall & Roberts (1971)."""
    load = 4.0 * E_star * a**3 / (3.0 * R) - np.sqrt(8.0 * math.pi * work * E_star * a**3)
    return a**2 / R - np.sqrt(2.0 * math.pi * a * work / E_star), load


def mistakes_of(path: Path, *overrides: str) -> list[str]:
    return [*mistakes(load_study, path, overrides)]


@pytest.fixture
def on_a_full_disk() -> Called:
    """Start the command where no file may be larger than so many bytes; the bytecode of its modules would be cut, too."""
    import resource

    def run(size: int, *words: str | Path) -> subprocess.CompletedProcess[str]:
        def full_disk() -> None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        command = [sys.executable, "-B", "-m", "gradhesion.cli", *words]
        return subprocess.run(command, preexec_fn=full_disk, capture_output=True, text=True, check=False)

    return run


def legend(panels: Any) -> list[str]:
    return [text.get_text() for one in panels.figure.legends for text in one.get_texts()]


def words(panels: Any) -> str:
    """All that stands above the panels."""
    return str(panels.figure.get_suptitle()).replace("\N{NO-BREAK SPACE}", " ").replace("$", "").replace("{}", " ")


def curves(axes: Any) -> list[Any]:
    return [line for line in axes.get_lines() if not str(line.get_label()).startswith("_")]


def contours(axes: Any) -> Any:
    from matplotlib.contour import QuadContourSet

    return next(one for one in axes.collections if isinstance(one, QuadContourSet) and not one.filled)
