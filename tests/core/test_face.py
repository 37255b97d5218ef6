"""The face that every kind of curve shows: each of its functions keeps its contract for each kind that answers it."""

import inspect
import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from gradhesion.core import face
from gradhesion.core.arrays.tables import changes_of, tables_of
from gradhesion.core.compiler.dispatch import Face
from gradhesion.core.contact.gap import opening_far, opening_near
from gradhesion.core.contact.touch import front_at
from gradhesion.core.curve import cosine, general, short_wave
from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, ROWS, RUN, RUN_LEAST, START, START_DEPTH
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_folds import last_arch
from gradhesion.core.curve.general import Basis, Patterned, Series
from gradhesion.core.curve.patterned import pattern_of
from gradhesion.core.curve.short_wave import ShortWave
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path import cosine as cosine_path
from gradhesion.core.path import general as general_path
from gradhesion.core.scene.short_wave import walk as walk_short
from gradhesion.core.sensitivities.jump_slopes import BEND, DEPTH, GAIN, SLOPES
from gradhesion.core.sensitivities.wave_slopes import ROOM
from gradhesion.core.struve.fractional import NODES
from gradhesion.core.waves.cosine import branch_of_wave

K, CHI, WAVES, FURTHEST = 0.37, 1.2, 12.0, 9.0
ONE = np.array([[1.0, 1.0, 0.0]])
TWO = np.array([[1.0, 1.0, 0.0], [2.0, 0.2, 0.15]])
EXACT = {"gap_in", "size_at", "most_size_at", "fold_at"}
OF_CONTACT = {
    "table_of",
    "coordinate_at",
    "surely_open",
    "is_always_one_disc",
    "touches_at_centre",
    "waves_are_one_disc",
}
OF_CONTACT |= {"panels_of", "profile_at", "edge_at", "excess_at", "fill_heights"}
OF_PROFILES = {"waves_at", "depth_of_point", "relative_toughness", "shortest_wave"}
OF_FOLDS = {"punch_of", "window", "find_all_folds", "measured_by", "reach"}
OF_SLOPES = {"steepness_at", "rim_slope", "add_slopes", "add_slopes_to_zero", "start_of_wave", "add_slopes_of_waves"}
DECLARED = {name: value for name, value in vars(face).items() if isinstance(value, Face)}


@dataclass(frozen=True)
class Case:
    """A curve with its branches: `near` is what sensitivities need."""

    table: Any
    curve: Any
    count: int
    trace: Any
    coordinate: Callable[[float], float]
    near: Any = ()

    def ask(self, name: str, *arguments: Any) -> Any:
        """Call a function of the face."""
        return DECLARED[name](self.table, self.curve, *arguments)

    def to_zero(self, x: float, level: float) -> float:
        """Give what the jump-out from x at a level loses; of a load, which bounds nothing, minus the jump-in's at 0."""
        dead = isinstance(self.curve, Series) and self.curve.alpha == 0.0
        return float(-self.ask("loss_from_zero", x) if dead else self.ask("loss_to_zero", x, level))


def _cosine() -> Case:
    table, _ = tables_of(K)
    bend, gain = CHI / (TWO_PI * WAVES) ** (0.5 * (1 + K)), CHI / float(table["amplitude"])
    curve = Cosine(bend, gain, 0.0)
    arches = cosine_path.extent(table, curve)
    count, trace = cosine_path.walk(table, curve, arches, FURTHEST, np.empty((ROWS, 192)), True)
    near = (np.array([table]), np.zeros((1, 2)), np.zeros(0))
    return Case(table, curve, count, trace, lambda x: float(cosine.depth(table, curve, x)), near=near)


def _series(rows: Any, exponent: float, alpha: float, beta: float) -> Case:
    basis, one = Basis(*tables_of(K, rows), rows), _cosine().curve
    curve = Series(0.5 * one.bend * (TWO_PI * 3) ** (2 - exponent), exponent, one.gain, alpha, beta)
    count, trace, _ = general_path.walk(basis, curve, face.window(basis, curve), FURTHEST, True)
    return Case(
        basis, curve, count, trace, lambda x: float(general.coordinate(basis, curve, x)), near=changes_of(K, rows)
    )


