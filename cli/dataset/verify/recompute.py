"""A random sample of a dataset's scenes against an independent solver of high precision."""

import math
import random
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.verify.belonging import study_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import SI, labels_of
from gradhesion.cli.names.scenes import REALISATION, SOLVER
from gradhesion.cli.study.study import Method, Study
from gradhesion.core import FAILED, PARAMETERS
from gradhesion.core.answers.spectrum import random_profile
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, NO_VALUE
from gradhesion.twin import stated
from gradhesion.twin.general import Shape

CANDIDATES: Final = 20
"""Scenes that may be drawn for each one of the sample, where some are left out."""

Progress = Callable[[int], AbstractContextManager[Callable[[int], None]]]


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A cell of a dataset: where it is, its solver, its parameters, and those of them that distinguish it."""

    index: Mapping[str, int]
    """Its place along each axis, in whatever order the dataset has them."""
    solver: str
    parameters: Mapping[str, float]
    place: Mapping[str, float | str]
    realisation: int = 0
    """Which punch of random roughness."""


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """How far a value is from what it should be; `expected` has 30 digits, both errors are absolute."""

    output: str
    scene: Mapping[str, float | str]
    value: float
    expected: str
    deviation: float
    stated: float

    @property
    def share(self) -> float:
        """The deviation over the stated error."""
        if self.stated > 0.0:
            return self.deviation / self.stated
        return 0.0 if self.deviation == 0.0 else math.inf


@dataclass(kw_only=True)
class Recomputed:
    """What was found: the deviations, the worst first, and what was left out."""

    seed: int
    total: int
    solvers: tuple[str, ...]
    scenes: int = 0
    deviations: list[Deviation] = field(default_factory=list)
    failed: int = 0
    beyond: int = 0
    unsure: int = 0
    near: dict[str, int] = field(default_factory=dict)
    unknown: tuple[str, ...] = ()

    @property
    def exceeding(self) -> int:
        """The number of values that deviate by more than their stated error."""
        return sum(one.share > 1.0 for one in self.deviations)


def recompute(dataset: xarray.Dataset, path: Path, *, sample: int, seed: int | None, progress: Progress) -> Recomputed:
    """
    Recompute a random sample of a dataset's scenes.

    Raises
    ------
    DatasetError
        The dataset and its study do not belong together, it is none that can be recomputed, or no scene of it can.
    """
    study = study_of(dataset, path)
    if dataset["status"].dtype.kind not in "iu":
        raise DatasetError(
            f"{path}: its status does not consist of integers; give the dataset as it was before `where`"
        )
    solvers = study.method.solver
    requested = (solvers,) if isinstance(solvers, str) else solvers
    known = tuple(solver for solver in requested if solver in stated.SOLVERS)
    if not known:
        raise DatasetError(
            f"{path}: made with the solver {' and '.join(requested)}, an approximation without an independent twin; "
            f"`gradhesion verify` accepts {' and '.join(stated.SOLVERS)}"
        )
    if study.method != Method(solver=solvers, check_contact=study.method.check_contact):  # that changes no value
        raise DatasetError(f"{path}: its study has settings that `gradhesion verify` cannot recompute")
    if study.rate is not None:
        raise DatasetError(
            f"{path}: edges with a speed have no independent twin; `gradhesion verify` accepts only those at rest"
        )
    if seed is None:
        seed = random.SystemRandom().randrange(10**6)
    found = Recomputed(seed=seed, total=study.scenes // len(requested) * len(known), solvers=known)
    outputs = [name for name in study.outputs if name in stated.KNOWN]
    found.unknown = (
        *(name for name in study.outputs if name not in outputs and not name.endswith("_error")),
        *(f"all of the solver {solver}" for solver in requested if solver not in known),
    )
    scenes = _drawn(dataset, study, outputs, sample, found)
    scenes.sort(key=lambda scene: scene.parameters["k"])  # scenes of one exponent share what is known of it
    with progress(len(scenes)) as advance:
        for scene in scenes:
            found.deviations += _compared(dataset, scene, shape_of(study, scene.realisation), outputs, found)
            advance(1)
    if not found.deviations:
        raise DatasetError(
            f"{path}: none of the scenes drawn can be recomputed ({found.beyond} have too many waves, {found.failed} "
            f"no value, {found.unsure} lie too close to where two folds meet); draw more with --sample"
        )
    found.deviations.sort(key=lambda one: (-one.share, -one.deviation))
    return found


def shape_of(study: Study, realisation: int = 0) -> Shape:
    """Give the reference solver the shape of the punch, and what is prescribed."""
    drawn = study.spectrum
    profile = study.profile if drawn is None else random_profile(drawn, realisation, study.profile.exponent)
    harmonics = tuple((wave.n, wave.cos, wave.sin) for wave in profile.harmonics)
    pattern = () if study.toughness is None else study.toughness.harmonics
    waves = tuple((wave.n, wave.cos, wave.sin) for wave in pattern if wave.cos != 0.0 or wave.sin != 0.0)
    of = "toughness" if study.toughness is None else study.toughness.of
    return Shape(study.profile.exponent, harmonics, study.loading.control, waves, of)


def _drawn(
    dataset: xarray.Dataset, study: Study, outputs: Collection[str], sample: int, found: Recomputed
) -> list[Scene]:
    """Draw scenes until `sample` of them have values that can be recomputed."""
    coordinates = {name: dataset[name].values for name in study.parameters}
    scenes: list[Scene] = []
    candidates = random.Random(found.seed).sample(range(found.total), min(found.total, CANDIDATES * sample))
    for candidate in candidates:
        if len(scenes) == sample:
            break
        scene = _scene(dataset, study, coordinates, candidate, found.solvers)
        status = int(dataset["status"][scene.index])
        if status & FAILED:
            found.failed += 1
            if status & NO_VALUE:
                found.deviations += _without_value(dataset, scene, study.variables)
        elif missing := [name for name in PARAMETERS if math.isnan(scene.parameters[name])]:
            found.deviations += [_unlike(scene, name, math.nan, "a value, by its status") for name in missing]
        elif _is_within_reach(scene, shape_of(study, scene.realisation), outputs):
            scenes.append(scene)
        else:
            found.beyond += 1
    return scenes


def _is_within_reach(scene: Scene, shape: Shape, outputs: Collection[str]) -> bool:
    try:
        return stated.within_reach(scene.parameters, outputs, scene.solver, shape)
    except ArithmeticError:  # which says so again when it is solved
        return True


def _scene(
    dataset: xarray.Dataset,
    study: Study,
    coordinates: Mapping[str, NDArray[np.float64]],
    candidate: int,
    known: tuple[str, ...],
) -> Scene:
    """Find the cell of a number below that of all scenes of the known solvers."""
    of_punch, realisation = divmod(candidate, study.sizes.get(REALISATION, 1))
    which, rest = divmod(of_punch, math.prod(study.axes.values()))
    index: tuple[Any, ...] = np.unravel_index(rest, tuple(study.axes.values()))
    along = dict(zip(study.axes, index, strict=True))
    if study.layout == "points":
        parameters = {name: float(values[index]) for name, values in coordinates.items()}
    else:
        parameters = {
            name: float(values[along[name]] if name in along else values) for name, values in coordinates.items()
        }
    place: dict[str, float | str] = {
        name: value for name, value in parameters.items() if isinstance(study.parameters[name], np.ndarray)
    }
    for name in study.made:
        own = {axis: at for axis, at in along.items() if axis in dataset[name].dims}
        parameters[name] = float(dataset[name].isel(own))
    if SOLVER in study.sizes:
        place = {SOLVER: known[which], **place}
        index = (study.method.solver.index(known[which]), *index)
    if REALISATION in study.sizes:
        place, index = {**place, REALISATION: realisation}, (*index, realisation)
    places = dict(zip(study.sizes, map(int, index), strict=True))
    return Scene(index=places, solver=known[which], parameters=parameters, place=place, realisation=realisation)


def _without_value(dataset: xarray.Dataset, scene: Scene, outputs: Collection[str]) -> Iterator[Deviation]:
    """Check that a scene without values has none."""
    for name in outputs:
        if labels_of(name):
            continue
        value = float(dataset[name][scene.index])
        if not (math.isnan(value) or (name.endswith("_jumps") and value == -1.0)):
            yield _unlike(scene, name, value, "none, by its status")


def _unlike(scene: Scene, output: str, value: float, expected: str) -> Deviation:
    """Make a deviation that has no size."""
    return Deviation(output=output, scene=scene.place, value=value, expected=expected, deviation=math.inf, stated=0.0)


def _compared(
    dataset: xarray.Dataset, scene: Scene, shape: Shape, outputs: Collection[str], found: Recomputed
) -> Iterator[Deviation]:
    """Recompute one scene and compare."""
    try:
        expected = stated.expected(scene.parameters, outputs, scene.solver, shape)
    except ArithmeticError:
        found.unsure += 1
        return
    if "R" in scene.parameters:
        expected |= stated.in_si(expected, scene.parameters)
    found.scenes += 1
    flagged = bool(int(dataset["status"][scene.index]) & CLOSE_TO_A_JUMP)
    for name, one in expected.items():
        value = scene.parameters[name] if name in scene.parameters else float(dataset[name][scene.index])
        error = one.error
        if f"{name}_error" in dataset.data_vars:  # of this very value; the last bit of a double is nobody's error
            error = float(dataset[f"{name}_error"][scene.index]) + 2.0**-52 * abs(value)
        deviation = stated.deviation(value, one)
        near = one.near or ("its status says so" if flagged and name.removesuffix(SI) in stated.BY_STEPS else "")
        if near and deviation > error:
            found.near[f"{name}: {near}"] = found.near.get(f"{name}: {near}", 0) + 1
            continue
        yield Deviation(
            output=name, scene=scene.place, value=value, expected=str(one), deviation=deviation, stated=error
        )
