"""A study: what is asked for, read from TOML or made in Python, checked as a whole and expanded."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gradhesion.cli.study.reading import load_study, study_from
    from gradhesion.cli.study.study import Method, Study

__all__ = ["Method", "Study", "load_study", "study_from"]


def __getattr__(name: str) -> Any:
    """Import what is public when it is first asked for: the names alone are needed by light commands."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from gradhesion.cli.study import reading  # noqa: PLC0415 (numpy)

    return getattr(reading, name)