def _short_wave(rows: Any) -> Case:
    one = _cosine()
    basis = Basis(one.table, *short_wave.waves_of(one.table, rows))
    curve = ShortWave(0.5 * one.curve.bend, 2.0, one.curve.gain, 1.0, 0.0)
    count, trace = walk_short(basis, curve, FURTHEST)
    return Case(basis, curve, count, trace, lambda x: float(general.coordinate(basis, curve, x)))


def _patterned(rows: Any, of_work: bool, alpha: float, beta: float) -> Case:
    one, (table, bins) = _cosine().curve, tables_of(K, rows)
    waves = np.array([[1.7, 0.15, -0.1], [0.4, 0.0, 0.1]])
    pattern, finest = pattern_of(bins, rows, one.gain, waves, of_work, 0.7)
    basis, curve = Basis(table, pattern, finest), Patterned(0.5 * one.bend, 2.0, 1.0, alpha, beta)
    count, trace, _ = general_path.walk(basis, curve, face.window(basis, curve), FURTHEST, True)
    return Case(basis, curve, count, trace, lambda x: float(general.coordinate(basis, curve, x)))


CASES = {
    "cosine": _cosine,
    "same cosine as a series": lambda: _series(ONE, 2.0, 1.0, 0.0),
    "series": lambda: _series(TWO, 2.3, 1.0, 0.0),
    "series by a machine": lambda: _series(TWO, 2.3, 0.7, 0.3),
    "series under a load": lambda: _series(TWO, 2.3, 0.0, 1.0),
    "short wave": lambda: _short_wave(ONE),
    "short waves": lambda: _short_wave(TWO),
    "patterned toughness": lambda: _patterned(ONE, False, 1.0, 0.0),
    "patterned work by a machine": lambda: _patterned(TWO, True, 0.7, 0.3),
    "patterned toughness under a load": lambda: _patterned(TWO, False, 0.0, 1.0),
}


@pytest.fixture(scope="module", params=CASES)
def case(request: pytest.FixtureRequest) -> Case:
    """Give a curve of every kind."""
    return CASES[request.param]()


@pytest.fixture(scope="module", params=[name for name in CASES if not name.startswith("short")])
def exact(request: pytest.FixtureRequest) -> Case:
    """Give a curve of every kind that is exact."""
    return CASES[request.param]()


@pytest.fixture(scope="module", params=[name for name in CASES if not name.startswith(("short", "patterned"))])
def sensed(request: pytest.FixtureRequest) -> Case:
    """Give a curve of every kind whose sensitivities the face knows."""
    return CASES[request.param]()


@pytest.fixture(scope="module", params=[name for name in CASES if name != "cosine"])
def profile(request: pytest.FixtureRequest) -> Case:
    """Give a curve of every kind but one cosine."""
    return CASES[request.param]()


def toughness(case: Case, x: float) -> float:
    """Give kappa, 1 where the interface is plain."""
    return 1.0 if isinstance(case.curve, Cosine) else float(case.ask("relative_toughness", x))


def jumps_of(case: Case) -> list[tuple[float, float]]:
    """Give the ends of some jumps: from the end of a branch outwards, and from the start of one inwards."""
    arrived = [branch for branch in range(case.count) if case.trace[START, branch] > 0.0]
    inner, outer = arrived[1], arrived[-2]
    return [
        (case.trace[END, inner], case.trace[START, outer] + 0.1),
        (case.trace[START, outer], case.trace[START, inner] + 0.1),
    ]


@pytest.mark.parametrize("name", DECLARED)
def test_each_function_is_answered_by_each_kind(name: str) -> None:
    """Short waves answer what a path asks, as a profile does: nothing else is computed of their leading form.

    Patterned interfaces have slopes of their own (sensitivities/patterned_slopes.py).
    """
    kinds = {Cosine, Series} if name in EXACT | OF_CONTACT | OF_SLOPES | OF_FOLDS else {Cosine, Series, ShortWave}
    kinds |= {Patterned} if name not in OF_SLOPES else set()
    kinds -= {Cosine} if name in OF_PROFILES | OF_FOLDS else set()
    assert {*DECLARED[name].answered()} == kinds
    declared = [*inspect.signature(DECLARED[name]).parameters]
    for kind in kinds:
        answer = [*inspect.signature(DECLARED[name].answer_of(kind)).parameters]
        assert len(answer) == len(declared)
        assert answer.index("curve" if "curve" in answer else "_curve") == declared.index("curve")


