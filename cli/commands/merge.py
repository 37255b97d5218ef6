"""`gradhesion merge`: join the blocks that shards have computed, or datasets that differ along axes."""

import time
from contextlib import ExitStack
from pathlib import Path

import click

from gradhesion.cli.commands.run import finish, history_now
from gradhesion.cli.commands.status import status_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.files import is_file
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.given_up import given_up
from gradhesion.cli.terminal.progress import progress
from gradhesion.cli.terminal.written import dataset_to_write


@click.command(epilog=example("merge big.nc", "merge first.nc second.nc -o all.nc"))
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    callback=dataset_to_write,
    help="Dataset to write, if several are joined.",
)
@click.option("--overwrite", is_flag=True, help="Replace an existing dataset.")
@click.option("--quiet", is_flag=True, help="Print errors only.")
@given_up("--chunk", "the size of blocks is chosen by itself")
@given_up("--log-json", "`gradhesion status FILE --json` shows how far a run is")
def merge(files: tuple[Path, ...], output: Path | None, overwrite: bool, quiet: bool) -> None:
    """Join the blocks of shards, or datasets.

    With one FILE, join the blocks left by `gradhesion run STUDY.toml --shard I/N -o FILE`. With several FILES and -o,
    join maps or optima whose studies differ along axes; the result has the values of all, and none may be missing.
    """
    if len(files) == 1 and output is None:
        _merge_shards(files[0], overwrite=overwrite, quiet=quiet)
    elif output is None or len(files) == 1:
        raise click.UsageError(
            "several datasets need an output, named with -o; a single FILE without -o joins the blocks of its shards"
        )
    elif len({*files}) < len(files):
        raise click.UsageError("the same dataset is named twice; name each once")
    else:
        _merge_datasets(files, output, overwrite=overwrite, quiet=quiet)


def _merge_shards(file: Path, *, overwrite: bool, quiet: bool) -> None:
    """Join the blocks of shards."""
    from gradhesion.cli.dataset.writer import write
    from gradhesion.cli.work.engines import kept
    from gradhesion.cli.work.folder import claimed, folder_of, study_in

    start = time.monotonic()
    folder = folder_of(file)
    study = study_in(folder)
    if study is None and is_file(file):
        status_of(file)  # which refuses what is no dataset
        if folder.is_dir():  # of a merge that was killed when it was done
            with claimed(file):
                pass
        messages.say(f"{file}: was complete already")
        return
    if study is None:
        raise DatasetError(f"{file}: has no blocks to join; compute them first, with `gradhesion run --shard`")
    with progress(study.scenes, quiet=quiet) as advance:
        written = write(study, file, history=history_now(), overwrite=overwrite, engine=kept, advance=advance)
    finish(file, study.scenes, written, time.monotonic() - start, quiet=quiet)


def _merge_datasets(files: tuple[Path, ...], output: Path, *, overwrite: bool, quiet: bool) -> None:
    """Join datasets along the axes in which they differ."""
    from gradhesion.cli.dataset.cautions import cautions, flagged_in
    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.select import write_dataset
    from gradhesion.cli.dataset.verify.joining import joined
    from gradhesion.cli.dataset.writer import Written
    from gradhesion.cli.disk import refuse_existing
    from gradhesion.cli.names.scenes import STEEP
    from gradhesion.core.problem.status import FAILED

    start = time.monotonic()
    refuse_existing(output, overwrite=overwrite)
    with ExitStack() as stack:
        sources = {file: stack.enter_context(opened(file)) for file in files}
        history = "\n".join([*(str(source.attrs["history"]) for source in sources.values()), history_now()])
        study, dataset = joined(sources, history)
        write_dataset(dataset, output, overwrite=overwrite)
    status = dataset["status"].values
    steep = int(dataset[STEEP].sum()) if STEEP in dataset else 0
    said = tuple(cautions(study, flagged_in(status), steep))
    written = Written(failed=int(((status & FAILED) != 0).sum()), cautions=said)
    finish(output, study.scenes, written, time.monotonic() - start, quiet=quiet)
