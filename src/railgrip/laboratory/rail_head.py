"""The head of a new 60E1 rail (UIC 60) as it lies in the track."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.errors import Problem, RailgripError

Array = NDArray[np.float64]

# EN 13674-1, drawing of 60E1: radii of the arcs, and where they meet, from the middle of the head.
_RADII = (0.300, 0.080, 0.013)
_MEETINGS = (0.020456 / 2.0, 0.052053 / 2.0)
# The last arc passes into the face, which leans by 1:20, at half the width of the head.
_FACE_LEAN = math.atan(1.0 / 20.0)
_FACE_ACROSS, _FACE_DEPTH = 0.036, 0.0143
_GAUGE_DEPTH = 0.014


class _Arc(NamedTuple):
    """One arc of the head: its radius, its centre, and the angles from the vertical it spans."""

    radius: float
    across: float
    depth: float
    begin: float
    end: float


def head_60e1(position: Array, gauge: float = 1.435, inclination: float = 1.0 / 40.0) -> Array:
    """Depth of the rail's surface below the top of the head, of a 60E1 rail in the track.

    Choose it to look for the place of contact of a new wheel; a worn head is another profile.

    Parameters
    ----------
    position : ndarray
        Distance from the middle of the track [m].
    gauge : float
        Distance of the inner faces 14 mm below the top, 1.40 … 1.50 [m].
    inclination : float
        How much the rail leans inwards, 0 … 0.05 [-]; usual are 1/40 and 1/20.

    Returns
    -------
    ndarray
        Depth, positive downwards [m]; NaN beyond the arcs of the head.

    Raises
    ------
    RailgripError
        "the gauge is out of range"; "the inclination of the rail is out of range".

    Notes
    -----
    Arcs of 300, 80 and 13 mm that pass into each other without a corner, to both sides of the
    middle; they meet 10.228 and 26.027 mm from it. These two numbers are quoted from memory; they
    are borne out by the last arc, which then ends 36.000 mm from the middle and 14.300 mm deep with
    the slope of the face, 1:20: the head of 60E1 is 72 mm wide there.

    References
    ----------
    .. [1] EN 13674-1, rail 60E1.

    Checked by tests/unit/laboratory/test_rail_head.py: no corner, the width of the head, the gauge.

    Examples
    --------
    >>> np.round(1e3 * head_60e1(np.array([0.740, 0.7606, 0.780])), 2).tolist()
    [0.75, 0.0, 1.95]
    """
    for name, value, least, most in (
        ("gauge", gauge, 1.40, 1.50),
        ("inclination of the rail", inclination, 0.0, 0.05),
    ):
        if not least <= value <= most:
            allowed = f"{least:g} … {most:g}"
            raise RailgripError(Problem("", f"the {name} is out of range", f"{value:g}", allowed))
    lean = math.atan(inclination)
    offset = position - _middle(gauge, lean)
    depth = np.full(offset.shape, math.nan)
    for arc in _arcs():
        across, centre = _leaning(arc.across, arc.depth, lean)
        lower = across + arc.radius * math.sin(arc.begin - lean)
        upper = across + arc.radius * math.sin(arc.end - lean)
        inside = (offset >= lower) & (offset <= upper)
        depth[inside] = centre - np.sqrt(arc.radius**2 - (offset[inside] - across) ** 2)
    return depth + _rise(lean)


def _leaning(across: float, depth: float, lean: float) -> tuple[float, float]:
    """A point of the upright head, turned inwards about the middle of its top."""
    cosine, sine = math.cos(lean), math.sin(lean)
    return across * cosine + depth * sine, depth * cosine - across * sine


def _rise(lean: float) -> float:
    """Height of the highest point, where the upright head slopes by the lean, over the middle."""
    highest = next(arc for arc in _arcs() if arc.begin <= lean <= arc.end)
    return highest.radius - _leaning(highest.across, highest.depth, lean)[1]


def _middle(gauge: float, lean: float) -> float:
    """Where the middle of the top lies, so that the inner face stands at half the gauge."""
    across, depth = _leaning(-_FACE_ACROSS, _FACE_DEPTH, lean)
    above = depth + _rise(lean) - _GAUGE_DEPTH
    return 0.5 * gauge - across - above * math.tan(_FACE_LEAN - lean)


def _arcs() -> list[_Arc]:
    """The five arcs of the upright head, from the middle of its top; depth counts downwards."""
    crown, shoulder, corner = _RADII
    first = math.asin(_MEETINGS[0] / crown)
    across, depth = (
        (crown - shoulder) * math.sin(first),
        crown - (crown - shoulder) * math.cos(first),
    )
    second = math.asin((_MEETINGS[1] - across) / shoulder)
    step = shoulder - corner
    far, deep = across + step * math.sin(second), depth - step * math.cos(second)
    last = 0.5 * math.pi - _FACE_LEAN
    return [
        _Arc(corner, -far, deep, -last, -second),
        _Arc(shoulder, -across, depth, -second, -first),
        _Arc(crown, 0.0, crown, -first, first),
        _Arc(shoulder, across, depth, first, second),
        _Arc(corner, far, deep, second, last),
    ]
