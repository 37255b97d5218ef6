"""The equilibrium curve itself, stable and unstable."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import END, START, Trace
from gradhesion.core.curves.sampling import sample
from gradhesion.core.curves.subject import Form, Subject
from gradhesion.core.types import Bits, Floats, Integers


def draw_through(form: Form, places: Floats, end: float) -> tuple[Floats, Integers]:
    """Return points of a form, of shape (3, n), from zero contact through places in order to an end; their knots."""
    knots = form.states(np.concatenate([[0.0], places, [end]]))
    joined = np.ones(knots.shape[1], dtype=np.bool_)
    joined[0] = False
    points, owners = sample(form.table, form.numbers, knots, joined, scales_of(knots))
    return points, owners


def draw_named(subject: Subject, form: Form, places: Floats, name: str) -> dict[str, Floats]:
    """Return the variables `name_...`, of shape (n,): radii, depths and loads of a form through places to the end."""
    points, _ = draw_through(form, places, subject.end / form.radius_scale)
    radius, depth, load = form.scaled(points)
    radius[-1] = subject.end
    return {f"{name}_contact_radius": radius, f"{name}_indentation": depth, f"{name}_load": load}


def scales_of(knots: Floats) -> Floats:
    """Return one over the spans of place, depth and load, of shape (3,), from their rows at knots, of shape (3, n)."""
    spans = np.ptp(knots, axis=1)
    return np.divide(1.0, spans, out=np.zeros(3), where=spans > 0.0)


@kernel(entry=True)
def _mark_stable(trace: Trace, places: Floats, stable: Bits) -> None:
    """Mark places x in the inside of a branch with 1, of shape (n,); the first start of k = 1 is no fold."""
    branch = 0
    for i in range(places.size):
        while branch < trace.shape[1] and trace[END, branch] <= places[i]:
            branch += 1
        if branch < trace.shape[1]:
            start = trace[START, branch]
            stable[i] = 1 if start < places[i] or start == places[i] == 0.0 else 0


def draw_equilibrium(subject: Subject) -> dict[str, NDArray[Any]]:
    """Return the equilibrium curve, from zero contact to the end of the drawn range, of a scene with known branches.

    Its variables are `contact_radius`, `indentation`, `load` and `stable` (draw.CURVES). Folds count as not stable, so
    that the line between two points is stable where one of them is: there is a point between any two folds.
    """
    form, trace = subject.exact, subject.trace
    assert trace is not None  # noqa: S101 (draw.py asks first)
    end = subject.end / form.radius_scale
    folds = np.sort(trace[[START, END]].ravel())
    folds = folds[(folds > 0.0) & (folds < end)]
    edges = np.concatenate([[0.0], folds, [end]])
    middles = 0.5 * (edges[1:] + edges[:-1])
    lonely = np.searchsorted(subject.load_folds, edges[1:]) == np.searchsorted(subject.load_folds, edges[:-1])
    places = np.sort(np.concatenate([folds, subject.load_folds, middles[lonely]]))
    points, _ = draw_through(form, places, end)
    stable = np.zeros(points.shape[1], dtype=np.int8)
    _mark_stable(trace, points[0], stable)
    radius, depth, load = form.scaled(points)
    radius[-1] = subject.end
    return {"contact_radius": radius, "indentation": depth, "load": load, "stable": stable}
