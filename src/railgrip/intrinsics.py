"""What LLVM is told outright, because it does not find it by itself.

Each is the compiled form of a plain function, by which it is called in the control files:
`railgrip.core.formulas.choosing` and `railgrip.control.side_by_side`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba as _numba
from llvmlite import ir
from numba.core import cgutils as _cgutils
from numba.extending import intrinsic
from numba.np import arrayobj

from railgrip.control import side_by_side
from railgrip.control.state_layout import GROUP
from railgrip.core.formulas.choosing import choose

# Numba's own type hints lack what we need.
_types: Any = _numba.types
_building: Any = _cgutils
_arrays: Any = arrayobj

_NUMBER, _INTEGER, _BIT = ir.DoubleType(), ir.IntType(64), ir.IntType(1)
_ALL = ir.VectorType(_NUMBER, GROUP)
_WHICH = ir.VectorType(_BIT, GROUP)
_ALIGNED = 8
_WHOLE = _types.int64


@intrinsic
def _select(context: Any, condition: Any, one: Any, other: Any) -> Any:
    """`choose` as LLVM's own instruction: a branch in its place would be merged with others."""

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        return builder.select(*given)

    number = _types.float64
    return number(_types.boolean, number, number), generate


def _array_at(context: Any, builder: Any, kind: Any, place: Any, shape: list[Any]) -> Any:
    """Return an array, column by column, of the values from an address on."""
    array = context.make_array(kind)(context, builder)
    size, strides = _INTEGER(8), []
    for length in shape:
        strides.append(size)
        size = builder.mul(size, length)
    _arrays.populate_array(array, place, shape, strides, _INTEGER(8), None)
    return array._getvalue()


@intrinsic
def values_at(context: Any, place: Any, n: Any) -> Any:
    """Return the array of so many numbers from an address on."""
    kind = _types.Array(_types.float64, 1, "C")

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        return _array_at(context, builder, kind, given[0], list(given[1:]))

    return kind(place, _WHOLE), generate


@intrinsic
def table_at(context: Any, place: Any, n_rows: Any, n_columns: Any) -> Any:
    """Return the table of so many numbers, column by column, from an address on."""
    kind = _types.Array(_types.float64, 2, "F")

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        return _array_at(context, builder, kind, given[0], list(given[1:]))

    return kind(place, _WHOLE, _WHOLE), generate


@intrinsic
def address(context: Any, array: Any) -> Any:
    """Return the address of an array's first value."""

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        return context.make_array(signature.args[0])(context, builder, given[0]).data

    return _types.CPointer(array.dtype)(array), generate


def _place(context: Any, builder: Any, kind: Any, array: Any, *index: Any) -> Any:
    """Return the address of sixteen values, the first of them at the index."""
    view = context.make_array(kind)(context, builder, array)
    first = _building.get_item_pointer(context, builder, kind, view, index, wraparound=False)
    return builder.bitcast(first, _ALL.as_pointer())


def _load(builder: Any, place: Any) -> Any:
    return builder.load(place, align=_ALIGNED, typ=_ALL)


def _store(builder: Any, values: Any, place: Any) -> None:
    builder.store(values, place, align=_ALIGNED)


def _rows_left(context: Any, builder: Any, kind: Any, table: Any, axle: Any) -> Any:
    """Return which of sixteen axles from one on the table has."""
    view = context.make_array(kind)(context, builder, table)
    left = builder.sub(_building.unpack_tuple(builder, view.shape, 2)[0], axle)
    counts = ir.Constant(ir.VectorType(_INTEGER, GROUP), list(range(GROUP)))
    return builder.icmp_signed("<", counts, _sixteen_times(builder, left))


def _sixteen_times(builder: Any, value: Any) -> Any:
    nothing = ir.Constant(ir.VectorType(value.type, GROUP), ir.Undefined)
    first = builder.insert_element(nothing, value, _INTEGER(0))
    return builder.shuffle_vector(first, nothing, _places([0] * GROUP))


def _places(numbers: list[int]) -> Any:
    return ir.Constant(ir.VectorType(ir.IntType(32), len(numbers)), numbers)


def _call(builder: Any, name: str, result: Any, given: list[Any], **flags: Any) -> Any:
    kind = ir.FunctionType(result, [one.type for one in given])
    function = _building.get_or_insert_function(builder.module, kind, name)
    return builder.call(function, given, **flags)


def _by_columns(table: Any) -> Any:
    if table.layout != "F":
        raise _numba.core.errors.TypingError(f"a table must lie column by column; got {table}")
    return table


