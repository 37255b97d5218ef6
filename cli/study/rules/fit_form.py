"""The form of a fit: the columns of measured loops, and what is fitted beside the parameters."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

from gradhesion.cli.study.rules.keys import File, Table, quantity, read_by, said
from gradhesion.cli.study.text.quantities import QUANTITIES, si_value


class ColumnTable(Table):
    """A column of the data, with its unit."""

    column: str = said("name of the column in the header", '"depth"', min_length=1)
    back: str = said("column of unloading, where it stands beside that of loading", '"depth_retract"', "")
    unit: str = said("unit of the column [from the header]", '"nm"', "")
    sign: Literal[1, -1] = said("-1 changes the sign, so that depth grows into the half-space and loads press", "-1", 1)


Column = Annotated[ColumnTable, BeforeValidator(lambda value: {"column": value} if isinstance(value, str) else value)]
Word = Annotated[str, Field(min_length=1)]


class DataTable(File):
    """The measured loop."""

    indentation: Column | None = said("column of the depth, with its unit", '{ column = "depth", unit = "nm" }', None)
    displacement: Column | None = said(
        "instead: column of depth + load/stiffness, that of a machine", '{ column = "piezo", unit = "nm" }', None
    )
    load: Column | None = said(
        "column of the load, with its unit; positive loads press", '{ column = "force", unit = "nN" }', None
    )
    branch: Word | None = said(
        'column of "loading" and "unloading", "approach" and "retract", 0 and 1 [order of points]', '"branch"', None
    )
    leave_out: list[Word] = said(
        'words of branch left out, beside "pause", "hold", "dwell", "creep" and "modulate"', '["wait"]', []
    )
    which: Literal["loading", "unloading"] | None = said("the branch that is fitted [both]", '"unloading"', None)
    cycle: Word | None = said("column with the number of the cycle, a whole number", '"cycle"', None)

    @property
    def depths(self) -> str:
        """The key that names the column of the depths; empty where none does."""
        return "displacement" if self.displacement else "indentation" if self.indentation else ""


def _zero(name: str, *words: str) -> Any:
    """Make the type of a zero of an instrument: a word, false, or the ends of the range in which it is searched."""

    def read(value: object) -> Any:
        if value is False or (isinstance(value, str) and value in words):
            return value
        if not isinstance(value, list) or len(value) != 2:
            end, known = QUANTITIES[name].value.strip('"'), " or ".join(f'"{word}"' for word in words)
            what = f'this must be {known}, false, or a range ["-{end}", "{end}"]; write for example {name} = "free"'
            raise ValueError(what)
        low, high = (si_value(end, name) for end in value)
        if not low < high:
            raise ValueError("the ends of a range must rise; exchange the two")
        return low, high

    return read_by(read, {"anyOf": [{"type": one} for one in ("string", "boolean", "array")]})


class OffsetsTable(Table):
    """Which zeros are fitted."""

    indentation: _zero("indentation", "free", "contact") = said("the zero of depth", '"contact"', "free")  # type: ignore[valid-type]
    load: _zero("load", "free") = said("the zero of load", '["-5 nN", "5 nN"]', "free")  # type: ignore[valid-type]
    slope: bool = said("whether a tilt of the load is fitted", "true", default=False)


def _offsets(value: object) -> object:
    """Read whether all zeros are fitted, or none."""
    both = dict.fromkeys(("indentation", "load"), "free" if value else False)
    return both if isinstance(value, bool) else value


class Noise(Table):
    """Standard deviations of the measured load, and of depth or displacement."""

    load: quantity("load") = said("of the load", '"0.5 nN"', gt=0.0)  # type: ignore[valid-type]
    indentation: quantity("indentation") | None = said("of the depth", '"0.1 nm"', None, gt=0.0)  # type: ignore[valid-type]
    displacement: quantity("indentation") | None = said("of the displacement", '"0.1 nm"', None, gt=0.0)  # type: ignore[valid-type]


class FitTable(Table):
    """What is fitted beside the parameters, and how."""

    offsets: Annotated[
        OffsetsTable, BeforeValidator(_offsets), WithJsonSchema({"anyOf": [{"type": "boolean"}, {"type": "object"}]})
    ] = said(
        "whether the zeros are also fitted; as a table `indentation`, `load` and, for a tilt, `slope`",
        '{ indentation = ["-1 um", "2 um"], load = "free", slope = true }',
        default=True,
        validate_default=True,
    )
    average: bool = said(
        "whether more than 2,000 points are averaged along the path, never across a jump", "false", default=True
    )
    noise: Noise | None = said(
        "standard deviations of the data [estimated from them]", '{ load = "0.5 nN", indentation = "0.1 nm" }', None
    )
    intervals: Literal["profile", "linear"] = said(
        "95 % intervals from profile likelihoods, or from the linearised problem", '"profile"', "profile"
    )
    starts: int = said("maximum number of refinements, each from other starting values", "32", 32, ge=1, le=4096)
