"""What a cycle turns at before the rim: at most one depth or load, which the exact solver finds."""

from collections.abc import Iterator
from typing import Final

from gradhesion.cli.keys import INPUTS, TURNS, Path
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.study.rules.roles import has_units, is_given, mixed

KEYS: Final[tuple[Path, ...]] = tuple((key.table, key.name) for key in INPUTS.values() if key.gives in TURNS)
"""Every key that gives a turning point, the ones with units before their ratios."""


def mistakes_of_turn(checked: Checked) -> Iterator[Mistake]:
    """Check that a study has one turning point at most, in the units of its other keys, and a solver that finds it."""
    paths = [path for path in KEYS if is_given(checked, path)]
    for path in paths[1:]:
        sentence = f"a cycle turns at one depth or load, and {paths[0][1]} gives it already; remove one of the two"
        yield Mistake(path, checked.data[str(path[0])][path[1]], sentence)
    for path in paths:
        if has_units(checked) and path[0] == "parameters":
            own = [key.name for key in INPUTS.values() if key.gives == path[1] and key.table == "physical"]
            yield mixed(path, checked, own)
    other = next((one for one in checked.form.method.solvers if one in ("asymptotic", "envelope")), None)
    if paths and other:
        sentence = f'the solver "{other}" turns only at the rim; write solver = "exact", or remove {paths[0][1]}'
        yield Mistake(("method", "solver"), checked.form.method.solver, sentence)
