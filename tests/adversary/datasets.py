"""Datasets that are changed at random: attributes, variables, dimensions, values and bytes."""

import hashlib
import random
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

ODD: tuple[Any, ...] = (
    "", "x", "\x1b[31m", "\n", "y" * 5000, "$\\bad{$", "{0}", "%s", "inf", "1", 1, -1, 0.5, np.nan, np.inf, np.int8(3),
    np.array([1.0, 2.0]), np.array([1, 2], dtype="i1"), 2**62,
)  # fmt: skip
"""Values of attributes."""
NUMBERS = (np.nan, np.inf, -np.inf, -1.0, 0.0, 1.0, 1e300, -1e300, 1e-300, 2.0**40)
TYPES = ("f4", "f8", "i1", "i2", "i4", "i8", "u1", "u8", "S1", "str")


@dataclass
class Variable:
    """A variable that can be written again."""

    dimensions: list[str]
    dtype: str
    attributes: dict[str, Any]
    values: Any


@dataclass
class Content:
    """All of a dataset."""

    sizes: dict[str, int]
    attributes: dict[str, Any]
    variables: dict[str, Variable] = field(default_factory=dict)

    @classmethod
    def of(cls, path: Path) -> "Content":
        """Read a dataset."""
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            content = cls(
                {name: one.size for name, one in file.dimensions.items()},
                {name: file.getncattr(name) for name in file.ncattrs()},
            )
            for name, one in file.variables.items():
                dtype = "str" if one.dtype is str else one.dtype.str[1:]
                attributes = {each: one.getncattr(each) for each in one.ncattrs()}
                content.variables[name] = Variable([*one.dimensions], dtype, attributes, np.asarray(one[...]))
        return content

    def write(self, path: Path) -> None:
        """Write a dataset; what NetCDF does not take is left out."""
        path.unlink(missing_ok=True)
        with netCDF4.Dataset(path, "w") as file:
            for name, size in self.sizes.items():
                file.createDimension(name, size)
            _attributes(file, self.attributes)
            for name, one in self.variables.items():
                fill = {"fill_value": one.attributes["_FillValue"]} if _is_fill(one) else {}
                try:
                    made = file.createVariable(name, str if one.dtype == "str" else one.dtype, one.dimensions, **fill)
                except (RuntimeError, ValueError, TypeError, KeyError, OverflowError):
                    continue
                _attributes(made, {key: value for key, value in one.attributes.items() if key != "_FillValue"})
                try:
                    if one.values is not None:
                        with np.errstate(all="ignore"):
                            made[...] = one.values
                except (RuntimeError, ValueError, TypeError, IndexError, OverflowError, AttributeError, MemoryError):
                    pass


def _is_fill(one: Variable) -> bool:
    return "_FillValue" in one.attributes and one.dtype[0] in "fi" and np.ndim(one.attributes["_FillValue"]) == 0


def _attributes(target: Any, attributes: dict[str, Any]) -> None:
    for name, value in attributes.items():
        try:
            target.setncattr(name, value)
        except (RuntimeError, ValueError, TypeError, AttributeError, OverflowError):
            continue


def mutate(content: Content, draw: random.Random) -> str:
    """Change something, and say what."""
    changes = (_attribute, _attribute, _value, _value, _type, _dimensions, _without, _renamed, _size, _study)
    return draw.choice(changes)(content, draw)


def _attribute(content: Content, draw: random.Random) -> str:
    """Remove an attribute, or give it another value."""
    owner = draw.choice(["", "", *content.variables])
    attributes = content.variables[owner].attributes if owner else content.attributes
    name = draw.choice([*attributes, "units", "_FillValue", "scale_factor", "calendar", "coordinates"])
    if draw.random() < 0.3:
        attributes.pop(name, None)
        return f"{owner}:{name} removed"
    value = draw.choice([*ODD, "days since 2000-01-01", "hours", "status k nothing"])
    attributes[name] = value
    return f"{owner}:{name} = {str(value)[:30]!r}"


