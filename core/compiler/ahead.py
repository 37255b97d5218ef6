"""Kernels that were compiled ahead: the contents of a wheel, and the machines that they fit.

A wheel that is built so has a folder in core/, named after a processor. It has a file for each kernel and
types of arguments, and a manifest: what the code was compiled from and for, a digest of each file, and the kinds of
work that are complete. Where all of it fits, that code is used and nothing is compiled. Anywhere else, and where a file
is missing or has been changed, kernels are compiled as from the sources.

The code is that of numba's own cache, for a processor that most have instead of the one at hand. It has the same bits
(tests/wheels).
"""

import hashlib
import json
import os
import pickle
import platform
import sys
import sysconfig
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

import llvmlite
import numba
import numpy as np
from llvmlite import binding

from gradhesion.core.compiler.cache import LINKING
from gradhesion.core.compiler.sources import COMPILED, CORE

PROCESSOR: Final = "x86-64-v3"
"""The processor, by LLVM's name: those of Intel since 2013 and of AMD since 2015, but for the smallest."""
FOLDER: Final = CORE / PROCESSOR
"""Where the code stands, if there is any."""
MANIFEST: Final = "manifest.json"
FEATURES: Final = (
    "64bit", "avx", "avx2", "bmi", "bmi2", "cmov", "crc32", "cx16", "cx8", "f16c", "fma", "fxsr", "lzcnt", "mmx",
    "movbe", "popcnt", "sahf", "sse", "sse2", "sse3", "sse4.1", "sse4.2", "ssse3", "xsave",
)  # fmt: skip
"""What that processor has, by LLVM's names."""
OTHERS: Final = ("BOUNDSCHECK", "CPU_FEATURES", "CPU_NAME", "DEBUGINFO", "ENABLE_AVX", "LOOP_VECTORIZE", "OPT")
"""Settings of numba, NUMBA_... in the environment, that require other code."""


def needed() -> dict[str, str]:
    """Return what code depends on beside the processor, by its names: where one differs, the code is not used.

    Numpy counts by its major number: its arrays stay where they are in memory as long as that does.
    """
    return {
        "sources": COMPILED,
        "python": f"{sys.implementation.cache_tag}{getattr(sys, 'abiflags', '')}",
        "platform": f"{sysconfig.get_platform()} {platform.libc_ver()[0]}".strip(),
        "numba": numba.__version__,
        "llvmlite": llvmlite.__version__,
        "numpy": np.__version__.partition(".")[0],
    }


@dataclass(frozen=True)
class Ahead:
    """Code that fits.

    Parameters
    ----------
    folder
        Where it stands.
    kinds
        The kinds of work (kinds.py) whose kernels are all there.
    digests
        The digest of each file, by its name.
    """

    folder: Path
    kinds: frozenset[str]
    digests: Mapping[str, str]

    def read(self, name: str) -> Any:
        """Return the contents of a file; None if there is no such file or it has been changed."""
        digest = self.digests.get(name)
        if digest is None:
            return None
        with suppress(OSError):
            data = (self.folder / name).read_bytes()
            if hashlib.sha256(data).hexdigest() == digest:
                return pickle.loads(data)  # noqa: S301 (as trustworthy as the program that it comes with)
        return None


def name_of(function: Callable[..., Any], types: Any) -> str:
    """Return the name of the file of a kernel and types of arguments."""
    closed = [cell.cell_contents for cell in function.__closure__ or ()]
    key = hashlib.sha256(f"{function.__qualname__}{closed!r}{types!r}".encode()).hexdigest()[:16]
    return f"{function.__module__.removeprefix('gradhesion.core.')}.{function.__name__}-{key}.code"


def fitting(folder: Path) -> tuple[Ahead | None, str]:
    """Return the code of a folder, if there is any and it fits here, and otherwise why not.

    The second is "" as well where there is no code, or where the environment requires other code.
    """
    own = os.environ.get("GRADHESION_KERNELS") == "own" or any(f"NUMBA_{name}" in os.environ for name in OTHERS)
    if own or LINKING == "ordinary" or not folder.is_dir():
        return None, ""
    try:
        manifest = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
        found = Ahead(folder, frozenset(manifest["kinds"]), dict(manifest["kernels"]))
        misfits = _misfits(dict(manifest["needs"]), list(manifest["features"]))
    except (OSError, ValueError, TypeError, KeyError):
        return None, f"{folder / MANIFEST} cannot be read"
    return (None, f"they are for {', '.join(misfits)}") if misfits else (found, "")


def _misfits(needs: Mapping[str, str], features: Iterable[str]) -> list[str]:
    """List in words what code needs and this machine does not have."""
    here = needed()
    found = [
        "other sources" if name == "sources" else f"{name} {needs[name]}, not {here[name]}"
        for name in here
        if needs[name] != here[name]
    ]
    lacks = lacking(features)
    return [*found, *([f"processors that have {', '.join(lacks)}"] if lacks else [])]


def lacking(features: Iterable[str]) -> list[str]:
    """List those of some features, by LLVM's names, that the processor at hand does not have."""
    processor = binding.get_host_cpu_features()
    return [feature for feature in features if not processor.get(feature, False)]


@lru_cache(maxsize=1)
def _found() -> tuple[Ahead | None, str]:
    """Return the code that came with the program, or why it is not used."""
    return fitting(FOLDER)


def shipped() -> Ahead | None:
    """Return the code that came with the program and fits here, if any."""
    return _found()[0]


def why_not() -> str:
    """Return one sentence on why the code that came with the program is not used; "" if it is, or if none came."""
    why = _found()[1]
    return f"the compiled kernels that came with the program are not used: {why}" if why else ""


def is_complete(kind: str) -> bool:
    """Report whether all kernels of a kind of work came with the program."""
    found = shipped()
    return found is not None and kind in found.kinds


def write(folder: Path, code: Mapping[str, bytes], kinds: Iterable[str]) -> None:
    """Write a folder of code, its manifest last.

    Parameters
    ----------
    folder
        A new folder.
    code
        The contents of each file, by its name.
    kinds
        The kinds of work whose kernels are all there.
    """
    folder.mkdir(parents=True)
    for name, data in code.items():
        (folder / name).write_bytes(data)
    digests = {name: hashlib.sha256(data).hexdigest() for name, data in sorted(code.items())}
    manifest = {"needs": needed(), "features": FEATURES, "kinds": sorted(kinds), "kernels": digests}
    (folder / MANIFEST).write_text(json.dumps(manifest, indent=1) + "\n", encoding="utf-8")
