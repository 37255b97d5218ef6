"""The one decorator of every kernel, and the one place that knows where compiled code is kept.

Numba notices an edit in the file of a kernel, but not in the files of the kernels that it calls. The folder of the
compiled code is therefore named after a digest of all sources of the core and of where they stand (numba keeps code of
one place for that place alone): an edit anywhere compiles all of it anew.
"""

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final, TypeVar

import numba
import platformdirs

Kernel = TypeVar("Kernel", bound=Callable[..., Any])

_CORE: Final = Path(__file__).parent


def _digest_of_sources() -> str:
    digest = hashlib.sha256()
    for source in sorted(_CORE.rglob("*.py")):
        digest.update(source.relative_to(_CORE).as_posix().encode())
        digest.update(source.read_bytes())
    return digest.hexdigest()


SOURCES: Final = _digest_of_sources()
"""A digest of all sources of the core, wherever they stand: results of one are comparable bit by bit."""

_PLACE: Final = hashlib.sha256(f"{_CORE}{SOURCES}".encode()).hexdigest()[:16]

CACHE_FOLDER: Final = Path(platformdirs.user_cache_dir("gradhesion")) / f"kernels-{_PLACE}"
"""Where the compiled kernels of exactly these sources are kept (numba falls back to its own choice if it cannot)."""


def kernel(*, contract: bool = False, inline: bool = False) -> Callable[[Kernel], Kernel]:
    """Compile a function to machine code that releases the GIL and follows IEEE arithmetic.

    Parameters
    ----------
    contract
        Allow `a * b + c` to be rounded once. No other liberty is ever taken: with full fast-math `isnan` is always
        false, and the exact argument reductions of the wave break.
    inline
        Insert the function into its callers: for one so short that handing its arrays over is a good part of its cost.
    """

    def decorate(function: Kernel) -> Kernel:
        previous = numba.config.CACHE_DIR
        try:
            CACHE_FOLDER.mkdir(parents=True, exist_ok=True)
            numba.config.CACHE_DIR = str(CACHE_FOLDER)
        except OSError:  # a read-only home: numba looks for a place of its own
            pass
        try:
            compiled: Kernel = numba.njit(
                cache=True,
                nogil=True,
                error_model="numpy",
                fastmath={"contract"} if contract else False,
                inline="always" if inline else "never",
            )(function)
        finally:
            numba.config.CACHE_DIR = previous
        return compiled

    return decorate
