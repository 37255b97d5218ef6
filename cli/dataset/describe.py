"""A study's dataset by CF-1.11: its variables, where coordinates come from, and what it says of itself."""

import platform
from collections.abc import Callable, Mapping
from functools import cache, partial
from importlib.metadata import version
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names import curves, outputs
from gradhesion.cli.names.outputs import BEST, OF_PHYSICAL, ON_BOUND, PARETO_POINT, SI, labels_of, unit_of
from gradhesion.cli.names.scenes import IDLE, REALISATION, REFERENCES, SOLVER, SOLVERS, STATUS, STEEP_CONTACT
from gradhesion.cli.study.files import COMMENT
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.shape_words import profile_table, rate_in_words, shape_in_words, toughness_in_words
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, shape_of
from gradhesion.cli.work.solve.scenes import blank_of, scenes_from
from gradhesion.core import FLAGS
from gradhesion.core.answers.flags import FLAGS as ALL_FLAGS
from gradhesion.core.problem.inputs import INPUTS, REDUCED
from gradhesion.core.problem.names import CONTACT_SLOPE, TURNS
from gradhesion.core.problem.outputs import without_scale
from gradhesion.core.problem.status import OF_EVERY_MAP, TOO_MANY_WAVES

RMS: Final = {
    "A": "rms height over wavelength of the random waviness",
    "amplitude": "rms height A lambda of the random waviness",
    "chi": "roughness parameter chi = r/s of one cosine as high as the rms height of the random waviness",
}
"""What the amplitude is of random roughness."""
_version: Final = cache(version)
"""Gives the version of a package, which takes a millisecond to read."""


class Variable(NamedTuple):
    """A variable of a dataset; a coordinate knows its values, an output gets them block by block."""

    dimensions: tuple[str, ...]
    dtype: str
    attributes: dict[str, Any]
    values: NDArray[Any] | None = None
    made: Callable[[Block], NDArray[np.float64]] | None = None
    """Makes the values of a block of a coordinate that may be as large as an output."""
    blank: float | None = None
    """What stands where there is no value, if `_FillValue` says so."""


def variables(study: Study) -> dict[str, Variable]:
    """Describe the variables of a study's dataset, coordinates first."""
    found = _labels(study) | _parameters(study)
    apart = (*study.sizes, *study.labels, curves.STATE)
    beside = " ".join(name for name in found if name not in apart)
    results = {name: _output(study, name) for name in study.variables}
    own = ALL_FLAGS if study.has_answers else FLAGS if study.turn == TURNS[0] else OF_EVERY_MAP
    flags = {name: bit for name, bit in own.items() if bit != TOO_MANY_WAVES}
    flags |= {name: bit for name, bit in FLAGS.items() if bit == TOO_MANY_WAVES and study.follows_waves}
    attributes = {"units": "1", "long_name": STATUS} | flags_of(flags, study.status_type)
    results["status"] = Variable(tuple(study.sizes), study.status_type, attributes)
    for name, variable in results.items():
        if beside and not curves.is_ragged(name):
            variable.attributes["coordinates"] = beside
    return found | results


def flags_of(bits: Mapping[str, int], dtype: str) -> dict[str, Any]:
    """Give the attributes of a variable whose bits have these names."""
    return {"flag_masks": np.array(list(bits.values()), dtype=dtype), "flag_meanings": " ".join(bits)}


def steep_contact(study: Study) -> Variable | None:
    """Describe the coordinate that marks steep contacts, where a study has any; None beside their slope itself."""
    if CONTACT_SLOPE in study.variables:
        return None
    attributes: dict[str, Any] = {"units": "1", "long_name": STEEP_CONTACT}
    attributes |= {"flag_values": np.array([0, 1], dtype="i1"), "flag_meanings": "shallow steep"}
    return Variable(tuple(study.sizes), "i1", attributes)


