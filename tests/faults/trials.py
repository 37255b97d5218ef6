"""Runs that are killed at a moment of their life, and gone on with: what is lost, what is left behind.

Each run is a process of its own, forked from one that has the kernels in memory, so that a trial takes a tenth of a
second and not two. It is killed by SIGKILL before or after its n-th change of a name in the folder (a rename, a
link, an unlink, a removal of a folder), or by SIGKILL or SIGTERM at a random moment. Then the same command is run to its end.

    python -m tests.faults.trials --random 100 --seed 7        (every change of a name, and 100 random moments)
"""

import argparse
import atexit
import itertools
import os
import random
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Container
from functools import partial
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

from gradhesion.cli.commands.status import status_of
from gradhesion.cli.dataset.writer import compute
from gradhesion.cli.main import main as gradhesion
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.cli.terminal import interrupts
from tests.conftest import SMALL, in_memory

OLD = b"precious"


def values_of(path: Path) -> dict[str, bytes]:
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        return {name: np.asarray(variable[...]).tobytes() for name, variable in file.variables.items()}


def run(study: Path, output: Path, *options: str, before: Callable[[], None] = lambda: None) -> int:
    """Start a run in a process of its own; `before` is called there first."""
    return start("run", study, "-o", output, *options, folder=output.parent.parent, before=before)


