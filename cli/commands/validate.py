"""`gradhesion validate`: whether a study is valid."""

from pathlib import Path

import click

from gradhesion.cli.commands.shared import A_PATH, example, overriding
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import counted


@click.command(epilog=example("validate study.toml", "validate study.toml --set parameters.A=0.02"))
@click.argument("study", type=A_PATH)
@overriding
def validate(study: Path, overrides: tuple[str, ...]) -> None:
    """Check a study and report every error.

    STUDY is a TOML file. Each error is printed with its line and a suggested fix. Nothing is computed.
    """
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.study.reading import load_any

    requested = load_any(study, overrides)
    if isinstance(requested, FitStudy):
        messages.show(f"{study}: valid; a fit of {requested.in_words}; fitted: {', '.join(requested.parameters)}")
        for note in requested.notes:
            messages.say(note)
        return
    axes = ", ".join(f"{name} ({size:,})" for name, size in requested.sizes.items()) or "none"
    outputs = ", ".join(requested.outputs or requested.variables)
    kind = f"{'an' if requested.kind[0] in 'aeiou' else 'a'} {requested.kind}"
    scenes = counted(requested.scenes, "scene")
    messages.show(f"{study}: valid; {kind} of {scenes}; axes: {axes}; outputs: {outputs}")