def _labels(study: Study) -> dict[str, Variable]:
    """Describe the coordinates that are no parameters: solvers, realisations, states, and what sensitivities are to."""
    found = {}
    if SOLVER in study.sizes:
        found[SOLVER] = _words(SOLVER, study.method.solver, SOLVERS)
    if study.spectrum is not None:
        about = {"units": "1", "long_name": "realisation of the random roughness"}
        numbers = np.arange(study.spectrum.realisations, dtype=np.int32)
        found[REALISATION] = Variable((REALISATION,), "i4", about, numbers)
    if study.states:
        about = {"units": "1", "long_name": "contact radius a/R of a state of equilibrium"}
        found[curves.STATE] = Variable((curves.STATE,), "f8", about, np.array(study.states))
    elif any(curves.curve_of(name) in curves.STATE_CURVES for name in study.outputs):
        found[curves.STATE] = _words(curves.STATE, curves.NAMED_STATES, "state of a loading cycle")
    return found | {name: _words(name, own, "parameter of the sensitivity") for name, own in study.labels.items()}


def _words(name: str, words: object, about: str) -> Variable:
    """Describe a dimension whose items are words."""
    return Variable((name,), "str", {"long_name": about}, np.array(words, dtype=str))


def _parameters(study: Study) -> dict[str, Variable]:
    """Describe the parameters of the scenes: those that are given, and those that follow from them."""
    axes, found = tuple(study.axes), dict[str, Variable]()
    for name, key in INPUTS.items():
        attributes = {"units": key.unit, "long_name": key.about}
        if study.spectrum is not None:
            attributes["long_name"] = RMS.get(name, key.about)
        if name in study.left_out:
            attributes["comment"] = f"{IDLE} where {key.idle_without} = 0; the study leaves it out"
        if name in study.points.inputs:
            attributes["comment"] = COMMENT + study.points.file
        if name in study.parameters:
            values = np.asarray(study.parameters[name])
            own: tuple[str, ...] = (name,) if name in axes else ()
            if study.layout == "points":
                own, values = axes, np.broadcast_to(values, tuple(study.axes.values()))
            found[name] = Variable(own, "f8", attributes, values)
        elif name in study.made:
            from gradhesion.core.closed.reduced import sources_of  # noqa: PLC0415 (300 ms for SciPy)

            sources = sources_of(name, dict.fromkeys(study.given))
            own = tuple(axis for axis in axes if axis in sources or study.layout == "points")
            blank = np.nan if REDUCED.keys() & study.parameters.keys() else None  # where there is no a_2
            found[name] = Variable(own, "f8", attributes, made=partial(_made, study, name, own), blank=blank)
    return found


def _made(study: Study, name: str, own: tuple[str, ...], block: Block) -> NDArray[Any]:
    """Compute a block, of its own axes, of a parameter that is made from others."""
    cuts = dict(zip(own, block, strict=True))
    whole = tuple(cuts.get(axis, slice(0, 1)) for axis in study.axes)
    given = study.parameters_of(whole) | {one: np.asarray(its.ends[0]) for one, its in study.searched.items()}
    return np.broadcast_to(scenes_from(given)[name], shape_of(whole)).reshape(shape_of(block))


def _output(study: Study, name: str) -> Variable:
    """Describe a result: a value of each scene of a map, of each optimum, or of a curve; perhaps in SI units."""
    plain, scenes = name.removesuffix(SI), tuple(study.sizes)
    if plain == ON_BOUND:
        ends = [f"{one}_at_its_{end}_bound" for one in study.searched for end in ("lower", "upper")]
        about: dict[str, Any] = {"units": "1", "long_name": "bounds at which the optimum lies (0: none)"}
        return Variable(scenes, "i1", about | flags_of({end: 1 << i for i, end in enumerate(ends)}, "i1"))
    unit, meaning = unit_of(name), _long_name(study, plain)
    about = {"units": unit, "ancillary_variables": "status"}
    about["long_name"] = meaning if plain == name else without_scale(meaning, unit)
    if study.kind == "curve":
        return _of_curve(scenes, plain, about)
    if plain.endswith("_std"):
        sampled = bool(study.uncertainty.samples)
        about["comment"] = "of samples of the uncertain inputs" if sampled else "linear, by sensitivities"
    if plain.endswith("_jumps") and not study.search:
        return Variable(scenes, "i4", about)
    labels = (labels_of(plain),) if labels_of(plain) else ()
    points = (PARETO_POINT,) if study.search.is_front else ()
    return Variable((*scenes, *labels, *points), "f8", about, blank=np.nan)


