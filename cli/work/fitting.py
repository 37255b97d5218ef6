"""The fit of a loop: its points given to the core, and what cannot be fitted as a mistake of the study."""

from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.fit_study import FitStudy
from gradhesion.core import kind_of_curves, kind_of_map, kind_of_turning
from gradhesion.core.answers.loop_fit import FittedLoop, fit_loop
from gradhesion.core.problem.control import Loading


def loading_of(study: FitStudy) -> Loading:
    """Give what is prescribed in a measured cycle."""
    return Loading(control="machine") if study.loop.through_machine else Loading()


def kinds_of_fit(study: FitStudy) -> tuple[str, ...]:
    """Give the kinds of work of a fit (core/kinds.py)."""
    shape = study.profile, loading_of(study)
    turning = (kind_of_turning(*shape),) if "preload" in {*study.fixed, *study.free} else ()
    return (kind_of_map(["dissipated_energy"], "exact", *shape), kind_of_curves(*shape), *turning)


def fitted(study: FitStudy) -> FittedLoop:
    """
    Fit the loop of a study.

    Raises
    ------
    StudyError
        What is searched cannot be told apart, has no effect, or has no path within its ranges.
    """
    loop = study.loop
    try:
        return fit_loop(
            loop.depth,
            loop.load,
            loop.unloading,
            study.fixed,
            study.free,
            noise=study.noise,
            offsets=study.offsets,
            profile=study.profile,
            through_machine=loop.through_machine,
            intervals=study.intervals,
            starts=study.starts,
        )
    except ValueError as error:
        raise StudyError(f"{study.name}: {error}") from None


def doubts_of(found: FittedLoop) -> list[str]:
    """Say why a fit is not to be trusted; nothing if it is."""
    sentences = [] if found.converged else ["the fit did not converge; give more starts, or narrower ranges"]
    end = "is at an end of its range; widen the range, or give it as a number"
    return [*sentences, *(f"{name} {end}" for name in found.on_bound)]