def _value(content: Content, draw: random.Random) -> str:
    """Set a value of a variable, or all."""
    name = draw.choice([*content.variables])
    one = content.variables[name]
    if one.values is None or np.asarray(one.values).dtype.kind not in "fiu" or not np.size(one.values):
        return f"{name} stays"
    number = draw.choice(NUMBERS)
    values = np.array(one.values, dtype=one.values.dtype)
    with np.errstate(all="ignore"):
        number = (
            number if values.dtype.kind == "f" else np.array(np.nan_to_num(number)).astype("i8").astype(values.dtype)
        )
    place: Any = ... if draw.random() < 0.3 else np.unravel_index(draw.randrange(values.size), values.shape)
    values[place] = number
    one.values = values
    return f"{name}[{'all' if place is ... else 'one'}] = {number}"


def _type(content: Content, draw: random.Random) -> str:
    """Give a variable another type."""
    name = draw.choice([*content.variables])
    content.variables[name].dtype = draw.choice(TYPES)
    content.variables[name].attributes.pop("_FillValue", None)
    if content.variables[name].dtype == "str":
        content.variables[name].values = np.full(np.shape(content.variables[name].values), "x\x1b[1m", dtype=object)
    return f"{name} of type {content.variables[name].dtype}"


def _dimensions(content: Content, draw: random.Random) -> str:
    """Take a dimension of a variable away, turn them round, or add one."""
    name = draw.choice([*content.variables])
    one = content.variables[name]
    how = draw.choice(["drop", "turn", "add", "none"])
    if how == "drop" and one.dimensions:
        axis = draw.randrange(len(one.dimensions))
        one.dimensions.pop(axis)
        one.values = (
            None if one.values is None else np.take(one.values, 0, axis=axis) if np.ndim(one.values) > axis else None
        )
    elif how == "turn":
        one.dimensions.reverse()
        one.values = None if one.values is None else np.transpose(one.values)
    elif how == "add" and content.sizes:
        one.dimensions.append(draw.choice([*content.sizes]))
    elif how == "none":
        one.dimensions, one.values = [], None
    return f"{name}: {how} a dimension"


def _without(content: Content, draw: random.Random) -> str:
    """Take a variable away."""
    name = draw.choice([*content.variables])
    del content.variables[name]
    return f"without {name}"


def _renamed(content: Content, draw: random.Random) -> str:
    """Give a variable the name of another, or a new one."""
    name = draw.choice([*content.variables])
    new = draw.choice([*content.variables, "x", "k2", "solver", "scene", "jump_count", "path_point", "R", "stable"])
    content.variables[new] = content.variables.pop(name)
    return f"{name} is {new}"


def _size(content: Content, draw: random.Random) -> str:
    """Give a dimension another size; values that do not fit are left out."""
    if not content.sizes:
        return "no size"
    name = draw.choice([*content.sizes])
    content.sizes[name] = draw.choice([0, 1, 2, 3, 100, 2**36])
    return f"{name} of size {content.sizes[name]}"


def _study(content: Content, draw: random.Random) -> str:
    """Change the study, with its fingerprint or without."""
    text = str(content.attributes.get("study", ""))
    old, new = draw.choice(
        [
            ("0.3", "0.29"),
            ("[", "[["),
            ("k", "kk"),
            ('"map"', '"curve"'),
            ("=", "= ="),
            ("\n", "\na.b.c = 1\n"),
            ("inf", "nan"),
        ]
    )
    content.attributes["study"] = draw.choice(
        [text.replace(old, new, 1), "", "x = ", text + "\n[x]\n", "a." * 5000 + "b = 1"]
    )
    if draw.random() < 0.8:
        content.attributes["study_sha256"] = hashlib.sha256(content.attributes["study"].encode()).hexdigest()
    return f"study {old} -> {new}"


def damage(content: bytes, draw: random.Random) -> bytes:
    """Change bytes of a file, or cut it short."""
    if draw.random() < 0.3:
        return content[: draw.randrange(len(content))]
    changed = bytearray(content)
    for _ in range(draw.randrange(1, 9)):
        changed[draw.randrange(len(changed))] = draw.randrange(256)
    return bytes(changed)
