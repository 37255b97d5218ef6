"""What tests of commands share: a command on a full disk."""

import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

Completed = subprocess.CompletedProcess[str]


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
