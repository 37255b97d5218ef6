"""`gradhesion run`: compute a study into a dataset."""

import re
import statistics
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from gradhesion.cli.commands import shared
from gradhesion.cli.errors import DoubtfulError
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import bytes_in_words, counted
from gradhesion.cli.terminal.progress import progress, rate

if TYPE_CHECKING:
    from gradhesion.cli.dataset.writer import Written
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.work.solve.fitting import Fit

ENGINES: Final = click.Choice(["threads", "dask"])
SAID: Final = 20
"""Sentences on the loops of a fit that are printed; `gradhesion info` has all of them."""


def _shard(_context: click.Context, _option: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Read I/N."""
    if value is None:
        return None
    found = re.fullmatch(r"(\d{1,9})/(\d{1,9})", value)
    shard = (int(found[1]), int(found[2])) if found else (0, 0)
    if not 1 <= shard[0] <= shard[1]:
        raise click.BadParameter(f"{value} is not of the form I/N with 1 <= I <= N; write for example --shard 3/8")
    return shard


@click.command(epilog=shared.example("run study.toml", "run study.toml -o wavier.nc --set parameters.A=0.05"))
@click.argument("study", type=shared.A_PATH)
@shared.dataset_to_write("Dataset to write [outputs/<study name>.nc].")
@shared.overriding
@shared.overwriting
@click.option("--fresh", is_flag=True, help="Discard the finished blocks of an earlier run.")
@click.option("--shard", metavar="I/N", callback=_shard, help="Compute every N-th block, for `merge`.")
@click.option("--engine", type=ENGINES, default="threads", show_default=True, help="Local threads, or a Dask cluster.")
@click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler or its file [a cluster on this machine].")
@shared.threading
@shared.quietly
@shared.given_up("--dry-run", "use `gradhesion plan`")
@shared.given_up("--chunk", "the size of blocks is chosen by itself")
@shared.given_up("--fail-fast", "run fewer scenes first, and `gradhesion info` reports which have failed, and why")
@shared.given_up("--log-json", "`gradhesion status FILE --json` shows how far a run is")
def run(study: Path, output: Path | None, overrides: tuple[str, ...], engine: str, **how: Any) -> None:
    """Compute a study into a dataset (NetCDF).

    STUDY is a TOML file. Interrupted runs resume where they stopped: give the same command again.
    """
    from gradhesion.cli.dataset.writer import write
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.study.reading import load_any
    from gradhesion.cli.work.compiling import prepare

    scheduler, shard, fresh, threads = how.pop("scheduler"), how["shard"], how["fresh"], how["threads"]
    if scheduler is not None and (engine != "dask" or threads is not None):
        raise click.UsageError("--scheduler needs --engine dask, without --threads: its workers have their own")
    if shard is not None and fresh:
        raise click.UsageError("--shard cannot be combined with --fresh, which discards the blocks of all shards")
    loaded = load_any(study, overrides)
    path = output or Path("outputs") / f"{loaded.name}.nc"
    if isinstance(loaded, FitStudy):
        if shard is not None or fresh or engine != "threads":
            raise click.UsageError("a fit has no blocks of scenes; run it without --shard, --fresh and --engine")
        _run_fit(loaded, path, overwrite=how["overwrite"])
        return
    if shard is not None and not loaded.has_parts:
        raise click.UsageError("--shard: the study has one block only, and needs no shards; run it without --shard")
    if scheduler is None:  # the workers of another cluster have caches of their own
        prepare(loaded)
    solver = None  # this process
    if engine == "dask":
        from gradhesion.cli.work.cluster import on_cluster

        solver = on_cluster(scheduler, threads)
        if not loaded.has_parts:
            solver = None
            messages.note("the study has one block or consists of curves, and is solved in this process")
    start = time.monotonic()
    with progress(loaded.scenes // (shard[1] if shard else 1)) as advance:
        done = write(loaded, path, history=shared.history_now(), engine=solver, advance=advance, **how)
    if shard is None:
        finish(path, loaded.scenes, done, time.monotonic() - start)
        return
    did = f"reused {counted(done.reused, 'block')}, computed {done.computed:,}"
    end = f"`gradhesion merge {path}` joins them when all shards are done"
    messages.note(f"{path}.parts: shard {shard[0]} of {shard[1]}: {did}; {end}")


def finish(path: Path, scenes: int, written: "Written", seconds: float) -> None:
    """Say what was written, how much of it an earlier run had done, and what has failed (DoubtfulError)."""
    count, size = counted(scenes, "scene"), bytes_in_words(path.stat().st_size)
    reused = f"; reused {counted(written.reused, 'block')}, computed {written.computed:,}" if written.reused else ""
    took = f"{count} in {seconds:.2f} s ({rate(scenes, seconds)} per s), {size}{reused}"
    messages.note(f"{path}: {f'{count}, {size}, were complete already' if written.complete else took}")
    messages.note(*(f"{path}: {sentence}" for sentence in written.cautions))
    if written.failed:
        failed = f"{written.failed:,} of {counted(scenes, 'scene')} failed"
        raise DoubtfulError(f"{path}: {failed}; `gradhesion info {path}` reports why")


def _run_fit(study: "FitStudy", path: Path, *, overwrite: bool) -> None:
    """Fit the loops of a study, write what is found, and say what is doubtful (DoubtfulError)."""
    from gradhesion.cli.dataset.fits import cautions_of_fit, dataset_of, refuse_size
    from gradhesion.cli.dataset.select import write_dataset
    from gradhesion.cli.disk import refuse_existing
    from gradhesion.cli.words.fit_words import doubts_of
    from gradhesion.cli.work.compiling import prepare
    from gradhesion.cli.work.solve.fitting import fits_of

    refuse_existing(path, overwrite=overwrite)
    refuse_size(study)
    messages.note(*_first(study.notes))
    prepare()
    start = time.monotonic()
    with progress(len(study.loops), "loop") as advance:
        fits = fits_of(study, advance)
    took = f"fitted in {time.monotonic() - start:.1f} s"
    dataset = dataset_of(study, fits, shared.history_now())
    write_dataset(dataset, path, overwrite=overwrite)

    messages.note(f"{path}: {_done(study, fits, f'{took}, {bytes_in_words(path.stat().st_size)}')}")
    about = [f"{path}" if study.is_of_one else f"{path}: {fit.loop.file}" for fit in fits]
    known = [(one, fit.found) for one, fit in zip(about, fits, strict=True) if fit.found]
    messages.note(*_first([f"{one}: {said}" for one, found in known for said in cautions_of_fit(study, found)]))
    rows = [dataset] if study.is_of_one else [dataset.isel(loop=i) for i in range(len(fits))]
    if doubts := [f"{one}: {said}" for one, row in zip(about, rows, strict=True) for said in doubts_of(row)]:
        raise DoubtfulError(_first(doubts))


def _done(study: "FitStudy", fits: Sequence["Fit"], took: str) -> str:
    """Say what was found: the values of one loop, or the medians of several."""
    found = [fit.found for fit in fits if fit.found is not None]
    medians = {name: statistics.median(one.values[name] for one in found) for name in found[0].values}
    values = ", ".join(f"{name} = {value:.4g}" for name, value in medians.items())
    reduced = [one.reduced_chi_square for one in found]
    if study.is_of_one:
        return f"{counted(study.loop.depth.size, 'point')} {took}: {values}; reduced chi square {reduced[0]:.3g}"
    span = f"{min(reduced):.3g} to {max(reduced):.3g}"
    return f"{len(found):,} of {counted(len(fits), 'loop')} {took}: medians {values}; reduced chi square {span}"


def _first(sentences: Sequence[str]) -> list[str]:
    """Give the first sentences, and say how many are left."""
    left = len(sentences) - SAID
    more = [f"and {left:,} more; `gradhesion info` of the dataset lists them"] if left > 0 else []
    return [*sentences[:SAID], *more]
