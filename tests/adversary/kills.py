"""Runs that are killed at every system call that changes a file: strace sends SIGKILL as the n-th call of a kind begins.

With that a run ends before each change of a byte, a size or a name, which is after the change before it.
"""

import os
import shutil
import signal
import subprocess
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from gradhesion.cli.terminal import interrupts
from tests.faults.trials import Trials
from tests.memory import in_memory

CALLS: Final = (
    "write", "pwrite64", "writev", "ftruncate", "fsync", "fdatasync", "rename", "renameat", "renameat2", "link", "linkat",
    "unlink", "unlinkat", "mkdir", "mkdirat", "rmdir", "fchmod", "utimensat",
)  # fmt: skip
"""System calls that change a file, or see to it that a change lasts."""


def traced(pid: int, *options: str, log: Path) -> "subprocess.Popen[bytes]":
    """Have strace follow a process that has stopped itself, and let that go on."""
    os.waitpid(pid, os.WUNTRACED)
    command = ["strace", "-f", "-qq", "-o", str(log), "-e", f"trace={','.join(CALLS)}", *options, "-p", str(pid)]
    strace = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    while "TracerPid:\t0\n" in Path(f"/proc/{pid}/status").read_text():
        assert strace.poll() is None, "strace has ended without following"
        time.sleep(0.002)
    os.kill(pid, signal.SIGCONT)
    return strace


def stop() -> None:
    """Stop this process until somebody follows it."""
    os.kill(os.getpid(), signal.SIGSTOP)


def counted(trials: Trials, log: Path) -> Counter[str]:
    """Count the calls of each kind of a whole run, of the thread that makes most of them."""
    calls: Counter[tuple[str, str]] = Counter()

    def follow(pid: int) -> None:
        trials.tracer = traced(pid, log=log)

    assert trials.fault(overwrite=False, before=stop, kill=follow) == 0
    trials.tracer.wait()
    for line in log.read_text().splitlines():
        thread, _, rest = line.partition(" ")
        name = rest.strip().partition("(")[0]
        if name in CALLS:
            calls[thread, name] += 1
    return Counter({name: max(n for (_, one), n in calls.items() if one == name) for _, name in calls})


def kill_at_every_call(trials: Trials, folder: Path, every: int = 1) -> tuple[Counter[str], int]:
    """Kill a run as each call begins (or every n-th), with and without an old output; give the calls, and the kills."""
    found, killed = counted(trials, folder / "strace.txt"), 0
    for name, count in found.items():
        for number in range(1, count + 1, every):
            inject = ("-e", f"inject={name}:signal=SIGKILL:when={number}")

            def follow(pid: int, inject: Sequence[str] = inject) -> None:
                trials.tracer = traced(pid, *inject, log=folder / "strace.txt")

            killed += trials.fault(overwrite=number % 2 == 0, before=stop, kill=follow) == -signal.SIGKILL
            trials.tracer.wait()
    return found, killed


def trials_of_kills(every: int = 1) -> str:
    """Kill runs, and say how many; "" where there is no strace."""
    if shutil.which("strace") is None:
        return ""
    interrupts.listen()
    start = time.monotonic()
    with tempfile.TemporaryDirectory(dir=in_memory(2**26)) as folder:
        trials = Trials(Path(folder))
        found, killed = kill_at_every_call(trials, Path(folder), every)
    return (
        f"{killed:,} runs killed at {sum(found.values()):,} system calls that change a file "
        f"({', '.join(f'{n} {name}' for name, n in found.most_common())}): nothing lost, nothing left behind, every resumed "
        f"dataset the same bit by bit; {time.monotonic() - start:.0f} s"
    )


if __name__ == "__main__":
    print(trials_of_kills() or "strace is not there")
