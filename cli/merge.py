"""`gradhesion merge`: join the parts that shards have computed."""

import time
from pathlib import Path

import click

from gradhesion.cli import messages
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.progress import progress
from gradhesion.cli.run import finish, history_now


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--overwrite", is_flag=True, help="Replace an existing dataset.")
@click.option("--quiet", is_flag=True, help="Say nothing unless something is wrong.")
@click.option("--log-json", is_flag=True, is_eager=True, callback=messages.speak_json, help="One JSON object a line.")
def merge(file: Path, overwrite: bool, quiet: bool, log_json: bool) -> None:  # noqa: ARG001 (its callback has it)
    """Join the parts that `gradhesion run STUDY.toml --shard I/N -o FILE` has left, into the dataset FILE."""
    from gradhesion.cli.blocks import count_of
    from gradhesion.cli.engines.kept import Kept
    from gradhesion.cli.folder import folder_of
    from gradhesion.cli.manifest import study_in
    from gradhesion.cli.writer import write

    start = time.monotonic()
    folder = folder_of(file)
    study = study_in(folder, file)
    count = count_of(study.shape)
    missing = [number + 1 for number in range(count) if not folder.part(number).exists()]
    if missing and not folder.finished.exists():
        shown = ", ".join(map(str, missing[:8])) + (", ..." if len(missing) > 8 else "")
        raise DatasetError(
            f"{file}: {len(missing):,} of {count:,} blocks are missing ({shown}); run the shards that have them, "
            "or `gradhesion run`, which computes all that is left"
        )
    with progress(study.scenes, quiet=quiet) as advance:
        written = write(study, file, history=history_now(), overwrite=overwrite, engine=Kept(), advance=advance)
    finish(file, study.scenes, written, time.monotonic() - start, quiet=quiet)
