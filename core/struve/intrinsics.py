"""Machine operations that numba does not offer.

A fused multiply-add, the bits of a float and back, and Horner's rule on several polynomials at once.
Several polynomials of one argument cost as little as one when each step is a single vector operation; that is what
makes the four functions S0, S1, S0', S1' as cheap as one of them.
"""

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

_DOUBLE = ir.DoubleType()
_INTEGER = ir.IntType(64)


@intrinsic
def fma(typingctx: Any, a: Any, b: Any, c: Any) -> Any:
    """Return a * b + c, rounded once."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = ir.FunctionType(_DOUBLE, [_DOUBLE] * 3)
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, "llvm.fma.f64"), arguments)

    return types.float64(types.float64, types.float64, types.float64), generate


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

    `coefficients` is a C-contiguous float64 array whose item `[j, lane]` belongs to t**j.
    """

    @intrinsic
    def horner(typingctx: Any, coefficients: Any, t: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            vector = ir.VectorType(_DOUBLE, lanes)
            undefined = ir.Constant(vector, ir.Undefined)
            first = context.make_array(signature.args[0])(context, builder, arguments[0]).data
            single = builder.insert_element(undefined, arguments[1], ir.Constant(ir.IntType(32), 0))
            zeros = ir.Constant(ir.VectorType(ir.IntType(32), lanes), [0] * lanes)
            argument = builder.shuffle_vector(single, undefined, zeros)
            kind = ir.FunctionType(vector, [vector] * 3)
            multiply_add = cgutils.get_or_insert_function(builder.module, kind, f"llvm.fmuladd.v{lanes}f64")

            def coefficient(j: int) -> Any:
                row = builder.gep(first, [ir.Constant(_INTEGER, j * lanes)])
                return builder.load(builder.bitcast(row, vector.as_pointer()), align=8)

            value = coefficient(terms - 1)
            for j in range(terms - 2, -1, -1):
                value = builder.call(multiply_add, [value, argument, coefficient(j)])
            items = [builder.extract_element(value, ir.Constant(ir.IntType(32), lane)) for lane in range(lanes)]
            return cgutils.pack_array(builder, items)

        return types.UniTuple(types.float64, lanes)(coefficients, types.float64), generate

    return horner


def make_polynomials(count: int, terms: int, first: int = 0) -> Any:
    """Make what `make_horner` makes, by operations on single numbers: for a loop whose runs are worked on at once.

    Row `first` of the coefficients belongs to t**0.
    """

    @intrinsic
    def polynomials(typingctx: Any, coefficients: Any, t: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            begin = context.make_array(signature.args[0])(context, builder, arguments[0]).data
            kind = ir.FunctionType(_DOUBLE, [_DOUBLE] * 3)
            multiply_add = cgutils.get_or_insert_function(builder.module, kind, "llvm.fmuladd.f64")

            def coefficient(j: int, of: int) -> Any:
                return builder.load(builder.gep(begin, [ir.Constant(_INTEGER, (first + j) * count + of)]))

            values = [coefficient(terms - 1, of) for of in range(count)]
            for j in range(terms - 2, -1, -1):
                values = [
                    builder.call(multiply_add, [value, arguments[1], coefficient(j, of)])
                    for of, value in enumerate(values)
                ]
            return cgutils.pack_array(builder, values)

        return types.UniTuple(types.float64, count)(coefficients, types.float64), generate

    return polynomials