def test_a_place_is_where_the_branch_meets_the_level(case: Case) -> None:
    for branch in range(case.count):
        low, high = case.trace[START_DEPTH, branch], case.trace[END_DEPTH, branch]
        high = high if math.isfinite(high) else low + 1.0
        for share in (0.03, 0.5, 0.98):
            level = low + share * (high - low)
            x = case.ask("find_place", level, case.trace, branch)
            assert case.trace[START, branch] <= x <= case.trace[END, branch]
            assert abs(case.coordinate(x) - level) <= 1e-6 * (abs(high) + abs(low)) + 1e-9


def test_a_jump_loses_the_difference_of_two_that_end_in_zero_contact(case: Case) -> None:
    if isinstance(case.curve, Series) and case.curve.alpha == 0.0:
        assert case.ask("loss_to_zero", 2.3, 0.1) == 0.0, "it has no bound"
        return
    for start, end in jumps_of(case):
        level = case.coordinate(start)
        out, other = case.to_zero(start, level), case.to_zero(end, level)
        found = case.ask("loss_between", start, end, np.empty(16))
        assert found == pytest.approx(out - other, abs=1e-9 * (abs(out) + abs(other)))
        assert found != 0.0
        assert case.ask("loss_from_zero", end) == pytest.approx(-case.to_zero(end, 0.0), rel=1e-12)


def test_the_depth_is_the_coordinate_unless_a_load_has_a_share(case: Case) -> None:
    for x in (0.4, 3.3):
        level = case.coordinate(x)
        depth = case.ask("depth_at", x, level)
        if not isinstance(case.curve, Series):
            assert depth == level
            continue
        by_depth = general.coordinate(case.table, case.curve._replace(alpha=1.0, beta=0.0), x)
        assert depth == pytest.approx(by_depth, rel=1e-13)


def test_loading_arrives_where_the_level_of_the_jump_is_met(exact: Case) -> None:
    """What kernels of the path get from the face, compiled into them."""
    arrived = [branch for branch in range(exact.count) if exact.trace[ARRIVAL, branch] < math.inf]
    assert len(arrived) > 2
    for before, after in pairwise(arrived):
        x = exact.ask("find_place", exact.trace[END_DEPTH, before], exact.trace, after)
        assert exact.trace[ARRIVAL, after] == x


def test_sizes_bound_the_coordinate(exact: Case) -> None:
    for x in (0.02, 0.7, 5.3, 800.1):
        size = exact.ask("size_at", x)
        assert abs(exact.coordinate(x)) <= size <= exact.ask("most_size_at", x)


def test_folds_are_zeros_of_the_slope(exact: Case) -> None:
    for branch in range(1, exact.count - 1):
        for row in (START, END):
            x = exact.trace[row, branch]
            value, rate = exact.ask("fold_at", x)
            assert abs(value) <= 1e-9 * abs(rate)
            assert (rate > 0.0) == (row == START)
    for x in (0.3, 4.4):
        step = 1e-5
        (low, _), (high, _) = exact.ask("fold_at", x - step), exact.ask("fold_at", x + step)
        assert exact.ask("fold_at", x)[1] == pytest.approx((high - low) / (2.0 * TWO_PI * step), rel=1e-6, abs=1e-8)


def test_kappa_is_what_the_edge_pulls_with(profile: Case) -> None:
    """Of a pattern the depth falls short of that of the plain interface by (kappa - 1) z^c."""
    for x in (0.3, 4.4):
        if not isinstance(profile.curve, Patterned):
            assert profile.ask("relative_toughness", x) == 1.0
            continue
        table, pattern, _ = profile.table
        plain = Series(profile.curve.bend, profile.curve.exponent, pattern.gain, 1.0, 0.0)
        bare = general.coordinate(Basis(table, pattern.cosine_bins, pattern.waves), plain, x)
        own = general.coordinate(profile.table, profile.curve._replace(alpha=1.0, beta=0.0), x)
        expected = 1.0 + (bare - own) / (TWO_PI * x) ** (0.5 * (1.0 - K))
        assert profile.ask("relative_toughness", x) == pytest.approx(expected, rel=1e-11)


def test_nothing_is_shorter_than_the_shortest_wave(profile: Case) -> None:
    waves = [profile.table.series]
    if isinstance(profile.curve, Patterned):
        waves = [profile.table.cosine_bins.waves, profile.table.cosine_bins.rows]
    assert profile.ask("shortest_wave") == max(rows[:, 0].max() for rows in waves)


