"""The form of a study: which keys there are, and which values each of them takes.

pydantic checks the form of the whole study at once and gives its JSON Schema; its findings become sentences in
`gradhesion.cli.study.mistakes`. What two keys have to do with each other is in `gradhesion.cli.study.rules`.
"""

from collections.abc import Mapping
from functools import cache
from typing import Annotated, Any, Final, Literal, Union

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, create_model

from gradhesion.cli.names import KEYS, MACHINE, PHYSICAL, RIM_KEYS, ROLES, SETTINGS, TIED, table_of
from gradhesion.core.profile import MOST_HARMONICS

LAYOUTS: Final = ("grid", "points")
KINDS: Final = ("map", "curve")

BOUNDS: Final[dict[str, tuple[dict[str, float], str]]] = {
    "k": ({"ge": 0.0, "le": 1.0}, "0 <= k <= 1"),
    "nu": ({"gt": -1.0, "le": 0.5}, "-1 < nu <= 0.5"),
    "modulus": ({"gt": 0.0}, "modulus > 0, and finite"),
    "c0_over_R": ({"gt": 0.0}, "c0_over_R > 0, and finite"),
    "lambda_over_R": ({"gt": 0.0}, "lambda_over_R > 0, and finite"),
    "A": ({"ge": 0.0}, "A >= 0, and finite"),
    "a_max_over_R": ({"gt": 0.0}, "a_max_over_R > 0 (inf: an unbounded punch)"),
    "lambda_over_L": ({"gt": 0.0}, "lambda_over_L > 0, and finite"),
    "chi": ({"ge": 0.0}, "chi >= 0, and finite"),
    "a_max_over_L": ({"gt": 0.0}, "a_max_over_L > 0 (inf: an unbounded punch)"),
    "a_max_over_a2": ({"gt": 0.0}, "a_max_over_a2 > 0 (inf: an unbounded punch)"),
    MACHINE: ({"gt": 0.0}, "machine_stiffness > 0, and finite"),
    **{key: ({"gt": 0.0}, f"{key} > 0, and finite") for key in PHYSICAL},
    "amplitude": ({"ge": 0.0}, "amplitude >= 0, and finite"),
    "a_max": ({"gt": 0.0}, "a_max > 0 (inf: an unbounded punch)"),
}
"""The bounds of each key that gives parameters, for pydantic and in words."""


MOST_WAVES: Final = 10_000
"""The shortest wave of a series, in waves a wavelength: beyond it hardly any scene can be followed."""


class _Table(BaseModel):
    """A table of a study: no unknown keys, no silent conversions."""

    model_config = ConfigDict(extra="forbid", strict=True)


class _Method(_Table):
    """How the scenes are solved."""

    solver: Annotated[
        Annotated[str, Tag("name")] | Annotated[list[str], Field(min_length=1), Tag("list")],
        Discriminator(lambda value: "list" if isinstance(value, list) else "name"),
        Field(description=SETTINGS["solver"]),
    ] = "exact"
    check_contact: Annotated[bool, Field(description=SETTINGS["check_contact"])] = True


class _Harmonic(_Table):
    """One wave of the series of a profile."""

    n: Annotated[int, Field(ge=1, le=MOST_WAVES, description=SETTINGS["n"])]
    cos: Annotated[float, Field(allow_inf_nan=False, description=SETTINGS["cos"])] = 0.0
    sin: Annotated[float, Field(allow_inf_nan=False, description=SETTINGS["sin"])] = 0.0


class _Profile(_Table):
    """The shape of the punch."""

    exponent: Annotated[float, Field(ge=1.0, allow_inf_nan=False, description=SETTINGS["exponent"])] = 2.0
    harmonics: Annotated[
        Annotated[list[_Harmonic], Field(min_length=1, max_length=MOST_HARMONICS)] | None,
        Field(description=SETTINGS["harmonics"]),
    ] = None


def _form(value: object) -> str:
    """Tell which of the three forms of a parameter is meant."""
    return "range" if isinstance(value, Mapping) else "list" if isinstance(value, list) else "number"


def _parameter(name: str) -> Any:
    """Make the type of a parameter: a number, a list of them, or a range table."""
    bounds: dict[str, Any] = dict(BOUNDS[name][0])
    finite: Any = Annotated[float, Field(strict=True, allow_inf_nan=False, **bounds)]
    number: Any = Annotated[float, Field(strict=True, **bounds)] if name in RIM_KEYS else finite
    return _forms(name, number, finite)


def _quantity(name: str) -> Any:
    """Make the type of a quantity with a unit, a list of them, or a range table; quantities.py reads them."""
    return _forms(name, Any, Any)


def _forms(name: str, number: Any, end: Any) -> Any:
    """Make the type of one value, a list of values, or a range table between two ends."""
    spacing: Any = Literal["linear", "log"]
    range_table: Any = create_model(
        f"Range_{name}",
        __base__=_Table,
        start=(_told(end, "start"), ...),
        stop=(_told(end, "stop"), ...),
        num=(_told(Annotated[int, Field(ge=1)], "num"), ...),
        spacing=(_told(spacing, "spacing"), "linear"),
    )
    forms: Any = Union[  # noqa: UP007 (made at run time)
        Annotated[number, Tag("number")],
        Annotated[list[number], Field(min_length=1), Tag("list")],
        Annotated[range_table, Tag("range")],
    ]
    return Annotated[forms, Discriminator(_form), Field(description=KEYS[name])]


def _told(kind: Any, name: str) -> Any:
    """Make a type tell what its key is."""
    return Annotated[kind, Field(description=SETTINGS[name])]


@cache
def study_model() -> type[BaseModel]:
    """Make the model of a whole study."""
    parameters: dict[str, Any] = {
        name: (_parameter(name), None if name in (*ROLES, *TIED) else ...)
        for name in KEYS
        if table_of(name) == "parameters"
    }
    physical: dict[str, Any] = {name: (_quantity(name), None) for name in PHYSICAL}
    loading: dict[str, Any] = {"control": (_told(str, "control"), "displacement"), MACHINE: (_parameter(MACHINE), None)}
    return create_model(
        "Study",
        __base__=_Table,
        title=(_told(str, "title"), ""),
        kind=(_told(str, "kind"), "map"),
        layout=(_told(str, "layout"), "grid"),
        outputs=(_told(Annotated[list[str], Field(min_length=1)], "outputs"), ...),
        parameters=(_told(create_model("Parameters", __base__=_Table, **parameters), "parameters"), ...),
        physical=(_told(create_model("Physical", __base__=_Table, **physical), "physical"), None),
        profile=(_told(_Profile, "profile"), None),
        loading=(_told(create_model("Loading", __base__=_Table, **loading), "loading"), None),
        method=(_told(_Method, "method"), _Method()),
    )
