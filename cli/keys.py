"""The keys of a study: for each of them, once, all that schema, messages, manual, datasets and pictures say of it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

Path = tuple[str | int, ...]
"""A key as the steps to it: `("parameters", "k", 3)` is item 3 of `parameters.k`."""


@dataclass(frozen=True, kw_only=True)
class Key:
    """
    One key of a study.

    >>> Key(name="k", about="gradient exponent", example="k = 0.5", bounds={"ge": 0, "le": 1}).allowed
    '0 <= k <= 1'
    """

    name: str
    about: str
    """What it is; of an input, the `long_name` of its coordinate."""
    example: str
    """A line of TOML that would do, or for a table what to write."""
    table: str = ""
    """The table that it stands in: empty at the top, "range" and "harmonics" for the tables within a value."""
    symbol: str = ""
    """How a picture writes it."""
    unit: str = "1"
    """Its unit in a dataset, as UDUNITS writes it."""
    gives: str = ""
    """The parameter that it is, or that it gives alone or with others; empty for what is no input."""
    role: str = ""
    """Of a parameter that other keys can give: what it stands for, in words."""
    instead_of: str = ""
    """The key of the same table that it replaces."""
    also: tuple[str, ...] = ()
    """Other tables that have a key of this name."""
    bounds: Mapping[str, float] = field(default_factory=dict)
    """Of a number: its bounds by the names of pydantic."""
    infinite: str = ""
    """What infinity means, where it is allowed."""

    @property
    def is_parameter(self) -> bool:
        """Whether it is a parameter itself, rather than another way to give one."""
        return self.gives == self.name

    @property
    def allowed(self) -> str:
        """Its bounds in words."""
        if not self.bounds:
            return f"-inf < {self.name} < inf" if self.gives else ""
        low = self.bounds.get("ge", self.bounds.get("gt"))
        least, greatest = ("<=" if "ge" in self.bounds else "<"), self.bounds.get("le")
        if greatest is not None:
            return f"{low:g} {least} {self.name} <= {greatest:g}"
        above = f"{self.name} {least.replace('<', '>')} {low:g}"
        return f"{above} (inf: {self.infinite})" if self.infinite else f"{above}, and finite"


_POSITIVE: Final = {"gt": 0.0}
_NOT_NEGATIVE: Final = {"ge": 0.0}
_UNBOUNDED: Final = "an unbounded punch"


def _parameter(
    name: str,
    about: str,
    example: str,
    symbol: str,
    *,
    gives: str = "",
    role: str = "",
    bounds: Mapping[str, float] = _POSITIVE,
    infinite: str = "",
) -> Key:
    """Make a key of [parameters]: a parameter, unless it gives another."""
    return Key(
        name=name,
        about=about,
        example=f"{name} = {example}",
        table="parameters",
        symbol=symbol,
        gives=gives or name,
        role=role,
        bounds=bounds,
        infinite=infinite,
    )


def _quantity(
    name: str,
    gives: str,
    unit: str,
    about: str,
    example: str,
    symbol: str,
    *,
    instead_of: str = "",
    bounds: Mapping[str, float] = _POSITIVE,
    infinite: str = "",
) -> Key:
    """Make a key of [physical]."""
    return Key(
        name=name,
        about=about,
        example=f"{name} = {example}",
        table="physical",
        symbol=symbol,
        unit=unit,
        gives=gives,
        instead_of=instead_of,
        bounds=bounds,
        infinite=infinite,
    )


MACHINE: Final = "machine_stiffness"
"""The key of [loading] that is a parameter: its dimension stands before that of the punch's radius."""
SPRING: Final = "spring_constant"
"""The key of [physical] that gives the same with its unit."""

TURNS: Final = ("indentation_max_over_R", "load_max")
"""The parameters at which a cycle may turn before the rim: those of a scene that need not be there."""
ADHESION_RANGE: Final = "adhesion_range_over_R"
"""The parameter that the Tabor parameters need alone: its dimension is the last, since nothing is solved for it."""
INTERACTION: Final = "adhesion_range"
"""The key of [physical] that gives the same with its unit."""