def test_all_folds_are_found_within_the_window(profile: Case) -> None:
    """Those of a fine grid, and none beyond the window, which ends in finite places here."""
    if isinstance(profile.curve, ShortWave):
        return
    first, last = profile.ask("window")
    assert 0.0 < first < last < math.inf
    zeros = np.empty(1000)
    count, rises, tangency = profile.ask("find_all_folds", first, last, zeros)
    places = np.concatenate([np.geomspace(1e-3 * first, first, 200), np.arange(first, 1.5 * last, 4e-3)])
    signs = np.array([profile.ask("fold_at", x)[0] >= 0.0 for x in places.tolist()])
    changes = np.flatnonzero(signs[1:] != signs[:-1])
    assert count == changes.size > 4
    assert (places[changes] <= zeros[:count]).all()
    assert (zeros[:count] <= places[changes + 1]).all()
    assert bool(rises) == signs[0]
    assert tangency == math.inf
    assert profile.ask("find_all_folds", first, last, np.empty(2))[0] == -1


def test_the_steepness_is_that_of_the_coordinate(sensed: Case) -> None:
    for branch in range(1, sensed.count - 1):
        assert abs(sensed.ask("steepness_at", sensed.trace[START, branch])) <= 1e-8
    for x in (0.3, 4.4):
        step = 1e-5
        slope = (sensed.coordinate(x + step) - sensed.coordinate(x - step)) / (2.0 * TWO_PI * step)
        assert sensed.ask("steepness_at", x) == pytest.approx(slope, rel=1e-6, abs=1e-8)


def test_the_slope_at_a_rim_is_that_of_the_loss(sensed: Case) -> None:
    step = 1e-4
    for x in (0.6, 3.7):
        ends = [sensed.ask("loss_from_zero", x * math.exp(i * step)) for i in (-2, -1, 1, 2)]
        expected = np.dot([1, -8, 8, -1], ends) / (12 * step)
        assert sensed.ask("rim_slope", 0.0, x) == pytest.approx(expected, rel=1e-7)


def test_slopes_are_those_of_the_losses(sensed: Case) -> None:
    """By bend and gain, in which a loss is a polynomial of degree 2; one cosine has its slope by b, a series by ln B."""
    curve = sensed.curve
    units = (curve.bend, curve.gain) if isinstance(curve, Cosine) else (1.0, 1.0)

    def other(share: float, gain: float) -> Case:
        changed = curve._replace(bend=share * curve.bend, gain=gain * curve.gain)
        return Case(sensed.table, changed, 0, None, sensed.coordinate)

    for start, end in jumps_of(sensed):
        total = np.zeros(SLOPES)
        sensed.ask("add_slopes", sensed.near, start, end, np.empty(ROOM), total)
        for row, factors in ((BEND, (1, 0)), (GAIN, (0, 1))):
            above, below = (
                other(*(1.0 + sign * factor for factor in factors)).ask("loss_between", start, end, np.empty(16))
                for sign in (0.5, -0.5)
            )
            assert units[row] * total[row] == pytest.approx(above - below, rel=1e-8, abs=1e-10)
    total = np.zeros(SLOPES)
    sensed.ask("add_slopes_to_zero", sensed.near, 2.3, False, total)
    for row, factors in ((BEND, (1, 0)), (GAIN, (0, 1))):
        above, below = (
            other(*(1.0 + sign * factor for factor in factors)).ask("loss_from_zero", 2.3) for sign in (0.5, -0.5)
        )
        assert units[row] * total[row] == pytest.approx(above - below, rel=1e-8)


def test_the_edge_of_a_contact(exact: Case) -> None:
    """Its parts add up to the depth, and depths exceed its own by those of the Hertzian profile."""
    curve, alone = exact.curve, exact
    if isinstance(curve, Series):
        alone = Case(exact.table, curve._replace(alpha=1.0, beta=0.0), 0, None, exact.coordinate)
    for x, other in ((0.4, 0.9), (3.3, 3.2), (3.3, 17.1)):
        edge = exact.ask("edge_at", x)
        depth, further = (float(alone.ask("coordinate_at", place, 0.0)) for place in (x, other))
        assert edge.x == x
        assert edge.stretch == pytest.approx((TWO_PI * x) ** (0.5 * (1.0 - K)), rel=1e-14)
        assert edge.bend + edge.wave - edge.stretch == pytest.approx(depth, rel=1e-12, abs=1e-14)
        excess, stretch = exact.ask("excess_at", edge, other)
        assert stretch == pytest.approx((TWO_PI * other) ** (0.5 * (1.0 - K)), rel=1e-14)
        assert excess == pytest.approx(further + toughness(exact, other) * stretch - depth, rel=1e-11, abs=1e-12)
    heights = np.empty(16)
    low, width = 3.5, 3.7**2 - 3.5**2
    edge = exact.ask("edge_at", 3.3)
    exact.ask("fill_heights", edge, low, width, heights)
    for node, found in zip(NODES, heights, strict=True):
        excess, stretch = exact.ask("excess_at", edge, math.sqrt(low * low + width * node))
        assert found == pytest.approx(excess * edge.stretch / stretch**2, abs=1e-12 * np.abs(heights).max())