def start(*words: str | Path, folder: Path, before: Callable[[], None] = lambda: None) -> int:
    """Start a command in a process of its own; `before` is called there first."""
    pid = os.fork()
    if pid:
        return pid
    try:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)  # until the command listens, as in a process of its own
        errors = os.open(folder / "stderr", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(errors, 2)
        sys.argv = ["gradhesion", *map(str, words), "--quiet"]
        atexit._clear()  # what this process tidies up at its end
        before()
        gradhesion()
    finally:
        os._exit(99)


def ended(pid: int) -> int:
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


def signal_at(number: int, sent: signal.Signals, *, after: bool) -> None:
    """Send this process a signal at its n-th change of a name, before it or after: SIGKILL ends it there, SIGSTOP stops it."""
    count = 0

    def wrap(change: Callable[..., Any]) -> Callable[..., Any]:
        def changed(*arguments: Any, **options: Any) -> Any:
            nonlocal count
            count += 1
            this = count
            if this == number and not after:
                os.kill(os.getpid(), sent)
            result = change(*arguments, **options)
            if this == number and after:
                os.kill(os.getpid(), sent)
            return result

        return changed

    for name in ("replace", "hardlink_to", "unlink", "rmdir", "mkdir"):
        setattr(Path, name, wrap(getattr(Path, name)))


class Trials:
    """A study, its dataset in a single go, and a folder for trials."""

    def __init__(self, folder: Path) -> None:
        os.environ["GRADHESION_CHUNK"] = "4"
        self.study = folder / "study.toml"
        self.study.write_text(study_from(SMALL).text)
        self.folder = folder / "data"
        self.output = self.folder / "out.nc"
        self.folder.mkdir()
        compute(load_study(self.study), threads=1)  # so that the processes to come have the kernels
        assert self._in_full() == 0
        self.whole = values_of(self.output)
        start = time.monotonic()
        assert self._in_full() == 0
        self.seconds = time.monotonic() - start
        self.interrupted = 0
        self.kept = 0

    def _in_full(self) -> int:
        return ended(run(self.study, self.output, "--overwrite"))

    def empty(self) -> None:
        shutil.rmtree(self.folder)
        self.folder.mkdir()

    def fault(self, *, overwrite: bool, before: Callable[[], None], kill: Callable[[int], None]) -> int:
        """Kill a run, and check what is left and what the same command makes of it."""
        self.empty()
        if overwrite:
            self.output.write_bytes(OLD)
        pid = run(self.study, self.output, *(["--overwrite"] if overwrite else []), before=before)
        kill(pid)
        return self.checked(ended(pid), overwrite=overwrite, codes=(0, 130, -signal.SIGKILL, -signal.SIGTERM))

    def checked(self, code: int, *, overwrite: bool, codes: Container[int]) -> int:
        """Check what a run has left, go on with it, and check what there is then; gives its exit code, one of some."""
        assert code in codes, (code, self.told())
        self.interrupted += code != 0
        old = self.output.read_bytes() if self.output.exists() else None
        complete = old not in (None, OLD)
        if complete:
            assert values_of(self.output) == self.whole, "half an output"
        else:
            assert old == (OLD if overwrite else None), "the old output is gone"
            assert code != 0, "it says that it is fine"
        parts = self.output.with_name("out.nc.parts")
        self.kept += len(list(parts.glob("*.npz")))
        if code == 130:
            left = [path.name for path in parts.glob("*") if path.suffix in {".tmp", ".nc"}]
            assert not left, left
        final = ended(run(self.study, self.output, *(["--overwrite"] if overwrite or code == 0 else [])))
        # An output that is complete without a word about it may be refused as any other that exists.
        assert final == 0 or (final == 4 and complete and not overwrite and code not in {0, 4}), (final, self.told())
        assert values_of(self.output) == self.whole, "the resumed dataset differs"
        assert os.listdir(self.folder) == ["out.nc"], os.listdir(self.folder)
        return code

    def told(self) -> str:
        path = self.folder.parent / "stderr"
        return path.read_text() if path.exists() else ""  # a run may be killed before it has opened it

    def at_every_change_of_a_name(self, trial: Callable[[int, Callable[[], None]], int]) -> int:
        """Kill what is tried before and after each change of a name; tells how many there are."""
        for number, after in itertools.product(range(1, 1000), (False, True)):
            if trial(number, partial(signal_at, number, signal.SIGKILL, after=after)) == 0:
                return number - 1
        raise AssertionError("it never ends")

    def of_a_run(self, number: int, before: Callable[[], None]) -> int:
        """Kill a run, whose output is there before every other time."""
        return self.fault(overwrite=number % 2 == 0, before=before, kill=lambda _: None)

    def of_a_merge(self, _number: int, before: Callable[[], None]) -> int:
        """Kill a merge, and give the same command again."""
        self.empty()
        assert ended(run(self.study, self.output, "--shard", "1/1")) == 0
        command = ("merge", self.output)
        code = ended(start(*command, folder=self.folder.parent, before=before))
        if self.output.exists():
            assert status_of(self.output)["state"] == "complete"
        assert ended(start(*command, folder=self.folder.parent)) == 0, self.told()
        assert status_of(self.output)["state"] == "complete"
        assert values_of(self.output) == self.whole
        assert os.listdir(self.folder) == ["out.nc"], os.listdir(self.folder)
        return code

    def at_random(self, count: int, seed: int) -> None:
        """Kill runs at random moments of their life, by SIGKILL and SIGTERM in turn."""
        draw = random.Random(seed)
        for number in range(count):

            def kill(pid: int, number: int = number) -> None:
                time.sleep(draw.uniform(0.0, 1.1 * self.seconds))
                os.kill(pid, (signal.SIGKILL, signal.SIGTERM)[number % 2])

            self.fault(overwrite=number % 4 < 2, before=lambda: None, kill=kill)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--random", type=int, default=200)
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    asked = parser.parse_args()
    interrupts.listen()
    start = time.monotonic()
    with tempfile.TemporaryDirectory(dir=in_memory(2**26)) as folder:
        trials = Trials(Path(folder))
        changes, merges = map(trials.at_every_change_of_a_name, (trials.of_a_run, trials.of_a_merge))
        trials.at_random(asked.random, asked.seed)
    print(
        f"killed before and after each of {changes} changes of a name ({merges} of a merge), and at {asked.random} random moments (seed "
        f"{asked.seed}): {trials.interrupted} runs ended early, {trials.kept} parts kept in all; nothing lost, nothing "
        f"left behind, every resumed dataset the same bit by bit; {time.monotonic() - start:.0f} s"
    )


if __name__ == "__main__":
    main()
