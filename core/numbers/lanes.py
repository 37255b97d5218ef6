"""Eight numbers processed at once: a type for kernels, whose operators act on each number separately.

A formula is written with them as it is with one number, and a number beside them stands for eight. The compiler keeps
them in one register or several, whatever the processor has.
"""

import operator
from collections.abc import Callable
from typing import Any, ClassVar, Final, TypeAlias

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.errors import TypingError
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, lower_cast, models, register_model

from gradhesion.core.compiler.jit import kernel

LANES: Final = 8
Lanes: TypeAlias = Any
"""Eight numbers, for annotations."""
_DOUBLE, _SMALL = ir.DoubleType(), ir.IntType(32)
VECTOR: Final = ir.VectorType(_DOUBLE, LANES)


class _Lanes(types.Type):  # type: ignore[misc] # numba has no types
    """Eight numbers, for numba."""

    def __init__(self) -> None:
        super().__init__(name="gradhesion.lanes")


LANES_TYPE: Final = _Lanes()


@register_model(_Lanes)
class _Model(models.PrimitiveModel):  # type: ignore[misc]
    """Eight numbers, for LLVM."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, VECTOR)


def spread(builder: Any, number: Any, lanes: int = LANES) -> Any:
    """Return eight times the same number, or as often as there are lanes."""
    undefined = ir.Constant(ir.VectorType(_DOUBLE, lanes), ir.Undefined)
    single = builder.insert_element(undefined, number, ir.Constant(_SMALL, 0))
    return builder.shuffle_vector(single, undefined, ir.Constant(ir.VectorType(_SMALL, lanes), [0] * lanes))


@lower_cast(types.float64, LANES_TYPE)
def _cast(context: Any, builder: Any, given: Any, wanted: Any, value: Any) -> Any:
    return spread(builder, value)


_CASES: Final = [(LANES_TYPE, LANES_TYPE), (LANES_TYPE, types.float64), (types.float64, LANES_TYPE)]


def _add_operator(function: Any, instruction: str) -> None:
    """Register with numba an operator on lanes, or on lanes and a number."""

    class Template(ConcreteTemplate):  # type: ignore[misc]
        cases: ClassVar = [signature(LANES_TYPE, *pair) for pair in _CASES]

    infer_global(function)(Template)

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        pair = [a if k == LANES_TYPE else spread(builder, a) for a, k in zip(arguments, kinds.args, strict=True)]
        return getattr(builder, instruction)(*pair)

    for pair in _CASES:
        lower_builtin(function, *pair)(generate)


for _function, _instruction in {
    operator.add: "fadd",
    operator.sub: "fsub",
    operator.mul: "fmul",
    operator.truediv: "fdiv",
}.items():
    _add_operator(_function, _instruction)


@infer_global(operator.neg)
class _Negative(ConcreteTemplate):  # type: ignore[misc]
    cases: ClassVar = [signature(LANES_TYPE, LANES_TYPE)]


@lower_builtin(operator.neg, LANES_TYPE)
def _negative(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
    return builder.fneg(arguments[0])


def _address(context: Any, builder: Any, kind: Any, array: Any, first: Any) -> Any:
    """Return where eight numbers of an array begin."""
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [first]), VECTOR.as_pointer())


@intrinsic
def load(typingctx: Any, array: Any, first: Any) -> Any:
    """Return eight numbers of a C-contiguous array of one axis, from the one numbered `first` on."""

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        return builder.load(_address(context, builder, kinds.args[0], *arguments), align=8)

    if array.layout != "C":
        raise TypingError("eight numbers are read from an array whose numbers are neighbours")
    return LANES_TYPE(array, types.int64), generate


@intrinsic
def store(typingctx: Any, array: Any, first: Any, values: Any) -> Any:
    """Put eight numbers into a C-contiguous array of one axis, from the one numbered `first` on."""

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        *place, values = arguments
        builder.store(values, _address(context, builder, kinds.args[0], *place), align=8)
        return context.get_dummy_value()

    if array.layout != "C":
        raise TypingError("eight numbers are put into an array whose numbers are neighbours")
    return types.none(array, types.int64, LANES_TYPE), generate


@intrinsic
def eight(typingctx: Any, number: Any) -> Any:
    """Return eight times the same number."""

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        return spread(builder, arguments[0])

    return LANES_TYPE(types.float64), generate


@intrinsic
def lane_of(typingctx: Any, values: Any, lane: Any) -> Any:
    """Return one of the numbers."""

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        return builder.extract_element(*arguments)

    return types.float64(LANES_TYPE, types.int64), generate


@intrinsic
def with_lane(typingctx: Any, values: Any, lane: Any, number: Any) -> Any:
    """Return the numbers with another one in one place."""

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        values, lane, number = arguments
        return builder.insert_element(values, number, lane)

    return LANES_TYPE(LANES_TYPE, types.int64, types.float64), generate


@kernel()
def next_lane(values: Lanes, number: int, added: float) -> Lanes:
    """Return the numbers with a next one behind the first `number`; the first of all stands in every place."""
    return eight(added) if number == 0 else with_lane(values, number, added)


@intrinsic
def chosen(typingctx: Any, low: Any, high: Any, first: Any, second: Any) -> Any:
    """Return `first` where low <= high, else `second`; numbers or lanes."""
    wide = LANES_TYPE in (low, high, first, second)

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        if wide:
            given = zip(arguments, kinds.args, strict=True)
            arguments = [value if kind == LANES_TYPE else spread(builder, value) for value, kind in given]
        low, high, first, second = arguments
        return builder.select(builder.fcmp_ordered("<=", low, high), first, second)

    own = [kind if kind == LANES_TYPE else types.float64 for kind in (low, high, first, second)]
    return (LANES_TYPE if wide else types.float64)(*own), generate


@intrinsic
def sum_of(typingctx: Any, values: Any) -> Any:
    """Return the sum of the eight numbers, added one after the other."""

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        total = ir.Constant(_DOUBLE, -0.0)
        for lane in range(LANES):
            total = builder.fadd(total, builder.extract_element(arguments[0], ir.Constant(_SMALL, lane)))
        return total

    return types.float64(LANES_TYPE), generate


def _make_unary(name: str) -> Callable[..., Any]:
    """Make a function of a number, or of each of eight, one that LLVM has."""

    @intrinsic
    def function(typingctx: Any, values: Any) -> Any:
        number, ending = (VECTOR, f"v{LANES}f64") if values == LANES_TYPE else (_DOUBLE, "f64")

        def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
            kind = ir.FunctionType(number, [number])
            return builder.call(
                cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.{ending}"), arguments
            )

        return values(values), generate

    made: Callable[..., Any] = function
    return made


size_of = _make_unary("fabs")
root_of = _make_unary("sqrt")
floor_of = _make_unary("floor")
rounded = _make_unary("arithmetic.fence")
"""The value itself, rounded as it stands: a product that a kernel returns is no part of a sum of its caller, which it
else would be where the compiler puts the one into the other, and not elsewhere."""


@intrinsic
def any_above(typingctx: Any, values: Any, bound: Any) -> Any:
    """Return whether any of the numbers is not within a bound: a NaN is not."""

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        pair = [a if k == LANES_TYPE else spread(builder, a) for a, k in zip(arguments, kinds.args, strict=True)]
        bits = builder.bitcast(builder.fcmp_unordered(">", *pair), ir.IntType(LANES))
        return builder.icmp_unsigned("!=", bits, ir.Constant(ir.IntType(LANES), 0))

    return types.boolean(LANES_TYPE, bound), generate


@intrinsic
def stand_apart(typingctx: Any) -> Any:
    """Keep the kernel that calls this from being put into others: which product a sum is fused with depends on that."""

    def generate(context: Any, builder: Any, kinds: Any, arguments: Any) -> Any:
        builder.function.attributes.add("noinline")
        return context.get_dummy_value()

    return types.none(), generate
