"""A random sample of a dataset's scenes against an independent solver of high precision."""

import math
import random
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import pandas as pd
import xarray

from gradhesion.cli.dataset.joining import study_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import SI, labels_of
from gradhesion.cli.names.scenes import REALISATION, SOLVER
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core import FAILED, PARAMETERS
from gradhesion.core.answers.spectrum import random_profile
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, NO_VALUE
from gradhesion.twin import stated
from gradhesion.twin.shape import Shape

CANDIDATES: Final = 20
"""Scenes that may be drawn for each one of the sample, where some are left out."""
ROWS: Final = 12
"""Deviations that are printed one by one."""
Progress = Callable[[int], AbstractContextManager[Callable[[int], None]]]


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A scene of a dataset."""

    cell: xarray.Dataset
    """What the dataset has of it."""
    solver: str
    parameters: Mapping[str, float]
    place: Mapping[str, float | str]
    """What distinguishes it from others: some of its parameters, its solver, its realisation."""
    shape: Shape
    """Of its punch, and what is prescribed."""


class Deviation(NamedTuple):
    """How far a value is from what it should be; `expected` has 30 digits or says what, both errors are absolute."""

    output: str
    scene: Mapping[str, float | str]
    value: float
    expected: str
    deviation: float = math.inf
    stated: float = 0.0

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
    """Recompute a random sample of a dataset's scenes; DatasetError if none can be, or it is not that of its study."""
    study = study_of(dataset, path)
    if dataset["status"].dtype.kind not in "iu":
        raise DatasetError(f"{path}: its status is no integer; give the dataset as it was before `where`")
    solvers = [str(solver) for solver in np.ravel(dataset[SOLVER].values if SOLVER in dataset else study.method.solver)]
    known = tuple(solver for solver in solvers if solver in stated.SOLVERS)
    if not known or study.rate is not None:
        accepted = f"the solvers {' and '.join(stated.SOLVERS)}, and edges at rest"
        raise DatasetError(f"{path}: has no independent twin; `gradhesion verify` accepts {accepted}")
    dataset = dataset.assign_coords({name: one.compute() for name, one in dataset.coords.items()})  # for all scenes
    if SOLVER in dataset.dims:
        dataset = dataset.isel({SOLVER: np.flatnonzero(np.isin(solvers, known))})
    outputs = [name for name in study.outputs if name in stated.KNOWN]
    unknown = [name for name in (*study.outputs, *study.spreads) if name not in outputs]
    found = Recomputed(
        seed=random.SystemRandom().randrange(10**6) if seed is None else seed,
        total=dataset["status"].size,
        solvers=known,
        unknown=(*unknown, *(f"all of the solver {solver}" for solver in solvers if solver not in known)),
    )
    scenes = _drawn(dataset, study, outputs, sample, found)
    scenes.sort(key=lambda scene: scene.parameters["k"])  # scenes of one exponent share what is known of it
    with progress(len(scenes)) as advance:
        for scene in scenes:
            found.deviations += _compared(scene, outputs, found)
            advance(1)
    if not found.deviations:
        reasons = f"{found.beyond} have too many waves, {found.failed} no value, {found.unsure} two folds that meet"
        more = "draw more with --sample" if found.beyond + found.failed < found.total else "there are no others"
        raise DatasetError(f"{path}: none of the scenes drawn can be recomputed ({reasons}); {more}")
    found.deviations.sort(key=lambda one: (-one.share, -one.deviation))
    return found


def _drawn(dataset: xarray.Dataset, study: Study, outputs: list[str], sample: int, found: Recomputed) -> list[Scene]:
    """Draw scenes until `sample` of them have values that can be recomputed."""
    sizes = dataset["status"].sizes
    scenes: list[Scene] = []
    for candidate in random.Random(found.seed).sample(range(found.total), min(found.total, CANDIDATES * sample)):
        if len(scenes) == sample:
            break
        cell = dataset.isel(dict(zip(sizes, np.unravel_index(candidate, [*sizes.values()]), strict=True)))
        scene = _scene(cell, study, found.solvers[0])
        status = int(cell["status"])
        if status & FAILED:
            found.failed += 1
            for name in study.variables if status & NO_VALUE else ():
                value = math.nan if labels_of(name) else float(cell[name])
                if not (math.isnan(value) or (name.endswith("_jumps") and value == -1.0)):
                    found.deviations.append(Deviation(name, scene.place, value, "none, by its status"))
        elif missing := [name for name in PARAMETERS if math.isnan(scene.parameters[name])]:
            found.deviations += [Deviation(name, scene.place, math.nan, "a value, by its status") for name in missing]
        else:
            within = True
            with suppress(ArithmeticError):  # which says so again when it is solved
                within = stated.within_reach(scene.parameters, outputs, scene.solver, scene.shape)
            scenes += [scene] if within else []
            found.beyond += not within
    return scenes