_ALL_INPUTS: Final = (
    _parameter(
        "k",
        "gradient exponent k of the modulus E0 (z/c0)^k",
        "0.5 or k = [0.0, 0.5]",
        "$k$",
        bounds={"ge": 0.0, "le": 1.0},
    ),
    _parameter("nu", "Poisson's ratio", "0.3", r"$\nu$", bounds={"gt": -1.0, "le": 0.5}),
    _quantity("R", "modulus", "m", "radius R of the punch at its tip", '"1 mm"', "$R$"),
    _quantity(
        "E_star",
        "modulus",
        "Pa",
        "reduced modulus E* = E0/(1 - nu^2) at the depth c0",
        '"50 kPa"',
        r"$E^{\ast}$",
    ),
    _quantity("E", "modulus", "Pa", "Young's modulus E0 at the depth c0", '"46 kPa"', "$E_0$", instead_of="E_star"),
    _quantity("work_of_adhesion", "modulus", "J m-2", "work of adhesion dgamma", '"20 mJ/m^2"', r"$\Delta\gamma$"),
    _parameter(
        "modulus",
        "reduced modulus E* R/dgamma, with E* = E0/(1 - nu^2)",
        "500.0",
        r"$E^{\ast}R/\Delta\gamma$",
        role="the reduced modulus",
    ),
    _quantity("c0", "c0_over_R", "m", "characteristic depth c0 of the gradient", '"0.1 mm"', "$c_0$"),
    _parameter(
        "c0_over_R",
        "characteristic depth c0/R of the gradient",
        "0.01",
        "$c_0/R$",
        role="the depth of the gradient",
    ),
    _quantity("wavelength", "lambda_over_R", "m", "wavelength lambda of the waviness", '"20 um"', r"$\lambda$"),
    _parameter(
        "lambda_over_L",
        "wavelength lambda/L of the waviness over the similarity length",
        "0.5",
        r"$\lambda/L$",
        gives="lambda_over_R",
    ),
    _parameter(
        "lambda_over_R",
        "wavelength lambda/R of the waviness",
        '{ start = 0.02, stop = 1.0, num = 200, spacing = "log" }',
        r"$\lambda/R$",
        role="the wavelength",
    ),
    _quantity(
        "amplitude",
        "A",
        "m",
        "amplitude A lambda of the waviness",
        '"0.5 um"',
        r"$A\lambda$",
        bounds=_NOT_NEGATIVE,
    ),
    _parameter(
        "chi", "roughness parameter chi = r/s of the waviness", "0.5", r"$\chi$", gives="A", bounds=_NOT_NEGATIVE
    ),
    _parameter(
        "A",
        "amplitude over wavelength of the waviness",
        "0.1",
        "$A$",
        role="the amplitude",
        bounds=_NOT_NEGATIVE,
    ),
    _quantity(SPRING, MACHINE, "N m-1", "spring constant S of the loading machine", '"0.2 N/m"', "$S$"),
    Key(
        name=MACHINE,
        about="stiffness S/(E* R) of the loading machine",
        example=f"{MACHINE} = 10.0",
        table="loading",
        symbol=r"$S/E^{\ast}R$",
        gives=MACHINE,
        bounds=_POSITIVE,
    ),
    _quantity(
        "a_max",
        "a_max_over_R",
        "m",
        "radius a_max of the punch (inf: unbounded)",
        '"0.5 mm" or a_max = inf',
        r"$a_{\max}$",
        infinite=_UNBOUNDED,
    ),
    _parameter(
        "a_max_over_L",
        "radius a_max/L of the punch over the similarity length (inf: unbounded)",
        "5.0",
        r"$a_{\max}/L$",
        gives="a_max_over_R",
        infinite=_UNBOUNDED,
    ),
    _parameter(
        "a_max_over_a2",
        "radius a_max/a_2 of the punch over the jump-in radius of the loading envelope",
        "2.0",
        r"$a_{\max}/a_2$",
        gives="a_max_over_R",
        infinite=_UNBOUNDED,
    ),
    _parameter(
        "a_max_over_R",
        "radius a_max/R of the punch (inf: unbounded)",
        "inf",
        r"$a_{\max}/R$",
        role="the radius of the punch",
        infinite=_UNBOUNDED,
    ),
    _quantity(
        "indentation_max",
        "indentation_max_over_R",
        "m",
        "depth delta_max at which the cycle turns",
        '"50 nm"',
        r"$\delta_{\max}$",
        bounds={},
    ),
    _parameter(
        "indentation_max_over_R",
        "depth delta_max/R at which the cycle turns",
        "0.05",
        r"$\delta_{\max}/R$",
        bounds={},
    ),
    _quantity("preload", "load_max", "N", "load P_max at which the cycle turns", '"50 nN"', r"$P_{\max}$"),
    _parameter(
        "load_max",
        "load P_max/(1.5 pi R dgamma) at which the cycle turns",
        "2.0",
        r"$P_{\max}/\frac{3}{2}\pi R\Delta\gamma$",
    ),
    _quantity(INTERACTION, ADHESION_RANGE, "m", "range z0 of the attraction", '"0.3 nm"', "$z_0$"),
    _parameter(ADHESION_RANGE, "range z0/R of the attraction, for the Tabor parameters", "3e-7", "$z_0/R$"),
)

