"""What an interpolated table lacks, filled when it is read for the first time.

An interpolated table (interpolated.py) is polynomials in k. It has hundreds of bins and arches, of which a force reads
some, and a cycle some dozens. So each of them is asked for before it is read. A table of its own lacks nothing: that
is one byte, which is zero, and a branch that is never taken.

A block is what is filled at once: a bin of the pair or of the moments, or four arches. Its coefficients are those of
powers of t, -1 <= t <= 1 over the piece of [0, 1] that k lies in, of the shape (TERMS, numbers), one after the other.
"""

from dataclasses import dataclass
from typing import Any, Final

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from gradhesion.core.struve.layout import (
    ARCHES,
    ARCHES_AT_ONCE,
    BIN_TERMS,
    BINS,
    EXPONENT_SPAN,
    MOMENT_BINS,
    MOMENT_TERMS,
    TABLE,
)

TERMS: Final = 8
"""Coefficients of powers of t, at most."""
POWERS_AT_ONCE: Final = 32
_WORD: Final = 8
_LANES: Final = 8
"""Numbers of one vector operation; 4 are left at the end of a block."""
_BYTE, _BIT, _INTEGER, _DOUBLE = ir.IntType(8), ir.IntType(1), ir.IntType(64), ir.DoubleType()


@dataclass(frozen=True)
class Blocks:
    """The blocks of one field.

    Attributes
    ----------
    field, lacks
        The names of the field, or the first of several, and of the flags of its blocks, "" where all is filled at once.
    number
        How many blocks there are.
    size
        Numbers of a block, a multiple of 4.
    total
        Numbers of the field: the last block ends there, and overlaps the one before where it has to.
    power
        The power of G((1+k)/2) that is taken out.
    first
        The number of doubles before its coefficients.
    terms
        How many coefficients a number has.
    """

    field: str
    lacks: str
    number: int
    size: int
    total: int
    power: int
    first: int = 0
    terms: int = TERMS

    @property
    def end(self) -> int:
        """The number of doubles before what follows its coefficients."""
        return self.first + self.terms * self.size * self.number


OF_BINS: Final = Blocks("bins", "lacks_bin", BINS, 4 * BIN_TERMS, 4 * BIN_TERMS * BINS, 1)
OF_MOMENTS: Final = Blocks(
    "moment_bins", "lacks_moments", MOMENT_BINS, 2 * MOMENT_TERMS, 2 * MOMENT_TERMS * MOMENT_BINS, 2, OF_BINS.end
)
OF_ARCHES: Final = Blocks(
    "arches", "lacks_arches", 1 + ARCHES // ARCHES_AT_ONCE, 6 * ARCHES_AT_ONCE, 6 * (ARCHES + 1), 1, OF_MOMENTS.end
)
OF_FORCES: Final = Blocks("theta_front", "", 3, 32, 81, 0, OF_ARCHES.end)
OF_POWERS: Final = Blocks("power_mantissa", "", 14, 32, 448, 0, OF_FORCES.end, 6)
OF_CYCLES: Final = Blocks("jump_tail", "", 12, 32, 367, 0, OF_POWERS.end)
OF_ENERGIES: Final = Blocks("moment_series", "", 5, 32, 150, 2, OF_CYCLES.end)
"""What every force reads, theta_front to power_mantissa; and what cycles read: to fractional, to moment_logarithm."""
ALL: Final = (OF_BINS, OF_MOMENTS, OF_ARCHES, OF_FORCES, OF_POWERS, OF_CYCLES, OF_ENERGIES)


def _offset(field: str) -> int:
    """Return where a field of a record begins."""
    return int(TABLE.fields[field][1])  # type: ignore[index]


def _at(builder: Any, base: Any, offset: Any, kind: Any) -> Any:
    """Return the pointer to what stands some bytes behind `base`."""
    return builder.bitcast(builder.gep(base, [offset]), kind.as_pointer())


