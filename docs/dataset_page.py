"""The page of what a dataset holds, from the names that are written into it."""

import ast
import inspect
from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any, Final

from docs.tables import code, table
from gradhesion.cli.dataset.describe import attributes
from gradhesion.cli.names.curves import CURVES, EXTENTS, MEANINGS, RAGGED
from gradhesion.cli.names.fits import (
    FIT,
    FIT_MORE,
    FIT_POINTS,
    FIT_WORDS,
    LOOP,
    MINIMUM,
    OTHER_PARAMETER,
    PARAMETER_UNITS,
)
from gradhesion.cli.names.outputs import (
    BEST,
    OF_LINEAR,
    ON_BOUND,
    OUTPUTS,
    PARAMETER,
    PARETO_POINT,
    SI,
    SPREAD,
    SPREADABLE,
    UNITS,
)
from gradhesion.cli.names.scenes import SCENE, SOLVER, STATUS, STEEP, STEEP_CONTACT
from gradhesion.cli.study.reading import study_from
from gradhesion.core import DOUBTFUL, FAILED, REPORTS, SENSITIVITIES
from gradhesion.core.answers import flags as flags_module
from gradhesion.core.answers.flags import FLAG_WORDS, FLAGS
from gradhesion.core.problem import status as status_module
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import PARAMETERS
from gradhesion.core.problem.status import OF_FITS

MODULES: Final = (status_module, flags_module)
"""Where flags are defined: those of a scene, and those of answers."""

NO_FLAGS: Final = (
    "OF_SCENES", "OF_LOOPS", "FLAGS", "OF_EVERY_MAP", "OF_FITS", "DOUBTFUL", "FAILED", "ANSWER_FLAGS", "FLAG_WORDS",
)  # fmt: skip
"""What `core.problem.status` defines beside its flags."""

ATTRIBUTES: Final = {
    "Conventions": "the conventions of names and units",
    "title": "the title of the study",
    "source": "the program and its version",
    "history": "when and how it was computed",
    "references": "the theory behind the values",
    "profile": "the shape of the punch, in words",
    "control": "the prescribed quantity",
    "toughness": "how the toughness varies with the radius, in words; with `[toughness]` only",
    "rate": "how the work grows with the speed, in words; with `[rate]` only",
    "study": "the whole study in TOML: `gradhesion run` of it makes the dataset again",
    "study_sha256": "its fingerprint",
    "python_version": "the versions that computed it",
    "numpy_version": "",
    "numba_version": "",
    "scipy_version": "",
}
"""What the attributes of a dataset are."""


def page() -> str:
    """Write the page."""
    return "\n\n".join(_sections())


def _sections() -> Iterator[str]:
    """Write the sections."""
    yield "# Variables and attributes of a dataset"
    yield (
        "This page is generated from the names in the program. Datasets are NetCDF-4 with the CF-1.11 conventions, "
        "and the same in a file and in xarray. Missing values are NaN."
    )
    yield "## Dimensions and coordinates"
    yield (
        "Each axis of a study is a dimension with a coordinate of the same name; a fixed parameter is a "
        f'coordinate without a dimension. With `layout = "points"` there is one dimension, `{SCENE}`. Several '
        f"solvers form the first dimension, `{SOLVER}`. Dimensions are in the order below. If a parameter was "
        "given by another key, the dataset has both."
    )
    coordinates = ([code(name), code(key.unit), key.about] for name, key in INPUTS.items())
    yield table(("coordinate", "units", "long_name"), coordinates)
    yield "## Variables of a map"
    yield (
        "One value per scene. For a study in units, each dimensional variable has an SI copy with the suffix "
        f"`{SI}`. Variables marked in the last column are available with the exact solver only."
    )
    yield table(("variable", "long_name", "in SI", "exact solver only"), _outputs())
    yield "## Spreads of uncertain inputs"
    yield (
        "With `[uncertainty]` a map has a standard deviation for each output: a linear one, from sensitivities, for "
        f"{_listed(OF_LINEAR)}; that of the samples for the others. With samples it also has their statistics. "
        f"`X` stands for any of {_listed(SPREADABLE)}; copies in SI end in `{SI}`."
    )
    spreads = ([code(f"X_{how}"), words.format("output")] for how, words in SPREAD.items())
    yield table(("variable", "meaning"), spreads)
    yield "## Variables of optima"
    yield (
        "The dataset has one value per cell of the axes that are not searched. `X` stands for a goal, for an output "
        "with a limit, or for a searched input; copies of outputs in SI end in `_si`. With two goals, "
        f"variables have a last dimension `{PARETO_POINT}` along which shorter fronts are padded."
    )
    yield table(
        ("variable", "meaning"),
        [
            [code(f"{BEST}X"), "the output at the optimum, or the place of the optimum"],
            [code(f"{BEST}X_sensitivity"), "of a force or an energy as the goal: its sensitivities at the optimum"],
            [code(ON_BOUND), "the bounds at which the optimum lies, as flags; 0: none"],
        ],
    )
    yield "## Variables of curves"
    yield (
        "Each curve has its own dimension, along which shorter curves are padded with missing values; jumps are a "
        "contiguous ragged array. Request a curve by its name, or single variables of it."
    )
    yield table(("curve", "dimension", "variable", "long_name", "0 and 1 mean"), _curves())
    yield "## Variables of a fit"
    yield (
        f"A fit has the dimension `{PARAMETER}`, the fitted values, with their units in "
        f"`{PARAMETER_UNITS}`; `{OTHER_PARAMETER}` is the same list, for correlations. Fixed parameters "
        "are coordinates without a dimension, in SI units. Offsets are added to the path, so that it passes "
        "through the data. `status` (int16) has the flags of the fitted cycle, and two of the fit. Variables of other "
        f"minima, along `{MINIMUM}`, exist if the noise allows such minima, those of the contact point if it was "
        "found before the fit. The attribute `alike` names what the loop cannot distinguish, `noise_is` the origin of "
        "the noise, `intervals` the kind of intervals, and `data_file` and `data_sha256` the fitted data."
    )
    yield (
        f"Fits of several loops have the first dimension `{LOOP}`, along which shorter loops are padded, and the "
        f"words {_listed(FIT_WORDS)} of each. A loop without a fit keeps its row, with `no_value`."
    )
    yield table(("variable", "dimensions", "long_name"), _of_fits())
    yield "## Status"
    yield (
        f"Every dataset has `status`, {STATUS}. Each bit is a flag. A scene with {_named(FAILED)} has failed. "
        f"Its values are doubtful with {_named(DOUBTFUL)}. The approximate solvers set `no_value` only. The flags "
        "after it occur with uncertain inputs and optima, the last ones where cycles turn at a depth, with patterns "
        "and speeds, and in fits; `status` is int16 there. A map or a curve study has the coordinate "
        f"`{STEEP}`, {STEEP_CONTACT}, where it is for any scene."
    )
    yield table(("flag", "bit", "in words", "of a scene"), _flags())
    yield "## Global attributes"
    yield table(("attribute", "what it is"), ([code(name), ATTRIBUTES[name]] for name in _attributes()))


