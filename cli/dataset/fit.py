"""What the dataset of a fit holds: values with intervals, correlations, the data, the fitted path and residuals."""

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli import names
from gradhesion.cli.dataset.dataset import origin
from gradhesion.cli.disk import replacement, writing
from gradhesion.cli.keys import INPUTS
from gradhesion.cli.study.fit_study import FitStudy, unit_of_parameter
from gradhesion.cli.study.shape_words import shape_in_words
from gradhesion.cli.work.compiling import prepare
from gradhesion.cli.work.fitting import fitted, kinds_of_fit, loading_of
from gradhesion.core.answers.loop_fit import FittedLoop
from gradhesion.core.arrays.reach import is_steep, slopes_of
from gradhesion.core.problem.status import OF_EVERY_MAP

if TYPE_CHECKING:
    import xarray

_UNITS: Final = {"indentation": "m", "load": "N"}
_WAYS: Final = {"flag_values": np.array([0, 1], np.int8), "flag_meanings": "loading unloading"}
_YES: Final = {"flag_values": np.array([0, 1], np.int8), "flag_meanings": "no yes"}


def compute_fit(study: FitStudy) -> "xarray.Dataset":
    """Fit a study in memory: the dataset that `gradhesion run` writes to a file."""
    prepare(kinds_of_fit(study))
    return dataset_of(study, fitted(study), "computed in memory")


def write_fit(study: FitStudy, found: FittedLoop, path: Path, *, history: str, overwrite: bool) -> None:
    """
    Write a fit into a file, which takes the place of `path` when it is complete and on disk.

    Raises
    ------
    OutputError
        It cannot be written, or exists.
    """
    dataset = dataset_of(study, found, history)
    packed = {"zlib": True, "complevel": 1, "shuffle": True}
    along = {name: packed for name, variable in dataset.variables.items() if variable.dims and variable.dtype != object}
    own = {name: along.get(name, {}) | {"_FillValue": None} for name in dataset.variables}
    with replacement(path, overwrite=overwrite) as temporary, writing(path):
        dataset.to_netcdf(temporary, format="NETCDF4", engine="netcdf4", encoding=own)


def dataset_of(study: FitStudy, found: FittedLoop, history: str) -> "xarray.Dataset":
    """Put a fit into a dataset."""
    import xarray  # noqa: PLC0415 (450 ms)

    loop, long = study.loop, names.FIT
    parameter = (names.PARAMETER,)
    labels = np.array(found.names, dtype=object)
    units = np.array([unit_of_parameter(name) for name in found.names], dtype=object)

    def along(values: dict[str, float]) -> Any:
        return np.array([values[name] for name in found.names])

    rows: dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]] = {
        "value": (parameter, along(found.values), {}),
        "standard_deviation": (parameter, along(found.standard_deviations), {}),
        "low": (parameter, along(found.low), {}),
        "high": (parameter, along(found.high), {}),
        "on_bound": (parameter, np.array([name in found.on_bound for name in found.names], np.int8), _YES),
        "correlation": ((*parameter, names.OTHER_PARAMETER), found.correlation, {"units": "1"}),
        "chi_square": ((), found.chi_square, {"units": "1"}),
        "degrees_of_freedom": ((), np.int32(found.degrees_of_freedom), {"units": "1"}),
        "converged": ((), np.int8(found.converged), _YES),
    }
    path = np.concatenate([found.loading, found.unloading[1:]])
    back = np.arange(len(path)) >= len(found.loading)
    points = {
        "measured_indentation": loop.depth,
        "measured_load": loop.load,
        "measured_unloading": loop.unloading.astype(np.int8),
        "measured_cycle": _narrow(loop.cycle),
        "residual": found.residual,
        "fitted_indentation": path[:, 0],
        "fitted_load": path[:, 1],
        "fitted_unloading": back.astype(np.int8),
    }
    of_machine = " of the machine" if loop.through_machine else ""
    for dimension, own in names.FIT_POINTS.items():
        for name, words in own.items():
            unit = _UNITS.get(name.rpartition("_")[2])
            told = {"units": unit or "1"} if unit or name in ("residual", "measured_cycle") else dict(_WAYS)
            if of_machine and name.endswith("_indentation"):
                words = words.replace("indentation depth", f"displacement{of_machine}")
            rows[name] = ((dimension,), points[name], told | {"long_name": words})
    made = {
        name: xarray.Variable(dims, values, {"long_name": long.get(name, "")} | told)
        for name, (dims, values, told) in rows.items()
    }
    if is_steep(slopes_of(np.array(found.turning_radius), study.profile)):
        made[names.STEEP] = xarray.Variable((), np.int8(1), {"units": "1", "long_name": names.STEEP_CONTACT})
    made["status"] = xarray.Variable((), np.int8(found.status), _of_status())
    fixed = {
        name: xarray.Variable((), study.fixed[name], {"units": key.unit, "long_name": key.about})
        for name, key in INPUTS.items()
        if name in study.fixed
    }
    told = {"long_name": "what is fitted"}
    coordinates = {
        names.PARAMETER: xarray.Variable(parameter, labels, told),
        names.OTHER_PARAMETER: xarray.Variable((names.OTHER_PARAMETER,), labels, told),
        names.PARAMETER_UNITS: xarray.Variable(parameter, units, {"long_name": "unit of what is fitted"}),
    }
    own_attributes = {
        "profile": shape_in_words(study.profile),
        "control": loading_of(study).control,
        "data_file": study.file,
        "data_sha256": loop.sha256,
        "data_rows_left_out": np.int32(loop.dropped),
        "noise_of_indentation": study.noise[0],
        "noise_of_load": study.noise[1],
        "noise_is": "given" if study.noise_is_given else "estimated from differences of neighbours",
        "intervals": "profile likelihoods" if study.intervals == "profile" else "linear",
    }
    marks = {name: made.pop(name) for name in (names.STEEP,) if name in made}
    return xarray.Dataset(made, coordinates | fixed | marks, origin(study, history, own_attributes))


def _narrow(cycle: NDArray[np.int64]) -> NDArray[np.int32] | NDArray[np.int64]:
    """Give the numbers of cycles in 32 bits, or in 64 where they need them."""
    return cycle.astype(np.int32) if np.abs(cycle).max() < 2**31 else cycle


def _of_status() -> dict[str, Any]:
    """Describe the status of the fitted cycle."""
    return {
        "units": "1",
        "long_name": "flags of the fitted cycle (0: nothing to report)",
        "flag_masks": np.array(list(OF_EVERY_MAP.values()), dtype=np.int8),
        "flag_meanings": " ".join(OF_EVERY_MAP),
    }
