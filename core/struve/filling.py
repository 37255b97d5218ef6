"""The missing parts of an interpolated table, filled when they are first read.

An interpolated table (interpolated.py) is polynomials in k. It has hundreds of bins and arches, of which a force reads
some, and a cycle some dozens. So each of them is requested before it is read. A table built for its exponent is
complete: the cost is one byte, which is zero, and a branch that is never taken.
"""

from typing import Any, Final

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from gradhesion.core.numbers.lanes import LANES, spread
from gradhesion.core.struve.layout import (
    EXPONENT_SPAN,
    OF_ARCHES,
    OF_BINS,
    OF_CYCLES,
    OF_ENERGIES,
    OF_FORCES,
    OF_MANTISSAS,
    OF_MOMENTS,
    TABLE,
    Blocks,
)

_STEP: Final = 32
"""Powers of 2^e are products of one for e/32 and one for the rest."""
_COLD: Final = "preserve_mostcc"
"""The calling convention of functions that are rarely called and keep the registers of their callers."""
_WORD: Final = 8
_BYTE, _BIT, _INTEGER, _DOUBLE = ir.IntType(8), ir.IntType(1), ir.IntType(64), ir.DoubleType()


def _offset(field: str) -> int:
    """Return where a field of a record begins."""
    return int(TABLE.fields[field][1])  # type: ignore[index]


def _at(builder: Any, base: Any, offset: Any, kind: Any) -> Any:
    """Return the pointer to what stands some bytes behind `base`."""
    return builder.bitcast(builder.gep(base, [offset]), kind.as_pointer())


def _define_filling(module: Any, blocks: Blocks) -> Any:
    """Return the function that fills a block of a record: `fill(record, block)`."""
    name = f"gradhesion.fill.{blocks.field}"
    if name in module.globals:
        return module.globals[name]
    fill = ir.Function(module, ir.FunctionType(ir.VoidType(), [_BYTE.as_pointer(), _INTEGER]), name)
    fill.linkage, fill.calling_convention = "linkonce_odr", _COLD
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
    for start in range(0, blocks.size, LANES):
        lanes = min(LANES, blocks.size - start)
        vector = ir.VectorType(_DOUBLE, lanes)
        fma = cgutils.get_or_insert_function(module, ir.FunctionType(vector, [vector] * 3), f"llvm.fmuladd.v{lanes}f64")
        rows = [
            builder.load(_at(builder, first, constant(term * size + _WORD * start), vector), align=8)
            for term in range(blocks.terms)
        ]
        total, argument = rows[-1], spread(builder, place, lanes)
        for row in rows[-2::-1]:
            total = builder.call(fma, [total, argument, row])
        if scale is not None:
            total = builder.fmul(total, spread(builder, scale, lanes))
        builder.store(total, _at(builder, out, constant(_WORD * start), vector), align=8)
    if blocks.lacks:
        flag = builder.add(block, constant(_offset(blocks.lacks)))
        builder.store(ir.Constant(_BYTE, 0), builder.gep(record, [flag]))
    builder.ret_void()
    return fill


def _call_filling(builder: Any, blocks: Blocks, record: Any, block: Any) -> None:
    """Fill a block of a record."""
    builder.call(_define_filling(builder.module, blocks), [record, block], cconv=_COLD)


