"""`gradhesion status`: how far a run is, from another shell."""

import json
import time
from pathlib import Path
from typing import Any

import click

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.terminal.amounts import bytes_in_words, counted, duration
from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.output import show, show_block


@click.command(epilog=example("status outputs/study.nc"))
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
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
        blocks = f"{found['kept']:,} of {counted(found['blocks'], 'block')} ({found['scenes']:,} scenes) are kept"
        if found["state"] == "stopped":
            end = "; the same command resumes"
        else:
            left = found["seconds_left"]
            end = "" if left is None else f"; about {duration(left)} left"
        show(f"{file}: {found['state']}; {blocks}{end}")


def status_of(file: Path) -> dict[str, Any]:
    """
    Find out how far a run is.

    Raises
    ------
    DatasetError
        Neither a dataset nor a run is there, or another file stands in its place.
    """
    from gradhesion.cli.work.folder import MARK, folder_of, is_running, is_written, mark_of, parts_in

    folder = folder_of(file)
    mark, running = mark_of(folder), is_running(folder)
    if running or (mark and not is_written(folder, file)):
        begun = (folder / MARK).stat().st_mtime if mark else 0.0
        dates = [path.stat().st_mtime for path in parts_in(folder)]
        new = sum(date > begun for date in dates)
        blocks = mark.get("blocks", 0)
        left = (max(dates) - begun) / new * (blocks - len(dates)) if running and new else None
        return {
            "output": str(file),
            "state": "running" if running else "stopped",
            "blocks": blocks,
            "scenes": mark.get("scenes", 0),
            "kept": len(dates),
            "seconds_left": left,
        }
    import netCDF4

    try:
        with netCDF4.Dataset(file) as dataset:
            dataset.getncattr("study")
        found = file.stat()
    except (OSError, RuntimeError, AttributeError, UnicodeError) as error:
        raise DatasetError(f"{file}: is neither a whole dataset nor one that a run is writing ({error})") from None
    return {"output": str(file), "state": "complete", "bytes": found.st_size, "written": found.st_mtime}
