"""What `gradhesion verify` has found, in words: the deviations, the worst first, what was left out, the verdict."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from gradhesion.cli.dataset.verify.recompute import Deviation, Recomputed
from gradhesion.cli.terminal.amounts import counted

ROWS: Final = 12
"""Deviations that are printed one by one."""


def lines_of(found: Recomputed, title: str, file: Path) -> Iterator[str]:
    """Report what was found, line by line."""
    every = found.deviations
    yield title
    yield (
        f"{file}: {found.scenes:,} of {counted(found.total, 'scene')} recomputed (--seed {found.seed}), "
        f"{counted(len(every), 'value')}, solver {' and '.join(found.solvers)}"
    )
    width = max(len("worst of each"), *(len(one.output) for one in every))
    heads = f"{'deviation':<10} {'stated':<10} {'share':<9}"
    yield ""
    yield f"{'worst first':<{width}} {heads} scene"
    for one in every[:ROWS]:
        scene = ", ".join(
            f"{name} = {value if isinstance(value, str) else f'{value:g}'}" for name, value in one.scene.items()
        )
        yield f"{_numbers(one, width)} {scene or 'the only scene'}"
    if len(every) > ROWS:
        yield f"... and {len(every) - ROWS:,} more, none beyond {every[ROWS].share:.2g} of its stated error"
    yield ""
    yield f"{'worst of each':<{width}} {heads} values"
    for output in dict.fromkeys(one.output for one in every):
        of_output = [one for one in every if one.output == output]
        yield f"{_numbers(of_output[0], width)} {len(of_output):,}"
    yield from _left_out(found)
    yield ""
    if found.exceeding:
        yield f"{found.exceeding:,} of {counted(len(every), 'value')} deviate by more than their stated errors"
    else:
        yield f"all {len(every):,} values are within their stated errors"


def _numbers(one: Deviation, width: int) -> str:
    """Write the first columns of a deviation."""
    return f"{one.output:<{width}} {one.deviation:<10.2g} {one.stated:<10.2g} {one.share:<9.2g}"


def _left_out(found: Recomputed) -> Iterator[str]:
    """Report what was not compared, and why."""
    reasons = [
        (found.beyond, "sampled scenes have more waves than can be followed; others were drawn instead"),
        (found.failed, "sampled scenes have failed, as their status shows"),
        (found.unsure, "scenes lie too close to where two folds meet, or too far out, for 51 digits"),
        *((count, f"values may be either of two ({reason})") for reason, count in found.near.items()),
    ]
    written = [f"  {count:,} {reason}" for count, reason in reasons if count]
    if found.unknown:
        written.append(f"  {', '.join(found.unknown)}: there is no independent solution to compare with")
    if written:
        yield ""
        yield "left out"
        yield from written
