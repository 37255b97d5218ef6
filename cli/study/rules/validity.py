"""The range of the attraction: the outputs that need it, and the key that gives it."""

from collections.abc import Iterator, Mapping
from typing import Final

from gradhesion.cli.keys import ADHESION_RANGE, INTERACTION, Path
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.terminal.wording import example, line_of

NEED_RANGE: Final = ("tabor_parameter", "wave_tabor_parameter")
"""The outputs that need it."""


def mistakes_of_range(checked: Checked) -> Iterator[Mistake]:
    """Check that one key gives the range where it is needed, and none where it has no effect."""
    paths: tuple[Path, ...] = (("physical", INTERACTION), ("parameters", ADHESION_RANGE))
    with_units = isinstance(checked.data.get("physical"), Mapping)
    tables = {path: checked.data.get(str(path[0])) for path in paths}
    given = [path for path, table in tables.items() if isinstance(table, Mapping) and path[1] in table]
    values = {path: checked.data[str(path[0])][path[1]] for path in given}
    needing = [(i, name) for i, name in enumerate(checked.form.outputs) if name in NEED_RANGE]
    if with_units and paths[1] in given:
        sentence = f"a ratio, where [physical] gives quantities with units; remove it, and {example(paths[0])}"
        yield Mistake(paths[1], values[paths[1]], f"{sentence} under [physical]")
    elif given and not needing and ("outputs",) not in checked.wrong:
        names = " or ".join(f'"{name}"' for name in NEED_RANGE)
        yield Mistake(given[0], values[given[0]], f"no output needs this key; remove it, or add {names} to outputs")
    elif needing and not given and not checked.wrong & {*paths}:
        i, name = needing[0]
        line = f"{line_of(paths[0])} under [physical]" if with_units else f"{line_of(paths[1])} under [parameters]"
        yield Mistake(("outputs", i), name, f"this output needs the range of the attraction; add {line}")
