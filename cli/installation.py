"""What the packages and the environment allow: packages are looked for only where something has failed."""

import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from gradhesion.cli.errors import MissingExtraError, SetupError


def unmet() -> list[tuple[str, str, str]]:
    """List what the installed packages lack: what needs it, what it needs ("bokeh>=3.6"), and "3.4 is" or "not"."""
    from importlib.metadata import distributions, requires  # noqa: PLC0415 (10 ms)

    from packaging.requirements import Requirement  # noqa: PLC0415

    found: dict[str, tuple[str, str, str]] = {}
    names = ["gradhesion"]
    for owner in names:  # which grows
        for needed in map(Requirement, requires(owner) or ()):
            name = needed.name.lower()
            if needed.marker and not needed.marker.evaluate({"extra": ""}):
                continue
            there = next((one.version for one in distributions(name=name)), "")
            if not there or not needed.specifier.contains(there, prereleases=True):
                found.setdefault(name, (owner, f"{name}{needed.specifier}", f"{there} is" if there else "not"))
            if there and name not in names:
                names.append(name)
    return [*found.values()]


def misfit(error: BaseException) -> MissingExtraError | None:
    """Return in one sentence which packages an error may come from; None if all are there as they are needed."""
    wanting = []
    if isinstance(error, ImportError | AttributeError | TypeError):
        with suppress(ImportError):  # gradhesion is not installed
            wanting = unmet()
    if not wanting:
        return None
    symptom = re.sub(r" \([^()]*\)$", "", str(error).partition("\n")[0])  # without the path of a file
    needs = ", ".join(f"{owner} needs {needed} ({there} installed)" for owner, needed, there in wanting)
    remedy = " ".join(f'"{needed}"' for _, needed, _ in wanting)
    return MissingExtraError(f"{symptom}: {needs}; run {sys.executable or 'python'} -m pip install {remedy}")


@contextmanager
def checked() -> Iterator[None]:
    """Have imports that fail in the block name the packages that do not serve (MissingExtraError)."""
    try:
        yield
    except (ImportError, AttributeError, TypeError) as error:
        if found := misfit(error):
            raise found from error
        raise


def refuse_without_threads() -> None:
    """Make sure that the compiler may have a thread (SetupError): numba fails at its import otherwise.

    An empty number is that of a shell variable which is not set; it is removed.
    """
    number = os.environ.get("NUMBA_NUM_THREADS", "").strip()
    if not number:
        os.environ.pop("NUMBA_NUM_THREADS", None)
    elif not number.isdecimal() or int(number) < 1:
        remedy = "the number of threads is a whole number from 1 on; change it, or unset it"
        raise SetupError(f"NUMBA_NUM_THREADS = {number}: {remedy}")
