"""Whether sensitivities are requested, expressed by a type: where they are not, their code is not compiled.

A solver takes a record `Sense` of this folder, or `NoSense` in its place, and makes of it what it needs for a curve
and for a trace. Kernels of `if_wanted` may be called with either.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, TypeVar, cast

from gradhesion.core.compiler.dispatch import Face
from gradhesion.core.compiler.jit import kernel

Kernel = TypeVar("Kernel", bound=Callable[..., Any])


class NoSense(NamedTuple):
    """No sensitivities are wanted, nor anything that is made for them."""

    energy: int = 0  # as of `Sense`: the parts of the cycle of whose energy they are wanted


AnySense: TypeAlias = Any
"""A record `Sense`, or what is made of it for a curve or a trace; `NoSense` where no sensitivities are wanted."""


@kernel()
def nothing(*_: Any) -> NoSense:
    """Do nothing, and return what is made for no sensitivities."""
    return NoSense(0)


class _IfWanted(Face[..., Any]):
    """A kernel, and `nothing` in its place for the type `NoSense` of an argument."""

    def __init__(self, wanted: Callable[..., Any], by: str) -> None:
        super().__init__(wanted, (), by)
        self._wanted = wanted

    def answer_of(self, kind: type) -> Any:
        """Return the kernel that is called for a type of the argument."""
        return nothing if kind is NoSense else self._wanted


def if_wanted(by: str) -> Callable[[Kernel], Kernel]:
    """Have a kernel do nothing where the argument of this name is `NoSense`, and return that."""

    def choose(kernel: Kernel) -> Kernel:
        return cast("Kernel", _IfWanted(kernel, by))

    return choose