def _spread(builder: Any, number: Any, lanes: int) -> Any:
    """Return a vector of one number."""
    undefined = ir.Constant(ir.VectorType(_DOUBLE, lanes), ir.Undefined)
    single = builder.insert_element(undefined, number, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(single, undefined, ir.Constant(ir.VectorType(ir.IntType(32), lanes), [0] * lanes))


def _define_filling(module: Any, blocks: Blocks) -> Any:
    """Return the function that fills a block of a record: `fill(record, block)`.

    It keeps the registers of its callers, which are hot where it is cold.
    """
    name = f"gradhesion.fill.{blocks.field}"
    if name in module.globals:
        return module.globals[name]
    fill = ir.Function(module, ir.FunctionType(ir.VoidType(), [_BYTE.as_pointer(), _INTEGER]), name)
    fill.linkage, fill.calling_convention = "linkonce_odr", "preserve_mostcc"
    for attribute in ("noinline", "cold", "nounwind"):
        fill.attributes.add(attribute)
    builder = ir.IRBuilder(fill.append_basic_block())
    record, block = fill.args

    def constant(value: int) -> Any:
        return ir.Constant(_INTEGER, value)

    def read(field: str, kind: Any) -> Any:
        return builder.load(_at(builder, record, constant(_offset(field)), kind), align=8)

    size = _WORD * blocks.size
    source, place, gamma = read("source", _INTEGER), read("place", _DOUBLE), read("gamma", _DOUBLE)
    scale = {0: None, 1: gamma, 2: builder.fmul(gamma, gamma)}[blocks.power]
    begin = builder.mul(block, constant(size))
    latest = constant(_WORD * blocks.total - size)
    begin = builder.select(builder.icmp_signed("<", begin, latest), begin, latest)
    out = builder.gep(record, [builder.add(begin, constant(_offset(blocks.field)))])
    before = builder.add(builder.mul(block, constant(blocks.terms * size)), constant(_WORD * blocks.first))
    first = builder.gep(builder.inttoptr(source, _BYTE.as_pointer()), [before])
    for start in range(0, blocks.size, _LANES):
        lanes = min(_LANES, blocks.size - start)
        vector = ir.VectorType(_DOUBLE, lanes)
        fma = cgutils.get_or_insert_function(module, ir.FunctionType(vector, [vector] * 3), f"llvm.fmuladd.v{lanes}f64")
        rows = [
            builder.load(_at(builder, first, constant(term * size + _WORD * start), vector), align=8)
            for term in range(blocks.terms)
        ]
        total, argument = rows[-1], _spread(builder, place, lanes)
        for row in rows[-2::-1]:
            total = builder.call(fma, [total, argument, row])
        if scale is not None:
            total = builder.fmul(total, _spread(builder, scale, lanes))
        builder.store(total, _at(builder, out, constant(_WORD * start), vector), align=8)
    if blocks.lacks:
        flag = builder.add(block, constant(_offset(blocks.lacks)))
        builder.store(ir.Constant(_BYTE, 0), builder.gep(record, [flag]))
    builder.ret_void()
    return fill


def _make_filling(blocks: Blocks) -> Any:
    """Make `fill(table, block)`."""

    @intrinsic
    def fill(typingctx: Any, table: Any, block: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            record = builder.bitcast(arguments[0], _BYTE.as_pointer())
            builder.call(_define_filling(builder.module, blocks), [record, arguments[1]], cconv="preserve_mostcc")
            return context.get_dummy_value()

        return types.none(table, types.int64), generate

    return fill


def _make_asking(blocks: Blocks) -> Any:
    """Make `ask(table, block)`: what has a table have a block, which is not negative."""

    @intrinsic
    def ask(typingctx: Any, table: Any, block: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            module = builder.module
            fill = _define_filling(module, blocks)
            record = builder.bitcast(arguments[0], _BYTE.as_pointer())
            block = arguments[1]
            assume = cgutils.get_or_insert_function(module, ir.FunctionType(ir.VoidType(), [_BIT]), "llvm.assume")
            expect = cgutils.get_or_insert_function(module, ir.FunctionType(_BIT, [_BIT, _BIT]), "llvm.expect.i1")
            builder.call(assume, [builder.icmp_signed(">=", block, ir.Constant(_INTEGER, 0))])
            offset = builder.add(block, ir.Constant(_INTEGER, _offset(blocks.lacks)))
            flag = builder.load(builder.gep(record, [offset]))
            lacks = builder.icmp_signed("!=", flag, ir.Constant(_BYTE, 0))
            with builder.if_then(builder.call(expect, [lacks, ir.Constant(_BIT, 0)])):
                builder.call(fill, [record, block], cconv="preserve_mostcc")
            return context.get_dummy_value()

        return types.none(table, types.int64), generate

    return ask


@intrinsic
def fill_powers(typingctx: Any, table: Any, up: Any, down: Any) -> Any:
    """Fill the powers of 2^e from those for 0 <= e < 32 and from those for 32 and -32."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        record, rise, fall = builder.bitcast(arguments[0], _BYTE.as_pointer()), arguments[1], arguments[2]
        one = _offset("power_exponent") + _WORD * EXPONENT_SPAN
        vector = ir.VectorType(_DOUBLE, _LANES)
        starts = range(0, POWERS_AT_ONCE, _LANES)

        def at(e: int) -> Any:
            return _at(builder, record, ir.Constant(_INTEGER, one + _WORD * e), vector)

        first = [builder.load(at(start), align=8) for start in starts]
        for e in range(POWERS_AT_ONCE, EXPONENT_SPAN + 1, POWERS_AT_ONCE):
            for start, powers in zip(starts, first, strict=True):
                if e < EXPONENT_SPAN:
                    builder.store(builder.fmul(powers, _spread(builder, rise, _LANES)), at(e + start), align=8)
                builder.store(builder.fmul(powers, _spread(builder, fall, _LANES)), at(start - e), align=8)
            rise, fall = builder.fmul(rise, arguments[1]), builder.fmul(fall, arguments[2])
        return context.get_dummy_value()

    return types.none(table, types.float64, types.float64), generate


fill_for_forces = _make_filling(OF_FORCES)
fill_mantissas = _make_filling(OF_POWERS)
fill_for_cycles = _make_filling(OF_CYCLES)
fill_for_energies = _make_filling(OF_ENERGIES)
ask_for_bin = _make_asking(OF_BINS)
ask_for_moments = _make_asking(OF_MOMENTS)
ask_for_arches = _make_asking(OF_ARCHES)
