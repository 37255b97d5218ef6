"""Kills, disks, changed folders of parts, hostile names, and scenes: what came of each, on a line.

python -m tests.adversary.trials --parts 1000 --names 300 --scenes 10000 --seed 7
"""

import argparse
import multiprocessing
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Final

from tests.adversary import parts
from tests.adversary.commands import fault_of
from tests.adversary.kills import trials_of_kills
from tests.adversary.names import faults_of_names
from tests.adversary.scenes import trials_of_scenes

PUNCH: Final = "[parameters]\nk = [0.0, 0.31]\nnu = 0.3\nmodulus = 430.0\nc0_over_R = 0.013\n"
MAP: Final = f"""\
outputs = ["pull_off_force", "dissipated_energy", "loading_jumps"]
{PUNCH}lambda_over_R = {{ start = 0.11, stop = 0.47, num = 3, spacing = "log" }}
A = [0.0, 0.023]
a_max_over_R = [1.7, inf]
"""

Faults = Counter[tuple[str, str]]
Trial = Callable[[Path, int, random.Random], Faults]


def of_parts(folder: Path, count: int, draw: random.Random) -> Faults:
    """Change folders of parts, and try the commands on them."""
    study, output, kept = folder / "map.toml", folder / "out.nc", folder / "kept"
    study.write_text(MAP)
    os.environ["GRADHESION_CHUNK"] = "2"
    try:
        assert not (fault := fault_of("run", study, "-o", output, "--shard", "1/2", codes=(0,))), fault
        made = Path(f"{output}.parts")
        shutil.move(made, kept)
        faults: Faults = Counter()
        examples: dict[str, str] = {}
        for _ in range(count):
            output.unlink(missing_ok=True)
            shutil.rmtree(made, ignore_errors=True)
            shutil.copytree(kept, made)
            what = "; ".join(parts.mutate(made, draw) for _ in range(draw.choice([1, 1, 2, 3])))
            for name, *options in (
                ("status", output), ("status", output, "--json"), ("plan", study, "-o", output), ("merge", output),
                ("run", study, "-o", output, "--shard", "2/2"), ("run", study, "-o", output), ("run", study, "-o", output, "--overwrite", "--fresh"),
            ):  # fmt: skip
                if fault := fault_of(name, *options):
                    faults[name, examples.setdefault(fault[:60], f"{fault} ({what})")] += 1
        return faults
    finally:
        del os.environ["GRADHESION_CHUNK"]


def of_names(folder: Path, count: int, draw: random.Random) -> Faults:
    """Try the commands on files with hostile names."""
    return Faults(faults_of_names(folder, count, draw))


def _alone(trial: Trial, count: int, seed: int) -> Faults:
    """Do trials in a folder of their own."""
    with tempfile.TemporaryDirectory() as folder:
        return trial(Path(folder), count, random.Random(seed))


def _side_by_side(trial: Trial, count: int, draw: random.Random) -> Faults:
    """Do trials in as many processes as there are cores."""
    cores = min(os.cpu_count() or 1, count)
    counts = [count // cores + (i < count % cores) for i in range(cores)]
    with ProcessPoolExecutor(cores, mp_context=multiprocessing.get_context("spawn")) as pool:
        found = pool.map(_alone, [trial] * cores, counts, [draw.randrange(2**32) for _ in counts])
        return sum(found, Faults())


def rows_of(asked: argparse.Namespace) -> Iterator[tuple[str, int]]:
    """Try all that is asked for: what came of it, in words, and the number of faults."""
    draw = random.Random(asked.seed)
    if asked.kills:
        words = trials_of_kills()
        yield words or "no kills at system calls: strace is not there", not words
    if asked.disks:
        done = subprocess.run(
            [sys.executable, "-m", "tests.adversary.disks"], capture_output=True, text=True, check=False
        )
        yield done.stdout.strip() or done.stderr.strip().splitlines()[-1], done.returncode
    for what, number, trial in (
        ("folders of parts changed at random", asked.parts, of_parts),
        ("hostile names", asked.names, of_names),
    ):
        if not number:
            continue
        start = time.monotonic()
        faults = _side_by_side(trial, number, draw)
        seconds = time.monotonic() - start
        tried = f"{number:,} {what} (seed {asked.seed}), every command tried on each"
        yield f"{tried}: {faults.total():,} commands end as none may; {seconds:.0f} s", faults.total()
        for (name, example), times in faults.most_common():
            yield f"  {times:,} times {name}: {example}", 0
    if asked.scenes:
        words, worst = trials_of_scenes(asked.scenes, asked.seed)
        yield words, int(not worst <= 1.0)


def main() -> None:
    """Try all, and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", type=int, default=1_000)
    parser.add_argument("--names", type=int, default=300)
    parser.add_argument("--scenes", type=int, default=10_000)
    parser.add_argument("--no-kills", dest="kills", action="store_false")
    parser.add_argument("--no-disks", dest="disks", action="store_false")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    faults = 0
    for words, number in rows_of(parser.parse_args()):
        print(words, flush=True)
        faults += number
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
