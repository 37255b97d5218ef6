"""Build a wheel that carries compiled kernels: `python -m wheels`, or `make wheel`.

The kernels are compiled for a processor that most have (core/compiler/ahead.py), by this Python, numba and numpy.
Where these are others, and on other processors, the program compiles as it does from its sources.
"""

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from gradhesion.core import KINDS
from gradhesion.core.compiler.ahead import FEATURES, FOLDER, PROCESSOR, lacking
from gradhesion.core.compiler.sources import COMPILED, WITHOUT_KERNELS, digest_of
from wheels import package

ROOT: Final = Path(__file__).parents[1]


def build(target: Path, kept: Path, kinds: tuple[str, ...]) -> Path:
    """Build the wheel, with the kernels of some kinds of work.

    Parameters
    ----------
    target
        The folder of the wheel.
    kept
        A folder for what is compiled, so that the next wheel of the same sources is built faster.
    kinds
        Kinds of work (core/kinds.py).

    Returns
    -------
    The wheel.
    """
    with TemporaryDirectory() as name:
        tree = Path(name) / "tree"
        package.copy(ROOT, tree)
        if digest_of(tree / "core", WITHOUT_KERNELS) != COMPILED:
            raise SystemExit(
                f"Python imports kernels of another tree than {ROOT}: install this one with pip install -e ."
            )
        environment = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")} | {
            "NUMBA_CPU_NAME": PROCESSOR,
            "NUMBA_CPU_FEATURES": ",".join(f"+{feature}" for feature in FEATURES),
            "NUMBA_CACHE_DIR": str(kept),
        }
        command = [sys.executable, "-m", "wheels.kernels", str(tree / "core" / FOLDER.name), *kinds]
        subprocess.run(command, cwd=ROOT, env=environment, check=True)
        return package.wheel(tree, target)


def main() -> None:
    """Build it, and print its name and size and the time that it took."""
    parser = argparse.ArgumentParser(prog="python -m wheels", description=__doc__.partition("\n")[0])
    parser.add_argument("--target", type=Path, default=ROOT / "dist", help="the folder of the wheel")
    parser.add_argument("--kept", type=Path, default=ROOT / "build" / "wheels", help="a folder for what is compiled")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS, help="kinds of work, all if not given")
    given, start = parser.parse_args(), time.monotonic()
    if lacks := lacking(FEATURES):
        raise SystemExit(f"kernels for {PROCESSOR} are also run here, and this processor lacks {', '.join(lacks)}")
    path = build(given.target.resolve(), given.kept.resolve(), tuple(given.kinds))
    print(f"{path}: {path.stat().st_size / 1e6:.1f} MB in {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main()
