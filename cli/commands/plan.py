"""`gradhesion plan`: what a run would do and cost; nothing is written."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Final

import click

from gradhesion.cli.terminal.amounts import bytes_in_words, counted
from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.output import show, show_block

if TYPE_CHECKING:
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.study.study import Study
    from gradhesion.cli.work.estimate import Estimate


chunk_option: Final = click.option(
    "--chunk", type=click.IntRange(min=1), envvar="GRADHESION_CHUNK", help="Cells of a chunk of the file [131072]."
)
"""The option of every command that cuts scenes into blocks."""


@click.command(epilog=example("plan study.toml"))
@click.argument("study", type=click.Path(path_type=Path))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Output of the run.")
@click.option("--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Override a key of the study; repeatable.")
@click.option("--threads", type=click.IntRange(min=1), help="Threads of the run [all available to the process].")
@chunk_option
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def plan(
    study: Path,
    output: Path | None,
    overrides: tuple[str, ...],
    threads: int | None,
    chunk: int | None,
    as_json: bool,
) -> None:
    """Show what a run would do and cost.

    Prints scenes and blocks, what an earlier run has left and why the rest cannot be reused, disk space, memory and
    time. The time is estimated by solving scenes of STUDY for a second or two. Nothing is written.
    """
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.study.reading import load_any

    requested = load_any(study, overrides)
    path = output or Path("outputs") / f"{requested.name}.nc"
    if isinstance(requested, FitStudy):
        show_fit_plan(requested, path, as_json=as_json)
    else:
        show_plan(requested.chunked(chunk), path, threads, as_json=as_json)


def show_fit_plan(study: "FitStudy", output: Path, *, as_json: bool = False) -> None:
    """Print the plan of a fit."""
    found = {
        "output": str(output),
        "output_exists": output.exists(),
        "kind": study.kind,
        "points": sum(loop.points for loop in study.loops),
        "cycles": sum(loop.cycles for loop in study.loops),
        "loops": len(study.loops),
        "parameters": list(study.parameters),
        "starts": study.starts,
    }
    if as_json:
        show_block(json.dumps(found, indent=2))
        return
    state = "exists; run needs --overwrite" if found["output_exists"] else "new"
    show(f"output    {output} ({state})")
    show(f"points    {study.in_words}")
    show(f"fitted    {', '.join(study.parameters)}; from at most {counted(study.starts, 'start')}")
    for note in study.notes:
        show(f"note      {note}")


def show_plan(study: "Study", output: Path, threads: int | None, *, as_json: bool = False) -> None:
    """Print the plan of a run."""
    from gradhesion.cli.work.compiling import prepare
    from gradhesion.cli.work.estimate import estimate

    prepare(study)
    found = estimate(study, output, threads)
    if as_json:
        show_block(json.dumps(asdict(found), indent=2))
        return
    for line in _lines(found):
        show(line)


def _lines(found: "Estimate") -> list[str]:
    """Describe a plan."""
    axes = ", ".join(f"{name} ({size:,})" for name, size in found.sizes.items()) or "none"
    state = "exists; run needs --overwrite" if found.output_exists else "new"
    if found.running:
        state = "a run is writing it"
    lines = [
        f"output    {found.output} ({state})",
        f"scenes    {found.scenes:,}{_each(found.solutions_of_scene)}; axes: {axes}",
        f"outputs   {', '.join(found.outputs)}",
    ]
    if not found.has_blocks:
        what = {"curve": "curves", "optimum": "fronts"}[found.kind]
        return [*lines, f"{what:<10}computed scene by scene; no parts, no estimate of time"]
    why = "; ".join(f"{number:,} {reason}" for reason, number in found.not_reused.items())
    lines.append(f"blocks    {found.blocks:,}; {found.blocks_reused:,} reused{f'; {why}' if why else ''}")
    lines += [f"          run would refuse: {difference}" for difference in found.differences]
    sizes = [f"{bytes_in_words(found.bytes_of_parts)} of parts until it is complete"] if found.bytes_of_parts else []
    if found.bytes_of_file is not None:
        sizes.insert(0, f"about {bytes_in_words(found.bytes_of_file)}")
    if found.bytes_free is not None:
        sizes.append(f"{bytes_in_words(found.bytes_free)} free")
    lines.append(f"disk      {'; '.join(sizes)}")
    if found.bytes_of_memory is not None:
        lines.append(f"memory    about {bytes_in_words(found.bytes_of_memory)}")
    if found.seconds is not None and found.seconds_uncertain is not None:
        lines.append(
            f"time      about {duration(found.seconds)} +- {duration(found.seconds_uncertain)} "
            f"(measured on {counted(found.scenes_probed, 'scene')}), and a second to start"
        )
        if found.seconds_dask is not None and found.seconds_of_block is not None:
            lines.append(
                f"engines   with --engine dask about {duration(found.seconds_dask)} on this machine; on N workers "
                f"elsewhere {duration(found.seconds_of_block * (found.blocks - found.blocks_reused))} / N, "
                f"{duration(found.seconds_of_block)} per block"
            )
    else:
        lines.append("time      only that of writing: every block is complete")
    return lines


def _each(solutions: int) -> str:
    """
    Say how often each scene is solved.

    >>> _each(1), _each(1024)
    ('', ', each solved about 1,024 times')
    """
    return f", each solved about {solutions:,} times" if solutions > 1 else ""


def duration(seconds: float) -> str:
    """
    Write a time in the unit that fits.

    >>> duration(0.31), duration(75.0), duration(1e4), duration(float("inf"))
    ('0.3 s', '75 s', '2.8 h', 'any time')
    """
    if seconds > 1e9:
        return "any time"
    for unit, size, most in (("s", 1.0, 120.0), ("min", 60.0, 7200.0), ("h", 3600.0, 172_800.0)):
        if seconds < most:
            return f"{seconds / size:.{0 if seconds / size >= 10 else 1}f} {unit}"
    return f"{seconds / 86_400:.0f} d"
