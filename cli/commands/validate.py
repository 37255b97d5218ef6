"""`gradhesion validate` and `gradhesion schema`: whether a study is valid, and what validation goes by."""

import json
from pathlib import Path

import click

from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.output import show, show_block

overriding = click.option(
    "--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Override a key of the study; repeatable."
)
"""The option of every command that reads a study."""


@click.command(epilog=example("validate study.toml", "validate study.toml --set parameters.A=0.02"))
@click.argument("study", type=click.Path(path_type=Path))
@overriding
def validate(study: Path, overrides: tuple[str, ...]) -> None:
    """Check a study and report every error.

    STUDY is a TOML file. Each error is printed with its line and a suggested fix. Nothing is computed.
    """
    from gradhesion.cli.study.fit.study import FitStudy
    from gradhesion.cli.study.reading import load_any

    requested = load_any(study, overrides)
    if isinstance(requested, FitStudy):
        show(f"{study}: valid; a fit of {requested.in_words}; fitted: {', '.join(requested.parameters)}")
        for note in requested.notes:
            messages.say(note)
        return
    axes = ", ".join(f"{name} ({size:,})" for name, size in requested.sizes.items()) or "none"
    outputs = ", ".join(requested.outputs or requested.variables)
    kind = f"{'an' if requested.kind[0] in 'aeiou' else 'a'} {requested.kind}"
    show(f"{study}: valid; {kind} of {counted(requested.scenes, 'scene')}; axes: {axes}; outputs: {outputs}")


@click.command(epilog=example("schema > study.schema.json"))
def schema() -> None:
    """Print the JSON Schema of a study.

    Editors use it to complete and check studies; `run` and `validate` use it too. What it cannot express (lists of
    unequal length, repeated values) is checked by `gradhesion validate`.
    """
    from gradhesion.cli.study.rules.form import Form

    document = {"$schema": "https://json-schema.org/draft/2020-12/schema", **Form.model_json_schema()}
    show_block(json.dumps(document, indent=2))
