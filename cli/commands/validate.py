"""`gradhesion validate` and `gradhesion schema`: whether a study is valid, and what validation goes by."""

import json
from pathlib import Path

import click


@click.command()
@click.argument("study", type=click.Path(path_type=Path))
@click.option("--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Set a key of the study, in TOML.")
def validate(study: Path, overrides: tuple[str, ...]) -> None:
    """Check STUDY (TOML) and tell all of its mistakes; nothing is computed."""
    from gradhesion.cli.study.study import load_study

    asked = load_study(study, overrides)
    axes = ", ".join(f"{name} ({size:,})" for name, size in asked.sizes.items()) or "none"
    click.echo(f"{study}: valid; a {asked.kind} of {asked.scenes:,} scenes; axes: {axes}; outputs: ", nl=False)
    click.echo(", ".join(asked.outputs))


@click.command()
def schema() -> None:
    """Print the JSON Schema of a study, for editors; it is the one that `run` and `validate` go by.

    What two keys have to do with each other (unequal lists, repeated values) is beyond it: `gradhesion validate` tells.
    """
    from gradhesion.cli.study.form import Form

    told = {"$schema": "https://json-schema.org/draft/2020-12/schema", **Form.model_json_schema()}
    click.echo(json.dumps(told, indent=2))
