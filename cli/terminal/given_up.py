"""Options that a command no longer has, and what to use instead."""

from collections.abc import Callable
from typing import Any

import click


def given_up(option: str, instead: str) -> Callable[[Any], Any]:
    """Make an option that is in no help, and whose use is refused with what to use instead."""

    def refuse(_context: click.Context, _option: click.Parameter, given: bool) -> None:
        if given:
            raise click.UsageError(f"{option} was given up in version 0.4; {instead}")

    return click.option(
        option,
        is_flag=True,
        is_eager=True,
        hidden=True,
        expose_value=False,
        callback=refuse,
        help=f"Given up: {instead}.",
    )
