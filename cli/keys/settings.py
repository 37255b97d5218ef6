"""The keys of a study that give no parameter, and its tables."""

from typing import Final

from gradhesion.cli.keys.key import POSITIVE, Key
from gradhesion.cli.keys.top import TOP

_WITHIN: Final = (
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
        about='column with "loading" or "unloading", "approach" or "retract", 0 or 1 [from the order of the points]',
        example='branch = "branch"',
    ),
    Key(
        name="cycle",
        table="data",
        about="column with the number of the cycle, a whole number",
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
        about="path of a file, from the folder of the study",
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
        bounds=POSITIVE,
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

SETTINGS: Final[dict[str, Key]] = {key.name: key for key in (*TOP, *_WITHIN)}
"""Every key that gives no parameter, and every table."""
