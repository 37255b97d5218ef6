"""The result types of numba's own functions for arguments of some types, found once.

For each `a + b` of a kernel numba tries the many forms that an addition can have, one after the other, once when it
infers types and once more when it makes code: a tenth of the time. What it finds depends on the types alone, so that it
is kept with the function.
"""

from collections.abc import Callable
from typing import Any

from numba.core import types


def remember_calls(is_ours: Callable[[], bool]) -> Callable[[], None]:
    """Have numba keep these in this process while it compiles our kernels; return a function that undoes this."""
    resolve = types.Function.get_call_type

    def get_call_type(self: Any, context: Any, args: Any, kws: Any) -> Any:
        """Return the signature of a call."""
        if kws or not is_ours():
            return resolve(self, context, args, kws)
        known = self.__dict__.setdefault("_known_calls", {})
        if args not in known:
            known[args] = resolve(self, context, args, kws)
        return known[args]

    types.Function.get_call_type = get_call_type  # type: ignore[method-assign]

    def forget() -> None:
        types.Function.get_call_type = resolve  # type: ignore[method-assign]

    return forget
