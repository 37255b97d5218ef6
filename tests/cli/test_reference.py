"""The reference scenes through the command line, as points: 30-digit values made from the integral definitions."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

SCENES = json.loads((Path(__file__).parents[1] / "reference" / "scenes.json").read_text())["scenes"]

RELATIVE = {"pull_off_force": 1e-12, "dissipated_energy": 1e-10, "pull_off_radius": 1e-7}
ABSOLUTE = {"delta_max": 1e-11, "delta_jump_out": 1e-11, "loading_jumps": 0.0, "unloading_jumps": 0.0}


@pytest.fixture(scope="module")
def dataset(tmp_path_factory: pytest.TempPathFactory) -> xarray.Dataset:
    """All reference scenes in one dataset."""
    from click.testing import CliRunner

    from gradhesion.cli.main import cli
    from gradhesion.cli.study.reading import study_from

    folder = tmp_path_factory.mktemp("reference")
    study: dict[str, Any] = {
        "title": "Reference scenes",
        "layout": "points",
        "outputs": [*RELATIVE, *ABSOLUTE],
        "parameters": {name: [scene["parameters"][name] for scene in SCENES] for name in SCENES[0]["parameters"]},
    }
    (folder / "reference.toml").write_text(study_from(study).text)
    run: Callable[..., Result] = CliRunner().invoke
    result = run(cli, ["run", f"{folder}/reference.toml", "-o", f"{folder}/reference.nc"])
    assert result.exit_code == 0, result.stderr
    return xarray.load_dataset(folder / "reference.nc")


@pytest.mark.parametrize("output", [*RELATIVE, *ABSOLUTE])
def test_reference_scenes(output: str, dataset: xarray.Dataset) -> None:
    expected = np.array([scene["expected"][output] for scene in SCENES])
    error = np.abs(dataset[output].values - expected)
    allowed = RELATIVE[output] * np.abs(expected) if output in RELATIVE else np.full(len(SCENES), ABSOLUTE[output])
    wrong = np.flatnonzero(~(error <= allowed))
    assert wrong.size == 0, f"scenes {wrong.tolist()} of {len(SCENES)}"
