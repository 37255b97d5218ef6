"""Cycles of hundreds to a hundred thousand waves, which are summed, against those that are walked and exact relations."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES

OUTPUTS = ("pull_off_force", "pull_off_radius", "dissipated_energy", "loading_energy", "unloading_energy")
DEPTHS = ("delta_max", "delta_jump_out", "turning_radius", "snap_in_force")
COUNTS = ("loading_jumps", "unloading_jumps")
PROFILES = {
    "one cosine": Profile(),
    "asymmetric": Profile(harmonics=(Harmonic(n=1, cos=1.0, sin=0.3), Harmonic(n=2, cos=0.4, sin=-0.2))),
    "steep between": Profile(harmonics=(Harmonic(n=1, cos=0.2, sin=0.0), Harmonic(n=4, cos=0.5, sin=0.2))),
    "exponent 1.5": Profile(exponent=1.5),
    "cubic": Profile(exponent=3.0, harmonics=(Harmonic(n=1, cos=1.0, sin=0.0), Harmonic(n=3, cos=0.2, sin=0.2))),
}
CONTROLS = {"displacement": {}, "load": {}, "machine": {"machine_stiffness": 0.4}}


def scenes(waves: Any, k: float = 0.3, A: Any = 0.02) -> dict[str, Any]:
    """Scenes whose rim, at 0.6 R, has that many waves."""
    scene = {"k": k, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.1, "a_max_over_R": 0.6}
    return scene | {"lambda_over_R": 0.6 / np.asarray(waves, dtype=float), "A": A}


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("profile", PROFILES.values(), ids=PROFILES)
def test_summed_waves_lose_what_walked_ones_do(profile: Profile, control: str) -> None:
    """The loop integral is known of walked waves alone: where it is asked for, nothing is summed up to 2,000 waves."""
    scene = scenes([650.3, 1171.9, 1702.6], A=np.array([0.006, 0.02, 0.06])[:, None]) | CONTROLS[control]
    names, how = (*OUTPUTS, *DEPTHS), {"profile": profile, "loading": Loading(control=control)}
    summed = solve(scene, [*names, *COUNTS], **how)
    if control == "load":  # which has no loop: a limit of machines
        scene, how = scene | {"machine_stiffness": 1e-13}, {"profile": profile, "loading": Loading(control="machine")}
        names = ("pull_off_force", "pull_off_radius", "loading_energy", "delta_max", "turning_radius")
    walked = solve(scene, [*names, *COUNTS, "energy_residual"], **how)
    assert np.isfinite(walked["energy_residual"]).all()
    for name in COUNTS:
        np.testing.assert_array_equal(summed[name], walked[name], name)
    size = np.abs(summed["loading_energy"]) + np.abs(summed["unloading_energy"])
    for name in names:
        scale = size if "energy" in name else np.abs(summed[name]) + (1e-3 if "delta" in name else 0.0)
        np.testing.assert_array_less(np.abs(summed[name] - walked[name]), 2e-12 * scale, name)


def test_beyond_what_is_walked_there_is_no_loop_integral() -> None:
    found = solve(scenes(2500.0), ["energy_residual", "dissipated_energy"])
    assert np.isnan(found["energy_residual"])
    assert found["dissipated_energy"] > 0.0


@pytest.mark.parametrize("control", ["displacement", "machine"])
@pytest.mark.parametrize("turn", [{"load_max": 30.0}, {"indentation_max_over_R": 0.21}])
def test_a_cycle_that_turns_is_that_of_a_rim_there(turn: dict[str, float], control: str) -> None:
    scene = scenes([1.1e3, 1.3e4, 0.9e5]) | CONTROLS[control] | {"a_max_over_R": 2.0}
    how = {"loading": Loading(control=control)}
    found = solve(scene | turn, [*OUTPUTS, *COUNTS, "turning_radius", "delta_jump_out"], **how)
    radius = found.pop("turning_radius")
    assert ((radius > 0.1) & (radius < 2.0)).all()
    at_rim = solve(scene | {"a_max_over_R": radius}, list(found)[:-1], **how)
    for name in (*OUTPUTS, "delta_jump_out"):
        np.testing.assert_allclose(found[name], at_rim[name], 1e-10, err_msg=name)
    for name in COUNTS:
        assert (np.abs(found[name] - at_rim[name]) <= 1).all()


def test_two_works_are_two_cycles() -> None:
    """Loading is that at a modulus over the ratio, unloading that of equal works, and the front loses the rest."""
    scene, ratio = scenes([900.0, 2.2e4]), 0.37
    names = ["loading_energy", "unloading_energy", "front_energy", "loading_jumps", "unloading_jumps"]
    found = solve(scene | {"closing_ratio": ratio}, names)
    closing = solve(scene | {"modulus": 500.0 / ratio}, names[:2] + names[3:])
    opening = solve(scene, names[:2] + names[3:])
    np.testing.assert_allclose(found["loading_energy"], ratio * closing["loading_energy"], 1e-11)
    np.testing.assert_allclose(found["unloading_energy"], opening["unloading_energy"], 1e-11)
    np.testing.assert_allclose(found["front_energy"], math.pi * 0.6**2 * (1.0 - ratio), 1e-13)
    np.testing.assert_array_equal(found["loading_jumps"], closing["loading_jumps"])
    np.testing.assert_array_equal(found["unloading_jumps"], opening["unloading_jumps"])


@pytest.mark.parametrize("solver", ["exact", "asymptotic"])
def test_fine_waves_pull_like_their_envelope(solver: str) -> None:
    """(3+k)/3 (1 + chi)^2 at fixed chi, from above, by the mean height of the waves: as lambda (physics 10)."""
    k = 0.3
    scene = scenes([2e3, 2e4, 2e5], k=k)
    scene |= {"A": 0.002 * (0.6 / 2e3 / scene["lambda_over_R"]) ** (0.5 * (1.0 + k))}
    chi = solve(scene, ["roughness_parameter"])["roughness_parameter"]
    force = solve(scene, ["pull_off_force"], solver=solver)["pull_off_force"]
    off = force / ((3.0 + k) / 3.0 * (1.0 + chi) ** 2) - 1.0
    assert (np.abs(off) < [1e-2, 1e-3, 1e-4]).all()


def test_more_than_a_million_waves_have_no_value() -> None:
    found = solve(scenes([0.9e6, 1.2e6]), [*OUTPUTS, *COUNTS])
    assert np.isfinite(found["dissipated_energy"][0])
    assert np.isnan(found["dissipated_energy"][1])
    assert found["loading_jumps"][1] == -1
    np.testing.assert_array_equal(found["status"] & (NO_VALUE | TOO_MANY_WAVES), [0, NO_VALUE | TOO_MANY_WAVES])


def test_the_last_fold_is_known_whatever_the_rim() -> None:
    """Beyond it a rim changes nothing."""
    scene = scenes(3e3, A=0.004)
    names = ["saturation_radius", "dissipated_energy"]
    found = solve(scene | {"a_max_over_R": np.array([0.01, 0.6, 50.0, math.inf])}, names)
    radius = found["saturation_radius"][0]
    np.testing.assert_allclose(found["saturation_radius"], radius, 1e-12)
    ends = solve(scene | {"a_max_over_R": radius * np.array([0.9, 1.0001])}, ["dissipated_energy"])
    np.testing.assert_allclose(ends["dissipated_energy"][1], found["dissipated_energy"][3], 1e-11)
    assert ends["dissipated_energy"][0] < found["dissipated_energy"][3]


def test_values_do_not_depend_on_neighbours() -> None:
    scene = scenes(10.0 ** np.linspace(2.9, 5.0, 12), A=0.01)
    names = [*OUTPUTS, "delta_max", *COUNTS]
    together = solve(scene, names)
    for i in (0, 5, 11):
        alone = solve(scene | {"lambda_over_R": scene["lambda_over_R"][i]}, names)
        for name in names:
            np.testing.assert_array_equal(alone[name], together[name][i], name)
