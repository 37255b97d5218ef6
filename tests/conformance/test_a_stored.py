"""Values that were computed once with 30 digits, or by two other ways: no seed changes them."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS, solve
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

from .kinds import DEPTH, LOAD, ONE, Kind, Scenes, at
from .promises import SENSITIVITY, agree

REFERENCE = Path(__file__).parents[1] / "reference"
KEYS = {"c0": "c0_over_R", "lam": "lambda_over_R", "ratio": "closing_ratio", "S": "machine_stiffness"}
KEYS |= {"turn": DEPTH, "turn_load": LOAD, "end": "a_max_over_R", "k": "k", "nu": "nu", "modulus": "modulus", "A": "A"}


def stored(name: str) -> Any:
    """Read one of the files of values."""
    return json.loads((REFERENCE / f"{name}.json").read_text(encoding="utf-8"))


def arrays(scenes: list[dict[str, Any]]) -> Scenes:
    """Turn scenes into an array for each parameter or value; what is missing is NaN."""
    names = dict.fromkeys(name for scene in scenes for name in scene)
    return {name: np.array([float(scene.get(name) or 0.0) for scene in scenes]) for name in names}


def agrees_where_given(kind: Kind, scenes: Scenes, expected: Scenes, **more: Any) -> None:
    """Solve scenes and compare them with the stored values that the kind has; the promise once: these are exact."""
    found = kind.solve(scenes)
    agree(kind, scenes, found, dict(found) | expected, [n for n in kind.outputs if n in expected], times=1.0, **more)


def test_60_cosines() -> None:
    scenes = stored("scenes")["scenes"]
    parameters = arrays([scene["parameters"] for scene in scenes])
    agrees_where_given(Kind("stored"), parameters, arrays([scene["expected"] for scene in scenes]))


def test_the_same_values_follow_from_m() -> None:
    """M = theta E*/c0^k: a homogeneous material has it as its modulus, so it needs neither c0 nor nu."""
    scenes = [scene for scene in stored("scenes")["scenes"] if scene["parameters"]["k"] == 0.0]
    assert scenes
    parameters = arrays([scene["parameters"] for scene in scenes])
    parameters |= {"modulus": np.array([s["expected"]["M"] for s in scenes]), "c0_over_R": 3.7, "nu": -0.4}
    parameters = {name: np.broadcast_to(values, len(scenes)) for name, values in parameters.items()}
    agrees_where_given(Kind("stored"), parameters, arrays([scene["expected"] for scene in scenes]))


@pytest.mark.parametrize("number", range(24))
def test_profiles_and_controls(number: int) -> None:
    scene = stored("general")["scenes"][number]
    given = dict(scene["parameters"])
    waves = tuple((wave["n"], wave["cos"], wave["sin"]) for wave in given.pop("harmonics"))
    kind = Kind("stored", exponent=given.pop("exponent"), waves=waves, control=given.pop("control"))
    agrees_where_given(kind, arrays([given]), arrays([scene["expected"]]))


@pytest.mark.parametrize("value", ["pull_off_force", "dissipated_energy"])
def test_sensitivities(value: str) -> None:
    scenes = stored("sensitivities")
    found = solve(arrays([scene["input"] for scene in scenes]), [f"{value}_sensitivity"])[f"{value}_sensitivity"]
    for i, name in enumerate(PARAMETERS):
        expected = np.array([scene[value][name] for scene in scenes])
        # the stored ones are themselves good to 1e-9, those by k to 1e-8
        limit = (SENSITIVITY + 1e-8) * (1 + np.abs(expected))
        assert (np.abs(found[:, i] - expected) <= limit).all(), (name, np.abs(found[:, i] - expected).max())


def edge_case(case: dict[str, Any]) -> tuple[Kind, Scenes, dict[str, Any]]:
    """Return the kind of a stored cycle of a moving edge, its scene, and its pattern of toughness."""
    given = {KEYS[name]: value for name, value in case.items() if name in KEYS}
    scene: dict[str, Any] = {"a_max_over_R": math.inf} | given
    control = "machine" if "S" in case else "load" if case.get("load") else "displacement"
    waves = tuple((int(n), even, odd) for n, even, odd in case["series"]) if "series" in case else ONE
    turn = DEPTH if "turn" in case else LOAD if "turn_load" in case else ""
    kind = Kind("stored", float(case.get("m", 2.0)), waves, control, turn, ratio="ratio" in case)
    how: dict[str, Any] = {}
    for of, name in (("toughness", "toughness"), ("work", "works")):
        if name in case:
            ((n, even, odd, wavelength),) = case[name]
            how["toughness"] = Toughness((ToughnessHarmonic(n=n, cos=even, sin=odd),), of=of)
            scene |= {"toughness_wavelength_over_R": wavelength, "toughness_amplitude": 1.0}
            kind = at(kind, pattern=of)
    return kind, arrays([scene]), how


EDGES = [(group, name) for group in ("works", "patterns") for name in stored("moving_edge")[group]]


@pytest.mark.parametrize(("group", "name"), EDGES, ids=[name for _, name in EDGES])
def test_two_works_and_patterns(group: str, name: str) -> None:
    case = stored("moving_edge")[group][name]
    kind, scenes, how = edge_case(case["input"])
    found = solve(scenes, kind.outputs, **(kind.how | how))
    values = {n: np.array([np.nan if v is None else float(v)]) for n, v in case["result"].items() if n in kind.outputs}
    assert len(values) > 10
    agree(kind, scenes, found, dict(found) | values, values, times=1.0)


@pytest.mark.parametrize("name", ["k0", "k03", "smooth"])
def test_an_edge_with_a_speed(name: str) -> None:
    """1e-10: two formulations of the same differential equation agree to 1e-12 in the force, 1e-11 in the energy."""
    case = stored("moving_edge")["rate"][name]
    _, scenes, _ = edge_case(case["input"])
    speed = {"speed_over_reference": np.array([one["eps"] for one in case["cases"]])}
    for exponent in {one["n"] for one in case["cases"]}:
        found = solve(scenes | speed, ["pull_off_force", "dissipated_energy"], rate=Rate(exponent=exponent))
        for i, one in enumerate(case["cases"]):
            if one["n"] == exponent:
                assert float(found["pull_off_force"][i]) == pytest.approx(one["pull_off_force"], rel=1e-10)
                assert float(found["dissipated_energy"][i]) == pytest.approx(one["dissipated_energy"], rel=1e-10)


def test_the_sum_over_many_punches_on_one_plate() -> None:
    """The energy of a patch is a sum over the depths at which loading steps: each step is a stored number."""
    case = stored("moving_edge")["plate"]
    base = {name: float(value) for name, value in case["base"].items()}
    for depth, before, after in case["steps"]:
        for offset, expected in ((-1e-6, before), (1e-6, after)):
            found = solve(base | {DEPTH: depth + offset}, ["dissipated_energy"])["dissipated_energy"]
            assert float(found) == pytest.approx(expected, rel=1e-11)


QUOTED: Scenes = {"k": 0.0, "nu": 0.3, "modulus": 272.6285627172757, "c0_over_R": 0.03702579865172199}
QUOTED |= {"lambda_over_R": 0.3577329844002347, "A": 0.021389499543939563, "a_max_over_R": 0.6257603035931136}
TWO_SINES = ((1, 0.5256813568663443, 0.33329100650643), (2, -0.7718687889912584, -1.6313131794236955))
ROUGH = (*TWO_SINES, (3, -0.6062622993243558, -0.3368594067365812))
BEFORE_THE_RIM: Scenes = {"k": 1.0, "nu": 0.5, "modulus": 1450.8610002823204, "c0_over_R": 0.6480129811209651}
BEFORE_THE_RIM |= {"lambda_over_R": 0.4865190784591345, "A": 0.09693642947498178, "a_max_over_R": 0.4573723130551461}


def test_a_rough_series_that_loses_much_on_unloading() -> None:
    """Its value is one that the loop integral confirmed; 1e-11 are the digits in which it was written down."""
    kind = Kind("quoted", waves=ROUGH)
    found = kind.solve(QUOTED, ["unloading_energy", "energy_residual", "dissipated_energy"])
    assert float(found["unloading_energy"]) == pytest.approx(0.964779886646169, rel=1e-11)
    assert abs(float(found["energy_residual"])) <= 1e-11 * float(found["dissipated_energy"])


def test_a_trough_close_to_the_rim_of_a_turned_cycle() -> None:
    scene = BEFORE_THE_RIM | {LOAD: 25.767153602798}
    found = Kind("quoted", turn=LOAD).solve(scene, ["pull_off_force"])
    assert float(found["pull_off_force"]) == pytest.approx(6.24870569780131, rel=1e-11)
