"""The fits of a study: points given to the core, and what cannot be fitted."""

from collections.abc import Callable
from typing import Any, Final, NamedTuple

from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.fit.loops import LoopFile
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.core.closed.applicability import validity
from gradhesion.core.closed.reduced import parameters_from
from gradhesion.core.loops.fit import fit_loop
from gradhesion.core.loops.fitted import FittedLoop
from gradhesion.core.loops.paths.model import EXPONENT, LoopModel
from gradhesion.core.problem.names import PARAMETERS, RANGE

USUAL_RANGE: Final = 3e-10
"""The range of the attraction in m where a study has none: about the distance of atoms."""


class Fit(NamedTuple):
    """A loop of a study with what was found, or why nothing was."""

    loop: LoopFile
    found: FittedLoop | None = None
    problem: str = ""


def fits_of(study: FitStudy, advance: Callable[[int], None] = lambda _: None) -> list[Fit]:
    """Fit every loop of a study, one after the other; `advance` is called with 1 after each.

    Of several, those in which what is searched cannot be told apart, has no effect or has no path have a `problem`;
    StudyError with that of the first if none is fitted.
    """
    own = ("offsets", "profile", "loading", "toughness", "rate", "intervals", "starts")
    settings: dict[str, Any] = {name: getattr(study, name) for name in own}
    settings["noise_is_given"] = study.given_noise is not None
    fits = []
    for loop in study.loops:
        found, problem, points = None, loop.problem, (loop.depth, loop.load, loop.unloading)
        try:
            if not problem:
                settings |= {"noise": study.noise_of(loop), "counts": loop.counts}
                found = fit_loop(*points, study.fixed, study.free, **settings)
        except ValueError as error:
            if study.is_of_one:
                raise StudyError(f"{study.name}: {error}") from None
            problem = str(error)
        fits.append(Fit(loop, found, problem))
        advance(1)
    if all(fit.found is None for fit in fits):
        more = f" (none of the {len(fits):,} loops has a fit)" if len(fits) > 1 else ""
        raise StudyError(f"{fits[0].loop.file}: {fits[0].problem}{more}")
    return fits


def tabor_of(study: FitStudy, found: FittedLoop) -> float:
    """Give the Tabor parameter at the fitted values."""
    model = LoopModel(study.fixed, found.names, study.profile, study.loading, study.toughness)
    given = model.given({name: value for name, value in found.values.items() if name != EXPONENT})
    made = parameters_from(given) | {RANGE: (study.adhesion_range or USUAL_RANGE) / given["R"]}
    scene = {name: float(made[name]) for name in (*PARAMETERS, RANGE)}
    return float(validity(scene, ["tabor_parameter"], study.profile)["tabor_parameter"])


def range_words(study: FitStudy) -> str:
    """Say which range of the attraction that is."""
    source = "assumed, as adhesion_range is not given" if study.adhesion_range is None else "given"
    return f"with a range of the attraction of {1e9 * (study.adhesion_range or USUAL_RANGE):.3g} nm, {source}"