def _make_asking(blocks: Blocks) -> Any:
    """Make `ask(table, block)`: a function that fills a block (not negative) of a table if it is missing."""

    @intrinsic
    def ask(typingctx: Any, table: Any, block: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            module = builder.module
            record = builder.bitcast(arguments[0], _BYTE.as_pointer())
            block = arguments[1]
            assume = cgutils.get_or_insert_function(module, ir.FunctionType(ir.VoidType(), [_BIT]), "llvm.assume")
            expect = cgutils.get_or_insert_function(module, ir.FunctionType(_BIT, [_BIT, _BIT]), "llvm.expect.i1")
            builder.call(assume, [builder.icmp_signed(">=", block, ir.Constant(_INTEGER, 0))])
            offset = builder.add(block, ir.Constant(_INTEGER, _offset(blocks.lacks)))
            flag = builder.load(builder.gep(record, [offset]))
            lacks = builder.icmp_signed("!=", flag, ir.Constant(_BYTE, 0))
            with builder.if_then(builder.call(expect, [lacks, ir.Constant(_BIT, 0)])):
                _call_filling(builder, blocks, record, block)
            return context.get_dummy_value()

        return types.none(table, types.int64), generate

    return ask


def _fill_powers(builder: Any, record: Any, power: Any) -> None:
    """Fill the powers of 2^e from that of 2^32: roots of it, their products, and multiples of these."""
    one = _offset("power_exponent") + _WORD * EXPONENT_SPAN
    sqrt = cgutils.get_or_insert_function(builder.module, ir.FunctionType(_DOUBLE, [_DOUBLE]), "llvm.sqrt.f64")
    vector = ir.VectorType(_DOUBLE, LANES)

    def at(e: int, kind: Any) -> Any:
        return _at(builder, record, ir.Constant(_INTEGER, one + _WORD * e), kind)

    powers, root = {0: ir.Constant(_DOUBLE, 1.0)}, power
    for step in (16, 8, 4, 2, 1):
        root = powers[step] = builder.call(sqrt, [root])
    for e in range(_STEP):
        if e not in powers:
            step = 1 << e.bit_length() - 1
            powers[e] = builder.fmul(powers[step], powers[e - step])
        builder.store(powers[e], at(e, _DOUBLE), align=8)
    starts = range(0, _STEP, LANES)
    first = [builder.load(at(start, vector), align=8) for start in starts]
    inverse = builder.fdiv(ir.Constant(_DOUBLE, 1.0), power)
    rise, fall = power, inverse
    for e in range(_STEP, EXPONENT_SPAN + 1, _STEP):
        for start, values in zip(starts, first, strict=True):
            if e < EXPONENT_SPAN:
                builder.store(builder.fmul(values, spread(builder, rise, LANES)), at(e + start, vector), align=8)
            builder.store(builder.fmul(values, spread(builder, fall, LANES)), at(start - e, vector), align=8)
        rise, fall = builder.fmul(rise, power), builder.fmul(fall, inverse)


def _define_refilling(module: Any) -> Any:
    """Return the function that fills all fields but the blocks: `refill(record, power)`."""
    name = "gradhesion.refill"
    if name in module.globals:
        return module.globals[name]
    refill = ir.Function(module, ir.FunctionType(ir.VoidType(), [_BYTE.as_pointer(), _DOUBLE]), name)
    refill.linkage = "linkonce_odr"
    for attribute in ("noinline", "nounwind"):
        refill.attributes.add(attribute)
    builder = ir.IRBuilder(refill.append_basic_block())
    record, power = refill.args

    def fill(*fields: Blocks) -> None:
        for blocks in fields:
            for block in range(blocks.number):
                _call_filling(builder, blocks, record, ir.Constant(_INTEGER, block))

    for blocks in (OF_BINS, OF_MOMENTS, OF_ARCHES):
        flags = builder.gep(record, [ir.Constant(_INTEGER, _offset(blocks.lacks))])
        cgutils.memset(builder, flags, ir.Constant(_INTEGER, blocks.number), 1)
    fill(OF_FORCES, OF_MANTISSAS)
    _fill_powers(builder, record, power)
    for_forces = builder.load(builder.gep(record, [ir.Constant(_INTEGER, _offset("for_forces"))]))
    with builder.if_then(builder.icmp_signed("==", for_forces, ir.Constant(_BYTE, 0))):
        fill(OF_CYCLES, OF_ENERGIES)
    builder.ret_void()
    return refill


@intrinsic
def refill(typingctx: Any, table: Any, power: Any) -> Any:
    """Fill all of a table but the blocks, which are filled when they are read; `power` is 2^(-16 (1+k))."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        record = builder.bitcast(arguments[0], _BYTE.as_pointer())
        builder.call(_define_refilling(builder.module), [record, arguments[1]])
        return context.get_dummy_value()

    return types.none(table, types.float64), generate


@intrinsic
def fill_theta(typingctx: Any, table: Any) -> Any:
    """Fill the fields for theta."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        record = builder.bitcast(arguments[0], _BYTE.as_pointer())
        _call_filling(builder, OF_FORCES, record, ir.Constant(_INTEGER, 0))
        return context.get_dummy_value()

    return types.none(table), generate


ask_for_bin = _make_asking(OF_BINS)
ask_for_moments = _make_asking(OF_MOMENTS)
ask_for_arches = _make_asking(OF_ARCHES)
