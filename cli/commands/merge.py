"""`gradhesion merge`: join the parts that shards have computed, or datasets that differ along one axis."""

import time
from contextlib import ExitStack
from pathlib import Path

import click

from gradhesion.cli.commands.plan import chunk_option
from gradhesion.cli.commands.run import finish, history_now
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.files import is_file
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.examples import example
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
@chunk_option
@click.option("--quiet", is_flag=True, help="Print errors only.")
@click.option("--log-json", is_flag=True, is_eager=True, callback=messages.speak_json, help="One JSON object per line.")
def merge(
    files: tuple[Path, ...],
    output: Path | None,
    overwrite: bool,
    chunk: int | None,  # noqa: ARG001 (given up: what is joined is written at once)
    quiet: bool,
    log_json: bool,  # noqa: ARG001 (its callback has it)
) -> None:
    """Join the parts of shards, or datasets.

    With one FILE, join the parts left by `gradhesion run STUDY.toml --shard I/N -o FILE`. With several FILES and -o,
    join maps or optima whose studies differ in the values of axes; the result has those of all, a full grid.
    """
    start = time.monotonic()
    if len(files) == 1 and output is None:
        _merge_shards(files[0], start, overwrite=overwrite, quiet=quiet)
    elif output is None or len(files) == 1:
        raise click.UsageError(
            "several datasets need an output, named with -o; a single FILE without -o joins the parts of its shards"
        )
    elif len({*files}) < len(files):
        raise click.UsageError("the same dataset is named twice; name each once")
    else:
        _merge_datasets(files, output, start, overwrite=overwrite, quiet=quiet)


def _merge_shards(file: Path, start: float, *, overwrite: bool, quiet: bool) -> None:
    """Join the parts of shards."""
    from gradhesion.cli.dataset.writer import Written, write
    from gradhesion.cli.engines.kept import Kept
    from gradhesion.cli.work.parts.folder import claimed, folder_of
    from gradhesion.cli.work.parts.manifest import study_in

    folder = folder_of(file)
    if folder.manifest() is None and not folder.foreign() and is_file(file):
        scenes, failed = _counted(file)
        if folder.path.is_dir():  # empty: a killed merge had tidied up all else
            with claimed(file):
                pass
        finish(file, scenes, Written(failed=failed, complete=True), 0.0, quiet=quiet)
        return
    study = study_in(folder, file)
    count = len(study.tiling)
    missing = [number + 1 for number in range(count) if not folder.part(number).exists()]
    if missing and not folder.has_made(file):
        shown = ", ".join(map(str, missing[:8])) + (", ..." if len(missing) > 8 else "")
        raise DatasetError(
            f"{file}: {len(missing):,} of {counted(count, 'block')} are missing ({shown}); run the shards that have "
            "them, or `gradhesion run`, which computes the rest"
        )
    with progress(study.scenes, quiet=quiet) as advance:
        written = write(study, file, history=history_now(), overwrite=overwrite, engine=Kept(), advance=advance)
    finish(file, study.scenes, written, time.monotonic() - start, quiet=quiet)


def _counted(file: Path) -> tuple[int, int]:
    """Count the scenes of a dataset, and those that have failed."""
    from gradhesion.cli.dataset.read.reader import opened, tiling_of
    from gradhesion.core.problem.status import FAILED

    with opened(file) as dataset:
        status = dataset["status"]
        return status.size, sum(int((status[block].values & FAILED != 0).sum()) for block in tiling_of(status))


def _merge_datasets(files: tuple[Path, ...], output: Path, start: float, *, overwrite: bool, quiet: bool) -> None:
    """Join datasets along the axes in which they differ."""
    from gradhesion.cli.dataset.cautions import cautions, flagged_in
    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.select import write_dataset
    from gradhesion.cli.dataset.verify.joining import joined
    from gradhesion.cli.dataset.writer import Written
    from gradhesion.cli.disk import refuse_existing
    from gradhesion.cli.names.scenes import STEEP
    from gradhesion.core.problem.status import FAILED

    refuse_existing(output, output, overwrite=overwrite)
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
