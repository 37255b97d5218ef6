"""`gradhesion status` and `merge`: how far a run is, and the blocks that shards have computed, or datasets, joined."""

import json
import os
import time
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gradhesion.cli.commands import shared
from gradhesion.cli.commands.run import finish
from gradhesion.cli.disk import kind_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.terminal.amounts import bytes_in_words, counted, duration
from gradhesion.cli.terminal.messages import say, show, show_block
from gradhesion.cli.terminal.progress import progress

if TYPE_CHECKING:
    from gradhesion.cli.dataset.writer import Written
    from gradhesion.cli.study.study import Study


@click.command(epilog=shared.example("status outputs/study.nc"))
@click.argument("file", type=shared.A_PATH)
@shared.as_json
def status(file: Path, as_json: bool) -> None:
    """Show the progress of a run.

    FILE is the output of the run, which is running, stopped or complete.
    """
    found = status_of(file)
    if as_json:
        show_block(json.dumps(found, indent=2))
    elif found["state"] == "complete":
        written = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(found["written"]))
        show(f"{file}: complete, {bytes_in_words(found['bytes'])}, written {written}")
    else:
        left = found["seconds_left"]
        end = f"; about {duration(left)} left" if left is not None else ""
        if found["state"] == "stopped":
            end = "; the same command resumes, and `gradhesion merge` joins shards when all are done"
            end += "; an earlier dataset stands there until then" if file.is_file() else ""
        kept = f"{found['kept']:,} of {counted(found['blocks'], 'block')} ({found['scenes']:,} scenes) are kept"
        show(f"{file}: {found['state']}; {kept}{end}")


def status_of(file: Path) -> dict[str, Any]:
    """Find out how far a run is; DatasetError where neither a dataset nor a run is there."""
    from gradhesion.cli.work.folder import MARK, folder_of, is_running, is_written, mark_of, parts_in

    folder = folder_of(file)
    mark, running = mark_of(folder), is_running(folder)
    if running or (mark and not is_written(folder, file)):
        begun = (folder / MARK).stat().st_mtime if mark else 0.0
        dates = [path.stat().st_mtime for path in parts_in(folder)]
        new, blocks = sum(date > begun for date in dates), mark.get("blocks", 0)
        return {
            "output": str(file),
            "state": "running" if running else "stopped",
            "blocks": blocks,
            "scenes": mark.get("scenes", 0),
            "kept": len(dates),
            "seconds_left": (max(dates) - begun) / new * (blocks - len(dates)) if running and new else None,
        }
    import netCDF4

    try:
        with netCDF4.Dataset(file) as dataset:
            dataset.getncattr("study")
        found = file.stat()
    except (OSError, RuntimeError, AttributeError, UnicodeError) as error:
        kind = kind_of(file) if file.suffix == ".toml" else ""
        why = f"({kind or getattr(error, 'strerror', None) or error}); name the output of a run"
        raise DatasetError(f"{file}: is neither a whole dataset nor one that a run is writing {why}") from None
    return {"output": str(file), "state": "complete", "bytes": found.st_size, "written": found.st_mtime}


@click.command(epilog=shared.example("merge big.nc", "merge first.nc second.nc -o all.nc"))
@click.argument("files", nargs=-1, required=True, type=shared.A_PATH)
@shared.dataset_to_write("Dataset to write, if several are joined.")
@shared.overwriting
@shared.quietly
@shared.given_up("--chunk", "the size of blocks is chosen by itself")
@shared.given_up("--log-json", "`gradhesion status FILE --json` shows how far a run is")
def merge(files: tuple[Path, ...], output: Path | None, overwrite: bool) -> None:
    """Join the blocks of shards, or datasets.

    With one FILE, join the blocks left by `gradhesion run STUDY.toml --shard I/N -o FILE`. With several FILES and -o,
    join maps or optima whose studies differ along axes; the result has the values of all, and none may be missing.
    """
    start = time.monotonic()
    if (output is None) != (len(files) == 1):
        raise click.UsageError("several datasets are joined into an output, named with -o; one, of shards, needs no -o")
    if len({*files}) < len(files):
        raise click.UsageError("the same dataset is named twice; name each once")
    if output is not None:
        study, written = _joined(files, output, overwrite=overwrite)
    elif (shards := _of_shards(files[0])) is None:
        say(f"{files[0]}: was complete already")
        return
    else:
        from gradhesion.cli.dataset.writer import only_kept, write

        study, engine = shards, partial(only_kept, files[0])
        with progress(study.scenes) as advance:
            history = shared.history_now()
            written = write(study, files[0], history=history, overwrite=overwrite, engine=engine, advance=advance)
    finish(output or files[0], study.scenes, written, time.monotonic() - start)


def _of_shards(file: Path) -> "Study | None":
    """Give the study of the blocks of shards; None if they are joined already."""
    from gradhesion.cli.work.folder import claimed, folder_of, study_in

    folder = folder_of(file)
    study = study_in(folder)
    if study is None and not os.path.isfile(file):  # noqa: PTH113 (that of pathlib raises where a name is too long)
        raise DatasetError(f"{file}: has no blocks to join; compute them first, with `gradhesion run --shard`")
    if study is None:
        status_of(file)  # which refuses what is no dataset
        if folder.is_dir():  # of a merge that was killed when it was done
            with claimed(file):
                pass
    return study


def _joined(files: tuple[Path, ...], output: Path, *, overwrite: bool) -> "tuple[Study, Written]":
    """Write the dataset of several that are joined along the axes in which they differ."""
    from gradhesion.cli.dataset.joining import joined
    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.writer import of_values, write
    from gradhesion.cli.disk import refuse_existing

    refuse_existing(output, overwrite=overwrite)
    with ExitStack() as stack:
        sources = {file: stack.enter_context(opened(file)) for file in files}
        history = "\n".join([*(str(source.attrs["history"]) for source in sources.values()), shared.history_now()])
        study, values = joined(sources)
    return study, write(study, output, history=history, overwrite=overwrite, engine=partial(of_values, values))
