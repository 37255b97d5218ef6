"""Every input of a study, declared once: all that schema, messages, manual, datasets and pictures say derives from it.

Those of a whole study are `INPUTS`; those of a table with a class of its own are fields of that, declared by `setting`.

A parameter is what `solve` takes; a reduced or a physical input stands in the place of one, with the formula by which
that follows. Importing this costs no compiler.
"""

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, Final

POSITIVE: Final = {"gt": 0.0}
NOT_NEGATIVE: Final = {"ge": 0.0}
SHARE: Final = {"ge": 0.0, "le": 1.0}
ANY: Final[dict[str, float]] = {}
"""Bounds, by the names of the comparisons: of `operator`, of pydantic and of NumPy."""


@dataclass(frozen=True)
class Input:
    """One input.

    >>> INPUTS["k"].allowed, INPUTS["a_max"].allowed, INPUTS["k"].admits(1.5)
    ('0 <= k <= 1', 'a_max > 0 (inf: an unbounded punch)', False)
    """

    name: str
    about: str
    """What it is; the `long_name` of its coordinate."""
    symbol: str
    """How a picture writes it."""
    value: str
    """A value that would do, as TOML has it."""
    bounds: Mapping[str, float] = field(default_factory=lambda: POSITIVE)
    unit: str = "1"
    """Its unit, as UDUNITS writes it."""
    table: str = "parameters"
    """The table of a study that it stands in."""
    gives: str = ""
    """The parameter that it is, or that it gives alone or with others."""
    follows: Callable[..., Any] | None = None
    """How that follows from it and from what it `needs`; of reduced inputs closed/reduced.py has the formulas."""
    needs: tuple[str, ...] = ()
    instead_of: str = ""
    """The input that follows from it, where that is no parameter."""
    group: str = ""
    """What it belongs to; empty for what every scene has."""
    infinite: bool = False
    """Whether it may be infinite: an unbounded punch."""
    idle_without: str = ""
    """The parameter at whose zero it has no effect."""
    called: tuple[str, ...] = ()
    """What else people call it, in small letters."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "gives", self.gives or self.name)

    @property
    def is_parameter(self) -> bool:
        """Whether it is a parameter itself, rather than another way to give one."""
        return self.gives == self.name

    @property
    def is_linear(self) -> bool:
        """Whether a search takes it as it is: a share, or what may have either sign; all else by its logarithm."""
        return "le" in self.bounds or not self.bounds

    @property
    def example(self) -> str:
        """A line of TOML that would do."""
        return f"{self.name} = {self.value}"

    @property
    def allowed(self) -> str:
        """Its bounds in words."""
        signs = {"gt": ">", "ge": ">=", "le": "<="}
        if "le" in self.bounds:
            (sign, low), (_, high) = self.bounds.items()
            return f"{low:g} {signs[sign].replace('>', '<')} {self.name} <= {high:g}"
        for sign, low in self.bounds.items():
            rest = " (inf: an unbounded punch)" if self.infinite else ", and finite"
            return f"{self.name} {signs[sign]} {low:g}{rest}"
        return f"-inf < {self.name} < inf"

    def admits(self, values: Any) -> Any:
        """Report which values are within its bounds, a bool for a number and an array for an array; NaN never is."""
        inside = (values == values) if self.infinite else abs(values) < math.inf  # noqa: PLR0124 (NaN)
        for sign, limit in self.bounds.items():
            inside = inside & getattr(operator, sign)(values, limit)
        return inside


_MATERIAL: Final = ("k", "nu", "modulus", "c0_over_R")
_UNIT: Final[dict[str, Any]] = {"table": "physical"}
_LENGTH: Final[dict[str, Any]] = {"table": "physical", "unit": "m", "needs": ("R",), "follows": operator.truediv}
"""A length, which gives its ratio to R."""

INPUTS: Final = {one.name: one for one in (
    Input("k", "gradient exponent k of the modulus E0 (z/c0)^k", "$k$", "0.5 or k = [0.0, 0.5]", SHARE,
          called=("exponent", "gradient", "gradient_exponent")),
    Input("nu", "Poisson's ratio", r"$\nu$", "0.3", {"gt": -1.0, "le": 0.5},
          called=("poisson", "poisson_ratio", "poissons_ratio", "v")),
    Input("R", "radius R of the punch at its tip", "$R$", '"1 mm"', unit="m", gives="modulus", **_UNIT,
          called=("radius", "tip_radius", "curvature_radius", "r0")),
    Input("E_star", "reduced modulus E* = E0/(1 - nu^2) at the depth c0", r"$E^{\ast}$", '"50 kPa"', unit="Pa",
          gives="modulus", needs=("R", "work_of_adhesion"), follows=lambda E, R, w: E * R / w, **_UNIT,
          called=("e*", "estar", "e_eff", "reduced_modulus", "effective_modulus", "plane_strain_modulus")),
    Input("E", "Young's modulus E0 at the depth c0", "$E_0$", '"46 kPa"', unit="Pa", gives="modulus",
          instead_of="E_star", needs=("nu",), follows=lambda E, nu: E / ((1.0 - nu) * (1.0 + nu)), **_UNIT,
          called=("young", "youngs_modulus", "young_modulus", "elastic_modulus", "e0")),
    Input("work_of_adhesion", "work of adhesion dgamma", r"$\Delta\gamma$", '"20 mJ/m^2"', unit="J/m^2",
          gives="modulus", **_UNIT, called=("gamma", "dgamma", "delta_gamma", "deltagamma", "w", "w_adh", "adhesion",
          "adhesion_energy", "surface_energy")),
    Input("modulus", "reduced modulus E* R/dgamma, with E* = E0/(1 - nu^2)", r"$E^{\ast}R/\Delta\gamma$", "500.0"),
    Input("c0", "characteristic depth c0 of the gradient", "$c_0$", '"0.1 mm"', gives="c0_over_R", **_LENGTH,
          called=("gradient_depth", "characteristic_depth")),
    Input("c0_over_R", "characteristic depth c0/R of the gradient", "$c_0/R$", "0.01", idle_without="k"),
    Input("wavelength", "wavelength lambda of the waviness", r"$\lambda$", '"20 um"', gives="lambda_over_R",
          **_LENGTH, called=("lambda", "lam", "period")),
    Input("lambda_over_L", "wavelength lambda/L of the waviness over the similarity length", r"$\lambda/L$", "0.5",
          gives="lambda_over_R", needs=_MATERIAL),
    Input("lambda_over_R", "wavelength lambda/R of the waviness", r"$\lambda/R$",
          '{ start = 0.02, stop = 1.0, num = 200, spacing = "log" }', idle_without="A",
          called=("wavelength_over_r", "lam_over_r", "lambda", "lam", "wavelength")),
    Input("amplitude", "amplitude A lambda of the waviness", r"$A\lambda$", '"0.5 um"', NOT_NEGATIVE, "m",
          gives="A", needs=("R", "lambda_over_R"), follows=lambda height, R, ratio: height / R / ratio, **_UNIT,
          called=("height", "wave_height")),
    Input("chi", "roughness parameter chi = r/s of the waviness", r"$\chi$", "0.5", NOT_NEGATIVE, gives="A",
          needs=(*_MATERIAL, "lambda_over_R")),
    Input("A", "amplitude over wavelength of the waviness", "$A$", "0.1", NOT_NEGATIVE,
          called=("amplitude_over_wavelength", "amplitude_over_lambda", "a_over_lambda", "amplitude")),
    Input("spring_constant", "spring constant S of the loading machine", "$S$", '"0.2 N/m"', unit="N/m",
          gives="machine_stiffness", needs=("E_star", "R"), follows=lambda S, E, R: S / (E * R), group="machine",
          **_UNIT, called=("stiffness", "spring", "spring_stiffness", "cantilever_stiffness")),
    Input("machine_stiffness", "stiffness S/(E* R) of the loading machine", r"$S/E^{\ast}R$", "10.0", table="loading",
          group="machine", called=("stiffness", "machine")),
    Input("a_max", "radius a_max of the punch (inf: unbounded)", r"$a_{\max}$", '"0.5 mm" or a_max = inf',
          gives="a_max_over_R", infinite=True, **_LENGTH, called=("contact_radius", "max_radius")),
    Input("a_max_over_L", "radius a_max/L of the punch over the similarity length (inf: unbounded)", r"$a_{\max}/L$",
          "5.0", gives="a_max_over_R", needs=_MATERIAL, infinite=True),
    Input("a_max_over_a2", "radius a_max/a_2 of the punch over the jump-in radius of the loading envelope",
          r"$a_{\max}/a_2$", "2.0", gives="a_max_over_R", needs=(*_MATERIAL, "lambda_over_R", "A"), infinite=True),
    Input("a_max_over_R", "radius a_max/R of the punch (inf: unbounded)", r"$a_{\max}/R$", "inf", infinite=True),
    Input("indentation_max", "depth delta_max at which the cycle turns", r"$\delta_{\max}$", '"50 nm"', ANY,
          gives="indentation_max_over_R", group="turn", **_LENGTH,
          called=("depth", "indentation", "max_indentation", "max_depth")),
    Input("indentation_max_over_R", "depth delta_max/R at which the cycle turns", r"$\delta_{\max}/R$", "0.05", ANY,
          group="turn"),
    Input("preload", "load P_max at which the cycle turns", r"$P_{\max}$", '"50 nN"', unit="N", gives="load_max",
          needs=("R", "work_of_adhesion"), follows=lambda load, R, w: load / (1.5 * math.pi * R * w), group="turn",
          **_UNIT, called=("load", "maximum_load", "max_load", "setpoint")),
    Input("load_max", "load P_max/(1.5 pi R dgamma) at which the cycle turns",
          r"$P_{\max}/\frac{3}{2}\pi R\Delta\gamma$", "2.0", group="turn"),
    Input("work_of_adhesion_closing", "work of adhesion w_c at which the edge closes; it opens at work_of_adhesion",
          "$w_c$", '"5 mJ/m^2"', NOT_NEGATIVE, "J/m^2", gives="closing_ratio", needs=("work_of_adhesion",),
          follows=operator.truediv, group="works", **_UNIT),
    Input("closing_ratio", "work of adhesion of closing over that of opening, w_c/dgamma", r"$w_c/\Delta\gamma$",
          "0.5", SHARE, group="works"),
    Input("toughness_wavelength", "wavelength of the pattern of toughness", r"$\lambda_t$", '"50 um"',
          gives="toughness_wavelength_over_R", group="toughness", **_LENGTH),
    Input("toughness_wavelength_over_R", "wavelength lambda_t/R of the pattern of toughness", r"$\lambda_t/R$", "0.1",
          group="toughness"),
    Input("toughness_amplitude", "amplitude of the pattern of toughness", "$t$", "0.5", ANY, group="toughness"),
    Input("speed", "speed V of the machine", "$V$", '"1 um/s"', NOT_NEGATIVE, "m/s", gives="speed_over_reference",
          needs=("reference_speed",), follows=operator.truediv, group="rate", **_UNIT),
    Input("reference_speed", "speed v* of the edge at which its work is doubled", "$v^*$", '"1 mm/s"', unit="m/s",
          gives="speed_over_reference", group="rate", **_UNIT),
    Input("speed_over_reference", "speed of the machine over the reference speed of the edge, V/v*", "$V/v^*$", "0.1",
          NOT_NEGATIVE, group="rate"),
    Input("adhesion_range", "range z0 of the attraction", "$z_0$", '"0.3 nm"', gives="adhesion_range_over_R",
          group="range", **_LENGTH, called=("z0", "range", "interaction_range")),
    Input("adhesion_range_over_R", "range z0/R of the attraction, for the Tabor parameters", "$z_0/R$", "3e-7",
          group="range"),
)}  # fmt: skip
"""Every input, in the order of a dataset's dimensions.

