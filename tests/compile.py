"""Compile the kernels that tests need, each once: processes that run tests side by side would compile them twice.

`python -m tests.compile` does so in two processes, and checks that none is compiled and kept by both.
"""

from itertools import combinations

from gradhesion.cli.work.kernels.warming import warm
from gradhesion.core import APART, KINDS
from gradhesion.core.kinds import before


def main() -> None:
    """Compile all kinds of work."""
    done: dict[str, set[str]] = {}
    warm(KINDS, 2, lambda kind, names: done.update({kind: {*names}}), kept=True)
    side_by_side = {}
    for one, other in combinations(done, 2):
        if one not in before(other) and other not in before(one) and {one, other} not in APART:
            side_by_side[one, other] = sorted(done[one] & done[other])
    twice = {pair: names for pair, names in side_by_side.items() if names}
    assert not twice, f"may run side by side, and compile the same: {twice}"


if __name__ == "__main__":
    main()
