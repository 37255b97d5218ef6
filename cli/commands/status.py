"""`gradhesion status`: how far a run is, from another shell."""

import json
import time
from pathlib import Path
from typing import Any

import click

from gradhesion.cli.commands.shared import A_PATH, as_json, example
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.terminal.amounts import bytes_in_words, counted, duration
from gradhesion.cli.terminal.messages import show, show_block


@click.command(epilog=example("status outputs/study.nc"))
@click.argument("file", type=A_PATH)
@as_json
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
        raise DatasetError(f"{file}: is neither a whole dataset nor one that a run is writing ({error})") from None
    return {"output": str(file), "state": "complete", "bytes": found.st_size, "written": found.st_mtime}
