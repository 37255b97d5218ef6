"""Where cycles of any profile and control turn: against a dense grid of the path, scaling, and the cycles themselves."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, draw_curves, solve
from gradhesion.core.arrays.general_turning import turning_general
from gradhesion.core.arrays.prepared import compliance_of
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, curve_of, state
from gradhesion.core.curve.general_folds import MOST_FOLDS, room
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.general import walk
from gradhesion.core.path.general_middle import REGULAR, middle_of
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import RESULTS
from gradhesion.core.problem.shape import depth_factor_of, rows_of
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, JUMP_IN_TO_RIM, LOADING_NOT_ONE_DISC, NO_VALUE
from gradhesion.core.turning.corners import Place, corners_of, first_reached, last_corner
from gradhesion.core.turning.general_far import turn_far

pytestmark = pytest.mark.slow

PAIR = (Harmonic(n=1, cos=0.8, sin=-0.3), Harmonic(n=2, cos=-0.3, sin=0.35))
SINE = (Harmonic(n=1, sin=1.0),)
ONE = (Harmonic(n=1),)
SCENE: dict[str, Any] = {
    "k": 0.3,
    "nu": 0.27,
    "modulus": 500.0,
    "c0_over_R": 0.01,
    "lambda_over_R": 0.1,
    "A": 0.05,
    "a_max_over_R": math.inf,
}
SHAPES = [
    Profile(harmonics=PAIR),
    Profile(exponent=3.0, harmonics=SINE),
    Profile(exponent=1.4, harmonics=PAIR),
    Profile(harmonics=ONE),
]
CONTROLS: list[tuple[Loading, dict[str, float]]] = [
    (Loading(), {}),
    (Loading(control="load"), {}),
    (Loading(control="machine"), {"machine_stiffness": 0.05}),
]
TURNS = ("indentation_max_over_R", "load_max")


def _numbers(scene: dict[str, Any], profile: Profile, loading: Loading) -> tuple[Any, Any, float, float]:
    """Basis and curve of a scene, and the units of depth and of load."""
    k = scene["k"]
    M = stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"])
    spring = (np.array(scene["machine_stiffness"]),) if loading.control == "machine" else ()
    compliance = float(compliance_of(loading, np.array(k), np.array(scene["modulus"]), np.array(M), *spring))
    stretch = math.sqrt(2 ** (1 + k) * math.pi / float(M))
    front = depth_factor_of(k, profile.exponent)
    numbers = (stretch, scene["lambda_over_R"], scene["A"], compliance)
    curve, length, unit = curve_of(k, profile.exponent, front, *numbers)
    return Basis(*tables_of(k), rows_of(profile)), curve, unit, force_unit(k, length, unit)


def _turn(scene: dict[str, Any], turn: str, values: Any, profile: Profile, loading: Loading) -> tuple[Any, Any]:
    return turning_general(scene | {turn: values}, turn, profile, loading, 1)[:2]


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("loading", CONTROLS)
@pytest.mark.parametrize("profile", SHAPES)
def test_loading_first_reaches_it_there(
    profile: Profile, loading: tuple[Loading, dict[str, float]], turn: str, truth: type[Any]
) -> None:
    """On a grid of radii the path is the running maximum of what is prescribed; the truth has no table and no folds."""
    control, spring = loading
    scene = SCENE | spring
    basis, curve, depth_unit, load_unit = _numbers(scene, profile, control)
    slow = truth(scene["k"], curve, basis[2], 8.0)
    z = slow.z
    prescribed = slow.coordinate(z)
    visited = prescribed >= np.maximum.accumulate(np.maximum(prescribed, 0.0))
    measured = slow.depth(z) * depth_unit if turn == TURNS[0] else slow.load(z) * load_unit
    path = np.flatnonzero(visited)
    rng = np.random.default_rng(5)
    top = measured[path][z[path] < 0.95 * z[-1]].max()
    targets = np.sort(rng.uniform(0.0, 1.0, 40)) ** 2 * top
    radii, flags = _turn(scene, turn, targets, profile, control)
    assert not flags.any() or set(np.unique(flags)) <= {0, LOADING_NOT_ONE_DISC}
    places = radii / scene["lambda_over_R"] * TWO_PI
    first = np.array([path[np.flatnonzero(measured[path] >= target)[0]] for target in targets])
    # the grid's next visited point is at most a cell behind the place, or as much as the truth is off, near a fold
    near = np.abs(z[first] - places) <= np.maximum(2.0 * np.diff(z).max(), 1e-6 * places)
    folds = np.abs(measured[first] - targets) <= 1e-4 * np.abs(targets)
    assert (near | folds).all()
    assert near.mean() > 0.9
    assert np.unique(first).size > 5


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("loading", CONTROLS)
@pytest.mark.parametrize("profile", SHAPES[:3])
def test_the_cycle_is_that_of_a_rim_there(
    profile: Profile, loading: tuple[Loading, dict[str, float]], turn: str
) -> None:
    control, spring = loading
    scene = SCENE | spring
    targets = np.linspace(0.002, 0.4, 60) if turn == TURNS[0] else np.linspace(0.05, 40.0, 60)
    turned = solve(scene | {turn: targets}, OUTPUTS, profile=profile, loading=control)
    radii = turned["turning_radius"]
    assert (radii > 0.0).all()
    rims = solve(scene | {"a_max_over_R": radii}, RESULTS, profile=profile, loading=control)
    for name in RESULTS:
        if name != "delta_max":
            assert np.array_equal(turned[name], rims[name]), name
    np.testing.assert_allclose(turned["delta_max"], rims["delta_max"], rtol=1e-13, atol=1e-15)
    # a jump to the very rim is flagged, one that ends where the cycle turns is not; nor is there a rim to be met
    mask = ~(CLOSE_TO_A_JUMP | JUMP_IN_TO_RIM | LOADING_NOT_ONE_DISC)
    assert np.array_equal(turned["status"] & mask, rims["status"] & mask)
    assert not (turned["status"] & CLOSE_TO_A_JUMP).any()
    assert np.unique(radii).size > 10


@pytest.mark.parametrize("loading", CONTROLS)
@pytest.mark.parametrize("profile", SHAPES)
def test_depth_and_load_agree(profile: Profile, loading: tuple[Loading, dict[str, float]]) -> None:
    """At the load of a turning depth loading turns there too, unless it has reached the load before."""
    control, spring = loading
    scene = SCENE | spring
    basis, curve, depth_unit, load_unit = _numbers(scene, profile, control)
    depths = np.linspace(0.01, 0.5, 80)
    radii, _ = _turn(scene, TURNS[0], depths, profile, control)
    states = [state(basis, curve, radius / scene["lambda_over_R"], 0.0) for radius in radii]
    loads = np.array([each[4] for each in states]) * load_unit
    others, _ = _turn(scene, TURNS[1], np.where(loads > 0.0, loads, 1.0), profile, control)
    same = np.abs(others - radii) <= 1e-11 * radii
    assert (same | (others < radii) | (loads <= 0.0)).all()
    assert same.sum() > 20
    on_branch = np.array(
        [abs(each[3] * depth_unit - depth) < 1e-12 for each, depth in zip(states, depths, strict=True)]
    )
    assert on_branch.sum() > 20


@pytest.mark.parametrize("control", ["displacement", "load"])
@pytest.mark.parametrize("turn", TURNS)
def test_scaling(control: str, turn: str) -> None:
    """Radii scale with L = (R^2 dgamma/M)^(1/(3+k)), depths with L^2, loads not at all, if lambda and A do."""
    k, factor = 0.3, 1.7
    profile, loading = Profile(harmonics=PAIR), Loading(control=control)
    targets = np.linspace(0.003, 0.3, 25) if turn == TURNS[0] else np.linspace(0.1, 20.0, 25)
    radii, _ = _turn(SCENE, turn, targets, profile, loading)
    other = SCENE | {
        "modulus": SCENE["modulus"] * factor ** -(3.0 + k),
        "lambda_over_R": SCENE["lambda_over_R"] * factor,
        "A": SCENE["A"] * factor,
    }
    scaled, _ = _turn(other, turn, targets * (factor**2 if turn == TURNS[0] else 1.0), profile, loading)
    np.testing.assert_allclose(scaled, radii * factor, rtol=1e-12)


@pytest.mark.parametrize("loading", CONTROLS)
def test_the_rim_and_no_contact(loading: tuple[Loading, dict[str, float]]) -> None:
    control, spring = loading
    profile = Profile(exponent=2.5, harmonics=PAIR)
    scene = SCENE | spring | {"a_max_over_R": 0.3}
    radii, flags = _turn(scene, TURNS[0], [-1.0, -1e-3, -1e-16, 0.0, 1e-3, 10.0, math.nan, math.inf], profile, control)
    assert (radii[:3] == 0.0).all()
    assert 0.0 < radii[3] == radii[4] or radii[3] < radii[4]
    assert radii[5] == 0.3
    assert np.isnan(radii[6:]).all()
    assert flags.tolist() == [0, 0, CLOSE_TO_A_JUMP, CLOSE_TO_A_JUMP, 0, 0, NO_VALUE, NO_VALUE]
    radii, flags = _turn(scene, TURNS[1], [0.0, -1.0, 1e4, math.inf], profile, control)
    assert radii[2] == 0.3
    assert np.isnan(radii[[0, 1, 3]]).all()
    assert flags.tolist() == [NO_VALUE, NO_VALUE, 0, NO_VALUE]


@pytest.mark.parametrize("loading", CONTROLS)
def test_a_step_is_flagged(loading: tuple[Loading, dict[str, float]]) -> None:
    """Where the target passes a fold of the path the turning radius steps; there, and only there, is a flag."""
    control, spring = loading
    scene, profile = SCENE | spring, Profile(harmonics=PAIR)
    low, high = 0.0, 0.3
    start, end = (float(_turn(scene, TURNS[0], depth, profile, control)[0]) for depth in (low, high))
    for _ in range(60):  # to the largest step
        middle = 0.5 * (low + high)
        place = float(_turn(scene, TURNS[0], middle, profile, control)[0])
        if place - start > end - place:
            high, end = middle, place
        else:
            low, start = middle, place
        if high - low < 1e-15:
            break
    assert end - start > 0.01 * scene["lambda_over_R"]
    _, flags = _turn(scene, TURNS[0], [low, high, low * (1 - 1e-9), high * (1 + 1e-9)], profile, control)
    assert (flags & CLOSE_TO_A_JUMP).tolist() == [CLOSE_TO_A_JUMP, CLOSE_TO_A_JUMP, 0, 0]


@pytest.mark.parametrize("by_load", [False, True])
@pytest.mark.parametrize(
    ("k", "m", "harmonics", "control", "chi"),
    [
        (0.3, 2.0, PAIR, "displacement", 0.6),
        (0.0, 2.0, SINE, "displacement", 0.15),
        (0.7, 1.0, PAIR, "displacement", 0.5),
        (0.3, 2.0, PAIR, "machine", 0.5),
        (0.6, 3.0, PAIR, "load", 0.7),
        (1.0, 3.0, SINE, "displacement", 0.9),
    ],
)
def test_far_turns_are_those_of_a_walk(
    k: float, m: float, harmonics: Any, control: str, chi: float, by_load: bool
) -> None:
    """On 3,000 waves: those that are passed by their regularity against every wave walked."""
    scene = SCENE | {"k": k, "nu": 0.5 if k == 1.0 else 0.27, "lambda_over_R": 2e-4, "machine_stiffness": 0.1}
    M = float(stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
    stretch = math.sqrt(2 ** (1 + k) * math.pi / M)
    size = math.pi ** (0.5 * (1 - k)) * math.gamma(0.5 * (1 + k)) * scene["lambda_over_R"] ** (0.5 * (1 + k))
    scene["A"] = chi * stretch / size
    basis, curve, _, _ = _numbers(scene, Profile(exponent=m, harmonics=harmonics), Loading(control=control))
    rim = 3000.0
    first, last = first_fold_bound(basis, curve) / TWO_PI, min(rim, last_fold_bound(basis, curve) / TWO_PI)
    middle = middle_of(basis, curve, first, last, 0.0)
    assert middle.kind == REGULAR
    count, trace, _ = walk(basis, curve, (first, last), rim, False)
    search = Place(room(), np.empty(MOST_FOLDS), 0.0, last_corner(basis, curve, by_load))
    corners, number = corners_of(basis, curve, by_load, count, trace, rim, search)
    top = corners[1, :number].max()
    reached = 0
    for share in (1e-6, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999):
        target = share * top
        found, x, _, passed = first_reached(basis, curve, by_load, corners, number, target, 0.0)
        assert found
        done, far, whole = turn_far(
            basis, curve, (by_load, target, last_corner(basis, curve, by_load)), first, middle, rim
        )
        assert done
        assert far[0]
        assert far[3] == passed
        assert whole + far[1] == pytest.approx(x, rel=1e-11)
        reached += whole > 0.0
    assert reached > 2
    done, far, _ = turn_far(
        basis, curve, (by_load, 1.001 * top, last_corner(basis, curve, by_load)), first, middle, rim
    )
    assert done
    assert not far[0]


@pytest.mark.parametrize("target", [1e-19, 1e-15])
def test_a_depth_that_the_first_jump_passes_is_not_that_of_the_cycle_however_small_both_are(target: float) -> None:
    """Under a load the contact jumps to a depth of its own; on a stiff half-space both are far below 1e-14."""
    punch = {"k": 0.3, "nu": 0.3, "modulus": 1e24, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02}
    load = Loading(control="load")
    scene = punch | {"a_max_over_R": 1.0, "indentation_max_over_R": target}
    turned = solve(scene, ["delta_max", "turning_radius"], loading=load)
    rim = solve(punch | {"a_max_over_R": turned["turning_radius"]}, ["delta_max"], loading=load)
    assert turned["delta_max"] == pytest.approx(rim["delta_max"], rel=1e-12, abs=0.0)
    assert turned["delta_max"] > 1.5 * target
    beyond = solve(scene | {"indentation_max_over_R": 3e-15}, ["delta_max"], loading=load)
    assert beyond["delta_max"] == 3e-15, "no jump passes that one"


def test_the_drawn_path_ends_there() -> None:
    profile = Profile(harmonics=PAIR)
    for loading, spring in CONTROLS:
        scene = SCENE | spring | {"a_max_over_R": 2.0, "indentation_max_over_R": 0.05}
        radius = float(solve(scene, ["turning_radius"], profile=profile, loading=loading)["turning_radius"])
        path, _ = draw_curves(scene, ["path"], profile, loading)
        assert np.max(path["path_contact_radius"]) == radius