@intrinsic
def _take(context: Any, state: Any, place: Any, table: Any, axle: Any, column: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        state, place, table, axle, column = given
        kinds = signature.args
        source = _place(context, builder, kinds[2], table, axle, column)
        which = _rows_left(context, builder, kinds[2], table, axle)
        values = _call(
            builder, f"llvm.masked.load.v{GROUP}f64.p0", _ALL,
            [source, ir.IntType(32)(_ALIGNED), which, ir.Constant(_ALL, [0.0] * GROUP)],
        )  # fmt: skip
        _store(builder, values, _place(context, builder, kinds[0], state, place))
        return context.get_dummy_value()

    return _types.void(state, _WHOLE, _by_columns(table), _WHOLE, _WHOLE), generate


def _store_column(context: Any, builder: Any, kind: Any, values: Any, *at: Any) -> None:
    """Write sixteen values into a table, column and axles from one on, as far as it has axles."""
    table, axle, column = at
    to = _place(context, builder, kind, table, axle, column)
    which = _rows_left(context, builder, kind, table, axle)
    given = [values, to, ir.IntType(32)(_ALIGNED), which]
    _call(builder, f"llvm.masked.store.v{GROUP}f64.p0", ir.VoidType(), given)


@intrinsic
def _give(context: Any, table: Any, axle: Any, column: Any, state: Any, place: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        *at, state, place = given
        values = _load(builder, _place(context, builder, signature.args[3], state, place))
        _store_column(context, builder, signature.args[0], values, *at)
        return context.get_dummy_value()

    return _types.void(_by_columns(table), _WHOLE, _WHOLE, state, _WHOLE), generate


@intrinsic
def _give_all(context: Any, table: Any, axle: Any, column: Any, value: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        *at, value = given
        values = _sixteen_times(builder, value)
        _store_column(context, builder, signature.args[0], values, *at)
        return context.get_dummy_value()

    return _types.void(_by_columns(table), _WHOLE, _WHOLE, _types.float64), generate


@intrinsic
def _move(context: Any, state: Any, to: Any, place: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        state, to, place = given
        kind = signature.args[0]
        values = _load(builder, _place(context, builder, kind, state, place))
        _store(builder, values, _place(context, builder, kind, state, to))
        return context.get_dummy_value()

    return _types.void(state, _WHOLE, _WHOLE), generate


@intrinsic
def _total(context: Any, state: Any, place: Any) -> Any:
    """Halves are added explicitly: LLVM's own sum leaves the order to the processor."""

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        values = _load(builder, _place(context, builder, signature.args[0], *given))
        half = GROUP // 2
        while half > 0:
            lower, upper = (
                builder.shuffle_vector(values, values, _places(list(range(at, at + half))))
                for at in (0, half)
            )
            values = builder.fadd(lower, upper)
            half //= 2
        return builder.extract_element(values, _INTEGER(0))

    return _types.float64(state, _WHOLE), generate


@intrinsic
def _greatest(context: Any, state: Any, place: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        values = _load(builder, _place(context, builder, signature.args[0], *given))
        name = f"llvm.vector.reduce.fmax.v{GROUP}f64"
        return _call(builder, name, _NUMBER, [values], fastmath=("nnan", "nsz"))

    return _types.float64(state, _WHOLE), generate


def _count(builder: Any, which: Any) -> Any:
    bits = builder.bitcast(which, ir.IntType(GROUP))
    return builder.zext(builder.ctpop(bits), _INTEGER)


@intrinsic
def _count_equal(context: Any, state: Any, place: Any, value: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        state, place, value = given
        values = _load(builder, _place(context, builder, signature.args[0], state, place))
        return _count(builder, builder.fcmp_ordered("==", values, _sixteen_times(builder, value)))

    return _WHOLE(state, _WHOLE, _types.float64), generate


@intrinsic
def _count_above(context: Any, state: Any, place: Any, bound: Any, but: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        state, place, bound, but = given
        kind = signature.args[0]
        values, others = (
            _load(builder, _place(context, builder, kind, state, one)) for one in (place, but)
        )
        is_above = builder.fcmp_ordered(">", values, _sixteen_times(builder, bound))
        is_sound = builder.fcmp_ordered("==", others, ir.Constant(_ALL, [0.0] * GROUP))
        return _count(builder, builder.and_(is_above, is_sound))

    return _WHOLE(state, _WHOLE, _types.float64, _WHOLE), generate


FORMS: dict[Callable[..., Any], Any] = {
    choose: _select,
    side_by_side.take: _take,
    side_by_side.give: _give,
    side_by_side.give_all: _give_all,
    side_by_side.move: _move,
    side_by_side.total: _total,
    side_by_side.greatest: _greatest,
    side_by_side.count_equal: _count_equal,
    side_by_side.count_above: _count_above,
}
