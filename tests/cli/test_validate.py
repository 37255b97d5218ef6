"""`gradhesion validate` tells all mistakes; `gradhesion schema` is what it goes by."""

import json
import tomllib
from collections.abc import Callable
from pathlib import Path

from click.testing import Result

from gradhesion.cli.study.rules.form import Form
from gradhesion.core.problem.inputs import INPUTS

Call = Callable[..., Result]


def test_a_valid_study_and_all_mistakes_of_another(gradhesion: Call, study_file: Path) -> None:
    result = gradhesion("validate", study_file)
    assert result.exit_code == 0
    assert result.stdout == (
        f"{study_file}: valid; a map of 24 scenes; axes: k (2), lambda_over_R (3), A (2), a_max_over_R (2); "
        "outputs: pull_off_force, dissipated_energy, loading_jumps\n"
    )
    result = gradhesion("validate", study_file, "--set=parameters.nu=0.7", "--set=parameters.k=-1.0")
    assert (result.exit_code, result.stdout, len(result.stderr.splitlines())) == (2, "", 2)


def test_the_schema_is_that_of_validation(gradhesion: Call, root: Path) -> None:
    told = json.loads(gradhesion("schema").stdout)
    assert told.pop("$schema").startswith("https://json-schema.org/")
    assert told == Form.model_json_schema()
    own = told["$defs"]["Parameters"]
    assert set(own["properties"]) == {"points", *(name for name, one in INPUTS.items() if one.table == "parameters")}
    assert own["additionalProperties"] is False
    for config in (root / "configs").glob("*.toml"):
        keys = tomllib.loads(config.read_text())
        assert keys.keys() <= told["properties"].keys()
        assert keys["parameters"].keys() <= own["properties"].keys()
