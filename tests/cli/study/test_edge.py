"""Patterns of toughness and speeds in studies: their keys, outputs and curves, and what is refused."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.study.reading import study_from
from gradhesion.core import solve
from gradhesion.core.problem.toughness import Rate, Toughness, ToughnessHarmonic

Call = Callable[..., Result]
Write = Callable[[str], Path]
PLAIN: dict[str, Any] = {"k": 0.1, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.01}
WAVES = {"harmonics": [{"n": 1, "cos": 0.3}, {"n": 2, "sin": 0.1}]}
PATTERN = Toughness((ToughnessHarmonic(n=1, cos=0.3), ToughnessHarmonic(n=2, sin=0.1)))
TEXT = """outputs = ["pull_off_force", "dissipated_energy"]
[parameters]
k = 0.0
nu = 0.3
modulus = 500.0
lambda_over_R = 0.2
A = 0.01
a_max_over_R = 0.5
"""


def test_a_pattern_has_its_dimensions_after_the_ratio() -> None:
    axes = {
        "closing_ratio": [0.5, 1.0],
        "toughness_wavelength_over_R": [0.1, 0.2],
        "toughness_amplitude": [0.0, 0.5, 1.0],
    }
    study = {"outputs": ["dissipated_energy", "dissipated_energy_sensitivity"], "toughness": WAVES}
    dataset = compute(study_from(study | {"parameters": PLAIN | {"a_max_over_R": 0.5} | axes}))
    assert dataset["dissipated_energy"].dims == tuple(axes)
    assert dataset["parameter"].values[-3:].tolist() == [*axes]
    assert dataset["status"].dtype == np.int16
    assert dataset.attrs["toughness"] == "K_c times 1 + t [0.3 cos(2 pi y) + 0.1 sin(4 pi y)], y = r/lambda_t"
    scene = PLAIN | {"a_max_over_R": 0.5, "closing_ratio": 0.5, "toughness_wavelength_over_R": 0.2}
    found = solve(scene | {"toughness_amplitude": 0.5}, ["dissipated_energy"], toughness=PATTERN)
    assert float(dataset["dissipated_energy"][0, 1, 1]) == float(found["dissipated_energy"])


@pytest.mark.parametrize(
    ("key", "table", "line"),
    [
        (
            "toughness_wavelength_over_R",
            '[toughness]\nharmonics = [{ n = 1, sin = 0.2 }]\nof = "work"',
            "toughness: w times 1 + t [0.2 sin(2 pi y)], y = r/lambda_t",
        ),
        (
            "speed_over_reference",
            "[rate]\nexponent = 0.6",
            "rate: G = w_o [1 + (v/v*)^0.6] while the edge opens, G = w_c while it closes",
        ),
    ],
)
def test_info_names_the_law_of_the_edge(key: str, table: str, line: str, gradhesion: Call, write_study: Write) -> None:
    study = write_study(f"{TEXT}{key} = 0.1\n{table}\n")
    output = study.parent / "law.nc"
    assert gradhesion("run", study, "-o", output, "--quiet").exit_code == 0
    assert line in gradhesion("info", output).stdout.splitlines()


def test_amplitude_0_is_no_pattern() -> None:
    scene = PLAIN | {"a_max_over_R": 0.5, "toughness_wavelength_over_R": 0.1, "toughness_amplitude": 0.0}
    flat = gr.solve(scene, ["pull_off_force", "dissipated_energy"], toughness=WAVES)
    plain = gr.solve(PLAIN | {"a_max_over_R": 0.5}, ["pull_off_force", "dissipated_energy"])
    for name in ("pull_off_force", "dissipated_energy"):
        np.testing.assert_allclose(flat[name], plain[name], rtol=1e-13)


def test_python_takes_a_pattern_as_an_object_too() -> None:
    scene = PLAIN | {"a_max_over_R": 0.5, "toughness_wavelength_over_R": 0.1}
    one, other = (gr.solve(scene, "pull_off_force", toughness=way)["pull_off_force"] for way in (WAVES, PATTERN))
    assert float(one) == float(other)


def test_curves_over_a_pattern(gradhesion: Call, write_study: Write) -> None:
    text = TEXT.replace(
        '["pull_off_force", "dissipated_energy"]', '["path", "equilibrium", "closing_equilibrium", "jumps"]'
    )
    path = write_study(
        f'kind = "curve"\n{text}closing_ratio = 0.4\ntoughness_wavelength_over_R = 0.1\n'
        "[toughness]\nharmonics = [{ n = 1, cos = 0.3 }]\n"
    )
    assert gradhesion("run", path, "-o", path.with_suffix(".nc")).exit_code == 0
    assert gradhesion("plot", path.with_suffix(".nc")).exit_code == 0


def test_a_pattern_is_verified_and_a_speed_is_refused(gradhesion: Call, write_study: Write) -> None:
    path = write_study(
        TEXT + "toughness_wavelength_over_R = [0.1, 0.2]\n[toughness]\nharmonics = [{ n = 1, cos = 0.3 }]\n"
    )
    assert gradhesion("run", path, "-o", path.with_suffix(".nc")).exit_code == 0
    result = gradhesion("verify", path.with_suffix(".nc"), "--sample", "2")
    assert result.exit_code == 0, result.output
    path = write_study(TEXT + "speed_over_reference = 0.1\n[rate]\nexponent = 0.6\n")
    assert gradhesion("run", path, "-o", path.with_suffix(".rate.nc")).exit_code == 0
    result = gradhesion("verify", path.with_suffix(".rate.nc"))
    assert result.exit_code != 0
    assert "edges with a speed have no independent twin" in result.output


def test_a_speed_in_units_gives_its_ratio() -> None:
    physical = {
        "R": "1 mm",
        "E_star": "50 kPa",
        "work_of_adhesion": "50 mJ/m^2",
        "wavelength": "0.2 mm",
        "a_max": "0.5 mm",
    }
    physical |= {"speed": ["0 um/s", "1 um/s", "0.01 mm/s"], "reference_speed": "1 mm/s"}
    study = {
        "outputs": ["pull_off_force", "dissipated_energy", "edge_speed_at_pull_off", "rate_coefficient"],
        "parameters": {"k": 0.0, "nu": 0.3, "A": 0.01},
        "physical": physical,
        "rate": {"exponent": 0.6},
    }
    dataset = compute(study_from(study))
    np.testing.assert_allclose(dataset["speed_over_reference"], [0.0, 1e-3, 1e-2], rtol=1e-15)
    assert (np.diff(dataset["pull_off_force_si"]) > 0.0).all()
    assert dataset.attrs["rate"].startswith("G = w_o [1 + (v/v*)^0.6]")
    scene = PLAIN | {"k": 0.0, "modulus": 1000.0, "a_max_over_R": 0.5}
    rest = solve(scene, ["pull_off_force"])["pull_off_force"]
    assert float(dataset["pull_off_force"][0]) == float(rest)


def test_a_path_at_a_speed_is_drawn_and_explored(gradhesion: Call, write_study: Write) -> None:
    text = TEXT.replace('["pull_off_force", "dissipated_energy"]', '["path", "equilibrium"]')
    path = write_study(
        f'kind = "curve"\n{text}speed_over_reference = [0.0, 0.1]\n[rate]\nexponent = 0.6\nclosing = "same"\n'
    )
    for command in ("run", "plot", "explore"):
        target = path if command == "run" else path.with_suffix(".nc")
        result = gradhesion(command, target, *(["-o", path.with_suffix(".nc")] if command == "run" else []))
        assert result.exit_code == 0, result.output


def test_spread_and_optima_know_speeds() -> None:
    moving = {"parameters": PLAIN | {"a_max_over_R": 0.5, "speed_over_reference": 0.1}, "rate": {"exponent": 0.6}}
    spread = moving | {"outputs": ["pull_off_force"], "uncertainty": {"modulus": "5 %", "samples": 64}}
    assert float(compute(study_from(spread))["pull_off_force_std"]) > 0.0
    bounds = {"start": 0.01, "stop": 1.0}
    best = moving | {
        "kind": "optimum",
        "optimum": {"maximise": "pull_off_force", "over": ["speed_over_reference"], "resolution": 20},
    }
    best["parameters"] = moving["parameters"] | {"speed_over_reference": bounds}
    found = compute(study_from(best))
    force = solve(
        PLAIN | {"a_max_over_R": 0.5, "speed_over_reference": 1.0}, ["pull_off_force"], rate=Rate(exponent=0.6)
    )
    assert float(found["best_pull_off_force"]) == pytest.approx(float(force["pull_off_force"]), rel=1e-9)
