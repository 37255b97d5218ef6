"""From values at Chebyshev nodes to Chebyshev coefficients."""

import numpy as np
from numpy.typing import NDArray


def chebyshev_fit(nodes: int, terms: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the nodes on [-1, 1], and the matrix from the values there to the first coefficients.

    The angles are reduced as whole numbers, so that the entries are good to an ulp.

    Parameters
    ----------
    nodes, terms
        How many, terms <= nodes.

    Returns
    -------
    Arrays of shape (nodes,) and (terms, nodes).

    Examples
    --------
    >>> places, fit = chebyshev_fit(8, 3)
    >>> (fit @ places**2).round(15).tolist()
    [0.5, 0.0, 0.5]
    """
    odd = 2 * np.arange(nodes) + 1
    degrees = np.arange(terms)[:, None]
    angles = (degrees * odd) % (4 * nodes)
    angles = np.where(angles > 2 * nodes, angles - 4 * nodes, angles)
    fit = np.cos(np.pi / (2 * nodes) * angles) * np.where(degrees > 0, 2.0, 1.0) / nodes
    return np.cos(np.pi / (2 * nodes) * odd), fit
