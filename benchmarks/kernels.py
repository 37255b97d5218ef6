"""The kernels that a kind of work compiles, and the modules in which they stand: `python -m benchmarks.kernels [KIND]`.

Without a kind, a row for each: kernels, modules, and the CPU seconds of their compilation after what the kind needs.
All are compiled anew, in a folder of their own.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter

from gradhesion.core import KINDS, compile_kind, watch_compilation
from gradhesion.core.kinds import before


def compiled(kind: str) -> tuple[Counter[str], float]:
    """Return how many kernels of each module a kind compiles beside those that it needs, and the CPU seconds."""
    for needed in sorted(before(kind), key=KINDS.index):
        compile_kind(needed)
    modules: Counter[str] = Counter()
    start = time.process_time()
    with watch_compilation(lambda name: modules.update([name.rpartition(".")[0]])):
        compile_kind(kind)
    return modules, time.process_time() - start


def main() -> None:
    """Print the table, or the modules of one kind."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", nargs="?", choices=KINDS)
    kind = parser.parse_args().kind
    if kind and "GRADHESION_KERNELS" in os.environ:
        modules, seconds = compiled(kind)
        print(f"| `{kind}` | {sum(modules.values())} | {len(modules)} | {seconds:.1f} |")
        for module, count in sorted(modules.items()):
            print(f"{count:5d}  {module}", file=sys.stderr)
        return
    print("| kind | kernels | modules | CPU s |\n| --- | --- | --- | --- |", flush=True)
    for one in [kind] if kind else KINDS:
        with tempfile.TemporaryDirectory() as folder:
            environment = os.environ | {"GRADHESION_KERNELS": "own", "NUMBA_CACHE_DIR": folder}
            quiet = None if kind else subprocess.DEVNULL
            subprocess.run([sys.executable, "-m", "benchmarks.kernels", one], env=environment, stderr=quiet, check=True)


if __name__ == "__main__":
    main()
