"""What a worker of a cluster does: it solves a block into its part, and returns nothing, or raises why not.

A task is a folder and the number of a block; the study is read there. So little goes through the scheduler, and
nothing of the values.
"""

import os
import time
from collections.abc import Callable
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any, Final, TypeVar

from gradhesion.cli.terminal import interrupts

SIGHT: Final = 20.0
"""Seconds until a new file is seen on every machine: network file systems look for one a few seconds late."""

_T = TypeVar("_T")


class RefusedError(Exception):
    """A worker, by its address, cannot do this work as it is meant, and why."""


class UnwritableError(Exception):
    """A worker, by its address, cannot write a part, and why."""


class UnsolvedError(Exception):
    """A block cannot be solved, and why."""


def carry_out(folder: str, fingerprint: str, number: int, versions: dict[str, Any]) -> None:
    """
    Solve a block of the study in a folder, into its part.

    Parameters
    ----------
    fingerprint
        Of the study's text.
    number
        Of the block.
    versions
        Those that are needed, as `needed`.

    Raises
    ------
    RefusedError
        This worker has other versions, or does not see the folder.
    UnwritableError
        The part cannot be written.
    UnsolvedError
        The block raised an exception; not every one can travel.
    """
    from distributed import get_worker  # noqa: PLC0415 (known where there is a cluster)

    address = get_worker().address
    try:
        reason = _differences(needed(), versions) or _solve(Path(folder), fingerprint, number)
    except ImportError as error:
        reason = f"cannot load gradhesion ({error})"
    except OSError as error:
        raise UnwritableError(address, error.strerror or str(error)) from None
    except UnsolvedError:
        raise
    except Exception as error:  # noqa: BLE001 (whatever it is, the other blocks go on)
        raise UnsolvedError(f"{type(error).__name__}: {error}") from None
    if reason:
        raise RefusedError(address, reason)


def needed() -> dict[str, Any]:
    """List the versions that a worker has to share with its client, for one to go on where the other ends."""
    import numpy as np  # noqa: PLC0415 (with what follows, a second: not where a worker only looks up a name)

    from gradhesion.cli.work.parts.parts import versions  # noqa: PLC0415

    return versions() | {"numpy": np.__version__}


def seen(look: Callable[[], _T | str], folder: Path) -> _T | str:
    """Look at files until they are seen; if they are not for as long as that may take, give the last reason why."""
    deadline = time.monotonic() + SIGHT
    while isinstance(result := look(), str) and time.monotonic() < deadline:
        interrupts.check()
        with suppress(OSError):
            os.listdir(folder)  # noqa: PTH208 (makes a network file system look)
        time.sleep(SIGHT / 100)
    return result


def _differences(here: dict[str, Any], there: dict[str, Any]) -> str:
    """Say which versions are others than needed."""
    names = sorted(name for name in {*here, *there} if here.get(name) != there.get(name))
    words = [f"has {name} {here.get(name)} instead of {there.get(name)}" for name in names if name != "core"]
    return ", ".join(words) or ("has other sources of the solver" if names else "")


def _solve(folder: Path, fingerprint: str, number: int) -> str:
    """Solve a block into its part, or say why this worker cannot."""
    from gradhesion.cli.work.parts.folder import Folder  # noqa: PLC0415
    from gradhesion.cli.work.parts.parts import key_of, write_part  # noqa: PLC0415
    from gradhesion.cli.work.parts.resume import attempted, found  # noqa: PLC0415

    study = seen(lambda: _study(folder, fingerprint), folder.parent)
    if isinstance(study, str):
        return study
    block = study.tiling[number]
    key = key_of(study, block)
    if isinstance(found(study, Folder(folder), number, block, key), dict):
        return ""  # a worker that was lost had done it
    values, error = attempted(study, block, 1)
    if error:
        raise UnsolvedError(error)
    write_part(Folder(folder).part(number), key, values, study)
    return ""


def _study(folder: Path, fingerprint: str) -> Any:
    """Give the study of a folder, or say that it is not there."""
    from gradhesion.cli.errors import DatasetError  # noqa: PLC0415

    with suppress(DatasetError):
        return _loaded(folder, fingerprint)
    return f"cannot access {folder}, the folder of the parts: it needs the file system of the output"


@lru_cache(maxsize=4)
def _loaded(folder: Path, fingerprint: str) -> Any:
    """Read the study of a folder, and compile what it needs where no process has; once in a process."""
    from gradhesion.cli.errors import DatasetError  # noqa: PLC0415
    from gradhesion.cli.work.compiling import compile_for, is_first  # noqa: PLC0415
    from gradhesion.cli.work.parts.folder import Folder  # noqa: PLC0415
    from gradhesion.cli.work.parts.manifest import study_in  # noqa: PLC0415

    study = study_in(Folder(folder), folder)
    if study.sha256 != fingerprint:
        raise DatasetError(f"{folder}: of another study")
    if is_first():
        compile_for(study)  # one worker does, and the others wait for it
    return study