def test_the_profile_is_that_of_the_depths(exact: Case) -> None:
    """The gap is one integral of depths outside the contact, and the profile less one of those within."""
    assert float(exact.ask("table_of")["k"]) == K
    assert exact.ask("profile_at", 0.0) == 0.0
    for a, r in ((0.3, 0.7), (1.3, 2.9)):
        edge = exact.ask("edge_at", a)
        near, far = (integral(exact.table, exact.curve, edge, r) for integral in (opening_near, opening_far))
        assert near == pytest.approx(far, rel=1e-9)


def test_the_profile_is_a_power_and_the_waves_of_the_punch(profile: Case) -> None:
    if isinstance(profile.curve, ShortWave):
        return
    _, rows, gain = profile.ask("punch_of")
    bend, m = (
        profile.curve.bend / (profile.curve.exponent * front_at(K, profile.curve.exponent)),
        profile.curve.exponent,
    )
    for x in (0.3, 1.7, 4.1):
        waves = sum(
            even * (1.0 - math.cos(TWO_PI * n * x)) + odd * math.sin(TWO_PI * n * x) for n, even, odd in rows.tolist()
        )
        expected = bend * (TWO_PI * x) ** m + gain * waves
        assert profile.ask("profile_at", x) == pytest.approx(expected, rel=1e-12)


def test_what_is_known_of_the_contact_beforehand(exact: Case) -> None:
    series = isinstance(exact.curve, Series)
    short, growth = exact.ask("panels_of")
    patterned = isinstance(exact.curve, Patterned)
    waves = exact.table[1].waves if patterned else exact.table[2] if series else ONE
    assert short == 1.0 / waves[:, 0].max()
    assert growth > 1.0
    for x in (0.7, 5.2):
        stretch = (TWO_PI * x) ** (0.5 * (1.0 - K))
        share = exact.curve.alpha + exact.curve.beta * (TWO_PI * x) ** (1.0 + K) if series else 1.0
        surely = exact.ask("surely_open", x)
        assert surely < share * stretch if patterned else surely == pytest.approx(share * stretch, rel=1e-13)
        assert surely <= share * stretch * toughness(exact, x) * (1.0 + 1e-13)
    for x, whole in ((0.7, 0.0), (0.2, 12.0)):
        coordinate = exact.ask("coordinate_at", x, whole)
        assert coordinate == pytest.approx(exact.coordinate(whole + x), rel=1e-11, abs=1e-12)
    assert not exact.ask("is_always_one_disc")
    assert exact.ask("touches_at_centre", 3.0)
    noted = exact.trace.copy()
    for least in (0.3, -0.1):
        noted[RUN, RUN_LEAST] = least
        assert exact.ask("waves_are_one_disc", noted) == (least > 0.0 or series)


def test_a_punch_that_touches_elsewhere_first() -> None:
    assert not _series(np.array([[1.0, -1.0, 0.0]]), 2.0, 1.0, 0.0).ask("touches_at_centre", 3.0)
    weak = _cosine()
    assert face.is_always_one_disc(weak.table, weak.curve._replace(gain=0.01))


