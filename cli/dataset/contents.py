"""How the variables of a map and of a curve study are described and computed: one value, or one curve, a scene."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.variable import Variable
from gradhesion.cli.names.curves import (
    CURVES,
    EXTENTS,
    INTEGERS,
    MEANINGS,
    RAGGED,
    STATE,
    extent_of,
    is_of_a_state,
    is_ragged,
)
from gradhesion.cli.names.outputs import (
    BEST,
    OF_PHYSICAL,
    ON_BOUND,
    OUTPUTS,
    PARETO_POINT,
    SPREADS,
    labels_of,
)
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.names.units import unit_of
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.work.solve import curves
from gradhesion.cli.work.solve.blocks import solved
from gradhesion.core.problem.inputs import INPUTS

Part = tuple[Block, dict[str, NDArray[Any]]]
"""A block of scenes with the values of its variables."""


@dataclass(frozen=True)
class Contents:
    """How the values of one sort of study are computed."""

    filled: bool
    """Whether every cell of its variables is written."""
    parts: Callable[[Study, int | None], Iterator[Part]]
    """Computes the values, part by part, in the order of the blocks, by so many threads."""
    joined: Callable[[Study, Iterable[Part]], dict[str, NDArray[Any]]]
    """Joins parts in memory."""


def described(study: Study, name: str) -> Variable:
    """Describe a variable of a study's dataset, in the units of the theory."""
    if study.kind == "curve":
        return _of_curve(study, name)
    scenes = tuple(study.sizes)
    if name == ON_BOUND:
        return _of_bounds(study)
    attributes = {"units": "1", "ancillary_variables": "status", "long_name": _long_name(study, name)}
    if name.endswith("_std"):
        sampled = bool(study.uncertainty.samples)
        attributes["comment"] = "of samples of the uncertain inputs" if sampled else "linear, by sensitivities"
    if name.removeprefix(BEST) in INPUTS:
        attributes["units"] = unit_of(name)
    if name.endswith("_jumps") and not study.search:
        return Variable(dimensions=scenes, dtype="i4", attributes=attributes)
    labels = (labels_of(name),) if labels_of(name) else ()
    points = (PARETO_POINT,) if study.search.is_front else ()
    return Variable(dimensions=(*scenes, *labels, *points), dtype="f8", attributes=attributes, blank=np.nan)


def _long_name(study: Study, name: str) -> str:
    """Say what a variable of a map or of optima is, also the sensitivity of one in SI units."""
    plain = name.removeprefix(BEST)
    if plain in INPUTS:
        return f"best {INPUTS[plain].about}"
    meaning = (OUTPUTS | SPREADS)[plain.removesuffix(OF_PHYSICAL)]
    if plain.endswith(OF_PHYSICAL):
        meaning = meaning.split(" to each parameter")[0] + " in SI units to each quantity q with a unit: d ln/d ln q"
    if study.search:
        return f"{meaning}, at the optimum"
    if name in ("dissipated_energy", "unloading_energy") and study.loading.control == "load":
        return meaning.replace(",", " without its jump-out, which has no bound,")
    return meaning


def _of_curve(study: Study, name: str) -> Variable:
    """Describe a variable of a curve, along a dimension of its own."""
    scenes, dtype = tuple(study.sizes), INTEGERS.get(name, "f8")
    attributes: dict[str, Any] = {"units": "1", "ancillary_variables": "status"}
    attributes["long_name"] = next(own[name] for own in CURVES.values() if name in own)
    if name in MEANINGS:
        attributes |= {"flag_values": np.array([0, 1], dtype=dtype), "flag_meanings": MEANINGS[name]}
    if name in RAGGED.values():
        attributes["sample_dimension"] = next(EXTENTS[one] for one in RAGGED if name in CURVES[one])
        return Variable(dimensions=scenes, dtype=dtype, attributes=attributes)
    if is_ragged(name):
        del attributes["ancillary_variables"]  # `status` has other dimensions
        return Variable(dimensions=(extent_of(name),), dtype=dtype, attributes=attributes)
    states = (STATE,) if is_of_a_state(name) else ()
    dimensions = (*scenes, *states, extent_of(name))
    return Variable(dimensions=dimensions, dtype=dtype, attributes=attributes, blank=curves.blank_of(name))


def _of_bounds(study: Study) -> Variable:
    """Describe the flags of the bounds at which an optimum lies."""
    ends = [f"{one.name}_at_its_{end}_bound" for one in study.search.inputs for end in ("lower", "upper")]
    flags: dict[str, Any] = {
        "units": "1",
        "long_name": "bounds at which the optimum lies (0: none)",
        "flag_masks": np.array([1 << i for i in range(len(ends))], dtype="i1"),
        "flag_meanings": " ".join(ends),
    }
    return Variable(dimensions=tuple(study.sizes), dtype="i1", attributes=flags)


def _side_by_side(study: Study, parts: Iterable[Part]) -> dict[str, NDArray[Any]]:
    """Join parts whose variables have as many values in each scene."""
    whole: dict[str, NDArray[Any]] = {}
    for block, values in parts:
        for name, part in values.items():
            if name not in whole:
                whole[name] = np.empty(study.shape_of(name, study.shape), part.dtype)
            whole[name][block] = part
    return whole


def _fronts(study: Study, parts: Iterable[Part]) -> dict[str, NDArray[Any]]:
    """Join the best compromises of two outputs, as many as a cell has."""
    every = list(parts)
    longest = max(values[study.variables[0]].shape[-1] for _, values in every)
    whole: dict[str, NDArray[Any]] = {name: np.full((*study.shape, longest), np.nan) for name in study.variables}
    whole["status"] = np.zeros(study.shape, np.int16)
    whole[STEEP] = np.zeros(study.shape, np.int8)
    for block, values in every:
        for name, part in values.items():
            whole[name][curves.within(name, block, part)] = part
    return whole


CONTENTS: Final = {
    "map": Contents(filled=True, parts=solved, joined=_side_by_side),
    "optimum": Contents(filled=True, parts=solved, joined=_side_by_side),
    "pareto": Contents(filled=False, parts=solved, joined=_fronts),
    "curve": Contents(
        filled=False, parts=curves.drawn, joined=lambda study, parts: curves.gathered(study, list(parts))
    ),
}
"""By the sort of a study."""
