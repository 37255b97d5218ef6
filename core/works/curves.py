"""Curves of one scene that opens at a larger work of adhesion than it closes at: one is drawn for each, and joined.

The path climbs the closing curve and descends the opening one; between them it is pinned, a straight line at the radius
at which the edge turns. Equilibrium, the smooth curve and states belong to opening, `closing_equilibrium` to closing.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curves.draw import draw_curves, subject_for
from gradhesion.core.curves.effective import turning_place
from gradhesion.core.curves.envelope import draw_envelope, envelopes_of
from gradhesion.core.curves.subject import BEYOND
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import CLOSING, CURVES, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import FAILED, NO_VALUE
from gradhesion.core.problem.toughness import Toughness
from gradhesion.core.sweep import How, solve
from gradhesion.core.works.cycle import LEAST, closing_parameters, starts_downwards

_OF_A_CYCLE: Final = ("path", "jumps", "effective")
_CLOSING: Final = "closing_equilibrium"
_SIGNS: Final = ("_load", "load_before", "load_after", "jump_energy")
"""Ends of the names of what is in units of the work of adhesion."""
Curves = dict[str, NDArray[Any]]


def _in_opening_units(found: Curves, ratio: float) -> Curves:
    """Return the variables of a scene that was solved at the work of closing over that of opening."""
    held = max(ratio, LEAST)
    return {
        name: held * values if name == "load" or name.endswith(_SIGNS) else values for name, values in found.items()
    }


def _joined_path(up: Curves, down: Curves, corner: tuple[float, float, float], grows: bool) -> Curves:
    """Return loading of one path, unloading of another, and between them the pinned stretch down to a corner.

    The corner is the radius, depth and load at which the edge opens; contact `grows` from a point where it closes
    without adhesion.
    """
    climbs, descends = up["path_unloading"] == 0, down["path_unloading"] == 1
    radius, depth = down["path_contact_radius"], down["path_indentation"]
    descends &= ~((radius == radius.max()) & (depth >= corner[1]) & (down["path_jump"] == 0))
    branch = up["path_branch"][climbs][-1]
    middle = dict(zip(CURVES["path"], (*corner, branch, 0, 1), strict=True))
    path = {
        name: np.concatenate([up[name][climbs], np.array([middle[name]], up[name].dtype), down[name][descends]])
        for name in CURVES["path"]
    }
    if grows:  # from a point, without a jump
        path["path_jump"][1] = 0
    return path


def _joined_jumps(up: Curves, down: Curves, grows: bool) -> Curves:
    """Return the jumps of loading of one list, and those of unloading of another one."""
    loading, unloading = up["jump_unloading"] == 0, down["jump_unloading"] == 1
    loading[:1] &= not grows
    return {name: np.concatenate([up[name][loading], down[name][unloading]]) for name in CURVES["jumps"]}


def _joined_envelopes(
    closing: Mapping[str, float], opening: Mapping[str, float], ratio: float, profile: Profile
) -> Curves | None:
    """Return the loading envelope at the work of closing, and the unloading one at that of opening."""
    down = subject_for(opening, profile, Loading())
    up = None if down is None else subject_for({**closing, "a_max_over_R": down.end}, profile, Loading())
    if up is None or down is None:
        return None
    radii = np.union1d(*(draw_envelope(one, profile)["envelope_contact_radius"] for one in (up, down)))
    found: Curves = {"envelope_contact_radius": radii}
    forms = envelopes_of(up, profile).up, envelopes_of(down, profile).down
    for name, form, unit in zip(("loading", "unloading"), forms, (max(ratio, LEAST), 1.0), strict=True):
        _, depth, load = form.scaled(form.states(radii / form.radius_scale))
        found |= {f"{name}_envelope_indentation": depth, f"{name}_envelope_load": unit * load}
    return found


def _joined_effective(
    closing: Mapping[str, float], opening: Mapping[str, float], ratio: float, profile: Profile
) -> Curves:
    """Return loading of the effective path at the work of closing, and unloading at that of opening."""
    rims = {}
    if not opening["a_max_over_R"] < math.inf:
        subjects = [subject_for(scene, profile, Loading()) for scene in (closing, opening)]
        envelopes = [(one, envelopes_of(one, profile)) for one in subjects if one is not None]
        turns = [turning_place(one, own) * own.up.radius_scale for one, own in envelopes]
        rims = {"a_max_over_R": max(turns, default=math.nan)}
    up, down = (draw_curves({**scene, **rims}, ["effective"], profile)[0] for scene in (closing, opening))
    up = _in_opening_units(up, ratio)
    first = int(np.argmax(up["effective_contact_radius"]))
    radii = down["effective_contact_radius"]
    last = radii.size - 1 - int(np.argmax(radii[::-1]))
    return {name: np.concatenate([up[name][: first + 1], down[name][last:]]) for name in CURVES["effective"]}


def draw_two_works(
    scene: Mapping[str, float],
    curves: Sequence[str],
    profile: Profile,
    loading: Loading,
    toughness: Toughness | None = None,
) -> tuple[Curves, int]:
    """Return curves of one scene that has a `closing_ratio`, as `draw_curves` (curves/draw.py) those of other scenes.

    Loads are in 1.5 pi R w_o and energies in R^2 w_o. On the path the pinned stretch is unloading, and no jump. A punch
    that is unbounded and does not turn turns at the end of the drawn range.
    """
    ratio = float(scene[CLOSING])
    plain = {name: value for name, value in scene.items() if name != CLOSING}
    shape: dict[str, Any] = {"profile": profile, "loading": loading, "toughness": toughness}
    if ratio == 1.0:
        others = [curve for curve in curves if curve not in (_CLOSING, "equilibrium")]
        alike, status = draw_curves(plain, [*others, "equilibrium"], **shape)
        alike |= {f"closing_{name}": alike[name] for name in CURVES["equilibrium"]}
        return {name: alike[name] for curve in curves for name in CURVES[curve]}, status
    turn = next((name for name in TURNS if name in scene), None)
    bare = {name: value for name, value in plain.items() if name != turn}
    made = closing_parameters(plain, np.asarray(ratio))
    closing = {name: float(np.asarray(value)) for name, value in made.items()}
    bare_closing = {name: value for name, value in closing.items() if name != turn}
    solved = solve(scene, ["turning_radius", "pull_off_radius", "loading_jumps"], **shape, threads=1)
    radius, status = float(solved["turning_radius"]), int(solved["status"])
    if status & NO_VALUE:
        return draw_curves({**bare, "a_max_over_R": math.nan}, curves, **shape)
    rim, end = scene["a_max_over_R"], {}
    if not rim < math.inf:
        reached = BEYOND * max(radius, float(solved["pull_off_radius"]))
        if not reached < math.inf:
            both = (draw_curves(one, ["equilibrium"], **shape)[0] for one in (bare, bare_closing))
            radius = reached = float(max(one["contact_radius"][-1] for one in both))
        end = {"a_max_over_R": reached}
    how = How("exact", False, 1, profile, loading, is_one_wave=False)
    grows = ratio == 0.0 and not bool(starts_downwards(plain, how))
    found: Curves = {}
    flags = 0

    def drawn(which: Mapping[str, float], curve: str, **change: float) -> Curves:
        """Draw one curve of a scene, and note what is reported of it."""
        nonlocal flags
        variables, own = draw_curves({**which, **change}, [curve], **shape)
        flags |= own & FAILED
        return variables

    for curve in curves:
        if curve not in (*_OF_A_CYCLE, "envelope", _CLOSING):
            found |= drawn(bare, curve, **end)
        elif curve == _CLOSING:
            own = _in_opening_units(drawn(bare_closing, "equilibrium", **end), ratio)
            found |= {f"closing_{name}": values for name, values in own.items()}
        elif radius == 0.0:
            found |= drawn(plain, curve)
        elif curve == "envelope":
            joined = _joined_envelopes({**bare_closing, **end}, {**bare, **end}, ratio, profile)
            found |= drawn(bare, curve, a_max_over_R=math.nan) if joined is None else joined
        elif curve == "effective":
            rims = {"a_max_over_R": radius} if turn else {}
            found |= _joined_effective({**bare_closing, **rims}, {**bare, **rims}, ratio, profile)
        else:
            up = _in_opening_units(drawn(bare_closing, curve, a_max_over_R=radius), ratio)
            down = drawn(bare, curve, a_max_over_R=radius)
            if curve == "jumps":
                own = _joined_jumps(up, down, grows)
                if radius < rim:
                    own["jump_at_rim"][:] = 0
            else:
                edge = drawn(bare, "equilibrium", a_max_over_R=radius)
                corner = (radius, float(edge["indentation"][-1]), float(edge["load"][-1]))
                own = _joined_path(up, down, corner, grows)
            found |= own
    if {*curves} & {"path", "jumps"}:
        flags |= status & ~FAILED
    return found, flags
