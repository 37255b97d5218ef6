"""`gradhesion run`: compute a study into a dataset."""

import re
import shlex
import sys
import time
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gradhesion.cli.commands.validate import overriding
from gradhesion.cli.errors import ScenesFailedError
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import bytes_in_words, counted
from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.given_up import given_up
from gradhesion.cli.terminal.printable import printable_line
from gradhesion.cli.terminal.progress import progress, rate
from gradhesion.cli.terminal.written import dataset_to_write

if TYPE_CHECKING:
    from gradhesion.cli.dataset.writer import Written
    from gradhesion.cli.study.study import Study
    from gradhesion.cli.work.engines import Engine


def _shard(_context: click.Context, _option: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Read I/N."""
    if value is None:
        return None
    found = re.fullmatch(r"(\d{1,9})/(\d{1,9})", value)
    shard = (int(found[1]), int(found[2])) if found else (0, 0)
    if not 1 <= shard[0] <= shard[1]:
        raise click.BadParameter(f"{value} is not of the form I/N with 1 <= I <= N; write for example --shard 3/8")
    return shard


@click.command(epilog=example("run study.toml", "run study.toml -o wavier.nc --set parameters.A=0.05"))
@click.argument("study", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    callback=dataset_to_write,
    help="Dataset to write [outputs/<study name>.nc].",
)
@overriding
@click.option("--overwrite", is_flag=True, help="Replace an existing dataset.")
@click.option("--fresh", is_flag=True, help="Discard the finished blocks of an earlier run.")
@click.option("--shard", metavar="I/N", callback=_shard, help="Compute every N-th block, for `merge`.")
@click.option(
    "--engine",
    type=click.Choice(["threads", "dask"]),
    default="threads",
    show_default=True,
    help="Where blocks are computed: local threads, or a Dask cluster.",
)
@click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler or its file [a cluster on this machine].")
@click.option(
    "--threads",
    type=click.IntRange(min=1),
    help="Threads to use [all available to the process]; values do not depend on it.",
)
@click.option("--quiet", is_flag=True, help="Print errors, and a line if the solver is compiled.")
@given_up("--dry-run", "use `gradhesion plan`")
@given_up("--chunk", "the size of blocks is chosen by itself")
@given_up("--fail-fast", "run fewer scenes first, and `gradhesion info` reports which have failed, and why")
@given_up("--log-json", "`gradhesion status FILE --json` shows how far a run is")
def run(
    study: Path,
    output: Path | None,
    overrides: tuple[str, ...],
    overwrite: bool,
    fresh: bool,
    shard: tuple[int, int] | None,
    engine: str,
    scheduler: str | None,
    threads: int | None,
    quiet: bool,
) -> None:
    """Compute a study into a dataset (NetCDF).

    STUDY is a TOML file. Interrupted runs resume where they stopped: give the same command again.
    """
    from gradhesion.cli.dataset.writer import write
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.study.reading import load_any
    from gradhesion.cli.work.compiling import prepare

    if scheduler is not None and (engine != "dask" or threads is not None):
        raise click.UsageError("--scheduler needs --engine dask, without --threads: its workers have their own")
    if shard is not None and fresh:
        raise click.UsageError("--shard cannot be combined with --fresh, which discards the blocks of all shards")
    loaded = load_any(study, overrides)
    path = output or Path("outputs") / f"{loaded.name}.nc"
    if isinstance(loaded, FitStudy):
        from gradhesion.cli.commands.run_fit import run_fit

        refused = {"--shard": shard, "--fresh": fresh, "--engine dask": engine != "threads"}
        if given := [word for word, on in refused.items() if on]:
            raise click.UsageError(f"{given[0]}: a fit has no blocks of scenes; run it without")
        run_fit(loaded, path, history=history_now(), overwrite=overwrite, quiet=quiet)
        return
    if scheduler is None:  # the workers of another cluster have caches of their own
        prepare(loaded)
    solver = _engine(loaded, engine, scheduler, threads, quiet=quiet)
    if shard is not None:
        _run_shard(loaded, path, shard, solver, overwrite=overwrite, quiet=quiet)
        return
    start = time.monotonic()
    with progress(loaded.scenes, quiet=quiet) as advance:
        written = write(
            loaded,
            path,
            history=history_now(),
            overwrite=overwrite,
            fresh=fresh,
            threads=threads,
            engine=solver,
            advance=advance,
        )
    finish(path, loaded.scenes, written, time.monotonic() - start, quiet=quiet)


def history_now() -> str:
    """Write the line of `history` for this command."""
    return printable_line(f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} gradhesion {shlex.join(sys.argv[1:])}")


def finish(path: Path, scenes: int, written: "Written", seconds: float, *, quiet: bool) -> None:
    """
    Say what was written, how much of it an earlier run had done, and what has failed.

    Raises
    ------
    ScenesFailedError
        Some scenes have.
    """
    if not quiet:
        count, size = counted(scenes, "scene"), bytes_in_words(path.stat().st_size)
        reused = f"; reused {counted(written.reused, 'block')}, computed {written.computed:,}" if written.reused else ""
        took = f"{count} in {seconds:.2f} s ({rate(scenes, seconds)} per s), {size}{reused}"
        messages.say(f"{path}: {f'{count}, {size}, were complete already' if written.complete else took}")
        for sentence in written.cautions:
            messages.say(f"{path}: {sentence}")
    if written.failed:
        raise ScenesFailedError(
            f"{path}: {written.failed:,} of {counted(scenes, 'scene')} failed; `gradhesion info {path}` reports why"
        )


def _engine(study: "Study", engine: str, scheduler: str | None, threads: int | None, *, quiet: bool) -> "Engine":
    """Choose who solves the blocks of a study."""
    from gradhesion.cli.work.engines import in_threads

    if engine == "dask":
        from gradhesion.cli.work.cluster import on_cluster, require_dask

        require_dask()
        if study.has_parts:
            return on_cluster(scheduler, threads, quiet=quiet)
        if not quiet:
            messages.say("the study has one block or consists of curves, and is solved in this process")
    return in_threads(threads)


def _run_shard(
    study: "Study", path: Path, shard: tuple[int, int], solver: "Engine", *, overwrite: bool, quiet: bool
) -> None:
    """Compute the blocks of a shard."""
    from gradhesion.cli.dataset.writer import write_shard

    if not study.has_parts:
        raise click.UsageError("--shard: the study has one block only, and needs no shards; run it without --shard")
    with progress(study.scenes // shard[1], quiet=quiet) as advance:
        written = write_shard(study, path, shard, overwrite=overwrite, engine=solver, advance=advance)
    if not quiet:
        messages.say(
            f"{path}.parts: shard {shard[0]} of {shard[1]}: reused {counted(written.reused, 'block')}, computed "
            f"{written.computed:,}; `gradhesion merge {path}` joins them when all shards are done"
        )
