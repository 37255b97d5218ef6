"""`gradhesion run`: compute a study into a dataset."""

import shlex
import sys
import time
from datetime import UTC, datetime
from pathlib import Path

import click

from gradhesion.cli.errors import ScenesFailedError
from gradhesion.cli.progress import progress, rate


@click.command()
@click.argument("study", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Dataset to write [outputs/<study name>.nc].")
@click.option("--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Set a key of the study, in TOML.")
@click.option("--overwrite", is_flag=True, help="Replace an existing dataset.")
@click.option("--threads", type=click.IntRange(min=1), help="Threads to use [all cores]; values do not depend on it.")
@click.option("--quiet", is_flag=True, help="Say nothing unless something is wrong.")
def run(
    study: Path, output: Path | None, overrides: tuple[str, ...], overwrite: bool, threads: int | None, quiet: bool
) -> None:
    """Compute STUDY (TOML) into a dataset (NetCDF)."""
    from gradhesion.cli.study import load_study
    from gradhesion.cli.writer import write
    from gradhesion.core import compiled_before

    asked = load_study(study, overrides)
    path = output or Path("outputs") / f"{asked.name}.nc"
    if not quiet and not compiled_before(curves=asked.kind == "curve"):
        click.echo("compiling the kernels, once per version", err=True)
    start = time.monotonic()
    history = f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} gradhesion {shlex.join(sys.argv[1:])}"
    with progress(asked.scenes, quiet=quiet) as advance:
        failed = write(asked, path, history=history, overwrite=overwrite, threads=threads, advance=advance)
    seconds = time.monotonic() - start
    if not quiet:
        size = path.stat().st_size / 1e6
        speed = rate(asked.scenes, seconds)
        click.echo(f"{path}: {asked.scenes:,} scenes in {seconds:.2f} s ({speed} per s), {size:.1f} MB", err=True)
    if failed:
        raise ScenesFailedError(
            f"{path}: {failed:,} of {asked.scenes:,} scenes have failed; `gradhesion info {path}` tells why"
        )
