"""`gradhesion init`, `validate` and `plan`: a study to start from, whether one is valid, and what a run would cost."""

import json
import re
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem

from gradhesion.cli.commands import shared
from gradhesion.cli.disk import replacement, writing
from gradhesion.cli.terminal.amounts import bytes_in_words, counted, duration
from gradhesion.cli.terminal.messages import say, show


def studies() -> dict[str, str]:
    """Read the studies that come with the program, by name."""
    files = sorted(resources.files("gradhesion.configs").iterdir(), key=lambda file: file.name)
    return {file.name.removesuffix(".toml"): file.read_text("utf-8") for file in files if file.name.endswith(".toml")}


def beside(text: str) -> dict[str, str]:
    """Read the files that a study names, which come with the program too."""
    files = resources.files("gradhesion.configs")
    named = re.findall(r'^\s*(?:file|points)\s*=\s*"([^"]+)"', text, re.MULTILINE)
    return {name: (files / name).read_text("utf-8") for name in named}


def _names(_context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the name of a study."""
    return [CompletionItem(name) for name in studies() if name.startswith(incomplete)]


@click.command(epilog=shared.example("init", "init curve -o tip.toml"))
@click.argument("name", default="map", shell_complete=_names)
@click.option("-o", "--output", type=shared.A_PATH, help="File to write [NAME.toml].")
@shared.overwriting
@click.option("--list", "listed", is_flag=True, help="List the studies and write nothing.")
@click.option("--paper", is_flag=True, help="With --list: the studies of the figures of the paper instead.")
def init(name: str, output: Path | None, overwrite: bool, listed: bool, paper: bool) -> None:
    """Write a commented study to start from.

    NAME is map (the default), curve, optimum, fit, points, physical, or another that --list shows; --list --paper shows
    those of figures, such as fig4a.
    """
    known = studies()
    if paper and not listed:
        raise click.UsageError("--paper goes with --list; a figure has its name: gradhesion init fig4a")
    if listed:
        those = {one: text for one, text in known.items() if one.startswith(("fig", "extra_")) == paper}
        width = max(map(len, those))
        for one, text in those.items():
            show(f"{one:{width}}  {text.splitlines()[0].removeprefix('# ')}")
        return
    if name not in known:
        if name.endswith(".toml"):
            study = Path(name).stem if Path(name).stem in known else "map"
            raise click.UsageError(f'"{name}" is not a study; -o names the file: gradhesion init {study} -o {name}')
        from gradhesion.cli.terminal.wording import did_you_mean

        raise click.UsageError(f'there is no study "{name}"; {did_you_mean(name, list(known))}')
    path = output or Path(f"{name}.toml")
    others = {path.with_name(file): text for file, text in beside(known[name]).items()}
    for each, content in (others | {path: known[name]}).items():
        with replacement(each, overwrite=overwrite) as temporary, writing(each):
            temporary.write_text(content, encoding="utf-8")
    and_others = "".join(f", with {each}" for each in others)
    say(f"{path}: written{and_others}; gradhesion run {path}")


@click.command(epilog=shared.example("validate study.toml", "validate study.toml --set parameters.A=0.02"))
@click.argument("study", type=shared.A_PATH)
@shared.overriding
def validate(study: Path, overrides: tuple[str, ...]) -> None:
    """Check a study and report every error.

    STUDY is a TOML file. Each error is printed with its line and a suggested fix. Nothing is computed.
    """
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.study.reading import load_any

    requested = load_any(study, overrides)
    if isinstance(requested, FitStudy):
        show(f"{study}: valid; a fit of {requested.in_words}; fitted: {', '.join(requested.parameters)}")
        say(*requested.notes)
        return
    axes = ", ".join(f"{name} ({size:,})" for name, size in requested.sizes.items()) or "none"
    outputs = ", ".join(requested.outputs or requested.variables)
    kind = f"{'an' if requested.kind[0] in 'aeiou' else 'a'} {requested.kind}"
    scenes = counted(requested.scenes, "scene")
    show(f"{study}: valid; {kind} of {scenes}; axes: {axes}; outputs: {outputs}")


@click.command(epilog=shared.example("plan study.toml"))
@click.argument("study", type=shared.A_PATH)
@click.option("-o", "--output", type=shared.A_PATH, help="Output of the run.")
@shared.overriding
@shared.threading
@shared.as_json
@shared.given_up("--chunk", "the size of blocks is chosen by itself")
def plan(study: Path, output: Path | None, overrides: tuple[str, ...], threads: int | None, as_json: bool) -> None:
    """Show what a run would do and cost.

    Prints scenes and blocks, how many of these are kept from an earlier run, disk space, memory and a rough time: some
    scenes of STUDY are solved for a second or two. Nothing is written.
    """
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.study.reading import load_any
    from gradhesion.cli.work.compiling import prepare
    from gradhesion.cli.work.estimate import estimate

    loaded = load_any(study, overrides)
    path = output or Path("outputs") / f"{loaded.name}.nc"
    found: dict[str, Any] = {"output": str(path), "output_exists": path.exists(), "kind": loaded.kind}
    if isinstance(loaded, FitStudy):
        found |= {"points": sum(loop.points for loop in loaded.loops)}
        found |= {"cycles": sum(loop.cycles for loop in loaded.loops), "loops": len(loaded.loops)}
        found |= {"parameters": list(loaded.parameters), "starts": loaded.starts}
        starts = f"from at most {counted(loaded.starts, 'start')}"
        lines = {"points": loaded.in_words, "fitted": f"{', '.join(loaded.parameters)}; {starts}"}
        notes = loaded.notes
    else:
        if loaded.kind == "map":  # of which some scenes are solved
            prepare(loaded)
        found |= estimate(loaded, path, threads)
        lines, notes = dict(_in_words(found)), ()
    state = "exists; run needs --overwrite" if found["output_exists"] else "new"
    lines = {"output": f"{path} ({'a run is writing it' if found.get('running') else state})"} | lines
    rows = [f"{name:<10}{line}" for name, line in [*lines.items(), *(("note", note) for note in notes)]]
    show(*(json.dumps(found, indent=2).splitlines() if as_json else rows))


def _in_words(found: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Describe the plan of a run."""
    axes = ", ".join(f"{name} ({size:,})" for name, size in found["sizes"].items()) or "none"
    solutions = found["solutions_of_scene"]
    often = f", each solved about {solutions:,} times" if solutions > 1 else ""
    yield "scenes", f"{found['scenes']:,}{often}; axes: {axes}"
    yield "outputs", ", ".join(found["outputs"])
    if not found["blocks"]:
        yield "blocks", "none: curves and fronts are computed scene by scene, and written together"
        return
    yield "blocks", f"{found['blocks']:,}; {found['blocks_kept']:,} kept from an earlier run"
    if found["refusal"]:
        yield "", f"run would refuse: {found['refusal']}"
    beside = ", and as much beside it until it is complete" if found["blocks"] > 1 else ""
    disk = f"{bytes_in_words(found['bytes_of_values'])}, less by compression{beside}"
    yield "disk", f"at most {disk}; {bytes_in_words(found['bytes_free'])} free"
    yield "memory", f"about {bytes_in_words(found['bytes_of_memory'])}"
    if found["seconds"] is None:
        yield "time", "only that of writing: every block is kept"
    else:
        timed = counted(found["scenes_timed"], "scene")
        yield "time", f"roughly {duration(found['seconds'])} (timed with {timed})"
        yield "engines", f"with --engine dask, a block takes a worker {duration(found['seconds_of_block'])}"
