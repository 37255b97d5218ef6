"""What the tests of the command line share."""

import gc
import math
import os
import sys
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from hypothesis import HealthCheck, settings

settings.register_profile("no clock", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("no clock")

ROOT = Path(__file__).parents[1]
SHARED = Path("/dev/shm")  # noqa: S108 (folders are made in it)
SMALL = {
    "title": "A small study",
    "outputs": ["pull_off_force", "dissipated_energy", "loading_jumps"],
    "parameters": {
        "k": [0.0, 0.31],
        "nu": 0.27,
        "modulus": 430.0,
        "c0_over_R": 0.013,
        "lambda_over_R": {"start": 0.11, "stop": 0.47, "num": 3, "spacing": "log"},
        "A": [0.0, 0.023],
        "a_max_over_R": [0.7, float("inf")],
    },
}


def in_memory(size: int) -> str | None:
    """Return where so many bytes of files, and programs among them, can stand in memory, as a disk is slower than most tests; None if nowhere."""
    if not (SHARED.is_dir() and os.access(SHARED, os.W_OK)):
        return None
    system = os.statvfs(SHARED)
    room = system.f_bavail * system.f_frsize
    return str(SHARED) if room >= size and not system.f_flag & os.ST_NOEXEC else None


def pytest_configure() -> None:
    """Have temporary folders in memory, where there is room, and old objects looked through for cycles seldom."""
    gc.set_threshold(2_000, 10, 30)
    sys.path.append(str(ROOT))  # scripts of benchmarks, documents and figures are not installed
    if place := in_memory(2**32):
        os.environ.setdefault("PYTEST_DEBUG_TEMPROOT", place)


@pytest.fixture(scope="session", autouse=True)
def announced() -> None:
    """Have no command say that it compiles, wherever a test is the first to need it: tests read what is printed.

    For this process alone: what is marked in the user's folder of kernels has been compiled.
    """
    from gradhesion.cli.work import compiling
    from gradhesion.core import place

    compiling._begun |= {(place().folder, need) for need in compiling.SECONDS}


@pytest.fixture
def root() -> Path:
    """The repository."""
    return ROOT


@pytest.fixture
def data() -> dict[str, Any]:
    """A small valid study, off every round number."""
    return deepcopy(SMALL)


@pytest.fixture
def write_study(tmp_path: Path) -> Callable[[str], Path]:
    """Write the text of a study into a file."""

    def write(text: str) -> Path:
        path = tmp_path / "study.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def study_file(data: dict[str, Any], write_study: Callable[[str], Path]) -> Path:
    """The small study as a file."""
    from gradhesion.cli.study.reading import study_from

    return write_study(study_from(data).text)


def command(*arguments: str | Path, code: int | None = None) -> Result:
    """Call the command line in this process; it may have to end with a code."""
    from gradhesion.cli.main import cli

    result = CliRunner().invoke(cli, [str(argument) for argument in arguments], catch_exceptions=False)
    assert code in (None, result.exit_code), (arguments, result.output)
    return result


@pytest.fixture
def gradhesion(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Result]:
    """The command line without lines of progress, of which a busy machine has some."""
    monkeypatch.setattr("gradhesion.cli.terminal.progress.PERIOD", math.inf)
    return command


def mistakes(call: Callable[..., Any], *arguments: Any, **keywords: Any) -> tuple[str, ...]:
    """What a call is refused for."""
    from gradhesion.cli.errors import GradhesionError

    with pytest.raises(GradhesionError) as caught:
        call(*arguments, **keywords)
    return caught.value.mistakes