def test_waves_that_were_not_walked() -> None:
    """Their slopes are those of their jumps, one by one; a kind whose traces have no gap says so by NaN."""
    one, series = _cosine(), _series(TWO, 2.3, 1.0, 0.0)
    table, curve = one.table, one.curve._replace(bend=CHI / (TWO_PI * 500.0) ** (0.5 * (1 + K)))
    wide = Case(table, curve, 0, None, one.coordinate, near=one.near)
    final = last_arch(table, curve, 0.5 * (1.0 - K))
    total, every = np.zeros(SLOPES), np.zeros(SLOPES)
    wide.ask("add_slopes_of_waves", wide.near, (30.0, 32.0), True, final, np.empty(ROOM), total)
    for wave in (30.0, 31.0, 32.0):
        end, level = branch_of_wave(table, curve, wave)[2:]
        _, _, high, high_level = branch_of_wave(table, curve, wave + 1.0)
        start, start_level = wide.ask("start_of_wave", wave + 1.0)
        assert (start, start_level) == branch_of_wave(table, curve, wave + 1.0)[:2]
        trace = np.full((ROWS, 1), np.nan)
        trace[[START, START_DEPTH, END, END_DEPTH], 0] = start, start_level, high, high_level
        wide.ask("add_slopes", wide.near, end, wide.ask("find_place", level, trace, 0), np.empty(ROOM), every)
    assert total[[BEND, GAIN, DEPTH]] == pytest.approx(every[[BEND, GAIN, DEPTH]], rel=1e-8)
    assert face.gap_in(curve, one.trace) == math.inf, "all of it was walked"
    assert face.gap_in(series.curve, series.trace) == math.inf
    assert np.isnan(series.ask("start_of_wave", 30.0)).all()
    total[:] = 0.0
    series.ask("add_slopes_of_waves", series.near, (30.0, 32.0), True, final, np.empty(ROOM), total)
    assert np.isnan(total).all()


def test_two_kinds_that_describe_one_curve_answer_the_same() -> None:
    one, series = _cosine(), _series(ONE, 2.0, 1.0, 0.0)
    assert one.count == series.count
    for branch in range(one.count - 1):
        level = 0.5 * (one.trace[START_DEPTH, branch] + one.trace[END_DEPTH, branch])
        places = [each.ask("find_place", level, each.trace, branch) for each in (one, series)]
        assert places[0] == pytest.approx(places[1], abs=1e-6)
    for name, arguments in {
        "loss_between": (3.1, 5.2, np.empty(16)),
        "loss_from_zero": (4.3,),
        "loss_to_zero": (4.3, -0.2),
        "depth_at": (2.2, one.coordinate(2.2)),
        "size_at": (2.2,),
        "fold_at": (2.2,),
        "steepness_at": (2.2,),
        "rim_slope": (0.3, 2.2),
        "coordinate_at": (0.2, 12.0),
        "surely_open": (2.2,),
        "profile_at": (2.3,),
        "edge_at": (2.2,),
        "excess_at": (one.ask("edge_at", 2.2), 2.6),
    }.items():
        assert one.ask(name, *arguments) == pytest.approx(series.ask(name, *arguments), rel=1e-11), name


def test_short_waves_come_to_the_exact_answers() -> None:
    """By one order in lambda over the radius."""
    for short, exact in ((_short_wave(ONE), _cosine()), (_short_wave(TWO), _series(TWO, 2.0, 1.0, 0.0))):
        for x in (10.0, 100.0):
            for name, arguments in (("loss_from_zero", (x,)), ("loss_to_zero", (x, 0.4))):
                assert short.ask(name, *arguments) == pytest.approx(exact.ask(name, *arguments), rel=0.5 / x), name


def test_a_curve_of_no_kind() -> None:
    with pytest.raises(TypeError, match="find_place has no answer for a curve of the type tuple"):
        face.find_place((), (0.1, 0.2, 0.0), 0.0, np.empty((ROWS, 1)), 0)


def test_another_coordinate_of_the_same_curve(profile: Case) -> None:
    if isinstance(profile.curve, ShortWave):
        return
    for by_load, shares in ((False, (1.0, 0.0)), (True, (0.0, 1.0))):
        measured = face.measured_by(profile.curve, by_load)
        assert type(measured) is type(profile.curve)
        assert measured == profile.curve._replace(alpha=shares[0], beta=shares[1])


def test_beyond_its_reach_the_coordinate_exceeds_a_target(profile: Case) -> None:
    """And not far within: waves are bounded by their sizes, which never meet."""
    if isinstance(profile.curve, ShortWave):
        return
    for target in (3.0, 400.0):
        x = profile.ask("reach", target)
        assert all(profile.coordinate(place) > target for place in np.geomspace(x, 10.0 * x, 2000).tolist())
        assert any(profile.coordinate(place) <= target for place in np.linspace(0.3 * x, x, 500).tolist())
