"""Every output of a map and every curve of a curve study, declared once: names, words, symbols, units and types."""

from dataclasses import dataclass, field
from typing import Final

OVER: Final = {
    "N": ("/(1.5 pi R dgamma)",),
    "J": ("/(R^2 dgamma)", ", in R^2 dgamma", " over R^2 dgamma"),
    "m": ("/R",),
    "m^2": (" (in R^2)",),
    "Pa": (" R/dgamma",),
}
"""How the words of a value say what it is over, by its unit in SI."""
_OVER_AS_SYMBOL: Final = {
    "N": r"\,/\,(\frac{3}{2}\pi R\Delta\gamma)",
    "J": r"\,/\,(R^2\Delta\gamma)",
    "m": "/R",
    "m^2": "/R^2",
    "Pa": r"\,R/\Delta\gamma",
}
"""The same in a symbol."""


def without_scale(about: str, unit: str) -> str:
    """Say what a value is in SI units, by what it is over its scale.

    >>> without_scale("energy dissipated in a loading cycle, H/(R^2 dgamma)", "J")
    'energy dissipated in a loading cycle, H'
    """
    for over in OVER[unit]:
        about = about.replace(over, "")
    return about


@dataclass(frozen=True)
class Output:
    """An output of a map: one value a scene.

    >>> OUTPUTS["pull_off_radius"].symbol, OUTPUTS["pull_off_radius"].symbol_in_si
    ('radius at pull-off $a/R$', 'radius at pull-off $a$')
    """

    name: str
    about: str
    """What it is; its `long_name`."""
    symbol_in_si: str
    """How a picture calls it where it has its unit."""
    group: str
    """Where it comes from: the "cycle", where it "turn"s, its "edge", its "rate", a "report" on request, the "validity"
    of the model, the "slope" of the punch, or a "sensitivity"."""
    unit: str = ""
    """In SI; empty for a number."""
    depends_on: str = "cycle"
    """What of a cycle it depends on: how "loading" reaches full contact, the "pull-off" alone, all of the "cycle", or
    nothing."""
    is_count: bool = False
    exact_alone: bool = False
    """Whether the exact solver alone has it."""
    has_spread: bool = True
    """Whether a spread of it is known: of no count, nor of what is known of other values."""
    needs_turn: bool = False
    """Whether it has no bound on an unbounded punch that closes at less work than it opens at and does not turn."""
    needs: str = ""
    """The group of inputs without which it is not known."""

    @property
    def symbol(self) -> str:
        """How a picture calls it, over its scale."""
        scale = _OVER_AS_SYMBOL.get(self.unit, "")
        words, dollar, _ = self.symbol_in_si.rpartition("$")
        if not scale or dollar:
            return words + scale + dollar if dollar else self.symbol_in_si
        bare = scale.lstrip(r"\,")  # without the space before it
        return f"{self.symbol_in_si} ${bare}$"


