"""What is out of range, empty, of another type or of shapes that do not fit."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, draw_curves, solve
from gradhesion.core.problem.names import EDGE

from .faults import FAULT_OF_EDGES, FAULT_OF_RIMS, FAULT_OF_WARNINGS
from .kinds import BY_NAME, COUNTS, DEPTH, KINDS, LOAD, Kind, drawn, name_of, some
from .promises import NO_CONTACT, NO_VALUE, agree, has

NAN, INF = math.nan, math.inf
SCENE = {"k": 0.3, "nu": 0.3, "modulus": 300.0, "c0_over_R": 0.1, "lambda_over_R": 0.2, "A": 0.03, "a_max_over_R": 0.5}
OUT_OF_RANGE = {
    "k": [-1e-9, 1 + 2.0**-52, 2.0, NAN, INF, -INF],
    "nu": [-1.0, 0.5 + 2.0**-53, 1.0, NAN, INF],
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
EVERY = pytest.mark.parametrize("kind", KINDS, ids=name_of)


@EVERY
def test_out_of_range_has_no_value_and_does_not_reach_its_neighbours(kind: Kind) -> None:
    scenes = some(drawn(kind)[0], slice(3))
    expected = kind.solve(scenes)
    for name, values in OUT_OF_RANGE.items():
        if name not in scenes:
            continue
        for value in values:
            bad = {n: np.insert(v, 1, v[1]) for n, v in scenes.items()}
            bad[name][1] = value
            with np.errstate(all="ignore"):
                found = kind.solve(bad)
            names = [n for n in kind.outputs if n not in EDGE or kind.ratio]
            if kind.solver == "asymptotic" and name == "a_max_over_R":
                names.remove("pull_off_radius")
            for output in names:
                assert found[output][1] == -1 if output in COUNTS else np.isnan(found[output][1]), (name, value, output)
            assert has(found, NO_VALUE)[1]
            agree(kind, scenes, {n: np.delete(v, 1) for n, v in found.items()}, expected)


@FAULT_OF_EDGES
@pytest.mark.parametrize("output", EDGE)
def test_results_of_the_edge_have_no_value_either(output: str) -> None:
    found = solve(SCENE | {"A": [0.03, -1.0]}, [output])
    assert np.isnan(found[output][1])


@FAULT_OF_EDGES
@pytest.mark.parametrize("output", EDGE)
def test_results_of_the_edge_may_be_empty(output: str) -> None:
    assert solve(SCENE | {"A": np.zeros((0, 3))}, [output])[output].shape == (0, 3)


@FAULT_OF_RIMS
@pytest.mark.parametrize("rim", [0.0, -1.0])
def test_short_waves_without_a_rim_have_no_radius(rim: float) -> None:
    found = solve(SCENE | {"a_max_over_R": rim}, ["pull_off_radius"], solver="asymptotic")
    assert np.isnan(found["pull_off_radius"])


@FAULT_OF_WARNINGS
def test_nothing_is_warned_of_what_has_no_value() -> None:
    with np.errstate(all="raise"):
        solve(SCENE | {"lambda_over_R": 0.0, "closing_ratio": 0.5}, ["dissipated_energy"])


def test_k_1_needs_nu_one_half() -> None:
    found = solve(SCENE | {"k": 1.0, "nu": [0.5, 0.3]})
    assert has(found, NO_VALUE).tolist() == [False, True]


@EVERY
def test_empty_and_single_arrays_keep_their_shape(kind: Kind) -> None:
    scenes, found = drawn(kind)
    for shape in ((0,), (0, 3), (2, 0)):
        empty = kind.solve({n: v[0] for n, v in scenes.items()} | {"A": np.zeros(shape)}, OUTPUTS)
        assert {values.shape for values in empty.values()} == {shape}
    for shape in ((), (1,), (1, 1, 1)):
        one = kind.solve({n: np.full(shape, v[0]) for n, v in scenes.items()})
        assert {values.shape for values in one.values()} == {shape}
        flat = {n: v.reshape(1) for n, v in one.items()}
        agree(kind, some(scenes, [0]), flat, some(found, [0]))


def test_shapes_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError):
        solve(SCENE | {"A": np.zeros(3), "k": np.zeros(4)})


def test_integers_lists_and_objects_are_numbers() -> None:
    scene = SCENE | {"k": 0, "a_max_over_R": 1, "modulus": 300}
    expected = solve({name: float(value) for name, value in scene.items()})
    for modulus in (np.array(300, dtype=np.int16), np.array(300, dtype=object), np.float32(300), [300][0]):
        found = solve(scene | {"modulus": modulus})
        for name in expected:
            assert found[name] == expected[name]
    listed = solve(scene | {"A": [0.03, 0.0], "modulus": np.array([300, 300], dtype=object)})
    assert listed["pull_off_force"][0] == expected["pull_off_force"]


@pytest.mark.parametrize("value", ["a", [1.0, "b"], {}, 1j])
def test_what_is_no_number_is_refused(value: Any) -> None:
    with pytest.raises((TypeError, ValueError)):
        solve(SCENE | {"modulus": value})


def test_arrays_that_are_views_or_read_only_are_read_and_left_alone() -> None:
    kind = BY_NAME["cosine"]
    scenes, found = drawn(kind)
    kept = {name: values.copy() for name, values in scenes.items()}
    backwards = kind.solve({name: values[::-1] for name, values in scenes.items()})
    np.testing.assert_array_equal(backwards["loading_jumps"][::-1], found["loading_jumps"])
    for values in scenes.values():
        values.flags.writeable = False
    kind.solve(scenes)
    for name, values in scenes.items():
        np.testing.assert_array_equal(values, kept[name])
        values.flags.writeable = True


@pytest.mark.parametrize(
    ("change", "outputs", "how"),
    [
        ({}, ["pull_of_force"], {}),
        ({}, ["pull_off_force"], {"solver": "approximate"}),
        ({"machine_stiffness": 1.0}, ["pull_off_force"], {}),
        ({}, ["pull_off_force"], {"loading": Loading(control="machine")}),
        ({DEPTH: 0.1, LOAD: 1.0}, ["pull_off_force"], {}),
        ({}, ["energy_residual"], {"loading": Loading(control="load")}),
        ({}, ["energy_residual"], {"solver": "envelope"}),
        ({}, ["pull_off_force"], {"solver": "asymptotic", "loading": Loading(control="load")}),
        ({"toughness_amplitude": 0.1}, ["pull_off_force"], {}),
        ({"toughness_wavelength_over_R": 0.1}, ["pull_off_force"], {}),
    ],
)
def test_requests_that_contradict_themselves_are_refused(change: Any, outputs: Any, how: Any) -> None:
    with pytest.raises(ValueError):
        solve(SCENE | change, outputs, **how)


@pytest.mark.parametrize("missing", list(SCENE))
def test_a_missing_parameter_is_refused(missing: str) -> None:
    rest = {name: value for name, value in SCENE.items() if name != missing}
    with pytest.raises(ValueError):
        solve(rest)
    with pytest.raises(ValueError):
        draw_curves(rest, ["path"])


@pytest.mark.parametrize(
    "make",
    [
        lambda: Profile(exponent=0.99),
        lambda: Profile(exponent=NAN),
        lambda: Profile(exponent=INF),
        lambda: Profile(harmonics=()),
        lambda: Profile(harmonics=(Harmonic(n=2), Harmonic(n=2))),
        lambda: Profile(harmonics=tuple(Harmonic(n=n) for n in range(1, 66))),
        lambda: Harmonic(n=0),
        lambda: Harmonic(n=1.5),  # type: ignore[arg-type]
        lambda: Harmonic(n=1, cos=NAN),
        lambda: Harmonic(n=1, sin=INF),
        lambda: Loading(control="speed"),
    ],
)
def test_shapes_and_controls_out_of_range_are_refused(make: Any) -> None:
    with pytest.raises(ValueError):
        make()


@pytest.mark.parametrize("name", ["cosine, turned at a depth", "exponent 1.5, machine, turned at a depth"])
def test_a_depth_without_contact_has_nothing(name: str) -> None:
    kind = BY_NAME[name]
    scenes = some(drawn(kind)[0], slice(4)) | {DEPTH: np.full(4, -0.01)}
    found = kind.solve(scenes)
    assert (found["status"].astype(int) == NO_CONTACT).all()
    for output in ("pull_off_force", "dissipated_energy", "turning_radius", *COUNTS):
        assert not found[output].any(), output
    for output in ("pull_off_radius", "delta_jump_out"):
        assert np.isnan(found[output]).all(), output


@pytest.mark.parametrize(("name", "value"), [(n, v) for n in SCENE for v in OUT_OF_RANGE[n][:3]])
def test_what_has_no_value_is_not_drawn(name: str, value: float) -> None:
    curves, status = draw_curves(SCENE | {name: value}, ["path", "jumps"])
    assert status & NO_VALUE
    assert curves["path_load"].shape == (1,)
    assert np.isnan(curves["path_load"]).all()
    assert curves["jump_energy"].size == 0
