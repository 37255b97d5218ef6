"""One name, a kernel for each kind of curve: numba chooses by the type of an argument when it compiles.

`functools.singledispatch` does so for Python. A face is declared once, as a function without a body whose docstring is
the contract; its implementations for kinds of curve are ordinary kernels, with their own types and options.
"""

import inspect
from collections.abc import Callable
from functools import update_wrapper
from importlib import import_module
from typing import Any, Generic, ParamSpec, Self, TypeVar, cast

from numba.core import types
from numba.core.datamodel import register_default
from numba.core.datamodel.models import OpaqueModel
from numba.core.types.containers import StarArgTuple, StarArgUniTuple

Given = ParamSpec("Given")
Result = TypeVar("Result")
Answer = TypeVar("Answer", bound=Callable[..., Any])


class Face(Generic[Given, Result]):
    """A function that each kind of curve answers with a kernel of its own.

    Parameters
    ----------
    declared
        The function without a body.
    answered_in
        The modules with the answers. They are imported when the first answer is needed, since they import modules
        that need the face.
    by
        The argument whose type chooses.
    """

    __name__: str
    __qualname__: str

    def __init__(self, declared: Callable[Given, Result], answered_in: tuple[str, ...], by: str = "curve") -> None:
        update_wrapper(self, declared)
        self._at = [*inspect.signature(declared).parameters].index(by)
        self._answered_in = answered_in
        self._answers: dict[type, Any] = {}
        self._numba_type_ = _Chosen(self, self._at)

    def __call__(self, *arguments: Given.args, **_: Given.kwargs) -> Result:
        """Call the answer of the kind of curve from Python."""
        return cast("Result", self.answer_of(type(arguments[self._at]))(*arguments))

    def with_answer(self, kind: type, answer: Any) -> Self:
        """Return itself, with a kernel that answers for a kind of curve."""
        self._answers[kind] = answer
        return self

    def answers(self, *kinds: type) -> Callable[[Answer], Answer]:
        """Have a kernel answer for some kinds of curve."""

        def register(answer: Answer) -> Answer:
            self._answers |= dict.fromkeys(kinds, answer)
            return answer

        return register

    def answered(self) -> tuple[type, ...]:
        """Return the kinds of curve that have an answer."""
        for module in self._answered_in:
            import_module(module)
        return tuple(self._answers)

    def answer_of(self, kind: type) -> Any:
        """Return the kernel that answers for a kind of curve.

        Raises
        ------
        TypeError
            No kernel does.
        """
        for module in self._answered_in:  # one after the other: no more are entered than are needed
            if kind in self._answers:
                break
            import_module(module)
        if kind not in self._answers:
            raise TypeError(f"{self.__name__} has no answer for a curve of the type {kind.__name__}")
        return self._answers[kind]


class _Chosen(types.Callable, types.Dummy):
    """The type of a face: that of the kernel that answers, once the arguments are known."""

    def __init__(self, face: Face[..., Any], at: int) -> None:
        self._face, self._at = face, at
        super().__init__(f"Face({face.__module__}.{face.__qualname__})")

    def _answer(self, arguments: Any) -> Any:
        stars = (StarArgTuple, StarArgUniTuple)  # what a kernel takes as `*arguments`
        kind = [one for each in arguments for one in (each if isinstance(each, stars) else (each,))][self._at]
        return self._face.answer_of(getattr(kind, "instance_class", type(kind)))._numba_type_

    def get_call_type(self, context: Any, args: Any, kws: Any) -> Any:
        """Return the signature of the answer."""
        return self._answer(args).get_call_type(context, args, kws)

    def get_call_signatures(self) -> Any:
        """Return no signature: there is one for each kind of curve."""
        return (), True

    def get_impl_key(self, sig: Any) -> Any:
        """Return the compiled answer."""
        return self._answer(sig.args).get_impl_key(sig)


register_default(_Chosen)(OpaqueModel)


def face_of(
    kind: type, *answered_in: str, by: str = "curve"
) -> Callable[[Callable[Given, Result]], Face[Given, Result]]:
    """Make a face of the kernel that answers for one kind; others answer in the modules of these names."""

    def declare(answer: Callable[Given, Result]) -> Face[Given, Result]:
        return Face(answer, answered_in, by).with_answer(kind, answer)

    return declare


def face(*answered_in: str, by: str = "curve") -> Callable[[Callable[Given, Result]], Face[Given, Result]]:
    """Declare a function that each kind of curve, or of an argument `by`, answers in the modules of these names."""

    def declare(declared: Callable[Given, Result]) -> Face[Given, Result]:
        return Face(declared, answered_in, by)

    return declare
