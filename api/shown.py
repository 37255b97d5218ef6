"""Pictures in a notebook: each is shown once, at the end of the cell that draws it, whatever the cell does with it."""

import sys
from importlib import import_module
from typing import Any, Final

_WAITING: Final[list[Any]] = []
"""Pictures of this cell that have not been shown."""


def show_later(picture: Any) -> None:
    """Show a picture when the cell that runs has ended, unless it is shown before; outside a notebook do nothing."""
    shell = _notebook()
    if shell is None:
        return
    if _show_all not in shell.events.callbacks["post_execute"]:
        shell.events.register("post_execute", _show_all)
    _WAITING.append(picture)


def is_shown(picture: Any) -> None:
    """Note that a picture has been shown."""
    _WAITING[:] = [one for one in _WAITING if one is not picture]


def _show_all() -> None:
    """Show what waits; each picture notes that it is shown."""
    display = import_module("IPython.display").display  # there in a notebook, and needed nowhere else
    for picture in [*_WAITING]:
        display(picture)
    _WAITING.clear()


def _notebook() -> Any:
    """Find the shell of a notebook, which has a kernel; None in scripts and in terminals."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return shell if getattr(shell, "kernel", None) is not None else None
