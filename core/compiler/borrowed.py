"""Kernels that own no array count no references to those of others.

An array that a kernel is given, or a part of one, belongs to a caller, which keeps it until the kernel returns. Numba
would count its references all the same, at each call and each view, atomically, and all threads count the arrays that
they share at one place in memory: that took a quarter of the time of a displacement-controlled scene of one cosine, and
more than half of that of a general one. So the counting is left out of a kernel that makes no array, gets none from
what it calls, and returns none. What else it may do with arrays stands in `_BORROWING`; whatever is not named there
keeps the counting.
"""

from typing import Any, Final

from numba.core import ir, types
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.typed_passes import NopythonRewrites

_BORROWING: Final = ("build_tuple", "cast", "exhaust_iter", "getattr", "getitem", "static_getitem")
"""Operations whose result, if it contains an array, contains one of their operands, or a view of it."""
_ITEMS: Final = (ir.SetItem, ir.StaticSetItem)


def _counted(state: Any, kind: Any) -> bool:
    """Return whether a value of a type counts references."""
    return bool(state.targetctx.data_model_manager[kind].contains_nrt_meminfo())


def _borrows(state: Any, value: Any) -> bool:
    """Return whether what is assigned, and counts references, belongs to a caller."""
    if isinstance(value, (ir.Arg, ir.Var, ir.Global, ir.FreeVar, ir.Const)):
        return True
    if not isinstance(value, ir.Expr):
        return False
    if value.op == "call":  # a record contains its fields
        return isinstance(state.typemap[value.func.name], types.NamedTupleClass)
    if value.op not in _BORROWING:
        return False
    # an array of indices takes a copy, a number or a slice takes a view
    index = getattr(value, "index", None) if value.op == "getitem" else None
    return not (isinstance(index, ir.Var) and _counted(state, state.typemap[index.name]))


def owns_nothing(state: Any) -> bool:
    """Return whether a kernel whose types are known neither makes, nor gets, nor returns anything that is counted."""
    if _counted(state, state.return_type):
        return False
    for block in state.func_ir.blocks.values():
        for statement in block.body:
            if isinstance(statement, ir.Assign) and _counted(state, state.typemap[statement.target.name]):
                if not _borrows(state, statement.value):
                    return False
            elif isinstance(statement, _ITEMS) and _counted(state, state.typemap[statement.value.name]):
                return False  # the one may be copied first where the two overlap
    return True


@register_pass(mutates_CFG=False, analysis_only=False)
class Borrow(FunctionPass):  # type: ignore[misc] # numba has no types
    """Leaves the counting out of a kernel that owns nothing."""

    _name = "gradhesion_borrow"

    def __init__(self) -> None:
        FunctionPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        """Decide for one kernel, between the inference of types and the code."""
        if owns_nothing(state):
            state.targetctx.enable_nrt = False  # the context is this kernel's own copy
            return True
        return False


class OrdinaryCompiler(CompilerBase):  # type: ignore[misc]
    """Numba's compiler with all of its steps and this one, for kernels that are linked as numba does."""

    def define_pipelines(self) -> list[Any]:
        """Return the one pipeline."""
        pipeline = DefaultPassBuilder.define_nopython_pipeline(self.state)
        pipeline.add_pass_after(Borrow, NopythonRewrites)
        pipeline.finalize()
        return [pipeline]
