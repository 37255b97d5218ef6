"""What is told on stderr while a command works: in words, as JSON lines for a program, or not at all."""

import json
import time
from typing import Any

import click

_json: list[bool] = []


def speak_json(_context: click.Context, _option: click.Parameter, value: bool) -> bool:
    """Choose JSON lines, or words, as the option of a command tells."""
    _json[:] = [value]
    return value


def in_json() -> bool:
    """Tell whether JSON lines are asked for."""
    return any(_json)


def say(event: str, sentence: str, **fields: Any) -> None:
    """Tell a sentence, or the same as a JSON line with more fields."""
    if in_json():
        say_json(event, message=sentence, **fields)
    else:
        click.echo(sentence, err=True)


def say_json(event: str, **fields: Any) -> None:
    """Print one JSON object on a line of stderr."""
    click.echo(json.dumps({"event": event, "time": round(time.time(), 3), **fields}), err=True)