def _of_curve(scenes: tuple[str, ...], name: str, about: dict[str, Any]) -> Variable:
    """Describe a variable of a curve, along a dimension of its own."""
    curve, dtype = curves.curve_of(name) or "", curves.INTEGERS.get(name, "f8")
    extent = curves.EXTENTS[curve]
    if name in curves.MEANINGS:
        about |= {"flag_values": np.array([0, 1], dtype=dtype), "flag_meanings": curves.MEANINGS[name]}
    if name in curves.RAGGED.values():
        return Variable(scenes, dtype, about | {"sample_dimension": extent})
    if curves.is_ragged(name):
        del about["ancillary_variables"]  # `status` has other dimensions
        return Variable((extent,), dtype, about)
    states = (curves.STATE,) if curve in curves.STATE_CURVES else ()
    return Variable((*scenes, *states, extent), dtype, about, blank=blank_of(name))


def _long_name(study: Study, name: str) -> str:
    """Say what a result is, also the sensitivity of one in SI units."""
    plain = name.removeprefix(BEST)
    if study.kind == "curve":
        return curves.CURVES[curves.curve_of(name) or ""][name]
    if plain in INPUTS:
        return f"best {INPUTS[plain].about}"
    meaning = (outputs.OUTPUTS | outputs.SPREADS)[plain.removesuffix(OF_PHYSICAL)]
    if plain.endswith(OF_PHYSICAL):
        meaning = meaning.split(" to each parameter")[0] + " in SI units to each quantity q with a unit: d ln/d ln q"
    if study.search:
        return f"{meaning}, at the optimum"
    if name in ("dissipated_energy", "unloading_energy") and study.loading.control == "load":
        return meaning.replace(",", " without its jump-out, which has no bound,")
    return meaning


def attributes(study: Study, history: str) -> dict[str, Any]:
    """List the global attributes of a study's dataset: what it is, where it comes from, how to make it again."""
    own: dict[str, Any] = {"profile": shape_in_words(study.profile, study.spectrum)}
    if (fit := study.measured.fit) is not None:
        own |= {"profile_file": study.measured.file, "profile_sha256": study.measured.sha256}
        own |= {"profile_fit": profile_table(study.profile)}
        own |= {"profile_residual_rms": fit.residual_rms, "profile_residual_max": fit.residual_max}
    return origin(study, history, own | driven_in_words(study))


def driven_in_words(study: Study | FitStudy) -> dict[str, Any]:
    """Say how the punch is driven; how its toughness varies, and grows with the speed of its edge, if it does."""
    toughness = {} if study.toughness is None else {"toughness": toughness_in_words(study.toughness)}
    rate = {} if study.rate is None else {"rate": rate_in_words(study.rate)}
    return {"control": study.loading.control, **toughness, **rate}


def origin(study: Study | FitStudy, history: str, own: Mapping[str, Any]) -> dict[str, Any]:
    """List the global attributes of any dataset, those of its `own` among them."""
    return {
        "Conventions": "CF-1.11",
        "title": study.title,
        "source": f"gradhesion {_version('gradhesion')}",
        "history": history,
        "references": REFERENCES,
        **own,
        "study": study.text,
        "study_sha256": study.sha256,
        "python_version": platform.python_version(),
        **{f"{package}_version": _version(package) for package in ("numpy", "numba", "scipy")},
    }
