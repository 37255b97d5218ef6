"""Sensitivities: the sum rules of similarity, and central differences of whole solves."""

from typing import Any

import numpy as np

from gradhesion.core import OUTPUTS, PARAMETERS

from .kinds import COUNTS, EXACT, SCENES, Kind, Scenes, drawn, for_kinds, one_of, powers_of, rng_of, some
from .promises import SENSITIVITY, SHARE, errors, is_sure, phase_of
from .theory import Array

VALUES = ("pull_off_force", "dissipated_energy")
EVERY = for_kinds([kind for kind in EXACT if not kind.unbounded])


def solved(kind: Kind) -> tuple[Scenes, Any, Any, dict[str, dict[str, Array]]]:
    """Scenes, their results, which of them have contact and no tie, and the sensitivities by value and parameter."""
    scenes = some(drawn(kind)[0], slice(SCENES // 2))
    with np.errstate(all="ignore"):
        found = kind.solve(scenes, [*OUTPUTS, *(f"{value}_sensitivity" for value in VALUES)])
    edge = ("closing_ratio", "toughness_wavelength_over_R", "toughness_amplitude")
    names = [*PARAMETERS, *(name for name in scenes if name not in (*PARAMETERS, *edge))]
    names += [name for name in edge if name in scenes]
    slopes = {v: dict(zip(names, np.moveaxis(found[f"{v}_sensitivity"], -1, 0), strict=True)) for v in VALUES}
    return scenes, found, is_sure(found), slopes


def sizes(kind: Kind, scenes: Scenes, found: Any, value: str) -> Array:
    """The sizes of the terms of a value over the value: how a relative promise is to be read where terms cancel."""
    with np.errstate(all="ignore"):
        return np.asarray(1 + errors(kind, scenes, found)[value] / SHARE / np.abs(found[value]))


@EVERY
def test_similarity_and_the_material_are_sum_rules(kind: Kind) -> None:
    """Along the scaling of all lengths a value changes by its power alone; c0 enters through M ~ E* c0^-k alone."""
    scenes, found, sure, slopes = solved(kind)
    powers = powers_of(kind, scenes["k"])
    for value, of in slopes.items():
        scaled = [name for name in of if name in powers]
        total = sum(powers[name] * of[name] for name in scaled)
        size = sizes(kind, scenes, found, value) * (1 + sum(np.abs(of[name]) for name in scaled))
        by_m = of["modulus"] - of.get("machine_stiffness", 0.0)
        assert np.isfinite(total[sure & (found[value] > 0)]).all()  # a loading may gain more than all other jumps lose
        for off in (total - powers[value], of["c0_over_R"] + scenes["k"] * by_m):
            assert np.nanmax((np.abs(off) / size)[sure]) <= SENSITIVITY, (value, np.nanargmax(np.abs(off / size)))


@EVERY
def test_central_differences(kind: Kind) -> None:
    """Fourth order, with a step of a part of the fastest phase; where no count, pull-off or turn steps within it."""
    scenes, found, sure, slopes = solved(kind)
    end = np.nan_to_num(found["turning_radius"])
    h = 3e-3 / (1 + phase_of(kind, scenes, end) + 4 * np.pi * end / scenes.get("toughness_wavelength_over_R", np.inf))
    ratios = [name for name in slopes[VALUES[0]] if name != "closing_ratio"]  # one-sided at 1, a root of it at 0
    checked = 0
    for name in {"A", "k", *rng_of(f"differences {kind.name}").choice(ratios, 3, replace=False)}:
        free, logs = sure.copy(), {}
        if name in ("k", "nu"):
            free &= (scenes["k"] > 0.02) & (scenes["k"] < 0.95) & (scenes["nu"] < 0.49)
        for j in (-2, -1, 1, 2):
            moved = scenes[name] + j * h if name in ("k", "nu") else scenes[name] * np.exp(j * h)
            with np.errstate(all="ignore"):
                values = kind.solve(scenes | {name: moved}, OUTPUTS)
                logs[j] = {value: np.log(values[value]) for value in VALUES}
                free &= is_sure(values)
                free &= np.logical_and.reduce([values[count] == found[count] for count in COUNTS])
                free &= np.abs(values["pull_off_radius"] / found["pull_off_radius"] - 1) < 0.02
                free &= np.abs(values["turning_radius"] / found["turning_radius"] - 1) < 0.1
                at_rim = values["turning_radius"] == (moved if name == "a_max_over_R" else scenes["a_max_over_R"])
                free &= at_rim == (found["turning_radius"] == scenes["a_max_over_R"])
        for value in VALUES:
            slope, size = slopes[value][name], sizes(kind, scenes, found, value)
            with np.errstate(all="ignore"):
                one, two = ((logs[j][value] - logs[-j][value]) / (2 * j * h) for j in (1, 2))
                limit = 4 * SHARE * size / h + np.abs(one - two) + SENSITIVITY * size * (1 + np.abs(slope))
                off = np.where(free, np.abs((4 * one - two) / 3 - slope) / limit, 0.0)
            i = int(np.nanargmax(off))
            assert off[i] <= 1, (value, name, slope[i], one[i], two[i], one_of(scenes, i))
            checked += int(free.sum())
    assert checked > SCENES
