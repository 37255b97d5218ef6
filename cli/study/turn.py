"""What a cycle turns at before the rim: at most one depth or load, which the exact solver finds."""

from collections.abc import Iterator
from typing import Any, Final

from gradhesion.cli.keys import INPUTS, TURNS, Path
from gradhesion.cli.study.mistakes import Checked, Mistake

KEYS: Final[tuple[Path, ...]] = tuple((key.table, key.name) for key in INPUTS.values() if key.gives in TURNS)
"""Every key that gives a turning point, the ones with units before their ratios."""


def mistakes_of_turn(checked: Checked) -> Iterator[Mistake]:
    """Check that a study has one turning point at most, in the units of its other keys, and a solver that finds it."""
    tables: dict[str, Any] = {table: checked.data.get(table) for table in ("parameters", "physical")}
    given = [path for path in KEYS if isinstance(tables[str(path[0])], dict) and path[1] in tables[str(path[0])]]
    for path in given[1:]:
        sentence = f"a cycle turns at one depth or load, and {given[0][1]} gives it already; remove one of the two"
        yield Mistake(path, tables[str(path[0])][path[1]], sentence)
    with_units = isinstance(tables["physical"], dict)
    for path in given:
        if with_units and path[0] == "parameters":
            own = next(key.name for key in INPUTS.values() if key.gives == path[1] and key.table == "physical")
            sentence = (
                "a ratio, where [physical] gives quantities with units, and the two ways do not mix; "
                f"write {own} under [physical], or remove [physical]"
            )
            yield Mistake(path, tables["parameters"][path[1]], sentence)
    other = next((one for one in checked.form.method.solvers if one in ("asymptotic", "envelope")), None)
    if given and other:
        sentence = f'the solver "{other}" turns at the rim alone; write solver = "exact", or remove {given[0][1]}'
        yield Mistake(("method", "solver"), checked.form.method.solver, sentence)
