"""The keys at the top of a study: its settings and its tables."""

from typing import Final

from gradhesion.cli.keys.inputs import PARAMETERS
from gradhesion.cli.keys.key import Key

TOP: Final = (
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
        about="quantities to compute for each scene",
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
        about="control of the punch",
        example='a table [loading] with control = "displacement", "load" or "machine"',
    ),
    Key(
        name="toughness",
        about="a toughness that varies with the radius: a series of waves",
        example="a table [toughness] with harmonics = [{ n = 1, cos = 0.2 }]",
    ),
    Key(
        name="rate",
        about="a work of adhesion that grows with the speed of the edge",
        example="a table [rate] with exponent = 0.6",
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
)
