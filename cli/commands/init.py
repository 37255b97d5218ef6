"""`gradhesion init`: a study to start from."""

import re
from importlib import resources
from pathlib import Path

import click
from click.shell_completion import CompletionItem

from gradhesion.cli.commands.shared import A_PATH, example, overwriting
from gradhesion.cli.disk import replacement, writing
from gradhesion.cli.terminal import messages


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


@click.command(epilog=example("init", "init curve -o tip.toml"))
@click.argument("name", default="map", shell_complete=_names)
@click.option("-o", "--output", type=A_PATH, help="File to write [NAME.toml].")
@overwriting
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
        shown = {one: text for one, text in known.items() if one.startswith(("fig", "extra_")) == paper}
        width = max(map(len, shown))
        for one, text in shown.items():
            messages.show(f"{one:{width}}  {text.splitlines()[0].removeprefix('# ')}")
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
    messages.say(f"{path}: written{and_others}; gradhesion run {path}")