INPUTS: Final[dict[str, Key]] = {key.name: key for key in _ALL_INPUTS}
"""
Every key that gives parameters, in the order of a dataset's dimensions.

Each stands before the parameter in whose place it is, those with units first. The radius of the punch and what a cycle
turns at are the last that scenes are solved for, since all of one curve share its trace.
"""

PARAMETERS: Final[dict[str, Key]] = {
    name: key
    for name, key in INPUTS.items()
    if key.table == "parameters" and key.is_parameter and name not in (*TURNS, ADHESION_RANGE)
}
"""Every parameter that all scenes have, in the order of a dataset's dimensions."""

REDUCED: Final[dict[str, Key]] = {
    name: key for name, key in INPUTS.items() if key.table == "parameters" and not key.is_parameter
}
"""The keys of [parameters] in reduced variables, each in the place of a parameter."""

PHYSICAL: Final[dict[str, Key]] = {name: key for name, key in INPUTS.items() if key.table == "physical"}
"""The keys of [physical]."""

_SETTINGS: Final = (
    Key(
        name="title",
        about="title of the dataset [name of the file]",
        example='title = "Pull-off force against wavelength"',
    ),
    Key(
        name="kind",
        about="one value per scene, curves of each scene, optima, or parameters from a measured loop",
        example='kind = "map"',
    ),
    Key(
        name="layout",
        about="every combination of the axes is a scene, or the lists are combined item by item",
        example='layout = "grid"',
    ),
    Key(
        name="outputs",
        about="what is computed for each scene",
        example='outputs = ["pull_off_force", "dissipated_energy"]',
    ),
    Key(
        name="parameters",
        about="the parameters of a scene, each a number or an axis",
        example=f"a table [parameters] with {', '.join(PARAMETERS)}",
    ),
    Key(
        name="physical",
        about="quantities with units instead of ratios",
        example='a table [physical] with R = "1 mm" and other quantities',
    ),
    Key(
        name="profile",
        about="the shape of the punch: a power, and a series of waves",
        example="a table [profile] with exponent or harmonics",
    ),
    Key(
        name="loading",
        about="what drives the punch",
        example='a table [loading] with control = "displacement", "load" or "machine"',
    ),
    Key(
        name="states",
        about='states of contact for pressure and surface, for kind = "curve"',
        example="a table [states] with contact_radius_over_R",
    ),
    Key(
        name="optimum",
        about='goal, searched inputs and requirements, for kind = "optimum"',
        example='a table [optimum] with maximise = "pull_off_force" and over = ["lambda_over_R"]',
    ),
    Key(
        name="uncertainty",
        about="uncertainties of the inputs: outputs get standard deviations and, with samples, quantiles",
        example='a table [uncertainty] with modulus = "5 %"',
    ),
    Key(
        name="method",
        about="how the scenes are solved",
        example='a table [method] with solver = "exact", "asymptotic" or "envelope"',
    ),
    Key(
        name="data",
        about='measured loop, for kind = "fit"',
        example='a table [data] with file = "loop.csv", indentation and load',
    ),
    Key(
        name="fit",
        about="further options of the fit",
        example="a table [fit] with offsets = true",
    ),
    Key(
        name="indentation",
        table="data",
        about="column of the depth, with its unit",
        example='indentation = { column = "depth", unit = "nm" }',
    ),
    Key(
        name="displacement",
        table="data",
        about="instead of indentation: column of depth + load/stiffness, the displacement of a machine",
        example='displacement = { column = "piezo", unit = "nm" }',
    ),
    Key(
        name="load",
        table="data",
        about="column of the load, with its unit; positive loads press",
        example='load = { column = "force", unit = "nN" }',
    ),
    Key(
        name="branch",
        table="data",
        about='column with "loading" or "unloading" [from the order of the points]',
        example='branch = "branch"',
    ),
    Key(
        name="cycle",
        table="data",
        about="column with the number of the cycle",
        example='cycle = "cycle"',
    ),
    Key(name="column", table="column", about="name of the column in the header", example='column = "depth"'),
    Key(
        name="unit",
        table="column",
        about="unit of the column [from the header]",
        example='unit = "nm"',
    ),
    Key(
        name="offsets",
        table="fit",
        about="whether the zeros of depth and load are also fitted",
        example="offsets = true",
    ),
    Key(
        name="noise",
        table="fit",
        about="standard deviations of the measured depth and load [estimated from the data]",
        example='noise = { load = "0.5 nN", indentation = "0.1 nm" }',
    ),
    Key(
        name="intervals",
        table="fit",
        about="95 % intervals from profile likelihoods, or from the linearised problem",
        example='intervals = "profile"',
    ),
    Key(
        name="starts",
        table="fit",
        about="maximum number of refinements, each from other starting values",
        example="starts = 32",
    ),
    Key(
        name="points",
        table="parameters",
        about="scenes from a file (CSV or NetCDF): one row per scene, one column per parameter",
        example='points = "samples.csv"',
    ),
    Key(
        name="file",
        table="profile",
        also=("data",),
        about="name of a file in the folder of the study",
        example='file = "tip.csv"',
    ),
    Key(
        name="sha256",
        table="profile",
        also=("data",),
        about="SHA-256 of the file; a file that differs is refused",
        example='sha256 = "..." as a dataset has it, or leave it out',
    ),
    Key(name="start", table="range", about="the first value", example="start = 0.1"),
    Key(name="stop", table="range", about="the last value", example="stop = 1.0"),
    Key(name="num", table="range", about="the number of values", example="num = 50"),
    Key(
        name="spacing",
        table="range",
        about="whether differences or ratios of neighbours are equal",
        example='spacing = "log"',
    ),
    Key(
        name="exponent",
        table="profile",
        about='power m of the punch without waves: 2 is a paraboloid, 1 a cone; "fit" fits it to the file',
        example="exponent = 2.0",
    ),
    Key(
        name="terms",
        table="profile",
        about="number of harmonics to fit to the heights in the file [16]",
        example="terms = 16",
    ),
    Key(
        name="up_to",
        table="profile",
        about="distance from the centre up to which heights are fitted [a_max]",
        example='up_to = "2 um"',
        unit="m",
        bounds=_POSITIVE,
    ),
    Key(
        name="spectrum",
        table="profile",
        about="random self-affine waves instead of harmonics; A is then their rms height over lambda",
        example="spectrum = { hurst = 0.8, first = 1, last = 32, realisations = 100, seed = 1 }",
    ),
    Key(
        name="hurst",
        table="spectrum",
        about="Hurst exponent H: the amplitudes of the waves n fall as n^-(H + 1/2)",
        example="hurst = 0.8",
    ),
    Key(
        name="first",
        table="spectrum",
        about="number of the longest wave; its wavelength is lambda/first",
        example="first = 1",
    ),
    Key(name="last", table="spectrum", about="number of the shortest wave", example="last = 32"),
    Key(
        name="realisations",
        table="spectrum",
        about="number of random profiles, along the last dimension of the dataset",
        example="realisations = 100",
    ),
    Key(
        name="seed",
        table="spectrum",
        also=("uncertainty",),
        about="seed of the random numbers",
        example="seed = 1",
    ),
    Key(
        name="samples",
        table="uncertainty",
        about="number of quasi-random samples, a power of two; 0: standard deviations by sensitivities only",
        example="samples = 1024",
    ),
    Key(
        name="maximise",
        table="optimum",
        about="output to maximise; two outputs: their best compromises",
        example='maximise = "pull_off_force"',
    ),
    Key(
        name="minimise",
        table="optimum",
        about="output to minimise, instead or as a second goal",
        example='minimise = "dissipated_energy"',
    ),
    Key(
        name="over",
        table="optimum",
        about="inputs to search between bounds: { start, stop } without num",
        example='over = ["lambda_over_R"]',
    ),
    Key(
        name="resolution",
        table="optimum",
        about="points of the sweep along each input; narrower peaks may be missed",
        example="resolution = 200",
    ),
    Key(
        name="require",
        table="optimum",
        about="conditions that an optimum must meet",
        example="require = { one_disc = true, minimum = { dissipated_energy = 0.1 } }",
    ),
    Key(
        name="one_disc",
        table="require",
        about="whether contact on loading must be one disc",
        example="one_disc = true",
    ),
    Key(
        name="minimum",
        table="require",
        about="minimum values of other outputs",
        example="minimum = { dissipated_energy = 0.1 }",
    ),
    Key(
        name="maximum",
        table="require",
        about="maximum values of other outputs",
        example="maximum = { pull_off_radius = 0.2 }",
    ),
    Key(name="low", table="deviation", about="lower end of a uniform distribution", example="low = 0.28"),
    Key(name="high", table="deviation", about="upper end of a uniform distribution", example="high = 0.32"),
    Key(
        name="harmonics",
        table="profile",
        about="waves of the series [one cosine]",
        example="harmonics = [{ n = 1, cos = 1.0 }, { n = 2, sin = 0.3 }]",
    ),
    Key(name="n", table="harmonics", about="number of the wave; its wavelength is lambda/n", example="n = 1"),
    Key(
        name="cos",
        table="harmonics",
        about="cosine of the wave, in units of the amplitude; 1 if cos and sin are both left out",
        example="cos = 1.0",
    ),
    Key(
        name="sin",
        table="harmonics",
        about="sine of the wave, in units of the amplitude",
        example="sin = 0.3",
    ),
    Key(
        name="control",
        table="loading",
        about="what is prescribed: the depth, the load, or the far end of a spring",
        example='control = "load"',
    ),
    Key(
        name="contact_radius_over_R",
        table="states",
        about="contact radii a/R of equilibrium states [turning point, pull-off and jump-out]",
        example="contact_radius_over_R = [0.1, 0.2]",
    ),
    Key(
        name="solver",
        table="method",
        about="the exact solution, or an approximation for short waves; a list compares several",
        example='solver = "exact" or solver = ["exact", "envelope"]',
    ),
    Key(
        name="check_contact",
        table="method",
        about="whether `status` reports that the contact on loading is not one disc",
        example="check_contact = false",
    ),
)

SETTINGS: Final[dict[str, Key]] = {key.name: key for key in _SETTINGS}
"""Every key that gives no parameter, and every table."""

KEYS: Final[dict[str, Key]] = SETTINGS | INPUTS
"""Every key of a study."""


FILE_KEYS: Final = ("file", "sha256")
"""The keys of the table of a file, in the place of its name."""


def keys_of(table: str) -> tuple[str, ...]:
    """
    Name the keys of a table.

    >>> keys_of("loading"), keys_of("harmonics")
    (('control', 'machine_stiffness'), ('n', 'cos', 'sin'))
    """
    return tuple(name for name, key in KEYS.items() if table in (key.table, *key.also))
