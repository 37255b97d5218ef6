"""Machine operations that numba does not offer.

A fused multiply-add, the bits of a float and back, quarter turns, and Horner's rule on several polynomials at once, of
one number or of eight (lanes.py).
Several polynomials of one argument cost as little as one when each step is a single vector operation; that is what
makes the four functions S0, S1, S0', S1' as cheap as one of them.
"""

from typing import Any, Final

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from gradhesion.core.numbers.lanes import LANES, LANES_TYPE, VECTOR, spread

ROUND: Final = 6755399441055744.0
"""1.5 2^52: adding it rounds to an integer, which then stands in the last bits."""
_ROUND_BITS: Final = 0x4338000000000000
_ROOT_HALF: Final = 0x3FE6A09E667F3BCD
_MANTISSA_BITS: Final = 52
_DOUBLE = ir.DoubleType()
_INTEGER = ir.IntType(64)


@intrinsic
def fma(typingctx: Any, a: Any, b: Any, c: Any) -> Any:
    """Return a * b + c, rounded once."""
    wide = LANES_TYPE in (a, b, c)
    number, name = (VECTOR, f"llvm.fma.v{LANES}f64") if wide else (_DOUBLE, "llvm.fma.f64")

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        if wide:
            given = zip(arguments, signature.args, strict=True)
            arguments = [value if kind == LANES_TYPE else spread(builder, value) for value, kind in given]
        kind = ir.FunctionType(number, [number] * 3)
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), arguments)

    own = [kind if kind == LANES_TYPE else types.float64 for kind in (a, b, c)]
    return (LANES_TYPE if wide else types.float64)(*own), generate


@intrinsic
def turned(typingctx: Any, sine: Any, cosine: Any, quarters: Any) -> Any:
    """Return sine and cosine of an angle some quarter turns further on; these stand in the last bits of `quarters`."""
    lanes = LANES if sine == LANES_TYPE else 1

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        sine, cosine, quarters = arguments
        real = sine.type
        whole = ir.VectorType(_INTEGER, lanes) if lanes > 1 else _INTEGER
        number = builder.bitcast(quarters, whole)

        def constant(value: int) -> Any:
            return ir.Constant(whole, [value] * lanes if lanes > 1 else value)

        def flipped(value: Any, number: Any) -> Any:
            sign = builder.shl(builder.and_(number, constant(2)), constant(62))
            return builder.bitcast(builder.xor(builder.bitcast(value, whole), sign), real)

        odd = builder.icmp_unsigned("!=", builder.and_(number, constant(1)), constant(0))
        first, second = builder.select(odd, cosine, sine), builder.select(odd, sine, cosine)
        pair = [flipped(first, number), flipped(second, builder.add(number, constant(1)))]
        return cgutils.pack_array(builder, pair)

    return types.UniTuple(sine, 2)(sine, sine, sine), generate


@intrinsic
def zero_from(typingctx: Any, value: Any, bound: Any) -> Any:
    """Return what is below a bound, 0 for what is not, and NaN for infinity."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        value, bound = arguments
        bound = spread(builder, bound) if signature.args[0] == LANES_TYPE else bound
        below = builder.fcmp_unordered("<", value, bound)
        return builder.select(below, value, builder.fsub(value, value))

    return value(value, types.float64), generate


@intrinsic
def parts_of(typingctx: Any, values: Any) -> Any:
    """Return m and e of eight normal numbers 2^e m > 0, sqrt(1/2) <= m < sqrt(2)."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        whole = ir.VectorType(_INTEGER, LANES)

        def constant(value: int) -> Any:
            return ir.Constant(whole, [value] * LANES)

        bits = builder.bitcast(arguments[0], whole)
        exponent = builder.ashr(builder.sub(bits, constant(_ROOT_HALF)), constant(_MANTISSA_BITS))
        mantissa = builder.sub(bits, builder.shl(exponent, constant(_MANTISSA_BITS)))
        shifted = builder.bitcast(builder.add(exponent, constant(_ROUND_BITS)), VECTOR)
        number = builder.fsub(shifted, spread(builder, ir.Constant(_DOUBLE, ROUND)))
        return cgutils.pack_array(builder, [builder.bitcast(mantissa, VECTOR), number])

    return types.UniTuple(LANES_TYPE, 2)(LANES_TYPE), generate


@intrinsic
def scaled(typingctx: Any, values: Any, rounded: Any) -> Any:
    """Return eight numbers times 2^t, for whole numbers t to which ROUND has been added."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        whole = ir.VectorType(_INTEGER, LANES)
        value, power = (builder.bitcast(argument, whole) for argument in arguments)
        power = builder.shl(power, ir.Constant(whole, [_MANTISSA_BITS] * LANES))
        return builder.bitcast(builder.add(value, power), VECTOR)

    return LANES_TYPE(LANES_TYPE, LANES_TYPE), generate


@intrinsic
def bits_of(typingctx: Any, value: Any) -> Any:
    """Return the 64 bits of a float as an integer."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], _INTEGER)

    return types.int64(types.float64), generate


@intrinsic
def float_of(typingctx: Any, bits: Any) -> Any:
    """Return the float that has these 64 bits."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], _DOUBLE)

    return types.float64(types.int64), generate


@intrinsic
def numbers_at(typingctx: Any, address: Any) -> Any:
    """Return a pointer to the float64 numbers at an address."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[0], _DOUBLE.as_pointer())

    return types.CPointer(types.float64)(types.int64), generate


def make_horner(lanes: int, terms: int) -> Any:
    """Make `horner(coefficients, t)`: the values of `lanes` polynomials, `terms` coefficients each, at t.

    `coefficients` is a C-contiguous float64 array whose item `[j, lane]` belongs to t**j; t is a number or eight.
    """

    @intrinsic
    def horner(typingctx: Any, coefficients: Any, t: Any) -> Any:
        wide = t == LANES_TYPE

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            vector = VECTOR if wide else ir.VectorType(_DOUBLE, lanes)
            first = context.make_array(signature.args[0])(context, builder, arguments[0]).data
            kind = ir.FunctionType(vector, [vector] * 3)
            name = f"llvm.fmuladd.v{vector.count}f64"
            multiply_add = cgutils.get_or_insert_function(builder.module, kind, name)

            def coefficient(j: int, lane: int) -> Any:
                place = builder.gep(first, [ir.Constant(_INTEGER, j * lanes + lane)])
                if wide:
                    return spread(builder, builder.load(place))
                return builder.load(builder.bitcast(place, vector.as_pointer()), align=8)

            def summed(argument: Any, lane: int) -> Any:
                value = coefficient(terms - 1, lane)
                for j in range(terms - 2, -1, -1):
                    value = builder.call(multiply_add, [value, argument, coefficient(j, lane)])
                return value

            if wide:
                return cgutils.pack_array(builder, [summed(arguments[1], lane) for lane in range(lanes)])
            value = summed(spread(builder, arguments[1], lanes), 0)
            items = [builder.extract_element(value, ir.Constant(ir.IntType(32), lane)) for lane in range(lanes)]
            return cgutils.pack_array(builder, items)

        number = LANES_TYPE if wide else types.float64
        return types.UniTuple(number, lanes)(coefficients, number), generate

    return horner
