"""Write the code of kernels for the processor of numba's environment: `python -m wheels.kernels FOLDER KIND...`."""

import sys
from pathlib import Path

from gradhesion.cli.work.kernels.warming import warm
from gradhesion.core import KINDS, compile_kind
from gradhesion.core.compiler import ahead, keeping, linking
from gradhesion.core.compiler.probe import LAZY
from gradhesion.core.kinds import before
from gradhesion.core.processors import processors


def main(folder: Path, kinds: list[str]) -> None:
    """Compile side by side, then read all of it and write it down."""
    if not LAZY:
        raise SystemExit(
            "this numba links kernels in its ordinary way, whose code cannot be carried: see core/compiler/linking.py"
        )
    warm(kinds, processors())
    needed = [kind for kind in KINDS if any(kind in {wanted, *before(wanted)} for wanted in kinds)]
    for kind in needed:
        compile_kind(kind)
    code = {name: data for entry in linking.entries() for name, data in keeping.code_of(entry).items()}
    ahead.write(folder, code, needed)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