Each stands before the parameter in whose place it is, those with units first. The radius of the punch and what a cycle
turns at are the last that scenes are solved for, since all of one curve share its trace; for the range of the
attraction nothing is solved.
"""
PHYSICAL: Final = {name: one for name, one in INPUTS.items() if one.table == "physical"}
"""Those with units."""
REDUCED: Final = {name: one for name, one in INPUTS.items() if one.table == "parameters" and not one.is_parameter}
"""Those in reduced variables, each in the place of a parameter."""


def parameters_in(group: str) -> tuple[str, ...]:
    """Name the parameters of a group, those that every scene has for the empty one.

    >>> parameters_in("turn")
    ('indentation_max_over_R', 'load_max')
    """
    return tuple(name for name, one in INPUTS.items() if one.is_parameter and one.group == group)


def setting(about: str, example: str, *, default: Any = MISSING, choices: Sequence[str] = (), **bounds: float) -> Any:
    """Declare a field: what it is and a value that would do, as TOML has it, for schema and manual.

    It may be left out if it has a default. Words are one of its choices; numbers have bounds by the names of the
    comparisons of `operator`: gt, ge, le.
    """
    return field(
        default=default, metadata={"about": about, "example": example, "choices": tuple(choices), "bounds": bounds}
    )


def check_settings(made: Any) -> None:
    """Raise ValueError for the first setting that is none of its choices, or out of its bounds."""
    for one in fields(made):
        value, choices = getattr(made, one.name), one.metadata["choices"]
        if choices and value not in choices:
            raise ValueError(f"{one.name} = {value!r}: it is one of {', '.join(choices)}")
        for sign, limit in one.metadata["bounds"].items():
            if not getattr(operator, sign)(value, limit):
                words = {"gt": "above", "ge": "at least", "le": "at most"}[sign]
                raise ValueError(f"{one.name} = {value!r}: it is {words} {limit:,}")
