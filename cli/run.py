"""`gradhesion run`: compute a study into a dataset."""

import shlex
import sys
import time
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gradhesion.cli.errors import ScenesFailedError
from gradhesion.cli.progress import progress, rate

if TYPE_CHECKING:
    from gradhesion.cli.writer import Written


@click.command()
@click.argument("study", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Dataset to write [outputs/<study name>.nc].")
@click.option("--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Set a key of the study, in TOML.")
@click.option("--overwrite", is_flag=True, help="Replace an existing dataset.")
@click.option("--fresh", is_flag=True, help="Drop the finished parts of an earlier run.")
@click.option("--fail-fast", is_flag=True, help="Stop at the first block with a failed scene, and write nothing.")
@click.option("--threads", type=click.IntRange(min=1), help="Threads to use [all cores]; values do not depend on it.")
@click.option("--quiet", is_flag=True, help="Say nothing unless something is wrong.")
def run(
    study: Path,
    output: Path | None,
    overrides: tuple[str, ...],
    overwrite: bool,
    fresh: bool,
    fail_fast: bool,
    threads: int | None,
    quiet: bool,
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
        written = write(
            asked,
            path,
            history=history,
            overwrite=overwrite,
            fresh=fresh,
            fail_fast=fail_fast,
            threads=threads,
            advance=advance,
        )
    seconds = time.monotonic() - start
    if not quiet:
        click.echo(_told(path, asked.scenes, written, seconds), err=True)
    for sentence in written.raised:
        click.echo(f"{path}: {sentence}", err=True)
    if written.raised:
        raise ScenesFailedError(
            f"{path}: {len(written.raised):,} blocks could not be solved, and their scenes have no value; the parts of "
            "the others are kept, and the same command with --overwrite tries these again"
        )
    if written.failed:
        raise ScenesFailedError(
            f"{path}: {written.failed:,} of {asked.scenes:,} scenes have failed; `gradhesion info {path}` tells why"
        )


def _told(path: Path, scenes: int, written: "Written", seconds: float) -> str:
    """Say what was written, and how much of it an earlier run had done."""
    size = path.stat().st_size / 1e6
    if written.complete:
        return f"{path}: {scenes:,} scenes, {size:.1f} MB, were complete already"
    speed = rate(scenes, seconds)
    reused = f"; reused {written.reused:,} blocks, computed {written.computed:,}" if written.reused else ""
    return f"{path}: {scenes:,} scenes in {seconds:.2f} s ({speed} per s), {size:.1f} MB{reused}"
