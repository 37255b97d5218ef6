"""Disks that are full at any byte, become read-only, or vanish at any moment: in a mount namespace of this process's own.

python -m tests.adversary.disks, as a user who may make namespaces (`unshare -m`).
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Final

from gradhesion.cli.terminal import interrupts
from tests.faults.trials import OLD, Trials, ended, run, values_of

PAGE: Final = os.sysconf("SC_PAGE_SIZE")
CODES: Final = (0, 4)
"""Of a run on such a disk: it is written, or it cannot be."""


def mount(*words: str | Path) -> None:
    """Mount something."""
    subprocess.run(["mount", *map(str, words)], check=True, capture_output=True)


def checked(trials: Trials, code: int, *, overwrite: bool) -> int:
    """Check what a run has left, resume it, and check what it has made; gives the code."""
    told = (trials.folder.parent / "stderr").read_text()
    assert code in CODES, (code, told)
    assert (code == 0) == (told == ""), told
    assert told.count("\n") == (code != 0), told
    assert "Traceback" not in told
    old = trials.output.read_bytes() if trials.output.exists() else None
    if code and overwrite:
        assert old == OLD, "the old output is gone"
    elif code:
        assert old is None, "half an output"
    options = ("--overwrite",) if overwrite or code == 0 else ()
    assert ended(run(trials.study, trials.output, *options)) == 0, (trials.folder.parent / "stderr").read_text()
    assert values_of(trials.output) == trials.whole
    assert os.listdir(trials.folder) == ["out.nc"], os.listdir(trials.folder)
    return code


def prepared(trials: Trials, *, overwrite: bool) -> tuple[str, ...]:
    """Empty the disk, but for an old output that is to be replaced."""
    for path in trials.folder.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    if overwrite:
        trials.output.write_bytes(OLD)
    return ("--overwrite",) if overwrite else ()


def full(trials: Trials, step: int) -> Counter[int]:
    """Run on disks of any number of pages, until one is large enough three times in a row."""
    codes: Counter[int] = Counter()
    pages, enough = 1, 0
    while enough < 3:
        mount("-o", "remount,size=64m", trials.folder)
        overwrite = pages % 2 == 0
        options = prepared(trials, overwrite=overwrite)
        mount("-o", f"remount,size={pages * PAGE}", trials.folder)
        code = ended(run(trials.study, trials.output, *options))
        mount("-o", "remount,size=64m", trials.folder)
        codes[checked(trials, code, overwrite=overwrite)] += 1
        enough = enough + 1 if code == 0 else 0
        pages += step
    return codes


def at_a_moment(trials: Trials, count: int, draw: random.Random, change: str) -> Counter[int]:
    """Run on a disk that becomes read-only, or vanishes, at a random moment."""
    codes: Counter[int] = Counter()
    for number in range(count):
        overwrite = number % 2 == 0
        options = prepared(trials, overwrite=overwrite)
        pid = run(trials.study, trials.output, *options)
        time.sleep(draw.uniform(0.0, 1.1 * trials.seconds))
        if change == "vanishes":
            os.kill(pid, signal.SIGSTOP)
            kept = trials.folder.parent / "kept"
            mount("--move", trials.folder, kept)
            os.kill(pid, signal.SIGCONT)
            code = ended(pid)
            left = os.listdir(trials.folder)
            for name in left:  # what it has begun on the disk below
                assert name == "out.nc.parts" or (name == "out.nc" and code == 0), left
            for path in trials.folder.iterdir():
                shutil.rmtree(path) if path.is_dir() else path.unlink()
            mount("--move", kept, trials.folder)
            made = trials.output.exists() and trials.output.read_bytes() != OLD
            if code == 0 and not made:  # all of it was begun anew on the disk below
                code = 4
                (trials.folder.parent / "stderr").write_text("it stood on the disk below\n")
        else:
            for _ in range(200):  # a file that is open for writing keeps it writable
                if (
                    subprocess.run(
                        ["mount", "-o", "remount,ro", trials.folder], check=False, capture_output=True
                    ).returncode
                    == 0
                ):
                    break
                time.sleep(0.001)
            code = ended(pid)
            mount("-o", "remount,rw", trials.folder)
        codes[checked(trials, code, overwrite=overwrite)] += 1
    return codes


def in_words(codes: Counter[int]) -> str:
    """Write down how runs ended."""
    return f"{codes.total():,} ({codes[4]:,} ended with exit code 4)"


def main() -> None:
    """Try disks, in a namespace of their own."""
    if "--inside" not in sys.argv:
        command = ["unshare", "-m", sys.executable, "-m", "tests.adversary.disks", "--inside", *sys.argv[1:]]
        sys.exit(subprocess.run(command, check=False).returncode)
    numbers = [int(word) for word in sys.argv[1:] if word.isdigit()]
    step, count = numbers or (1, 100)
    interrupts.listen()
    start, draw = time.monotonic(), random.Random(11)
    with tempfile.TemporaryDirectory() as folder:
        trials = Trials(Path(folder))
        (Path(folder) / "kept").mkdir()
        prepared(trials, overwrite=False)
        mount("--make-rprivate", "/")
        mount("-t", "tmpfs", "-o", "size=64m", "none", trials.folder)
        words = [f"full disks, page by page: {in_words(full(trials, step))}"]
        words += [f"{name}: {in_words(at_a_moment(trials, count, draw, name))}" for name in ("read-only", "vanishes")]
        subprocess.run(["umount", trials.folder], check=True)
    print(f"runs on {'; '.join(words)}; nothing lost, {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main()
