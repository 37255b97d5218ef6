"""The jump-in radius of the loading envelope from the parameters of a scene: the size of a punch is often given in it.

    a_2 = [(1+k) R (s - r)]^(2/(3+k))   (5.34)

of Jin, Guo & Wan (2013), where the depth of the loading envelope (5.26) is that of the mean surface. Lengths are in R.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.equations.effective import jump_in_radius
from gradhesion.core.equations.envelopes import adhesion_strength, waviness_strength
from gradhesion.core.problem.material import stiffness


def jump_in_radius_of_envelope(
    k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike, lambda_over_R: ArrayLike, A: ArrayLike
) -> NDArray[np.float64]:
    """Return a_2/R, the radius to which the contact jumps in on the loading envelope (5.34).

    Parameters
    ----------
    k, nu, modulus, c0_over_R, lambda_over_R, A
        The first six of `PARAMETERS`, with their ranges; all broadcastable.

    Returns
    -------
    Array of the broadcast shape. NaN outside the ranges, and where r >= s: there the waves lift the loading envelope
    above zero depth everywhere, and loading starts at a point. Without waviness it is the radius of the smooth punch at
    zero depth. Accurate to a few units in the last place, over s - r where s and r are close.

    Examples
    --------
    The smooth punch of Johnson, Kendall & Roberts (1971): a^3 = 2 pi R^2 dgamma/E* at zero depth.

    >>> radius = jump_in_radius_of_envelope(0.0, 0.3, 500.0, 0.01, 0.1, A=0.0)
    >>> round(float(radius**3 * 500.0 / (2.0 * np.pi)), 12)
    1.0
    """
    with np.errstate(all="ignore"):  # what overflows has no value
        adhesion = adhesion_strength(k, stiffness(k, nu, modulus, c0_over_R))
        return jump_in_radius(k, adhesion, waviness_strength(k, lambda_over_R, A))
