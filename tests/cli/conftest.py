"""What tests of commands share: the dataset of the small study, and a command on a full disk."""

import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from gradhesion.cli.dataset.writer import write
from gradhesion.cli.study import study_from
from tests.conftest import SMALL

Completed = subprocess.CompletedProcess[str]


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
def small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


@pytest.fixture
def made(
    gradhesion: Callable[..., Result], data: dict[str, Any], write_study: Callable[[str], Path], tmp_path: Path
) -> Callable[..., Path]:
    """Write the dataset of the small study with other keys by the command."""

    def make(name: str = "out", exit_code: int = 0, parameters: dict[str, Any] | None = None, **changes: Any) -> Path:
        study = study_from(data | changes | {"parameters": data["parameters"] | (parameters or {})})
        path = tmp_path / f"{name}.nc"
        result = gradhesion("run", write_study(study.text), "-o", path, "--quiet", "--overwrite")
        assert result.exit_code == exit_code, result.stderr
        return path

    return make


@pytest.fixture
def on_a_full_disk() -> Callable[..., Completed]:
    """Start the command where no file may be larger than so many bytes; the bytecode of its modules would be cut, too."""
    import resource

    def run(size: int, *words: str | Path) -> Completed:
        def full_disk() -> None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        command = [sys.executable, "-B", "-m", "gradhesion.cli", *words]
        return subprocess.run(command, preexec_fn=full_disk, capture_output=True, text=True, check=False)

    return run
