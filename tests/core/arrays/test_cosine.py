"""Many exponents at once: each scene as it is alone, within what is stated."""

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, solve
from gradhesion.core.arrays import tables
from gradhesion.core.struve.interpolated import ROUNDING

COUNT = 300


@pytest.fixture(scope="module")
def scenes() -> dict[str, np.ndarray]:
    """Give scenes that all have exponents of their own."""
    rng = np.random.default_rng(11)
    return {
        "k": np.concatenate([[0.0, 1e-12, 1.0 - 1e-12], rng.uniform(0.0, 1.0, COUNT - 3)]),
        "nu": rng.uniform(-0.5, 0.499, COUNT),
        "modulus": 10 ** rng.uniform(1.0, 4.0, COUNT),
        "c0_over_R": 10 ** rng.uniform(-3.0, 0.0, COUNT),
        "lambda_over_R": 10 ** rng.uniform(-2.5, 0.0, COUNT),
        "A": 10 ** rng.uniform(-3.5, -1.0, COUNT),
        "a_max_over_R": rng.choice([0.3, 1.0, np.inf], COUNT),
    }


def test_each_is_what_it_is_alone(scenes: dict[str, np.ndarray]) -> None:
    errors = ["pull_off_force_error", "dissipated_energy_error"]
    together = solve(scenes, [*OUTPUTS[:3], "loading_jumps", "unloading_jumps", *errors], threads=1)
    for i in range(COUNT):
        alone = solve({name: float(value[i]) for name, value in scenes.items()}, list(together)[:-1], threads=1)
        for name in ("loading_jumps", "unloading_jumps"):
            assert together[name][i] == alone[name]
        for name, error in zip(("pull_off_force", "dissipated_energy"), errors, strict=True):
            assert abs(together[name][i] - alone[name]) <= together[error][i] + alone[error]
        # with a table of its own the pull-off may be met a few ulp elsewhere
        assert together[errors[0]][i] == pytest.approx(ROUNDING * alone[errors[0]], rel=1e-6)


def test_tables_are_made_together(scenes: dict[str, np.ndarray], monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[int] = []
    real = tables.table_of_each
    monkeypatch.setattr(tables, "table_of_each", lambda k, *, forces: made.append(k.size) or real(k, forces=forces))
    monkeypatch.setattr(tables, "build_table", lambda _: pytest.fail("a table of its own"))
    solve(scenes, ["pull_off_force"], threads=1)
    assert sum(made) == COUNT
    assert max(made) == min(COUNT, 512)


def test_threads_change_nothing(scenes: dict[str, np.ndarray]) -> None:
    one, two = (solve(scenes, OUTPUTS, threads=threads) for threads in (1, 2))
    for name, values in one.items():
        np.testing.assert_array_equal(values, two[name])


def test_what_is_out_of_range_has_no_value(scenes: dict[str, np.ndarray]) -> None:
    wrong = {**scenes, "k": np.where(np.arange(COUNT) % 7 == 0, 1.5, scenes["k"])}
    found = solve(wrong, ["pull_off_force"], threads=1)
    np.testing.assert_array_equal(np.isnan(found["pull_off_force"]), np.arange(COUNT) % 7 == 0)
