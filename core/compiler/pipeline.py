"""The steps in which a kernel becomes code.

Numba has thirty, most of which are for features that no kernel here has: closures, generators, `with` blocks,
expressions of whole arrays, literals that choose a type. Each goes through all of a kernel, and after many of them
numba finds anew where every variable lives. With only those that change something, the same code takes a seventh less
time.
"""

from typing import Any, Final

from numba.core.compiler import CompilerBase
from numba.core.compiler_machinery import PassManager
from numba.core.typed_passes import (
    IRLegalization,
    NativeLowering,
    NoPythonBackend,
    NopythonTypeInference,
    PreLowerStripPhis,
)
from numba.core.untyped_passes import (
    DeadBranchPrune,
    FixupArgs,
    GenericRewrites,
    InlineInlinables,
    IRProcessing,
    ReconstructSSA,
    RewriteSemanticConstants,
    TranslateByteCode,
)

from gradhesion.core.compiler.borrowed import Borrow

STEPS: Final = (
    TranslateByteCode,
    FixupArgs,
    IRProcessing,
    RewriteSemanticConstants,  # the length of a tuple is a number
    DeadBranchPrune,  # what such a number excludes is not compiled
    GenericRewrites,  # items of tuples by number
    InlineInlinables,
    ReconstructSSA,
    NopythonTypeInference,
    PreLowerStripPhis,
    Borrow,
    IRLegalization,
    NativeLowering,
    NoPythonBackend,
)
"""Those that kernels need, in numba's order; the one of our own follows when types are known."""


class KernelCompiler(CompilerBase):  # type: ignore[misc] # numba has no types
    """Numba's compiler, of these steps."""

    def define_pipelines(self) -> list[Any]:
        """Return the one pipeline."""
        pipeline = PassManager("kernel")
        for step in STEPS:
            pipeline.add_pass(step, step.__name__)
        pipeline.finalize()
        return [pipeline]
