"""A study's dataset: what it holds, how it is written, read, selected from, joined and verified."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gradhesion.cli.dataset.writer import compute

__all__ = ["compute"]


def __getattr__(name: str) -> Any:
    """Import what is public when it is first asked for."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from gradhesion.cli.dataset import writer  # noqa: PLC0415 (numpy)

    return getattr(writer, name)
