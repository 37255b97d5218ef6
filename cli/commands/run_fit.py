"""What `gradhesion run` does with a study of a fit: fit every loop, write, and say what is doubtful."""

import statistics
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from gradhesion.cli.errors import FitDoubtfulError
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import bytes_in_words, counted
from gradhesion.cli.terminal.progress import progress

if TYPE_CHECKING:
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.work.solve.fitting import Fit

SAID: Final = 20
"""Sentences on several loops that are printed; `gradhesion info` has all of them."""


def run_fit(study: "FitStudy", path: Path, *, history: str, overwrite: bool, quiet: bool) -> None:
    """
    Fit the loops of a study and write what is found.

    Raises
    ------
    FitDoubtfulError
        It is written, and some of it is not to be trusted.
    """
    from gradhesion.cli.dataset.fits.cautions import cautions_of_fit
    from gradhesion.cli.dataset.fits.fit import write_fit
    from gradhesion.cli.dataset.fits.rows import refuse_size
    from gradhesion.cli.disk import refuse_existing
    from gradhesion.cli.work.compiling import prepare
    from gradhesion.cli.work.solve.fitting import doubts_of, fits_of

    refuse_existing(path, overwrite=overwrite)
    refuse_size(study)
    for note in () if quiet else _first(study.notes):
        messages.say(note)
    prepare()
    start = time.monotonic()
    with progress(len(study.loops), quiet=quiet or len(study.loops) == 1, noun="loop") as advance:
        fits = fits_of(study, advance)
    seconds = time.monotonic() - start
    write_fit(study, fits, path, history=history, overwrite=overwrite)

    def about(fit: "Fit") -> str:
        return f"{path}: " if study.is_of_one else f"{path}: {fit.loop.file}: "

    if not quiet:
        messages.say(f"{path}: {_done(study, fits, seconds, path.stat().st_size)}")
        warnings = [f"{about(fit)}{one}" for fit in fits if fit.found for one in cautions_of_fit(study, fit.found)]
        for sentence in _first(warnings):
            messages.say(sentence)
    doubts = [f"{about(fit)}{one}" for fit in fits for one in (doubts_of(fit.found) if fit.found else [fit.problem])]
    if doubts:
        raise FitDoubtfulError(list(_first(doubts)))


def _done(study: "FitStudy", fits: Sequence["Fit"], seconds: float, size: int) -> str:
    """Say what was fitted."""
    found = [fit.found for fit in fits if fit.found is not None]
    took = f"fitted in {seconds:.1f} s, {bytes_in_words(size)}"
    if study.is_of_one:
        values = ", ".join(f"{name} = {value:.4g}" for name, value in found[0].values.items())
        points = counted(study.loop.depth.size, "point")
        return f"{points} {took}: {values}; reduced chi square {found[0].reduced_chi_square:.3g}"
    medians = ", ".join(
        f"{name} = {statistics.median([one.values[name] for one in found]):.4g}" for name in study.parameters
    )
    reduced = [one.reduced_chi_square for one in found]
    of_all = f"{len(found):,} of {counted(len(fits), 'loop')}"
    return f"{of_all} {took}: medians {medians}; reduced chi square {min(reduced):.3g} to {max(reduced):.3g}"


def _first(sentences: Sequence[str]) -> Iterator[str]:
    """Give the first sentences, and say how many are left."""
    yield from sentences[:SAID]
    if (left := len(sentences) - SAID) > 0:
        yield f"and {left:,} more; `gradhesion info` of the dataset lists them"
