"""The optima of the cells of a block: what is sought as a merit of what is searched, and what is reported."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import BEST, ON_BOUND, SI
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.rules.form import Optimum
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, shape_of
from gradhesion.cli.work.solve.scenes import Arrays, solve_given, value_slopes
from gradhesion.core.answers.flags import NOTHING_FEASIBLE, RESOLUTION_TOO_COARSE
from gradhesion.core.answers.optimum import Optima, axis_of, front, optima_of, sweep
from gradhesion.core.problem.names import SENSITIVITIES
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC, NO_VALUE

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


def solve_optima(study: Study, block: Block, threads: int | None) -> Arrays:
    """Find the optimum of each cell of a block: the values of its variables and `status`.

    Of two goals these are the best compromises, along a last dimension, padded to the longest.
    """
    search, shape = study.search, shape_of(block)
    count = int(np.prod(shape))
    goals = [_Cells(study=study, block=block, threads=threads, goal=goal) for goal in range(len(search.goals))]
    swept = sweep(goals[0].all_values, len(study.searched), count, search.resolution)
    ends = [optima_of(goal, merits) for goal, merits in zip(goals, swept, strict=True)]
    places, numbers = ends[0].places, np.arange(count)
    if search.is_front:
        places, numbers = _fronts(goals[0], swept, ends), numbers[:, None]
    found = _reported(goals[0], places, numbers)
    reported = found.pop("status").astype(np.int16)
    if search.is_front:
        reported = np.bitwise_or.reduce(np.where(reported & NO_VALUE, 0, reported), axis=-1)
        found |= {STEEP: found[STEEP].max(axis=-1)} if STEEP in found else {}
    else:
        bounds = [(1 * (place == 0.0) + 2 * (place == 1.0)) << 2 * i for i, place in enumerate(places)]  # low, high
        found[ON_BOUND] = np.bitwise_or.reduce(bounds).astype(np.int8)
    status = np.bitwise_or.reduce([_status_of(reported, *own) for own in zip(ends, swept, strict=True)])
    known = {*study.variables, STEEP}
    shaped = {name: own.reshape((*shape, *own.shape[1:])) for name, own in found.items() if name in known}
    return shaped | {"status": status.reshape(shape)}


@dataclass(frozen=True, kw_only=True, eq=False)
class _Cells:
    """The cells of a block, and one of the goals as a merit of what is searched (`core.answers.optimum.Merit`)."""

    study: Study
    block: Block
    threads: int | None
    goal: int

    @cached_property
    def plain(self) -> Study:
        """The study of the scenes: what is searched is given."""
        study = self.study
        given = {**study.parameters, **{name: one.ends[0] for name, one in study.searched.items()}}
        method = study.method if study.search.require.one_disc else replace(study.method, check_contact=False)
        return replace(study, search=Optimum(), searched={}, parameters=given, method=method)

    @cached_property
    def given(self) -> Arrays:
        """What the study gives of each cell, or of all."""
        shape = shape_of(self.block)
        return {
            name: values.reshape(()) if values.size == 1 else np.broadcast_to(values, shape).ravel()
            for name, values in self.study.parameters_of(self.block).items()
        }

    def at(self, places: Floats, cells: Integers) -> Arrays:
        """Give scenes as a study does: cells, and where they are searched."""
        found = {name: values if values.ndim == 0 else values[cells] for name, values in self.given.items()}
        for (name, one), place in zip(self.study.searched.items(), places, strict=True):
            low, high = one.ends
            inner = low * (high / low) ** place if one.spacing == "log" else low + (high - low) * place
            found[name] = np.where(place == 1.0, high, inner)
        return found

    def all_values(self, places: Floats, cells: Integers) -> Floats:
        """Return the merits by all goals, along a first axis."""
        search = self.study.search
        given = self.at(places, cells)
        found = solve_given(self.plain, given, self.block, self.threads, outputs=search.solved)
        meets = np.ones(np.broadcast_shapes(places.shape[1:], np.shape(cells)), bool)
        for name, least in search.require.minimum.items():
            meets &= found[name] >= least
        for name, most in search.require.maximum.items():
            meets &= found[name] <= most
        if search.require.one_disc:
            meets &= (found["status"] & LOADING_NOT_ONE_DISC) == 0
        goals = [sign * found[goal] for sign, goal in zip(search.signs, search.goals, strict=True)]
        return np.array([np.where(meets | np.isnan(goal), goal, -np.inf) for goal in goals])

    def values(self, places: Floats, cells: Integers) -> Floats:
        """Return the merits by one goal."""
        return np.asarray(self.all_values(places, cells)[self.goal])

    def slopes(self, places: Floats, cells: Integers) -> Floats | None:
        """Return the slopes of merits to the places, where they are known."""
        study, goal = self.study, self.study.search.goals[self.goal]
        name = f"{goal.removesuffix(SI)}_sensitivity"
        if not study.knows_slopes or name not in SENSITIVITIES:
            return None
        given = self.at(places, cells)
        found = solve_given(self.plain, given, self.block, self.threads, outputs=(goal.removesuffix(SI), name))
        slopes = value_slopes(self.plain, given, [*study.searched], goal, found)
        along = []
        for key, one in study.searched.items():
            low, high = one.ends
            reach = given[key] * np.log(high / low) if one.spacing == "log" else high - low
            along.append(np.nan_to_num(study.search.signs[self.goal] * slopes[key] * reach))
        return np.array(np.broadcast_arrays(*along))


def _fronts(cells: _Cells, swept: Floats, ends: Sequence[Optima]) -> Floats:
    """Find the places of the best compromises of each cell: of the sweep and of the optima, padded to the longest."""
    inputs, count = ends[0].places.shape
    axis = axis_of(cells.study.search.resolution)
    grid = axis[np.indices((axis.size,) * inputs).reshape(inputs, -1)]
    fronts = []
    for cell in range(count):
        best = np.stack([end.places[:, cell] for end in ends], axis=1)
        places = np.concatenate([grid, best], axis=1)
        merits = np.concatenate([swept[..., cell].reshape(2, -1), cells.all_values(best, np.array(cell))], axis=1)
        fronts.append(places.take(front(np.where(np.isneginf(merits), np.nan, merits)), axis=1))
    padded = np.full((inputs, count, max(1, *(places.shape[1] for places in fronts))), np.nan)
    for cell, places in enumerate(fronts):
        padded[:, cell, : places.shape[1]] = places
    return padded


def _reported(cells: _Cells, places: Floats, numbers: Integers) -> Arrays:
    """Solve the optima for all that is reported of them."""
    study, given, watch = cells.study, cells.at(places, numbers), cells.study.watches_slope
    slopes = (study.search.slope,) if study.has_slopes else ()
    whole = replace(cells.plain, method=study.method)
    # the outputs of the search as well, so that status says of loading what it said there
    requested = tuple(dict.fromkeys((*study.search.solved, *slopes)))
    found = solve_given(whole, given, cells.block, cells.threads, outputs=requested, watch=watch)
    status = found.pop("status")
    steep = {STEEP: np.broadcast_to(found.pop(STEEP), status.shape)} if watch else {}
    best = {
        BEST + name: np.broadcast_to(own, (*status.shape, *own.shape[status.ndim :])) for name, own in found.items()
    }
    for name in study.searched:
        best[BEST + name] = np.where(np.isnan(places[0]), np.nan, np.broadcast_to(given[name], status.shape))
    return best | steep | {"status": status}


def _status_of(reported: NDArray[np.int16], found: Optima, merits: Floats) -> NDArray[np.int16]:
    """Say of each cell what there is to report of its optimum by one goal, or why it has none."""
    status = reported | np.where(found.too_coarse, RESOLUTION_TOO_COARSE, 0).astype(np.int16)
    some = ~np.isnan(merits.reshape(-1, merits.shape[-1])).all(axis=0)
    none = np.isnan(found.merits)
    return np.where(none, np.where(some, NOTHING_FEASIBLE, NO_VALUE), status).astype(np.int16)
