"""Values that were computed once with 30 digits, or by two other ways: no seed changes them."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS, solve
from tests.core.scene import pattern_of

from .kinds import DEPTH, LOAD, ONE, Kind, Scenes
from .promises import SENSITIVITY, agree

REFERENCE = Path(__file__).parents[1] / "reference"
KEYS = {"c0": "c0_over_R", "lam": "lambda_over_R", "ratio": "closing_ratio", "S": "machine_stiffness"}
KEYS |= {"turn": DEPTH, "turn_load": LOAD, "end": "a_max_over_R", "k": "k", "nu": "nu", "modulus": "modulus", "A": "A"}


def stored(name: str) -> Any:
    return json.loads((REFERENCE / f"{name}.json").read_text(encoding="utf-8"))


def arrays(scenes: list[dict[str, Any]]) -> Scenes:
    return {name: np.array([float(scene[name]) for scene in scenes]) for name in scenes[0]}


def agrees_with_stored(kind: Kind, scenes: Scenes, expected: Scenes, **how: Any) -> None:
    """Solve scenes and compare them with the values that are stored of them: within the promise once, for these are exact."""
    found = solve(scenes, kind.outputs, **(kind.how | how))
    names = [name for name in kind.outputs if name in expected]
    assert len(names) > 3
    agree(kind, scenes, found, found | expected, names, times=1.0)


def test_60_cosines() -> None:
    scenes = stored("scenes")["scenes"]
    expected = arrays([scene["expected"] for scene in scenes])
    agrees_with_stored(Kind("stored"), arrays([scene["parameters"] for scene in scenes]), expected)


@pytest.mark.parametrize("scene", stored("general")["scenes"], ids=range(24))
def test_profiles_and_controls(scene: dict[str, Any]) -> None:
    given = dict(scene["parameters"])
    waves = tuple((wave["n"], wave["cos"], wave["sin"]) for wave in given.pop("harmonics"))
    kind = Kind("stored", exponent=given.pop("exponent"), waves=waves, control=given.pop("control"))
    agrees_with_stored(kind, arrays([given]), arrays([scene["expected"]]))


@pytest.mark.parametrize("value", ["pull_off_force", "dissipated_energy"])
def test_sensitivities(value: str) -> None:
    """The stored ones are themselves good to 1e-9, those by k to 1e-8."""
    scenes = stored("sensitivities")
    found = solve(arrays([scene["input"] for scene in scenes]), [f"{value}_sensitivity"])[f"{value}_sensitivity"]
    expected = np.array([[scene[value][name] for name in PARAMETERS] for scene in scenes])
    assert (np.abs(found - expected) <= (SENSITIVITY + 1e-8) * (1 + np.abs(expected))).all()


CASES = [(group, name) for group in ("works", "patterns") for name in stored("moving_edge")[group]]


@pytest.mark.parametrize(("group", "name"), CASES, ids=[name for _, name in CASES])
def test_two_works_and_patterns(group: str, name: str) -> None:
    case = stored("moving_edge")[group][name]
    given, result = case["input"], case["result"]
    scene: dict[str, Any] = {"a_max_over_R": math.inf} | {KEYS[key]: given[key] for key in given if key in KEYS}
    waves = tuple((int(n), even, odd) for n, even, odd in given["series"]) if "series" in given else ONE
    control = "machine" if "S" in given else "load" if given.get("load") else "displacement"
    turn = DEPTH if "turn" in given else LOAD if "turn_load" in given else ""
    how: dict[str, Any] = {}
    for of, key in (("toughness", "toughness"), ("work", "works")):
        for n, even, odd, wavelength in given.get(key, ()):
            how["toughness"] = pattern_of(of, (n, even, odd))
            scene |= {"toughness_wavelength_over_R": wavelength, "toughness_amplitude": 1.0}
    kind = Kind("stored", float(given.get("m", 2.0)), waves, control, turn, "ratio" in given)
    values = {key: np.array([np.nan if value is None else float(value)]) for key, value in result.items()}
    agrees_with_stored(kind, arrays([scene]), values, **how)


def test_the_steps_of_the_sum_over_many_punches_on_one_plate() -> None:
    """Each step in depth at which loading loses more is stored with the energies on both sides."""
    case = stored("moving_edge")["plate"]
    base = {name: float(value) for name, value in case["base"].items()}
    depth, before, after = np.array(case["steps"]).T
    found = solve(base | {DEPTH: np.concatenate([depth - 1e-6, depth + 1e-6])}, ["dissipated_energy"])
    np.testing.assert_allclose(found["dissipated_energy"], np.concatenate([before, after]), rtol=1e-11)


ROUGH = ((1, 0.5256813568663443, 0.33329100650643), (2, -0.7718687889912584, -1.6313131794236955))
OTHERS = [
    pytest.param(Kind(waves=(*ROUGH, (3, -0.6062622993243558, -0.3368594067365812))), [0.0, 0.3, 272.6285627172757, 0.03702579865172199, 0.3577329844002347, 0.021389499543939563, 0.6257603035931136],
                 {"unloading_energy": 0.964779886646169, "energy_residual": 0.0}, id="a rough series that loses much on unloading"),
    pytest.param(Kind(turn=LOAD), [1.0, 0.5, 1450.8610002823204, 0.6480129811209651, 0.4865190784591345, 0.09693642947498178, 0.4573723130551461],
                 {"pull_off_force": 6.24870569780131}, id="a trough close to the rim of a turned cycle"),
    pytest.param(Kind(exponent=1.5, solver="asymptotic"), [0.1, -0.14948324019929654, 1797.6287307914445, 0.019586376145827922, 0.1606546729216172, 0.05713366846748247, 0.24396449978013468],
                 {"dissipated_energy": 0.0697955996225522, "loading_energy": 0.02814897197698235}, id="short waves of a power"),
    pytest.param(Kind(exponent=1.0, waves=((1, 1.0, 0.5),), solver="asymptotic"), [1.0, 0.5, 114.54403694634479, 0.05249341923986221, 0.9071833220759363, 0.008083235579520901, math.inf],
                 {"dissipated_energy": 0.0027090523327527216}, id="short waves of a cone"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "values", "expected"), OTHERS)
def test_values_that_were_confirmed_by_integrals(kind: Kind, values: Any, expected: dict[str, float]) -> None:
    """Of loops, or by quadrature of each jump; 1e-11: the digits are those of a solver."""
    scene = dict(zip(PARAMETERS, values, strict=True)) | ({LOAD: 25.767153602798} if kind.turn else {})
    found = kind.solve(scene, list(expected))
    for output, value in expected.items():
        assert float(found[output]) == pytest.approx(value, rel=1e-11, abs=0.0 if value else 1e-11)
