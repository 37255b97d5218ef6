"""The spread of a block's values: by sensitivities, by a few samples that check them, and by many."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import SI, SPREADABLE
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.rules.form import Uncertainty
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, Tiling, shape_of
from gradhesion.cli.work.solve.scenes import Arrays, solve_given, value_slopes
from gradhesion.core.answers import uncertainty
from gradhesion.core.answers.flags import LINEAR_DEVIATION_OFF
from gradhesion.core.problem.status import NO_VALUE

SCENES: Final = 2**20
"""Samples that are solved at a time: some ten arrays of 8 MB are held."""


@dataclass(frozen=True, kw_only=True, eq=False)
class _Centre:
    """The scenes of a block, about which inputs are spread."""

    study: Study
    """Without its uncertain inputs."""
    given: Arrays
    block: Block
    threads: int | None
    spreads: Mapping[str, uncertainty.Spread]

    def solve(self, given: Arrays, outputs: tuple[str, ...], *, watch: bool = False) -> Arrays:
        """Solve scenes that are given as these are, for other outputs."""
        return solve_given(self.study, given, self.block, self.threads, outputs=outputs, watch=watch)

    def aligned(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Give an input the dimensions of results: random punches are their last."""
        return values[..., None] if self.study.spectrum is not None else values


def solve_uncertain(study: Study, block: Block, threads: int | None) -> Arrays:
    """Solve a block of a study with uncertain inputs: the values of its variables and `status`."""
    _, axes, _ = study.apart(block)
    centre = _Centre(
        study=replace(study, uncertainty=Uncertainty()),
        given=study.parameters_of(axes),
        block=block,
        threads=threads,
        spreads={name: uncertainty.Spread(**asdict(one)) for name, one in study.uncertainty.deviations.items()},
    )
    more = tuple(f"{name}_sensitivity" for name in study.linear)
    watch = study.watches_slope
    found = centre.solve(centre.given, tuple(dict.fromkeys((*study.outputs, *more))), watch=watch)
    given = {key: centre.aligned(values) for key, values in centre.given.items()}
    known = [name for one in study.linear for name in (one, one + SI) if name in found]
    linear = {name: value_slopes(centre.study, given, [*centre.spreads], name, found) for name in known}
    by_slopes = "std_linear" if study.uncertainty.samples else "std"
    deviations = [spread.standard_deviation(given[key]) for key, spread in centre.spreads.items()]
    made = {
        _named(name, by_slopes): uncertainty.linear_deviation([*slopes.values()], deviations)
        for name, slopes in linear.items()
    }
    if study.uncertainty.samples:
        made |= _sampled(centre, study.uncertainty, found["status"].shape)
        both = {name: (made[_named(name, by_slopes)], made[_named(name, "std")]) for name in linear}
        off = [uncertainty.differ(*deviations, found[name]) for name, deviations in both.items()]
    else:
        off = _off_the_line(centre, study.uncertainty.seed, found, linear)
    failed = (found["status"] & NO_VALUE) != 0
    flagged = np.any(off, axis=0) & ~failed if off else np.zeros_like(failed)
    status = found["status"].astype(np.int16) | np.where(flagged, LINEAR_DEVIATION_OFF, 0).astype(np.int16)
    plain = {name: found[name] for name in (*centre.study.variables, *((STEEP,) if watch else ()))}
    return plain | {name: np.where(failed, np.nan, made[name]) for name in study.spreads} | {"status": status}


def _named(name: str, way: str) -> str:
    """Name the variable of a spread: `pull_off_force_std_si` of `pull_off_force_si`."""
    return f"{name.removesuffix(SI)}_{way}" + (SI if name.endswith(SI) else "")


def _off_the_line(centre: _Centre, seed: int, found: Arrays, linear: Mapping[str, Arrays]) -> list[NDArray[np.bool_]]:
    """Report of each value where it is no straight line within the spread of its inputs, by a few samples."""
    off = {name: np.zeros(found[name].shape, bool) for name in linear}
    outputs = tuple(name for name in linear if not name.endswith(SI))
    for place, given, samples in _samples_of(centre, uncertainty.FEW, seed, outputs):
        moves = {key: centre.aligned(given[key] - _cut(centre.given[key], place)) for key in centre.spreads}
        for name, slopes in linear.items():
            line = np.sum([slopes[key][place] * move for key, move in moves.items()], axis=0)
            deviations = np.std(samples[name], axis=0), np.std(line, axis=0)
            off[name][place] = uncertainty.differ(*deviations, found[name][place], uncertainty.AT_FEW)
    return [*off.values()]


def _sampled(centre: _Centre, requested: Uncertainty, shape: tuple[int, ...]) -> Arrays:
    """Give the statistics of all values by samples of the inputs."""
    outputs = tuple(name for name in centre.study.outputs if name in SPREADABLE)
    several, *_ = centre.study.apart(centre.block)
    axis, made = len(several), dict[str, NDArray[Any]]()
    for part, _, samples in _samples_of(centre, requested.samples, requested.seed, outputs):
        place = (*(slice(None) for _ in range(axis)), *part)
        for name, values in samples.items():
            size = (*values.shape[:axis], requested.samples, *values.shape[axis + 1 :])  # some do not depend on them
            whole = np.moveaxis(np.broadcast_to(values, size), axis, -1)
            for way, one in uncertainty.statistics_of(whole).items():
                made.setdefault(_named(name, way), np.empty(shape))[place] = one
    return made


def _samples_of(
    centre: _Centre, count: int, seed: int, outputs: tuple[str, ...]
) -> Iterator[tuple[Block, Arrays, Arrays]]:
    """Solve the samples of all scenes, the same set for each, some scenes at a time.

    Yields which scenes of the block, what gives their samples, and the values of these: samples along the first axis.
    """
    shares = uncertainty.drawn_shares(len(centre.spreads), count, seed)
    _, axes, profiles = centre.study.apart(centre.block)
    for part in Tiling(shape_of(axes), max(1, SCENES // (count * len(profiles))), 1):
        given = {key: _cut(values, part)[None] for key, values in centre.given.items()}
        for (key, spread), own in zip(centre.spreads.items(), shares, strict=True):
            if key == "work_of_adhesion_closing":  # an edge opens at no less than it closes at
                spread = replace(spread, high=np.minimum(spread.high, given["work_of_adhesion"]))
            given[key] = spread.quantiles(given[key], own.reshape(-1, *(1 for _ in part)))
        found = centre.solve(given, outputs)
        yield part, given, {name: values for name, values in found.items() if name != "status"}


def _cut(values: NDArray[Any], part: Block) -> NDArray[Any]:
    """Cut a piece out of an array that broadcasts to the block."""
    return values[tuple(slice(None) if size == 1 else one for size, one in zip(values.shape, part, strict=True))]
