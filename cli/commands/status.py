"""`gradhesion status`: how far a run is, from another shell."""

import json
import time
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.files import is_file, kind_of
from gradhesion.cli.terminal.amounts import bytes_in_words, counted
from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.output import show, show_block
from gradhesion.cli.terminal.progress import rate

if TYPE_CHECKING:
    from gradhesion.cli.work.parts.records import State


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
        return
    if found["state"] == "complete":
        show(f"{file}: complete, {bytes_in_words(found['bytes'])}, written {_date(found['written'])}")
        return
    blocks, scenes = (f"{found[name]:,}" if found[name] else "?" for name in ("blocks", "scenes"))
    end = "" if found["state"] == "running" else "; the same command resumes"
    show(f"{file}: {found['state']}; {found['parts']:,} of {blocks} blocks ({scenes} scenes) are kept{end}")
    for run in found["runs"]:
        show(f"  {_words(run, running=found['state'] == 'running')}")


def status_of(file: Path) -> dict[str, Any]:
    """
    Find out how far a run is.

    Raises
    ------
    DatasetError
        Neither a dataset nor a run is there, or another file stands in its place.
    """
    from gradhesion.cli.work.parts.folder import folder_of
    from gradhesion.cli.work.parts.records import State, read_record

    folder = folder_of(file)
    study = folder.manifest()
    running = not folder.foreign() and folder.busy()
    if not running and (study is None or folder.has_made(file)):
        if not is_file(file):
            raise DatasetError(f"{file}: there is neither a dataset nor parts of one; name the output of a run")
        kind = kind_of(file)
        if not kind.startswith("a dataset"):
            what = f"it is {kind}" if kind else "it does not begin as a dataset does"
            raise DatasetError(
                f"{file}: is not the output of a run ({what}); name a dataset that `gradhesion run` wrote"
            )
        found = file.stat()
        return {"output": str(file), "state": "complete", "bytes": found.st_size, "written": found.st_mtime}
    states = [(path, read_record(path, State)) for path in folder.states()]
    runs = [_run(state) | {"shard": path.stem[6:]} for path, state in states if state]
    return {
        "output": str(file),
        "state": "running" if running else "stopped",
        "blocks": study.blocks if study else 0,
        "scenes": study.scenes if study else 0,
        "parts": len(folder.parts()),
        "runs": runs,
    }


def _run(state: "State") -> dict[str, Any]:
    """Add the rate and the time left to the state of a run."""
    seconds = _seconds(state)
    solved = state.scenes_done - state.scenes_reused
    left = (state.scenes - state.scenes_done) * seconds / solved if solved else None
    return {**asdict(state), "seconds": seconds, "rate": solved / seconds if seconds > 0 else 0.0, "seconds_left": left}


def _words(run: dict[str, Any], *, running: bool) -> str:
    """Describe the state of a run."""
    solved = run["scenes_done"] - run["scenes_reused"]
    share = run["scenes_done"] / max(1, run["scenes"])
    words = [
        f"process {run['pid']} on {run['host']}: {run['blocks_done']:,} of {counted(run['blocks'], 'block')} done",
        f"{run['blocks_reused']:,} of them reused",
        f"{run['scenes_done']:,} of {counted(run['scenes'], 'scene')} ({share:.0%})",
        f"{run['scenes_failed']:,} failed",
        f"{rate(solved, run['seconds'])} per s",
    ]
    if running and run["seconds_left"] is not None:
        words.append(f"{run['seconds_left']:.0f} s left")
    shard = f"shard {run['shard'].replace('-', ' ')}, " if run["shard"] else ""
    return f"{shard}{', '.join(words)} (reported {max(0.0, time.time() - run['updated']):.0f} s ago)"


def _seconds(state: "State") -> float:
    """Give the time that a run has taken; states of earlier versions have the two dates alone, and clocks are set."""
    return max(0.0, state.updated - state.started) if state.seconds is None else state.seconds


def _date(seconds: float) -> str:
    """Write a date; some file systems keep dates that no calendar has."""
    try:
        return time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds))
    except (OverflowError, ValueError, OSError):
        return "at an unknown date"
