"""What is wrong with points that no loop has, in sentences that say what to write instead."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.fit.loop_columns import LoopFileError
from gradhesion.core.loops.measured.plausible import fault_of
from gradhesion.core.loops.measured.points import has_order, ways

if TYPE_CHECKING:
    from gradhesion.cli.study.fit.form import DataTable


def refuse_order(depth: NDArray[np.float64], cycle: NDArray[np.int32] | None) -> None:
    """
    Refuse points whose order tells no branches.

    Raises
    ------
    LoopFileError
        They come in no order.
    """
    if not has_order(depth, cycle):
        turns = int(ways(depth)[1].max())
        raise LoopFileError(
            "file",
            f"the branches cannot be recognised from the order of the points ({turns:,} turns of the depth among "
            f'{depth.size:,} points); name a column that has them, branch = "branch", or sort the rows as they '
            "were measured",
        )


def refuse_faults(
    depth: NDArray[np.float64],
    load: NDArray[np.float64],
    noise: NDArray[np.float64],
    unloading: NDArray[np.bool_],
    table: "DataTable",
) -> None:
    """
    Refuse points without contact, and with a sign that is wrong.

    Raises
    ------
    LoopFileError
        They are those of no contact.
    """
    fault = fault_of(depth, load, noise, unloading)
    depth_key = "displacement" if table.displacement else "indentation"
    if fault == "straight":
        raise LoopFileError(
            "load",
            "the load is linear in the depth within its noise: the data show no contact; name a "
            "file or a column that does",
        )
    if fault in ("load", "both"):
        where = "deepest" if fault == "load" else "shallowest"
        raise LoopFileError(
            "load",
            f"the load falls towards the {where} points and is farthest from the base line there, so that its sign is "
            f"wrong{'' if fault == 'load' else ', as is that of the depth'}: positive loads press; write "
            f"{_turned('load', table)}{'' if fault == 'load' else f' and {_turned(depth_key, table)}'}",
        )
    if fault == "depth":
        raise LoopFileError(
            depth_key,
            "the load rises towards the shallowest points, so that the sign of the depth is wrong: it grows into the "
            f"half-space; write {_turned(depth_key, table)}",
        )


def _turned(key: str, table: "DataTable") -> str:
    """Write a column with the other sign."""
    column = getattr(table, key)
    if column is None:
        return f'{key} = {{ column = "...", sign = -1 }}'
    unit = f', unit = "{column.unit}"' if column.unit else ""
    sign = "" if column.sign == -1 else ", sign = -1"
    return f'{key} = {{ column = "{column.column}"{unit}{sign} }}'
