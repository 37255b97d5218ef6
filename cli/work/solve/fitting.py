"""The fits of a study: points given to the core, what cannot be fitted, and why a fit is not to be trusted."""

from collections.abc import Callable, Iterator
from typing import Final, NamedTuple

from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.fit.loop_file import LoopFile
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.core.closed.applicability import validity
from gradhesion.core.closed.reduced import parameters_from
from gradhesion.core.loops.fit import fit_loop
from gradhesion.core.loops.fitted import FittedLoop, poor_from
from gradhesion.core.loops.paths.model import AMPLITUDES, EXPONENT, Model
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.problem.names import CLOSING, PARAMETERS, RANGE
from gradhesion.core.problem.status import POOR_FIT

USUAL_RANGE: Final = 3e-10
"""The range of the attraction in m where a study has none: about the distance of atoms."""
_AT_AN_END: Final = {
    **dict.fromkeys(OFFSETS, "widen it with offsets under [fit], or look at the base line of the data"),
    **dict.fromkeys(AMPLITUDES, "widen the range; at its lower end the loop shows no waves: leave them out"),
    "k": "widen the range; at 0 the loop shows no gradient of the modulus: write k = 0",
    CLOSING: f"widen the range; at 1 the loop shows one work of adhesion: leave {CLOSING} out",
}
"""What to do about a value at an end of its range."""


class Fit(NamedTuple):
    """A loop of a study with what was found, or why nothing was."""

    loop: LoopFile
    found: FittedLoop | None = None
    problem: str = ""


def fitted(study: FitStudy, loop: LoopFile) -> FittedLoop:
    """Fit a loop; StudyError where what is searched cannot be told apart, has no effect, or has no path."""
    try:
        return fit_loop(
            loop.depth,
            loop.load,
            loop.unloading,
            study.fixed,
            study.free,
            noise=study.noise_of(loop),
            noise_is_given=study.given_noise is not None,
            counts=loop.counts,
            offsets=study.offsets,
            profile=study.profile,
            loading=study.loading,
            toughness=study.toughness,
            rate=study.rate,
            intervals=study.intervals,
            starts=study.starts,
        )
    except ValueError as error:
        raise StudyError(f"{study.name if study.is_of_one else loop.file}: {error}") from None


def fits_of(study: FitStudy, advance: Callable[[int], None] = lambda _: None) -> list[Fit]:
    """Fit every loop of a study, one after the other; `advance` is called with 1 after each.

    Of several, those that cannot be fitted have a `problem`; StudyError with that of the first if none can.
    """
    fits = []
    for loop in study.loops:
        found, problem = None, loop.problem
        try:
            found = None if problem else fitted(study, loop)
        except StudyError as error:
            if study.is_of_one:
                raise
            problem = str(error).removeprefix(f"{loop.file}: ")
        fits.append(Fit(loop, found, problem))
        advance(1)
    if all(fit.found is None for fit in fits):
        more = f" (none of the {len(fits):,} loops has a fit)" if len(fits) > 1 else ""
        raise StudyError(f"{fits[0].loop.file}: {fits[0].problem}{more}")
    return fits


def tabor_of(study: FitStudy, found: FittedLoop) -> float:
    """Give the Tabor parameter at the fitted values."""
    model = Model(study.fixed, found.names, study.profile, study.loading, study.toughness)
    given = model.given({name: value for name, value in found.values.items() if name != EXPONENT})
    made = parameters_from(given) | {RANGE: (study.adhesion_range or USUAL_RANGE) / given["R"]}
    scene = {name: float(made[name]) for name in (*PARAMETERS, RANGE)}
    return float(validity(scene, ["tabor_parameter"], study.profile)["tabor_parameter"])


def range_words(study: FitStudy) -> str:
    """Say which range of the attraction that is."""
    source = "assumed, as adhesion_range is not given" if study.adhesion_range is None else "given"
    return f"with a range of the attraction of {1e9 * (study.adhesion_range or USUAL_RANGE):.3g} nm, {source}"


def doubts_of(found: FittedLoop) -> Iterator[str]:
    """Say why a fit is not to be trusted; nothing if it is."""
    if not found.converged:
        yield "the fit did not converge; give more starts, or narrower ranges"
    if found.status & POOR_FIT:
        most = f"{poor_from(found.degrees_of_freedom):.3g} is the most that noise explains"
        remedy = "try another model, wider ranges, or other noise (fit.noise), and check the signs of depth and load"
        yield f"a poor fit: reduced chi square {found.reduced_chi_square:.3g}, where {most}; {remedy}"
    for other in found.others:
        here, there = (
            f"{one.chi_square:.6g} at " + ", ".join(f"{name} = {value:.4g}" for name, value in one.values.items())
            for one in (found, other)
        )
        remedy = "narrow the ranges to the one that is meant"
        yield f"another minimum is within the noise: chi square {there}, beside {here}; {remedy}"
    for name in found.on_bound:
        low, high = found.ranges[name]
        remedy = _AT_AN_END.get(name, "widen the range, or give it as a number; or the data do not show it")
        yield f"{name} is at an end of its range ({found.values[name]:.4g} of {low:.4g} to {high:.4g}); {remedy}"
