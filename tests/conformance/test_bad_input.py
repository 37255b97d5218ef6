"""What is out of range, empty, of another type or of shapes that do not fit."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import CURVES, OUTPUTS, Loading, draw_curves, solve
from gradhesion.core.draw.draw import INTEGERS
from tests.core.scene import pattern_of

from .kinds import COUNTS, DEPTH, KINDS, LOAD, Kind, Scenes, drawn, for_kinds, some
from .promises import NO_CONTACT, NO_VALUE, agree, has

NAN, INF = math.nan, math.inf
NO_NUMBERS: list[Any] = ["a", [1, "b"], {}, 1j]
SCENE = {"k": 0.3, "nu": 0.3, "modulus": 300.0, "c0_over_R": 0.1, "lambda_over_R": 0.2, "A": 0.03, "a_max_over_R": 0.5}
OUT_OF_RANGE: dict[str, list[float]] = {
    "k": [-1e-9, 1 + 2.0**-52, NAN, INF, -INF],
    "nu": [-1.0, 0.5 + 2.0**-53, NAN, INF],
    "modulus": [0.0, -1.0, NAN, INF],
    "c0_over_R": [0.0, -1.0, NAN],  # at k = 0 its infinity is a homogeneous material
    "lambda_over_R": [0.0, -0.1, NAN, INF],
    "A": [-1e-300, -1.0, NAN, INF],
    "a_max_over_R": [0.0, -1.0, NAN, -INF],
    "machine_stiffness": [0.0, -1.0, NAN],
    "closing_ratio": [-1e-9, 1 + 2.0**-52, NAN, INF],
    DEPTH: [NAN],
    LOAD: [NAN],
    "toughness_wavelength_over_R": [0.0, -1.0, NAN],
    "toughness_amplitude": [NAN, INF, 1e3],
}
PATTERN = pattern_of("toughness", (1, 0.0, 0.3))
PERIOD, STIFFNESS = "toughness_wavelength_over_R", "machine_stiffness"
LOADED, MACHINE = Loading(control="load"), Loading(control="machine")
CONTRADICTORY: list[tuple[str, dict[str, Any], dict[str, Any]]] = [  # what the refusal names, keys, how to solve
    *((name, {name: None}, {}) for name in SCENE),
    ("force", {}, {"outputs": ["force"]}),
    ("pull_off_force_error", {}, {"outputs": ["pull_off_force_error"]}),
    ("fast", {}, {"solver": "fast"}),
    (LOAD, {DEPTH: 0.1, LOAD: 0.1}, {}),
    (DEPTH, {DEPTH: 0.1}, {"solver": "asymptotic"}),
    *((solver, {}, {"solver": solver, "loading": LOADED}) for solver in ("asymptotic", "envelope")),
    *((solver, {STIFFNESS: 1.0}, {"solver": solver, "loading": MACHINE}) for solver in ("asymptotic", "envelope")),
    ("energy_residual", {}, {"solver": "asymptotic", "outputs": ["energy_residual"]}),
    ("asymptotic", {PERIOD: 0.1}, {"solver": "asymptotic", "toughness": PATTERN}),
    (STIFFNESS, {STIFFNESS: 1.0}, {}),
    (STIFFNESS, {}, {"loading": MACHINE}),
    ("energy_residual", {}, {"loading": LOADED, "outputs": ["energy_residual"]}),
    (PERIOD, {PERIOD: 0.1}, {}),
    (PERIOD, {}, {"toughness": PATTERN}),
]


@pytest.mark.parametrize(("name", "keys", "how"), CONTRADICTORY)
def test_what_contradicts_itself_or_lacks_a_parameter_is_refused(name: str, keys: Scenes, how: Scenes) -> None:
    with pytest.raises(ValueError, match=name):
        solve({key: value for key, value in (SCENE | keys).items() if value is not None}, **how)


@for_kinds(KINDS)
def test_out_of_range_has_no_value_and_does_not_reach_its_neighbours(kind: Kind) -> None:
    """Each wrong scene stands between good ones, and is another good one but for one value."""
    good = some(drawn(kind)[0], slice(2))
    wrong = [(name, value) for name in good for value in OUT_OF_RANGE[name]]
    bad = {n: np.array([value if n == name else values[1] for name, value in wrong]) for n, values in good.items()}
    columns = {n: np.stack([np.full(len(wrong), values[0]), bad[n]], axis=1) for n, values in good.items()}
    with np.errstate(all="ignore"):
        found = kind.solve(columns)
    for i, case in enumerate(wrong):
        assert has(found, NO_VALUE)[i, 1], case
        for output in kind.outputs:
            assert found[output][i, 1] == -1 if output in COUNTS else np.isnan(found[output][i, 1]), (case, output)
    first = {n: np.full(len(wrong), values[0]) for n, values in good.items()}
    agree(kind, first, some(found, np.s_[:, 0]), kind.solve(first))


@for_kinds(KINDS)
def test_empty_and_single_arrays_keep_their_shape(kind: Kind) -> None:
    scenes, found = drawn(kind)
    for shape in ((0,), (0, 3), (2, 0)):
        empty = kind.solve(some(scenes, 0) | {"A": np.zeros(shape)})
        assert {values.shape for values in empty.values()} == {shape}
    for single in ((), (1,), (1, 1, 1)):
        one = kind.solve({name: np.full(single, values[0]) for name, values in scenes.items()})
        assert {values.shape for values in one.values()} == {single}
        agree(kind, some(scenes, [0]), {name: values.reshape(1) for name, values in one.items()}, some(found, [0]))


@pytest.mark.parametrize("value", [np.int16(300), np.array(300, dtype=object), np.float32(300), 300, [300], "300"])
def test_what_is_a_number_is_read(value: Any) -> None:
    found, expected = solve(SCENE | {"modulus": value}, OUTPUTS), solve(SCENE, OUTPUTS)
    for name in expected:
        np.testing.assert_array_equal(np.squeeze(found[name]), expected[name])


@pytest.mark.parametrize("change", [*({"modulus": value} for value in NO_NUMBERS), {"A": [0, 0], "k": [0, 0, 0]}])
def test_what_is_no_number_or_does_not_fit_is_refused(change: Any) -> None:
    with pytest.raises((TypeError, ValueError)):
        solve(SCENE | change)


@for_kinds(["cosine, turned at a depth", "exponent 1.5, machine, turned", "sines, machine, two works, turned"])
def test_a_depth_without_contact_has_nothing(kind: Kind) -> None:
    found = kind.solve(some(drawn(kind)[0], slice(4)) | {DEPTH: np.full(4, -0.01)})
    assert (found["status"].astype(int) == NO_CONTACT).all()
    assert (found["status"].dtype, solve(SCENE)["status"].dtype) == (np.int16, np.int8)
    assert not np.any([found[name] for name in ("pull_off_force", "dissipated_energy", "turning_radius", *COUNTS)])
    assert np.isnan([found[name] for name in ("pull_off_radius", "delta_jump_out")]).all()


@pytest.mark.parametrize("name", SCENE)
def test_what_has_no_value_is_not_drawn(name: str) -> None:
    for value in OUT_OF_RANGE[name]:
        curves, status = draw_curves(SCENE | {name: value}, [*CURVES])
        assert status == NO_VALUE
        for variable, values in curves.items():
            none = [] if variable in CURVES["jumps"] else [-1 if variable in INTEGERS else NAN]
            np.testing.assert_array_equal(values, none, variable)