OUTPUTS: Final = {one.name: one for one in (
    Output("pull_off_force", "pull-off force F/(1.5 pi R dgamma)", "pull-off force $F$", "cycle", "N", "pull-off"),
    Output("pull_off_radius", "contact radius a/R at pull-off", "radius at pull-off $a$", "cycle", "m", "pull-off"),
    Output("dissipated_energy", "energy dissipated in a loading cycle, H/(R^2 dgamma)", "dissipated energy $H$",
           "cycle", "J", "loading", needs_turn=True),
    Output("loading_jumps", "number of jumps on loading, including the jump-in", "jumps on loading", "cycle",
           depends_on="loading", is_count=True, has_spread=False),
    Output("unloading_jumps", "number of jumps on unloading, including the jump-out", "jumps on unloading", "cycle",
           is_count=True, has_spread=False),
    Output("delta_max", "indentation depth delta/R at which unloading starts, the greatest if the depth is controlled",
           r"greatest depth $\delta_{\max}$", "cycle", "m", "loading"),
    Output("delta_jump_out", "indentation depth delta/R at the jump-out", r"depth at jump-out $\delta$", "cycle", "m"),
    Output("loading_energy", "energy dissipated on loading, H/(R^2 dgamma)", "energy of loading $H$", "cycle", "J",
           "loading"),
    Output("unloading_energy", "energy dissipated on unloading, H/(R^2 dgamma)", "energy of unloading $H$", "cycle",
           "J"),
    Output("turning_radius", "contact radius a/R at which unloading starts (0: no contact is made)",
           "turning radius $a_t$", "turn", "m"),
    Output("front_energy", "energy of the edge, which opens at more work than it closes at, in a cycle, H/(R^2 dgamma)",
           "energy of the edge $H$", "edge", "J", needs_turn=True),
    Output("snap_in_force", "pull just after the jump into contact P/(1.5 pi R dgamma)", "snap-in force $P$", "edge",
           "N", exact_alone=True),
    Output("pinned_depth", "depth delta/R by which the punch moves back before the edge opens",
           r"pinned depth $\delta$", "edge", "m", needs_turn=True),
    Output("edge_speed_at_pull_off", "speed of the edge over its reference speed at the pull-off, v/v*",
           "speed of the edge at pull-off $v/v^*$", "rate", needs="rate"),
    Output("rate_coefficient", "gain of the pull-off force over (V/v*)^n as the speed tends to 0", "rate coefficient",
           "rate", needs="rate"),
    Output("energy_residual", "dissipated energy less the loop integral of the load over the depth, in R^2 dgamma",
           "residual of the energy", "report", "J", exact_alone=True, has_spread=False, needs_turn=True),
    Output("roughness_parameter", "roughness parameter chi = r/s of the waviness", r"roughness parameter $\chi$",
           "report", depends_on="", exact_alone=True),
    Output("saturation_radius", "contact radius a/R beyond which the curve has no fold", "saturation radius $a$",
           "report", "m", exact_alone=True),
    Output("adhesion_gain", "pull-off force over that of the smooth punch of the same material and radius",
           "gain in force $F/F_0$", "report", depends_on="pull-off", exact_alone=True),
    Output("energy_gain", "dissipated energy over that of the smooth punch of the same material and radius",
           "gain in energy $H/H_0$", "report", depends_on="loading", exact_alone=True, needs_turn=True),
    Output("tabor_parameter", "Tabor parameter of the punch: height of its neck over the range of the attraction",
           r"Tabor parameter $\mu$", "validity", depends_on="", needs="range"),
    Output("wave_tabor_parameter", "Tabor parameter of the crests of the waviness",
           r"Tabor parameter of crests $\mu_w$", "validity", depends_on="", needs="range"),
    Output("wave_slope", "steepest slope of the waviness", "steepest slope of the waves", "validity",
           depends_on=""),
    Output("johnson_alpha", "Johnson's parameter alpha = 1/(sqrt(pi) chi) of the waviness", r"Johnson's $\alpha$",
           "validity", depends_on=""),
    Output("contact_slope", "slope of the punch at the largest contact radius that the other outputs depend on",
           r"contact slope $(a/R)^{m-1}$", "slope", has_spread=False),
    Output("pull_off_force_sensitivity",
           "sensitivity of the pull-off force F to each parameter p: d ln F/d ln p (k, nu: /dp)", r"strongest on $F$",
           "sensitivity", depends_on="pull-off", exact_alone=True, has_spread=False),
    Output("dissipated_energy_sensitivity",
           "sensitivity of the energy H to each parameter p: d ln H/d ln p (k, nu: /dp)", r"strongest on $H$",
           "sensitivity", depends_on="loading", exact_alone=True, has_spread=False, needs_turn=True),
)}  # fmt: skip
"""Every output of a map, in the order of a dataset."""
GIVEN_UP: Final = {
    "pull_off_force_error": "its accuracy is promised in docs/accuracy.md and checked by `gradhesion verify`",
    "dissipated_energy_error": "its accuracy is promised in docs/accuracy.md and checked by `gradhesion verify`; "
    "energy_residual is a measure of it in every scene",
}
"""Outputs of earlier versions, with what stands in their place."""


def outputs_in(*groups: str) -> tuple[str, ...]:
    """Name the outputs of some groups, in the order of a dataset.

    >>> outputs_in("rate")
    ('edge_speed_at_pull_off', 'rate_coefficient')
    """
    return tuple(name for name, one in OUTPUTS.items() if one.group in groups)


@dataclass(frozen=True)
class Variable:
    """A variable of a curve."""

    name: str
    about: str
    unit: str = ""
    """In SI; empty for a number."""
    dtype: str = "f8"
    meanings: str = ""
    """What 0 and 1 mean, where it is a flag."""


