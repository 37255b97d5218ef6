"""What the dataset of a fit holds: values with intervals, correlations, the data, the fitted path and residuals."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gradhesion.cli.dataset.dataset import origin
from gradhesion.cli.dataset.fits.rows import VARIABLES, refuse_size, rows_of, side_by_side
from gradhesion.cli.dataset.select import write_dataset
from gradhesion.cli.names.fits import FIT_WORDS, LOOP, OTHER_PARAMETER, PARAMETER_UNITS
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.fit.loop_file import fingerprint
from gradhesion.cli.study.fit.study import FitStudy, unit_of_parameter
from gradhesion.cli.study.shape_words import rate_in_words, shape_in_words, toughness_in_words
from gradhesion.cli.work.compiling import prepare
from gradhesion.cli.work.solve.fitting import Fit, fits_of, range_words
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.status import FLAGS, OF_FITS

if TYPE_CHECKING:
    import xarray


def compute_fit(study: FitStudy) -> "xarray.Dataset":
    """Fit a study in memory: the dataset that `gradhesion run` writes to a file."""
    refuse_size(study)
    prepare()
    return dataset_of(study, fits_of(study), "computed in memory")


def write_fit(study: FitStudy, fits: Sequence[Fit], path: Path, *, history: str, overwrite: bool) -> None:
    """
    Write fits into a file, which takes the place of `path` when it is complete and on disk.

    Raises
    ------
    OutputError
        It cannot be written, or exists.
    """
    write_dataset(dataset_of(study, fits, history), path, overwrite=overwrite)


def dataset_of(study: FitStudy, fits: Sequence[Fit], history: str) -> "xarray.Dataset":
    """Put the fits of a study into a dataset: that of one loop, or of several along a first dimension."""
    import xarray  # noqa: PLC0415 (450 ms)

    each = [rows_of(study, fit) for fit in fits]
    rows = each[0] if study.is_of_one else side_by_side(each)
    along = () if study.is_of_one else (LOOP,)
    made = {
        name: xarray.Variable((*along, *VARIABLES[name].dims), values, _attributes_of(study, name))
        for name, values in rows.items()
    }
    labels = np.array(study.parameters, dtype=object)
    units = np.array([unit_of_parameter(name) for name in study.parameters], dtype=object)
    parameter = (PARAMETER,)
    fixed = {
        name: xarray.Variable((), value, {"units": key.unit, "long_name": key.about})
        for name, key in INPUTS.items()
        if (value := study.adhesion_range if name == "adhesion_range" else study.fixed.get(name)) is not None
    }
    attributes = {"long_name": "fitted quantity"}
    coordinates = {
        PARAMETER: xarray.Variable(parameter, labels, attributes),
        OTHER_PARAMETER: xarray.Variable((OTHER_PARAMETER,), labels, attributes),
        PARAMETER_UNITS: xarray.Variable(parameter, units, {"long_name": "unit of the fitted quantity"}),
    }
    if not study.is_of_one:
        words = {
            "file": [fit.loop.file for fit in fits],
            "sha256": [fit.loop.sha256 for fit in fits],
            "problem": [fit.problem for fit in fits],
            "alike": ["; ".join(fit.found.alike) if fit.found else "" for fit in fits],
        }
        for name, values in words.items():
            own = {"long_name": FIT_WORDS[name]}
            coordinates[name] = xarray.Variable((LOOP,), np.array(values, dtype=object), own)
    marks = {name: made.pop(name) for name in (STEEP,) if name in made}
    return xarray.Dataset(made, coordinates | fixed | marks, origin(study, history, _attributes(study, fits)))


def _attributes(study: FitStudy, fits: Sequence[Fit]) -> dict[str, Any]:
    """List the attributes that fits alone have."""
    found = [fit.found for fit in fits if fit.found is not None]
    methods = {one.contact.method for one in found if one.contact is not None}
    exponent = ", with a fitted exponent" if "exponent" in study.free else ""
    intervals = "profile likelihoods" if study.intervals == "profile" else "linear"
    return {
        "profile": shape_in_words(study.profile),
        "control": study.loading.control,
        **({} if study.toughness is None else {"toughness": toughness_in_words(study.toughness)}),
        **({} if study.rate is None else {"rate": f"{rate_in_words(study.rate)}{exponent}"}),
        "data_file": study.file,
        "data_sha256": fingerprint(study.loops),
        "data_rows_left_out": np.int64(sum(loop.dropped for loop in study.loops)),
        "data_rows_of_pauses": np.int64(sum(loop.paused for loop in study.loops)),
        "noise_is": "given" if study.noise_is_given else "estimated from differences of neighbours",
        "intervals": intervals,
        **({"contact_point": "; ".join(sorted(methods))} if methods else {}),
        **({"alike": "; ".join(found[0].alike)} if study.is_of_one and found[0].alike else {}),
    }


def _attributes_of(study: FitStudy, name: str) -> dict[str, Any]:
    """Describe a variable."""
    one = VARIABLES[name]
    words = one.about
    if study.loading.control == "machine" and name.endswith("_indentation") and one.dims:
        words = words.replace("indentation depth", "displacement of the machine")
    attributes: dict[str, Any] = {"long_name": words} | ({"units": one.unit} if one.unit else {})
    if one.meanings:
        padded = not study.is_of_one and name.endswith("_unloading")
        attributes["flag_values"] = np.array([-1, 0, 1][not padded :], np.int8)
        attributes["flag_meanings"] = "none " * padded + one.meanings
    if name == "tabor_parameter":
        attributes["comment"] = range_words(study)
    if name == "status":
        flags = FLAGS | OF_FITS
        attributes |= {
            "flag_masks": np.array(list(flags.values()), dtype=np.int16),
            "flag_meanings": " ".join(flags),
        }
    return attributes