def _listed(names_of: Iterable[str]) -> str:
    """Write names one after the other."""
    return ", ".join(map(code, names_of))


def _outputs() -> list[list[str]]:
    """Write a row for each output of a map."""
    return [
        [code(name), words, code(UNITS.get(name, "")), "yes" if name in (*REPORTS, *SENSITIVITIES) else ""]
        for name, words in OUTPUTS.items()
    ]


def _curves() -> list[list[str]]:
    """Write a row for each variable of a curve."""
    return [
        [
            code(curve),
            "" if name in RAGGED.values() else code(EXTENTS[curve]),
            code(name),
            words,
            code(MEANINGS.get(name, "")),
        ]
        for curve, own in CURVES.items()
        for name, words in own.items()
    ]


def _of_fits() -> list[list[str]]:
    """Write a row for each variable of a fit."""
    rows = [[code(name), code(", ".join(one.dims)), one.about] for name, one in (FIT | FIT_MORE).items()]
    rows += [[code(name), code(LOOP), words] for name, words in FIT_WORDS.items()]
    points = ((along, name, one) for along, each in FIT_POINTS.items() for name, one in each.items())
    return rows + [[code(name), code(along), one.about] for along, name, one in points]


def _flags() -> list[list[str]]:
    """Write a row for each flag, with what its definition says of it."""
    said: dict[str, str] = {}
    statements = [one for module in MODULES for one in ast.parse(inspect.getsource(module)).body]
    for definition, words in pairwise(statements):
        match definition, words:
            case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=str(text))):
                said[name] = " ".join(text.split())
    constants = {
        getattr(module, constant): text
        for module in MODULES
        for constant, text in said.items()
        if constant not in NO_FLAGS and hasattr(module, constant)
    }
    return [[code(name), str(bit), FLAG_WORDS[name], constants[bit]] for name, bit in (FLAGS | OF_FITS).items()]


def _named(bits: int) -> str:
    """Name the flags of some bits."""
    return " or ".join(code(name) for name, bit in FLAGS.items() if bit & bits)


def _attributes() -> list[str]:
    """List the global attributes of a dataset."""
    parameters = dict.fromkeys(PARAMETERS, 0.5)
    laws: dict[str, dict[str, Any]] = {
        "toughness_wavelength_over_R": {"toughness": {"harmonics": [{"n": 1, "cos": 0.5}]}},
        "speed_over_reference": {"rate": {"exponent": 0.6}},
    }
    studies = [
        {"outputs": ["pull_off_force"], "parameters": {**parameters, key: 0.5}, **law} for key, law in laws.items()
    ]
    found = {name for study in studies for name in attributes(study_from(study), "")}
    return [name for name in ATTRIBUTES if name in found] + sorted(found - ATTRIBUTES.keys())