@dataclass(frozen=True)
class Curve:
    """A curve of a curve study: one a scene."""

    name: str
    extent: str
    """The dimension along it."""
    variables: tuple[Variable, ...]
    depends_on: str = ""
    """What of a cycle it depends on: how "loading" reaches full contact, or nothing of that."""
    needs_depth: bool = False
    """Whether it is known at a prescribed depth alone."""
    knows_pattern: bool = False
    """Whether it is known of an interface whose toughness varies with the radius."""
    knows_rate: bool = True
    """Whether it is known of an edge with a speed."""
    of_a_state: bool = False
    """Whether it belongs to a state of contact, along the radius, in the place of the scene."""
    count: str = ""
    """The variable that counts the items of each scene, where those of all scenes follow one another."""
    names: tuple[str, ...] = field(init=False)
    """Those of its variables."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", tuple(one.name for one in self.variables))


def _states(name: str, where: str) -> tuple[Variable, ...]:
    """Declare radius, depth and load of a curve; `where` ends the words for them."""
    return (
        Variable(f"{name}_contact_radius", f"contact radius a/R {where}", "m"),
        Variable(f"{name}_indentation", f"indentation depth delta/R {where}", "m"),
        Variable(f"{name}_load", f"load P/(1.5 pi R dgamma) {where}", "N"),
    )


def _of_equilibrium(name: str, point: str, start: str = "", of: str = "") -> Curve:
    """Declare a curve of equilibria: radius, depth and load, and whether they are stable."""
    return Curve(name, point, (
        Variable(f"{start}contact_radius", f"contact radius a/R{of}", "m"),
        Variable(f"{start}indentation", f"indentation depth delta/R in equilibrium{of}", "m"),
        Variable(f"{start}load", f"load P/(1.5 pi R dgamma) in equilibrium{of or ', negative if it pulls'}", "N"),
        Variable(f"{start}stable", f"whether the equilibrium{of} is stable under the control of the study", dtype="i1",
                 meanings="unstable stable"),
    ), knows_pattern=True)  # fmt: skip


_WAYS: Final = "loading unloading"

CURVES: Final = {one.name: one for one in (
    _of_equilibrium("equilibrium", "point"),
    _of_equilibrium("closing_equilibrium", "closing_point", "closing_", " of an edge that closes"),
    Curve("path", "path_point", (
        *_states("path", "on the path of a loading cycle"),
        Variable("path_branch", "stable branch of the path, counted from inside (0: out of contact)", dtype="i4"),
        Variable("path_jump", "whether the point is reached by a jump", dtype="i1",
                 meanings="along_a_branch by_a_jump"),
        Variable("path_unloading", "whether the path is loading or unloading", dtype="i1", meanings=_WAYS),
    ), depends_on="loading", knows_pattern=True),
    Curve("asymptotic", "asymptotic_point", _states("asymptotic", "of the asymptotic curve"), needs_depth=True),
    Curve("envelope", "envelope_point", (
        Variable("envelope_contact_radius", "contact radius a/R of the envelopes", "m"),
        Variable("loading_envelope_indentation", "indentation depth delta/R of the loading envelope", "m"),
        Variable("loading_envelope_load", "load P/(1.5 pi R dgamma) of the loading envelope", "N"),
        Variable("unloading_envelope_indentation", "indentation depth delta/R of the unloading envelope", "m"),
        Variable("unloading_envelope_load", "load P/(1.5 pi R dgamma) of the unloading envelope", "N"),
    ), needs_depth=True),
    Curve("effective", "effective_point", (
        *_states("effective", "on the effective path between the envelopes"),
        Variable("effective_jump", "whether the point of the effective path is reached by a jump", dtype="i1",
                 meanings="along_an_envelope by_a_jump"),
    ), needs_depth=True),
    Curve("smooth", "smooth_point", _states("smooth", "of the punch without waviness")),
    Curve("jumps", "jump", (
        Variable("jump_count", "number of jumps of a loading cycle; those of all scenes follow one another",
                 dtype="i4"),
        Variable("jump_indentation", "indentation depth delta/R before the jump; constant under displacement control",
                 "m"),
        Variable("jump_radius_before", "contact radius a/R before the jump (0: no contact)", "m"),
        Variable("jump_radius_after", "contact radius a/R after the jump (0: no contact)", "m"),
        Variable("jump_energy", "energy dissipated by the jump over R^2 dgamma (negative: gained)", "J"),
        Variable("jump_load_before", "load P/(1.5 pi R dgamma) before the jump", "N"),
        Variable("jump_load_after", "load P/(1.5 pi R dgamma) after the jump", "N"),
        Variable("jump_unloading", "whether the jump is on loading or on unloading", dtype="i1", meanings=_WAYS),
        Variable("jump_at_rim", "whether the jump starts or ends at the rim", dtype="i1",
                 meanings="within_the_rim at_the_rim"),
    ), depends_on="loading", knows_pattern=True, knows_rate=False, count="jump_count"),
    Curve("pressure", "pressure_point", (
        Variable("pressure_radius", "distance r/R from the axis under the punch", "m"),
        Variable("pressure", "contact pressure p R/dgamma, positive in compression", "Pa"),
    ), knows_rate=False, of_a_state=True),
    Curve("surface", "surface_point", (
        Variable("surface_radius", "distance r/R from the axis", "m"),
        Variable("surface_displacement", "displacement u_z/R of the surface, positive into the half-space", "m"),
        Variable("surface_gap", "gap/R between the surfaces (missing beyond the rim)", "m"),
    ), knows_rate=False, of_a_state=True),
)}  # fmt: skip
"""Every curve of a curve study, in the order of a dataset; those of a scene before those of a state."""
VARIABLES: Final = {one.name: one for curve in CURVES.values() for one in curve.variables}
"""Every variable of a curve."""
