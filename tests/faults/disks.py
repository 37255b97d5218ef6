"""Disks that are full at any byte, become read-only, or vanish at any moment: in a mount namespace of this process's own.

python -m tests.faults.disks, as a user who may make namespaces (`unshare -m`).
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
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Final

from gradhesion.cli.terminal import interrupts
from tests.conftest import in_memory
from tests.faults.trials import OLD, Trials, ended, run, signal_at

PAGE: Final = os.sysconf("SC_PAGE_SIZE")


def mount(*words: str | Path, check: bool = True) -> None:
    subprocess.run(["mount", *map(str, words)], check=check, capture_output=True)


def checked(trials: Trials, code: int, *, overwrite: bool) -> int:
    """Check what a run has said and left, go on with it, and check what that has made; gives the code."""
    told = trials.told()
    assert told.count("\n") == (code != 0), told
    assert "Traceback" not in told
    return trials.checked(code, overwrite=overwrite, codes=(0, 4))


def empty(trials: Trials) -> None:
    for path in trials.folder.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def prepared(trials: Trials, *, overwrite: bool) -> tuple[str, ...]:
    """Empty the disk, but for an old output that is to be replaced."""
    empty(trials)
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


def make_read_only(trials: Trials) -> None:
    """Make the disk read-only, unless a file is open for writing: that keeps it writable."""
    mount("-o", "remount,ro", trials.folder, check=False)


def make_writable(trials: Trials, code: int) -> int:
    """Make the disk writable again; gives the code of the run that has ended meanwhile."""
    mount("-o", "remount,rw", trials.folder)
    return code


def take_away(trials: Trials) -> None:
    """Let the disk vanish: what stands there is the disk below."""
    mount("--move", trials.folder, trials.folder.parent / "kept")


def bring_back(trials: Trials, code: int) -> int:
    """Bring the disk back; a run that began anew on the disk below, and ended well there, has written nothing on it."""
    below = {*os.listdir(trials.folder)}
    assert below <= {"out.nc.parts", *(["out.nc"] if code == 0 else [])}, below
    empty(trials)
    mount("--move", trials.folder.parent / "kept", trials.folder)
    if "out.nc" in below:
        (trials.folder.parent / "stderr").write_text("it stood on the disk below\n")
        return 4
    return code


CHANGES: Final[dict[str, tuple[Callable[[Trials], None], Callable[[Trials, int], int]]]] = {
    "read-only": (make_read_only, make_writable),
    "gone": (take_away, bring_back),
}
"""What becomes of a disk, and how that is undone."""


def changed_while_stopped(trials: Trials, what: str, pid: int, *, overwrite: bool) -> int | None:
    """Change the disk while a run is stopped, let it go on, and check what it leaves; None where it ended before."""
    _, status = os.waitpid(pid, os.WUNTRACED)
    if not os.WIFSTOPPED(status):
        assert checked(trials, os.waitstatus_to_exitcode(status), overwrite=overwrite) == 0
        return None
    change, undo = CHANGES[what]
    change(trials)
    os.kill(pid, signal.SIGCONT)
    return checked(trials, undo(trials, ended(pid)), overwrite=overwrite)


def at_every_change_of_a_name(trials: Trials, what: str, every: int = 1) -> Counter[int]:
    """Change the disk before a run's n-th change of a name, for every n or each so many."""
    codes: Counter[int] = Counter()
    for number in range(1, 1000, every):
        overwrite = len(range(1, number, every)) % 2 == 0
        options = prepared(trials, overwrite=overwrite)
        pid = run(trials.study, trials.output, *options, before=partial(signal_at, number, signal.SIGSTOP, after=False))
        code = changed_while_stopped(trials, what, pid, overwrite=overwrite)
        if code is None:
            return codes
        codes[code] += 1
    raise AssertionError("it never ends")


def at_random_moments(trials: Trials, what: str, count: int, draw: random.Random) -> Counter[int]:
    """Change the disk at random moments: some fall between two changes of a name, some after the end."""
    codes: Counter[int] = Counter()
    for number in range(count):
        overwrite = number % 2 == 0
        pid = run(trials.study, trials.output, *prepared(trials, overwrite=overwrite))
        time.sleep(draw.uniform(0.0, 1.1 * trials.seconds))
        os.kill(pid, signal.SIGSTOP)
        codes[changed_while_stopped(trials, what, pid, overwrite=overwrite) or 0] += 1
    return codes


def in_words(codes: Counter[int]) -> str:
    return f"{codes.total():,} ({codes[4]:,} ended with exit code 4)"


def main() -> None:
    if "--inside" not in sys.argv:
        command = ["unshare", "-m", sys.executable, "-m", "tests.faults.disks", "--inside", *sys.argv[1:]]
        sys.exit(subprocess.run(command, check=False).returncode)
    numbers = [int(word) for word in sys.argv[1:] if word.isdigit()]
    step, count = numbers or (1, 100)
    interrupts.listen()
    start, draw = time.monotonic(), random.Random(11)
    with tempfile.TemporaryDirectory(dir=in_memory(2**26)) as folder:
        trials = Trials(Path(folder))
        (Path(folder) / "kept").mkdir()
        prepared(trials, overwrite=False)
        mount("--make-rprivate", "/")
        mount("-t", "tmpfs", "-o", "size=64m", "none", trials.folder)
        words = [f"full disks, page by page: {in_words(full(trials, step))}"]
        for what in CHANGES:
            words.append(f"{what} at a change of a name: {in_words(at_every_change_of_a_name(trials, what, step))}")
            words.append(f"{what} at a random moment: {in_words(at_random_moments(trials, what, count, draw))}")
        subprocess.run(["umount", trials.folder], check=True)
    print(f"runs on {'; '.join(words)}; nothing lost, {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main()
