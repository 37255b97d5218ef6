"""The kinds of work: each has kernels of its own, which are compiled on its first use.

    force              the pull-off of one cosine wave under displacement control, by the exact solver
    energy             anything else of `OUTPUTS` of it
    long               the same where contact passes more than `MANY_WAVES`
    smooth             both of many punches whose waves have no effect
    reports            `REPORTS` of it
    turning            where its cycles turn before the rim
    envelope           the envelopes of it
    curves             the curves of it
    sensitivities      how strongly its force and energy depend on its parameters
    long_sensitivities
    general_force      the same of any other profile or control
    general_energy
    general_long
    general_reports
    general_turning
    general_sensitivities
    general_long_sensitivities
    general_envelope
    general_curves
    edge               where an edge that closes at less work jumps in, and how its turning point moves
    asymptotic         the asymptotic solver of any profile
    patterned          maps of interfaces whose toughness varies with the radius
    patterned_reports  `REPORTS` of them
    patterned_turning  where their cycles turn before the rim
    patterned_sensitivities
    patterned_curves
    rate               opening and closing at a speed, of any profile and control
    loops              fits of measured loops, but for the reports on the fitted cycle

and `tables` is what all of them share.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Final

from gradhesion.core.problem.control import BY_DISPLACEMENT, Loading
from gradhesion.core.problem.names import PULL_OFF, REPORTS
from gradhesion.core.problem.profile import WAVY, Profile
from gradhesion.core.problem.shape import equivalent_wave

if TYPE_CHECKING:
    from gradhesion.core.problem.toughness import Toughness

_WORK: Final[dict[str, tuple[tuple[str, ...], int, float]]] = {
    "tables": ((), 56, 3.0),
    "force": (("tables",), 56, 1.5),
    "energy": (("tables",), 174, 5.5),
    "long": (("energy",), 64, 5.0),
    "smooth": (("tables",), 33, 1.5),
    "reports": (("energy",), 64, 4.5),
    "turning": (("energy",), 79, 6.0),
    "envelope": (("tables",), 13, 0.5),
    "curves": (("energy",), 49, 4.0),
    "sensitivities": (("energy",), 49, 6.0),
    "long_sensitivities": (("sensitivities",), 56, 6.5),
    "general_force": (("tables",), 99, 5.5),
    "general_energy": (("tables",), 253, 13.0),
    "general_long": (("general_energy",), 32, 5.5),
    "general_reports": (("general_energy",), 42, 5.5),
    "general_turning": (("general_energy",), 33, 6.0),
    "general_sensitivities": (("general_energy",), 48, 8.5),
    "general_long_sensitivities": (("general_sensitivities",), 34, 8.0),
    "general_envelope": (("tables",), 0, 0.0),
    "general_curves": (("general_energy",), 38, 8.0),
    "edge": (("tables",), 28, 2.0),
    "asymptotic": (("tables",), 68, 3.0),
    "patterned": (("tables",), 158, 8.0),
    "patterned_reports": (("patterned",), 15, 2.0),
    "patterned_turning": (("patterned",), 15, 3.5),
    "patterned_sensitivities": (("patterned",), 18, 4.0),
    "patterned_curves": (("patterned",), 16, 3.5),
    "rate": (("general_force",), 44, 3.5),
    "loops": (("tables",), 13, 1.0),
}
"""Of each kind, after those that it needs: these, and about how many kernels it compiles and how long that takes."""
NEEDS: Final = {kind: needed for kind, (needed, _, _) in _WORK.items()}
"""The kinds that are compiled before a kind, directly: those of whose entries it needs the same, or others of the same
name. Processes that compile kinds side by side, each after those that it needs and none beside one of `APART`, compile
no entry twice, and no two write to one index of the cache."""
MANY_SMOOTH: Final = 4096
"""Scenes of smooth punches in a call from which on kernels of their own solve them."""
MANY_WAVES: Final = {"": 80.0, "general_": 512.0}
"""Waves within a rim up to which all are walked, so that no kernels of long curves are needed: of one cosine, and of
the shortest harmonic of other profiles."""
_OF_ONE_NAME: Final = (
    ("force", "energy", "long", "envelope", "sensitivities", "long_sensitivities"),
    ("general_force", "general_energy", "general_sensitivities", "patterned", "patterned_sensitivities"),
    ("general_long", "general_long_sensitivities"),
    ("general_turning", "patterned_turning"),
    ("general_reports", "patterned_reports"),
    ("curves", "general_curves", "patterned_curves"),
)
"""Kinds whose loops over curves are entries of the same name (scene/solvers.py, scene/general.py)."""
APART: Final = (
    *({one, other} for kinds in _OF_ONE_NAME for one, other in combinations(kinds, 2)),
    *({"smooth", other} for other in ("force", "energy", "envelope")),
)
"""Kinds that do not need each other, and yet compile entries of the same name: not to be compiled side by side."""
KINDS: Final = tuple(NEEDS)
"""All kinds, each after those that it needs."""
KERNELS: Final = {kind: kernels for kind, (_, kernels, _) in _WORK.items()}
"""About how many kernels a kind compiles after those that it needs, in one process."""
CPU_SECONDS: Final = {kind: seconds for kind, (_, _, seconds) in _WORK.items()}
"""About how long that takes one core, on a machine where both outputs of a first map take 9 s."""


def before(kind: str) -> set[str]:
    """Return all kinds that are compiled before a kind.

    Examples
    --------
    >>> sorted(before("reports"))
    ['energy', 'tables']
    """
    return {*NEEDS[kind]}.union(*map(before, NEEDS[kind]))


def kind_of_map(
    outputs: Sequence[str],
    solver: str = "exact",
    profile: Profile | None = None,
    loading: Loading | None = None,
    toughness: Toughness | None = None,
) -> str:
    """Return the kind of work that `solve` does, by its arguments.

    Examples
    --------
    >>> kind_of_map(["pull_off_force"]), kind_of_map(["pull_off_force"], profile=Profile(exponent=1.5))
    ('force', 'general_force')
    """
    if toughness is not None:
        return "patterned_reports" if any(name in REPORTS for name in outputs) else "patterned"
    if solver == "asymptotic":
        return solver
    profile, loading = profile or WAVY, loading or BY_DISPLACEMENT
    general = "general_" if loading != BY_DISPLACEMENT or equivalent_wave(profile) is None else ""
    if solver != "exact":
        return general + solver
    if any(name in REPORTS for name in outputs):
        return general + "reports"
    return general + ("force" if set(outputs) <= set(PULL_OFF) else "energy")


def kinds_of_long(kinds: Sequence[str], waves: float, profile: Profile | None = None) -> tuple[str, ...]:
    """Return the kinds of work for cycles of many waves that others leave, where rims contain so many wavelengths.

    Examples
    --------
    >>> kinds_of_long(["energy"], 70.0), kinds_of_long(["energy", "sensitivities"], 90.0)
    ((), ('long', 'long_sensitivities'))
    """
    waves *= max((one.n for one in (profile or WAVY).harmonics), default=1)
    found: dict[str, None] = {}
    for kind in kinds:
        family = "general_" if kind.startswith("general_") else ""
        ending = {"energy": "", "reports": "", "sensitivities": "_sensitivities"}.get(kind.removeprefix(family))
        if ending is not None and waves > MANY_WAVES[family]:
            found[f"{family}long{ending}"] = None
    return tuple(found)


def kind_of_turning(
    profile: Profile | None = None, loading: Loading | None = None, toughness: Toughness | None = None
) -> str:
    """Return the kind of work that `solve` does besides where cycles turn before the rim, by its arguments.

    Examples
    --------
    >>> kind_of_turning(), kind_of_turning(loading=Loading(control="load"))
    ('turning', 'general_turning')
    """
    if toughness is not None:
        return "patterned_turning"
    profile, loading = profile or WAVY, loading or BY_DISPLACEMENT
    return "turning" if loading == BY_DISPLACEMENT and equivalent_wave(profile) is not None else "general_turning"


def kind_of_sensitivities(
    profile: Profile | None = None, loading: Loading | None = None, toughness: Toughness | None = None
) -> str:
    """Return the kind of work that `solve` does besides where sensitivities are requested, by its arguments.

    Examples
    --------
    >>> kind_of_sensitivities(), kind_of_sensitivities(loading=Loading(control="load"))
    ('sensitivities', 'general_sensitivities')
    """
    return kind_of_turning(profile, loading, toughness).replace("turning", "sensitivities")


def kind_of_curves(
    profile: Profile | None = None, loading: Loading | None = None, toughness: Toughness | None = None
) -> str:
    """Return the kind of work that `draw_curves` does, by its arguments.

    Examples
    --------
    >>> kind_of_curves(), kind_of_curves(loading=Loading(control="load"))
    ('curves', 'general_curves')
    """
    if toughness is not None:
        return "patterned_curves"
    default = (profile or WAVY) == WAVY and (loading or BY_DISPLACEMENT) == BY_DISPLACEMENT
    return "curves" if default else "general_curves"
