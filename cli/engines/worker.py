"""What a worker of a cluster does: it solves blocks into parts, and returns a few words about them.

It is told a folder and the numbers of blocks; the study it reads there. So little goes through the scheduler, and
nothing of the values. It refuses where it could not do the work as it is meant.
"""

import os
import time
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

SIGHT: Final = 20.0
"""Seconds until a new file is seen on every machine: network file systems look for one a few seconds late."""


def carry_out(folder: str, fingerprint: str, numbers: tuple[int, ...], versions: dict[str, Any]) -> dict[str, Any]:
    """
    Solve blocks of the study in a folder, each into its part.

    Parameters
    ----------
    fingerprint
        Of the study's text.
    numbers
        Of the blocks.
    versions
        Those that are needed, as `needed`.

    Returns
    -------
    `worker`, its address; `refused`, why it cannot do this work; or `seconds` that it took, and `errors`, by block,
    of those that could not be solved. `unwritable`: why a part could not be written.
    """
    from distributed import get_worker  # noqa: PLC0415 (known where there is a cluster)

    told: dict[str, Any] = {"worker": get_worker().address, "refused": "", "unwritable": "", "errors": {}, "seconds": 0}
    try:
        reason = _differences(needed(), versions)
        return told | ({"refused": reason} if reason else _solved(Path(folder), fingerprint, numbers))
    except ImportError as error:
        return told | {"refused": f"cannot load gradhesion ({error})"}
    except Exception as error:  # noqa: BLE001 (not every error can travel)
        return told | {"errors": dict.fromkeys(numbers, f"{type(error).__name__}: {error}")}


def _differences(here: dict[str, Any], there: dict[str, Any]) -> str:
    """Say which versions are others than needed."""
    names = sorted(name for name in {*here, *there} if here.get(name) != there.get(name))
    words = [f"has {name} {here.get(name)} instead of {there.get(name)}" for name in names if name != "core"]
    return ", ".join(words) or ("has other sources of the solver" if names else "")


def needed() -> dict[str, Any]:
    """List the versions that a worker has to share with its client, for one to go on where the other ends."""
    import numpy as np  # noqa: PLC0415 (with what follows, a second: not where a worker only looks up a name)

    from gradhesion.cli.work.parts import versions  # noqa: PLC0415

    return versions() | {"numpy": np.__version__}


def _solved(folder: Path, fingerprint: str, numbers: tuple[int, ...]) -> dict[str, Any]:
    """Solve blocks of the study in a folder."""
    from gradhesion.cli.work.folder import Folder  # noqa: PLC0415
    from gradhesion.cli.work.parts import key_of, write_part  # noqa: PLC0415
    from gradhesion.cli.work.resume import attempted, found  # noqa: PLC0415

    study = _study(folder, fingerprint)
    if study is None:
        return {"refused": f"does not see {folder}, where the parts go: it needs the file system of the output"}
    start = time.monotonic()
    errors = {}
    for number in numbers:
        block = study.tiling[number]
        key = key_of(study, block)
        if isinstance(found(study, Folder(folder), number, block, key), dict):
            continue  # a worker that was lost had done it
        values, error = attempted(study, block, 1)
        if error:
            errors[number] = error
            continue
        try:
            write_part(Folder(folder).part(number), key, values, study)
        except OSError as failure:
            return {"unwritable": failure.strerror or str(failure)}
    return {"errors": errors, "seconds": time.monotonic() - start}


@lru_cache(maxsize=4)
def _loaded(folder: Path, fingerprint: str) -> Any:
    """Read the study of a folder, and compile what it needs; once in a process."""
    from gradhesion.cli.errors import DatasetError  # noqa: PLC0415
    from gradhesion.cli.work.folder import Folder  # noqa: PLC0415
    from gradhesion.cli.work.kernels import compile_kinds, kinds_of  # noqa: PLC0415
    from gradhesion.cli.work.manifest import study_in  # noqa: PLC0415

    deadline = time.monotonic() + SIGHT
    while True:
        with suppress(DatasetError):
            study = study_in(Folder(folder), folder)
            if study.sha256 == fingerprint:
                with suppress(Exception):  # the block that is asked for will tell
                    compile_kinds(kinds_of(study))
                return study
        if time.monotonic() > deadline:
            raise FileNotFoundError(folder)
        with suppress(OSError):
            os.listdir(folder.parent)  # noqa: PTH208 (makes a network file system look)
        time.sleep(SIGHT / 100)


def _study(folder: Path, fingerprint: str) -> Any:
    """Give the study of a folder, if it is there."""
    with suppress(FileNotFoundError):
        return _loaded(folder, fingerprint)
    return None
