"""Formulae at many digits, which several suites compare with: theta of the half-space, and the loop of the envelopes."""

from typing import Any

import mpmath


def theta(k: Any, nu: Any) -> Any:
    """Give theta as it stands in section 2 of docs/theory.md, with the exact doubles k and nu."""
    k, nu = mpmath.mpf(k), mpmath.mpf(nu)
    beta = mpmath.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
    c = 2 ** (1 + k) * mpmath.gamma((3 + k + beta) / 2) * mpmath.gamma((3 + k - beta) / 2) / mpmath.gamma(2 + k)
    c /= mpmath.pi
    front = 2 ** (1 + k) * (1 + k) * mpmath.cos(k * mpmath.pi / 2) * mpmath.gamma(1 + k / 2)
    return front / (mpmath.sqrt(mpmath.pi) * c * beta * mpmath.sin(beta * mpmath.pi / 2) * mpmath.gamma((1 + k) / 2))


def envelope_loop(k: float, M: Any, m: float, up: Any, down: Any, rim: Any) -> Any:
    """Integrate P d(delta) along envelopes that are off the mean by r_+ and r_-, and along the line at the rim.

    R = dgamma = 1, depths are counted from the mean surface, and the jumps are at their fixed depth.
    """
    k, c = mpmath.mpf(k), (1 - mpmath.mpf(k)) / 2
    K, s = 2 ** (1 - k) * M / (1 + k), mpmath.sqrt(2 ** (1 + k) * mpmath.pi / M)
    front = mpmath.beta(mpmath.mpf(m) / 2, (1 + k) / 2) / 2

    def depth(pull: Any, a: Any) -> Any:
        return front * a**m - pull * a**c

    def load(pull: Any, a: Any) -> Any:
        return K * a ** (1 + k) * (m / (1 + k + m) * front * a**m - pull * a**c)

    def work(pull: Any, first: Any, last: Any) -> Any:
        def rate(t: Any) -> Any:
            a = mpmath.exp(t)
            return load(pull, a) * (m * front * a**m - pull * c * a**c)

        return mpmath.quad(rate, mpmath.linspace(mpmath.log(first), mpmath.log(last), 9)) if last > first else 0

    rim, loading, unloading = mpmath.mpf(rim), s - up, s + down
    a_in = min(rim, (max(loading, mpmath.mpf(10) ** -40) / front) ** (1 / (m - c)))
    a_out = min(rim, (max(c * unloading, mpmath.mpf(10) ** -40) / (m * front)) ** (1 / (m - c)))
    drop = max(0, depth(loading, rim)) - depth(unloading, rim)
    pinned = drop * load(unloading, rim) + K * rim ** (1 + k) * drop**2 / 2
    return work(loading, a_in, rim) - pinned - work(unloading, a_out, rim)
