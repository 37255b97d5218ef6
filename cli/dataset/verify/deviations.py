"""What `gradhesion verify` has found, in words: the deviations, the worst first, what was left out, the verdict."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from gradhesion.cli.dataset.verify.recompute import Deviation, Recomputed
from gradhesion.cli.terminal.amounts import counted

ROWS: Final = 12
"""Deviations that are printed one by one."""


def lines_of(found: Recomputed, title: str, file: Path, *, digits: bool) -> Iterator[str]:
    """Report what was found, line by line."""
    yield title
    yield (
        f"{file}: {found.scenes:,} of {counted(found.total, 'scene')} recomputed (--seed {found.seed}), "
        f"{counted(len(found.deviations), 'value')}, solver {' and '.join(found.solvers)}"
    )
    yield ""
    yield f"{'worst first':<18} {'deviation':<10} {'stated':<10} {'share':<9} scene"
    for one in found.deviations[:ROWS]:
        yield _row(one)
        if digits:
            yield f"  in the dataset   {int(one.value) if one.output.endswith('_jumps') else one.value!r}"
            yield f"  recomputed       {one.expected}"
    if len(found.deviations) > ROWS:
        rest = found.deviations[ROWS].share
        yield f"... and {len(found.deviations) - ROWS:,} more, none beyond {rest:.2g} of its stated error"
    yield ""
    yield f"{'worst of each':<18} {'deviation':<10} {'stated':<10} {'share':<9} values"
    for output in dict.fromkeys(one.output for one in found.deviations):
        of_output = [one for one in found.deviations if one.output == output]
        yield f"{_numbers(of_output[0])} {len(of_output):,}"
    yield from _left_out(found)
    yield ""
    if found.exceeding:
        values = counted(len(found.deviations), "value")
        yield f"{found.exceeding:,} of {values} deviate by more than their stated errors"
    else:
        yield f"all {len(found.deviations):,} values are within their stated errors"


def _row(one: Deviation) -> str:
    """
    Write a deviation.

    >>> _row(Deviation(output="delta_max", scene={"k": 0.5}, value=1.0, expected="1", deviation=0.0, stated=1e-13))
    'delta_max          0          1e-13      0         k = 0.5'
    """
    scene = (
        ", ".join(
            f"{name} = {value}" if isinstance(value, str) else f"{name} = {value:g}"
            for name, value in one.scene.items()
        )
        or "the only scene"
    )
    return f"{_numbers(one)} {scene}"


def _numbers(one: Deviation) -> str:
    return f"{one.output:<18} {one.deviation:<10.2g} {one.stated:<10.2g} {one.share:<9.2g}"


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
