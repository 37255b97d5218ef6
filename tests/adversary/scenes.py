"""Scenes of all classes against interval arithmetic: one cosine, hostile and eventful, and any profile and control."""

import time
from typing import Final

from tests.stress.draw import eventful, hostile
from tests.twin.compare import compare, compare_general

SHARE_OF_GENERAL: Final = 0.15
"""Scenes of other profiles and controls: each costs some ten times as much."""
WAVES: Final = 60.0
"""Waves of a scene, at most."""


def trials_of_scenes(count: int, seed: int) -> tuple[str, float]:
    """Solve scenes both ways; give what came of them, and the largest error in shares of what is promised."""
    start, general = time.monotonic(), round(SHARE_OF_GENERAL * count)
    half = (count - general) // 2
    made = [compare(draw(seed, 2 * half), (0.0, WAVES), half) for draw in (hostile, eventful)]
    made += [compare_general(seed, 2 * general, WAVES, general)]
    scenes, worst = [one.scenes for one in made], max(one.worst for one in made)
    words = (
        f"{sum(scenes):,} scenes against interval arithmetic ({scenes[0]:,} hostile, {scenes[1]:,} eventful, {scenes[2]:,} of any profile and "
        f"control; seed {seed}): the largest error is {worst:.2g} of what is promised; {time.monotonic() - start:.0f} s"
    )
    return words, worst