def _scene(cell: xarray.Dataset, study: Study, solver: str) -> Scene:
    """Describe the scene of a cell; `solver` is that of a dataset with no other."""
    parameters = {name: float(cell[name]) for name in (*study.parameters, *study.made)}
    place: dict[str, float | str] = {}
    if SOLVER in cell.coords:
        place[SOLVER] = solver = str(cell[SOLVER].item())
    place |= {name: parameters[name] for name, values in study.parameters.items() if isinstance(values, np.ndarray)}
    profile = study.profile
    if study.spectrum is not None:
        place[REALISATION] = number = int(cell[REALISATION])
        profile = random_profile(study.spectrum, number, profile.exponent)
    pattern = () if study.toughness is None else study.toughness.harmonics
    shape = Shape(
        profile.exponent,
        tuple((wave.n, wave.cos, wave.sin) for wave in profile.harmonics),
        study.loading.control,
        tuple((wave.n, wave.cos, wave.sin) for wave in pattern if wave.cos != 0.0 or wave.sin != 0.0),
        "toughness" if study.toughness is None else study.toughness.of,
    )
    return Scene(cell=cell, solver=solver, parameters=parameters, place=place, shape=shape)


def _compared(scene: Scene, outputs: list[str], found: Recomputed) -> Iterator[Deviation]:
    """Recompute one scene and compare."""
    try:
        expected = stated.expected(scene.parameters, outputs, scene.solver, scene.shape)
    except ArithmeticError:
        found.unsure += 1
        return
    if "R" in scene.parameters:
        expected |= stated.in_si(expected, scene.parameters)
    found.scenes += 1
    flagged = bool(int(scene.cell["status"]) & CLOSE_TO_A_JUMP)
    for name, one in expected.items():
        value = float(scene.cell[name])
        error = one.error
        if f"{name}_error" in scene.cell:  # of this very value; the last bit of a double is nobody's error
            error = float(scene.cell[f"{name}_error"]) + 2.0**-52 * abs(value)
        deviation = stated.deviation(value, one)
        near = one.near or ("its status says so" if flagged and name.removesuffix(SI) in stated.BY_STEPS else "")
        if near and deviation > error:
            found.near[f"{name}: {near}"] = found.near.get(f"{name}: {near}", 0) + 1
            continue
        yield Deviation(name, scene.place, value, str(one), deviation, error)


def in_words(found: Recomputed, title: str, file: Path) -> Iterator[str]:
    """Report what was found, line by line: the deviations, the worst first, what was left out, and the verdict."""
    every = found.deviations
    columns = ["output", "deviation", "stated", "share"]
    table = pd.DataFrame([[getattr(one, name) for name in columns] for one in every], columns=columns)
    places = [
        ", ".join(f"{name} = {value if isinstance(value, str) else f'{value:g}'}" for name, value in one.scene.items())
        for one in every[:ROWS]
    ]
    of_each = table.groupby("output", sort=False).first()
    of_each["values"] = table["output"].value_counts()
    yield title
    drawn = f"{found.scenes:,} of {counted(found.total, 'scene')} recomputed (--seed {found.seed})"
    yield f"{file}: {drawn}, {counted(len(every), 'value')}, solver {' and '.join(found.solvers)}"
    for words, rows in (("worst first", table.head(ROWS).assign(scene=places)), ("of each", of_each.reset_index())):
        yield from ("", words, *rows.to_string(index=False, float_format="{:.2g}".format).splitlines())
    reasons = [
        (found.beyond, "sampled scenes have more waves than can be followed; others were drawn instead"),
        (found.failed, "sampled scenes have failed, as their status shows"),
        (found.unsure, "scenes lie too close to where two folds meet, or too far out, for 51 digits"),
        *((count, f"values may be either of two ({reason})") for reason, count in found.near.items()),
    ]
    written = [f"  {count:,} {reason}" for count, reason in reasons if count]
    if found.unknown:
        written.append(f"  {', '.join(found.unknown)}: there is no independent solution to compare with")
    yield from ("", "left out", *written, "") if written else ("",)
    exceeding = f"{found.exceeding:,} of {counted(len(every), 'value')} deviate by more than their stated errors"
    yield exceeding if found.exceeding else f"all {len(every):,} values are within their stated errors"
