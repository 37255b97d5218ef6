"""How wide a tie is: a billionth away from a change of the jumps nothing is flagged, and nothing is to be.

That both sides of every change are flagged, and random scenes are not, is asserted in tests/conformance.
"""

from typing import Any

import numpy as np

from gradhesion.core import solve
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP

COUNTS = ("loading_jumps", "unloading_jumps")


def test_what_is_not_flagged_stays() -> None:
    """At 1e-9 off a change the flag is gone, and an error of 1e-12 in each parameter changes no count."""

    def counted(**change: Any) -> tuple[Any, Any]:
        """The numbers of jumps, (2, scenes), and which scenes are close to others."""
        found = solve(scenes | change, COUNTS)
        return np.array([found[name] for name in COUNTS]), (found["status"] & CLOSE_TO_A_JUMP) != 0

    rng, size = np.random.default_rng(83), 1500
    scenes: dict[str, Any] = {"k": rng.choice([0.0, 0.31, 0.8], size), "nu": np.full(size, 0.3)}
    ranges = {"modulus": (1, 4), "c0_over_R": (-3, 0), "lambda_over_R": (-1.5, -0.2), "A": (-2.5, -0.7)}
    scenes |= {name: 10 ** rng.uniform(*ends, size) for name, ends in (ranges | {"a_max_over_R": (-0.7, 0.3)}).items()}
    changed = (counted()[0] != counted(A=1.05 * scenes["A"])[0]).any(axis=0)
    scenes = {name: values[changed] for name, values in scenes.items()}
    first, low, high = counted()[0], scenes["A"], 1.05 * scenes["A"]
    for _ in range(50):  # 0.05/2^50 is below the rounding of the first
        middle = 0.5 * (low + high)
        moved = (counted(A=middle)[0] != first).any(axis=0)
        low, high = np.where(moved, low, middle), np.where(moved, middle, high)
    for A, off in ((low, 1 - 1e-9), (high, 1 + 1e-9)):
        close = counted(A=A)[1]
        assert close.size > 40
        assert close.all()
        scenes["A"] = A * off
        base, close = counted()
        assert np.mean(close) < 0.1
        for name in ("A", "a_max_over_R", "lambda_over_R", "modulus"):
            for step in (1 - 1e-12, 1 + 1e-12):
                other, _ = counted(**{name: scenes[name] * step})
                assert not (other != base)[:, ~close].any(), name
