"""Which key gives each parameter: exactly one does, and some may be left out where they have no effect."""

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from gradhesion.cli.keys import INPUTS, Key, Path
from gradhesion.cli.study.form.axes import Values
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.terminal.wording import example, line_of

ABSENT: Final = {"c0_over_R": ("k", "k = 0"), "lambda_over_R": ("A", "A = 0")}
"""The parameters without effect where another is zero: that other one, and the condition in words."""

_ROLES: Final = tuple(key for key in INPUTS.values() if key.role)
_OTHERS: Final[dict[str, list[Path]]] = {
    role.name: [(key.table, key.name) for key in INPUTS.values() if key.gives == role.name and not key.is_parameter]
    for role in _ROLES
}
"""The other keys that give a parameter."""


def mistakes_of_roles(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check that exactly one key gives each parameter that more than one can give."""
    if ("parameters",) in checked.wrong and "parameters" not in checked.data:
        return
    for role in _ROLES:
        if role.name == "modulus" and has_units(checked):
            yield from _mistakes_of_modulus(checked)
        else:
            yield from _mistakes_of_role(role, checked, sound)


def left_out(sound: Mapping[str, Values], *, with_units: bool) -> dict[str, float]:
    """
    Give the inputs that a valid study leaves out, with the values that they then have.

    >>> left_out({"k": 0.0, "nu": 0.3, "modulus": 500.0, "A": 0.1, "lambda_over_R": 0.2}, with_units=False)
    {'a_max_over_R': inf, 'c0_over_R': 1.0}
    """
    given = {INPUTS[name].gives for name in sound}
    absent = {name: 1.0 for name, (other, _) in ABSENT.items() if name not in given and _is_zero(other, sound)}
    rim = {} if "a_max_over_R" in given else {"a_max" if with_units else "a_max_over_R": np.inf}
    return rim | absent


def _is_zero(parameter: str, sound: Mapping[str, Values]) -> bool:
    """Report whether a parameter is given, and zero everywhere."""
    own = [values for name, values in sound.items() if INPUTS[name].gives == parameter]
    return bool(own) and not any(np.any(np.asarray(values)) for values in own)


def has_units(checked: Checked) -> bool:
    """Report whether the study has a table [physical], right or wrong."""
    return isinstance(checked.data.get("physical"), Mapping)


def is_given(checked: Checked, path: Path) -> bool:
    """Report whether a key is there, right or wrong."""
    table = checked.data.get(str(path[0]))
    return isinstance(table, Mapping) and path[1] in table


def _mistakes_of_modulus(checked: Checked) -> Iterator[Mistake]:
    """Check that all quantities are there that make the reduced modulus."""
    path: Path = ("parameters", "modulus")
    if is_given(checked, path):
        yield mixed(path, checked, ["R", "E_star", "work_of_adhesion"])
    ways: dict[str, list[Path]] = {}
    for key in INPUTS.values():
        if key.table == "physical" and key.gives == "modulus":
            ways.setdefault(key.instead_of or key.name, []).append(("physical", key.name))
    for paths in ways.values():
        yield from _repeated(paths, checked, "the modulus")
        if not any(is_given(checked, path) or path in checked.meant for path in paths):
            yield _absent(paths, "quantity", "")


def _mistakes_of_role(role: Key, checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check that one key gives a parameter, unless it may be left out."""
    plain: Path = ("parameters", role.name)
    tied, united = ([path for path in _OTHERS[role.name] if path[0] == table] for table in ("parameters", "physical"))
    if has_units(checked) and role.name != "A":
        if is_given(checked, plain):
            yield mixed(plain, checked, [str(path[1]) for path in united])
            return
        paths = [*united, *tied]
    else:
        paths = [plain, *tied, *(united if has_units(checked) else [])]
    yield from _repeated(paths, checked, role.role)
    if any(is_given(checked, path) or path in checked.meant for path in paths) or role.name == "a_max_over_R":
        return
    other, condition = ABSENT.get(role.name, ("", ""))
    if not (other and _is_zero(other, sound)):
        what = "quantity" if paths[0][0] == "physical" else "parameter"
        yield _absent(paths, what, f"unless {condition} everywhere, " if condition else "")


def mixed(path: Path, checked: Checked, keys: list[str]) -> Mistake:
    """Say that a ratio stands beside quantities with units."""
    sentence = (
        "a ratio, where [physical] gives quantities with units, and the two cannot be combined; remove it "
        f"and give {', '.join(keys)} under [physical], or remove [physical]"
    )
    return Mistake(path, checked.data[str(path[0])][path[1]], sentence)


def _repeated(paths: list[Path], checked: Checked, role: str) -> Iterator[Mistake]:
    """Say which keys give again what another gives already."""
    given = [path for path in paths if is_given(checked, path)]
    for path in given[1:]:
        sentence = f"{given[0][1]} gives {role} already; keep one of the two and remove the other"
        yield Mistake(path, checked.data[str(path[0])][path[1]], sentence)


def _absent(paths: list[Path], what: str, unless: str) -> Mistake:
    """Say that a parameter is missing, and which keys can give it."""
    instead = " or ".join(
        line_of(path) + (f" under [{path[0]}]" if path[0] != paths[0][0] else "") for path in paths[1:]
    )
    sentence = f"{unless}this {what} is required; {example(paths[0])}" + (f", or instead {instead}" if instead else "")
    return Mistake(paths[0], None, sentence)
