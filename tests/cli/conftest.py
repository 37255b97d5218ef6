"""What tests of commands share: a study that is refused, and a command on a full disk."""

import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

Completed = subprocess.CompletedProcess[str]


@pytest.fixture
def refused_at_once(
    gradhesion: Callable[..., Result], write_study: Callable[[str], Path]
) -> Callable[[str, str], None]:
    """Run a text as a study in which a sentence is said before anything is computed."""

    def run(text: str, sentence: str) -> None:
        path = write_study(text)
        result = gradhesion("run", path, "-o", path.with_suffix(".nc"))
        assert result.exit_code == 2
        assert sentence in result.output
        assert [*path.parent.iterdir()] == [path], "nothing is written"

    return run


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
