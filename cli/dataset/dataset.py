"""What a study's dataset holds: names, dimensions and attributes by CF-1.11, the same in a file and in xarray."""

import platform
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.cautions import cautions, flagged_in
from gradhesion.cli.dataset.contents import CONTENTS, described
from gradhesion.cli.dataset.coordinates import coordinates
from gradhesion.cli.dataset.variable import Variable
from gradhesion.cli.names.curves import STATE, is_ragged
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.scenes import REFERENCES, STATUS, STEEP, STEEP_CONTACT
from gradhesion.cli.names.units import unit_of
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.shape_words import profile_table, rate_in_words, shape_in_words, toughness_in_words
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import messages
from gradhesion.cli.work.compiling import prepare
from gradhesion.core import FLAGS
from gradhesion.core.answers.flags import FLAGS as ALL_FLAGS
from gradhesion.core.problem.names import CONTACT_SLOPE
from gradhesion.core.problem.outputs import without_scale
from gradhesion.core.problem.status import OF_EVERY_MAP, TOO_MANY_WAVES

if TYPE_CHECKING:
    import xarray


def variables(study: Study) -> dict[str, Variable]:
    """Describe the variables of a study's dataset, coordinates first."""
    found = coordinates(study)
    apart = (*study.sizes, *study.labels, STATE)
    beside = " ".join(name for name in found if name not in apart)
    outputs = {name: _output(study, name) for name in study.variables}
    outputs["status"] = _status(study)
    if beside:
        for name, variable in outputs.items():
            if not is_ragged(name):
                variable.attributes["coordinates"] = beside
    return found | outputs


def _output(study: Study, name: str) -> Variable:
    """Describe a result, perhaps in SI units."""
    plain = described(study, name.removesuffix(SI))
    if not name.endswith(SI):
        return plain
    unit = unit_of(name)
    long_name = without_scale(plain.attributes["long_name"], unit)
    return replace(plain, attributes=plain.attributes | {"units": unit, "long_name": long_name})


def _status(study: Study) -> Variable:
    """Describe the status of the scenes."""
    own = FLAGS if study.turns_at_a_depth else OF_EVERY_MAP
    own = ALL_FLAGS if study.has_answers else own
    many = {name: bit for name, bit in FLAGS.items() if bit == TOO_MANY_WAVES and study.follows_waves}
    flags = {name: bit for name, bit in own.items() if bit != TOO_MANY_WAVES} | many
    dtype = study.status_type
    attributes = {
        "units": "1",
        "long_name": STATUS,
        "flag_masks": np.array(list(flags.values()), dtype=dtype),
        "flag_meanings": " ".join(flags),
    }
    return Variable(dimensions=tuple(study.sizes), dtype=dtype, attributes=attributes)


def steep_contact(study: Study) -> Variable:
    """Describe the coordinate that marks the scenes whose contact reaches a slope that is not small."""
    attributes = {
        "units": "1",
        "long_name": STEEP_CONTACT,
        "flag_values": np.array([0, 1], dtype="i1"),
        "flag_meanings": "shallow steep",
    }
    return Variable(dimensions=tuple(study.sizes), dtype="i1", attributes=attributes)


def marks_steep_contact(study: Study) -> bool:
    """Report whether the dataset of a study has that coordinate where it marks any scene: not beside the slope."""
    return CONTACT_SLOPE not in study.variables


def attributes(study: Study, history: str) -> dict[str, Any]:
    """List the global attributes of a study's dataset: what it is, where it comes from, how to make it again."""
    own = {
        "profile": shape_in_words(study.profile, study.spectrum),
        **_of_fit(study),
        "control": study.loading.control,
        **({} if study.toughness is None else {"toughness": toughness_in_words(study.toughness)}),
        **({} if study.rate is None else {"rate": rate_in_words(study.rate)}),
    }
    return origin(study, history, own)


def origin(study: Study | FitStudy, history: str, own: Mapping[str, Any]) -> dict[str, Any]:
    """List the global attributes of any dataset, those of its `own` among them."""
    return {
        "Conventions": "CF-1.11",
        "title": study.title,
        "source": _source(),
        "history": history,
        "references": REFERENCES,
        **own,
        "study": study.text,
        "study_sha256": study.sha256,
        **_versions(),
    }


@cache
def _source() -> str:
    """Name this program and its version, which is read once: that takes a millisecond."""
    return f"gradhesion {version('gradhesion')}"


@cache
def _versions() -> Mapping[str, str]:
    """List the versions of what the values come from, which are read once."""
    packages = {f"{package}_version": version(package) for package in ("numpy", "numba", "scipy")}
    return {"python_version": platform.python_version(), **packages}


def _of_fit(study: Study) -> dict[str, Any]:
    """Say which file the profile was fitted to, what was found, and what the fit leaves, in m."""
    fit = study.measured.fit
    if fit is None:
        return {}
    return {
        "profile_file": study.measured.file,
        "profile_sha256": study.measured.sha256,
        "profile_fit": profile_table(study.profile),
        "profile_residual_rms": fit.residual_rms,
        "profile_residual_max": fit.residual_max,
    }


def compute(study: Study, *, threads: int | None = None) -> "xarray.Dataset":
    """
    Compute a study in memory.

    Parameters
    ----------
    study
        From `load_study` or `study_from`.
    threads
        Threads to use, as many as the process may use if None; the values do not depend on it.

    Returns
    -------
    The dataset that `gradhesion run` writes to a file, as xarray reads it.

    Notes
    -----
    The first study of a version compiles the solver, which a line on stderr reports.
    """
    prepare(study)
    kind = CONTENTS[study.sort]
    found = kind.joined(study, kind.parts(study, threads))
    for sentence in cautions(study, flagged_in(found["status"]), int(np.count_nonzero(found.get(STEEP, 0)))):
        messages.say(f"{study.name}: {sentence}")
    return assembled(study, found, "computed in memory")


def assembled(study: Study, found: Mapping[str, NDArray[Any]], history: str) -> "xarray.Dataset":
    """Put the values of all variables, and the marks of steep contacts, into the dataset of a study."""
    import xarray  # noqa: PLC0415 (450 ms that `run` does not need)

    made = {}
    for name, variable in variables(study).items():
        if variable.made:
            values = variable.made(tuple(slice(0, study.axes[axis]) for axis in variable.dimensions))
        else:
            values = found[name] if variable.values is None else variable.values
        blank = {} if variable.blank is None else {"_FillValue": values.dtype.type(variable.blank)}
        made[name] = xarray.Variable(variable.dimensions, values, variable.attributes | blank)
    coded = xarray.Dataset(made, attrs=attributes(study, history))
    return with_steep_contact(xarray.decode_cf(coded), study, found.get(STEEP, np.zeros(1, np.int8)))


def with_steep_contact(dataset: "xarray.Dataset", study: Study, steep: NDArray[np.int8]) -> "xarray.Dataset":
    """Mark the scenes of a dataset in memory whose contact reaches a slope that is not small, if any does."""
    if not steep.any() or not marks_steep_contact(study):
        return dataset
    mark = (dataset["status"].dims, steep, steep_contact(study).attributes)
    return dataset.assign_coords({STEEP: mark})
