"""How kernels are compiled: the only module that knows numba's options.

A kernel is a function of floats, arrays and NamedTuples. It neither raises nor prints. Contraction (a b + c in one
step) is the only freedom that its arithmetic has; sums of quadrature may be reordered as well. `isnan` keeps its
meaning everywhere.
"""

from collections.abc import Callable
from typing import Any, Final, TypeVar

from numba import njit

_Function = TypeVar("_Function", bound=Callable[..., Any])
_CONTRACTED: Final = {"contract"}
_REORDERED: Final = {"contract", "reassoc", "nsz"}


def kernel(function: _Function) -> _Function:
    """Compile a function that other kernels or Python call; it runs without the lock of the interpreter."""
    return njit(cache=True, nogil=True, error_model="numpy", fastmath=_CONTRACTED)(function)


def leaf(function: _Function) -> _Function:
    """Compile a short function into each of its callers: to hand an array over takes 2 ns, as long as a polynomial."""
    return njit(cache=True, nogil=True, error_model="numpy", fastmath=_CONTRACTED, forceinline=True)(function)


def quadrature(function: _Function) -> _Function:
    """Compile a loop of sums whose terms may be added in any order, so that several are added at once."""
    return njit(cache=True, nogil=True, error_model="numpy", fastmath=_REORDERED)(function)


def quadrature_leaf(function: _Function) -> _Function:
    """Compile such a loop into each of its callers."""
    return njit(cache=True, nogil=True, error_model="numpy", fastmath=_REORDERED, forceinline=True)(function)
