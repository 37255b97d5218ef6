"""The scenes of a dataset: its dimensions, the flags of its status, and where its values come from."""

from typing import Final

SCENE: Final = "scene"
"""The one dimension of a dataset with `layout = "points"`."""

SOLVER: Final = "solver"
"""The first dimension of a dataset with several solvers."""

REALISATION: Final = "realisation"
"""The last dimension of the scenes of random roughness."""

REALISATIONS: Final = "realisation of the random roughness"
"""The `long_name` of `realisation`."""

SOLVERS: Final = "how the scenes are solved"
"""The `long_name` of `solver`."""

IDLE: Final = "without effect"
"""What the comment of a coordinate begins with that is there for completeness."""

STATUS: Final = "flags of a scene (0: nothing to report)"
"""The `long_name` of `status`."""

FLAG_WORDS: Final = {
    "loading_contact_not_one_disc": "contact on loading is not one disc",
    "unloading_contact_not_one_disc": "contact on unloading is not one disc",
    "pull_off_at_rim": "the pull-off is at the rim",
    "jump_in_to_rim": "the jump-in reaches the rim",
    "close_to_a_jump": "an input error of 1e-10 could change a number of jumps or the place of the pull-off",
    "tolerance_not_met": "the requested accuracy is not reached",
    "no_value": "a parameter is outside its range, or the scene cannot be resolved",
    "linear_deviation_off": "a linear standard deviation is off: a kink is near",
    "resolution_too_coarse": "a sweep finer than the resolution finds another optimum",
    "nothing_feasible": "no point of the sweep meets the requirements",
    "no_contact": "the cycle turns before first contact",
    "too_many_waves": "the contact contains more waves than can be followed",
    "poor_fit": "the residual exceeds the noise",
    "another_minimum": "other values fit the loop as well within its noise",
}
"""Every flag of `status`, in words."""

STEEP: Final = "steep_contact"
"""The coordinate that marks the scenes whose contact reaches a slope of the punch that is not small, if any does."""

STEEP_CONTACT: Final = "whether the contact reaches a slope of the punch above 1"
"""Its `long_name`."""

REFERENCES: Final = (
    "Jin, Guo & Wan (2013), Mechanics of axisymmetric adhesive contact of rough surfaces involving power-law graded "
    "materials; Johnson, Kendall & Roberts (1971), Surface energy and the contact of elastic solids"
)
"""The theory behind the values."""
