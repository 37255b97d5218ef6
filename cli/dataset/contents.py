"""How the variables of a map and of a curve study are described and computed: one value, or one curve, a scene."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any, Final, Protocol

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


class Contents(Protocol):
    """What the dataset of one kind of study asks of its kind."""

    filled: bool
    """Whether every cell of its variables is written."""

    def described(self, study: Study, name: str) -> Variable:
        """Describe a variable, in the units of the theory."""

    def parts(self, study: Study, threads: int | None) -> Iterator[Part]:
        """Compute the values, part by part, in the order of the blocks."""

    def joined(self, study: Study, parts: Iterable[Part]) -> dict[str, NDArray[Any]]:
        """Join parts in memory."""


def _long_name(name: str) -> str:
    """Say what an output of a map is, also the sensitivity of one in SI units."""
    if not name.endswith(OF_PHYSICAL):
        return (OUTPUTS | SPREADS)[name]
    meaning = OUTPUTS[name.removesuffix(OF_PHYSICAL)]
    return meaning.split(" to each parameter")[0] + " in SI units to each quantity q with a unit: d ln/d ln q"


class _OfMap:
    """One value a scene."""

    filled = True

    def described(self, study: Study, name: str) -> Variable:
        attributes = {"units": "1", "ancillary_variables": "status", "long_name": _long_name(name)}
        if name.endswith("_std"):
            sampled = bool(study.uncertainty.samples)
            attributes["comment"] = "of samples of the uncertain inputs" if sampled else "linear, by sensitivities"
        if name in ("dissipated_energy", "unloading_energy") and study.loading.control == "load":
            attributes["long_name"] = OUTPUTS[name].replace(",", " without its jump-out, which has no bound,")
        if name.endswith("_jumps"):
            return Variable(dimensions=tuple(study.sizes), dtype="i4", attributes=attributes)
        own = (*study.sizes, labels_of(name)) if labels_of(name) else tuple(study.sizes)
        return Variable(dimensions=own, dtype="f8", attributes=attributes, blank=np.nan)

    def parts(self, study: Study, threads: int | None) -> Iterator[Part]:
        return solved(study, threads)

    def joined(self, study: Study, parts: Iterable[Part]) -> dict[str, NDArray[Any]]:
        whole: dict[str, NDArray[Any]] = {}
        for block, values in parts:
            for name, part in values.items():
                if name not in whole:
                    whole[name] = np.empty(study.shape_of(name, study.shape), part.dtype)
                whole[name][block] = part
        return whole


class _OfCurves:
    """One curve a scene, along a dimension of its own."""

    filled = False

    def described(self, study: Study, name: str) -> Variable:
        dimensions, dtype = tuple(study.sizes), INTEGERS.get(name, "f8")
        attributes: dict[str, Any] = {"units": "1", "ancillary_variables": "status"}
        attributes["long_name"] = next(own[name] for own in CURVES.values() if name in own)
        if name in MEANINGS:
            attributes |= {"flag_values": np.array([0, 1], dtype=dtype), "flag_meanings": MEANINGS[name]}
        if name in RAGGED.values():
            attributes["sample_dimension"] = next(EXTENTS[one] for one in RAGGED if name in CURVES[one])
            return Variable(dimensions=dimensions, dtype=dtype, attributes=attributes)
        if is_ragged(name):
            del attributes["ancillary_variables"]  # `status` has other dimensions
            return Variable(dimensions=(extent_of(name),), dtype=dtype, attributes=attributes)
        states = (STATE,) if is_of_a_state(name) else ()
        dimensions = (*dimensions, *states, extent_of(name))
        return Variable(dimensions=dimensions, dtype=dtype, attributes=attributes, blank=curves.blank_of(name))

    def parts(self, study: Study, threads: int | None) -> Iterator[Part]:
        return curves.drawn(study, threads)

    def joined(self, study: Study, parts: Iterable[Part]) -> dict[str, NDArray[Any]]:
        return curves.gathered(study, list(parts))


class _OfOptima(_OfMap):
    """The best of what is searched, a value a cell."""

    def described(self, study: Study, name: str) -> Variable:
        if name != ON_BOUND:
            plain = name.removeprefix(BEST)
            own = (*study.sizes, labels_of(name)) if labels_of(name) else tuple(study.sizes)
            long_name = INPUTS[plain].about if plain in INPUTS else _long_name(plain)
            attributes: dict[str, Any] = {
                "units": unit_of(name),
                "ancillary_variables": "status",
                "long_name": f"best {long_name}",
            }
            if plain not in INPUTS:
                attributes |= {"units": "1", "long_name": f"{long_name}, at the optimum"}
            return Variable(dimensions=own, dtype="f8", attributes=attributes, blank=np.nan)
        ends = [f"{one.name}_at_its_{end}_bound" for one in study.search.inputs for end in ("lower", "upper")]
        flags: dict[str, Any] = {
            "units": "1",
            "long_name": "bounds at which the optimum lies (0: none)",
            "flag_masks": np.array([1 << i for i in range(len(ends))], dtype="i1"),
            "flag_meanings": " ".join(ends),
        }
        return Variable(dimensions=tuple(study.sizes), dtype="i1", attributes=flags)


class _OfFronts(_OfOptima):
    """The best compromises of two outputs, as many as a cell has."""

    filled = False

    def described(self, study: Study, name: str) -> Variable:
        plain = super().described(study, name)
        return replace(plain, dimensions=(*plain.dimensions, PARETO_POINT))

    def joined(self, study: Study, parts: Iterable[Part]) -> dict[str, NDArray[Any]]:
        every = list(parts)
        longest = max(values[study.variables[0]].shape[-1] for _, values in every)
        whole: dict[str, NDArray[Any]] = {name: np.full((*study.shape, longest), np.nan) for name in study.variables}
        whole["status"] = np.zeros(study.shape, np.int16)
        whole[STEEP] = np.zeros(study.shape, np.int8)
        for block, values in every:
            for name, part in values.items():
                whole[name][curves.within(name, block, part)] = part
        return whole


CONTENTS: Final[dict[str, Contents]] = {
    "map": _OfMap(),
    "curve": _OfCurves(),
    "optimum": _OfOptima(),
    "pareto": _OfFronts(),
}
"""By the sort of a study."""
