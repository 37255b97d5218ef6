"""Whether sensitivities are requested, expressed by a type: where they are not, their code is not compiled.

A solver takes a record `Sense` of this folder, or `NoSense` in its place, and makes of it what it needs for a curve
and for a trace. Kernels of `if_wanted` may be called with either.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, ParamSpec, TypeAlias, TypeVar

from gradhesion.core.compiler.dispatch import Face
from gradhesion.core.compiler.jit import kernel

Given = ParamSpec("Given")
Result = TypeVar("Result")


class NoSense(NamedTuple):
    """No sensitivities are wanted, nor anything that is made for them."""

    energy: int = 0  # as of `Sense`: the parts of the cycle of whose energy they are wanted


AnySense: TypeAlias = Any
"""A record `Sense`, or what is made of it for a curve or a trace; `NoSense` where no sensitivities are wanted."""


@kernel()
def nothing(*_: Any) -> NoSense:
    """Do nothing, and return what is made for no sensitivities."""
    return NoSense(0)


class _IfWanted(Face[Given, Result]):
    """A kernel, and `nothing` in its place for the type `NoSense` of an argument; other types may have their own."""

    def __init__(self, wanted: Callable[Given, Result], answered_in: tuple[str, ...], by: str) -> None:
        super().__init__(wanted, answered_in, by)
        self._wanted = wanted

    def answer_of(self, kind: type) -> Any:
        """Return the kernel that is called for a type of the argument."""
        if kind is NoSense:
            return nothing
        return super().answer_of(kind) if self._answered_in else self._wanted


def if_wanted(
    by: str, kind: type = object, *answered_in: str
) -> Callable[[Callable[Given, Result]], Face[Given, Result]]:
    """Have a kernel do nothing where the argument of this name is `NoSense`, and return that.

    It is called for all others, or for one kind of them if some are answered in other modules.
    """

    def choose(kernel: Callable[Given, Result]) -> Face[Given, Result]:
        return _IfWanted(kernel, answered_in, by).with_answer(kind, kernel)

    return choose
