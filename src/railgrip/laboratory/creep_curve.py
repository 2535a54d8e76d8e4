"""A creep curve in its four forms: force or adhesion, over slip speed or creepage."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.inputs import checked_array, checked_number

FloatArray = NDArray[np.float64]

CREEPAGES: FloatArray = np.geomspace(1e-6, 1.0, 601)
"""Creepages of a curve if none are given: 100 a decade, from the straight beginning to the lock."""


class Peak(NamedTuple):
    """The greatest force of a curve and where it lies.

    Parameters
    ----------
    creepage, slip_speed : float
        Where [-], [m/s].
    force, adhesion : float
        How much [N], [-].
    is_at_the_end : bool
        True where the curve still rises, or is level, at its last point.
    """

    creepage: float
    slip_speed: float
    force: float
    adhesion: float
    is_at_the_end: bool


@dataclass(frozen=True, eq=False)
class CreepCurve:
    """Force of one wheel over its creepage, at one speed of the train and one wheel load.

    `creep_curve` checks what it is given; the four forms are pairs of the four arrays.

    Parameters
    ----------
    speed : float
        Speed of the train v, > 0 [m/s].
    load : float
        Wheel load Q, > 0 [N].
    creepage : ndarray
        Creepage s, rising, ≥ 0 [-].
    force : ndarray
        Tangential force along the track T [N].

    Notes
    -----
    w = s v and μ = T/Q convert the forms into each other, at this speed and load only: another
    speed is another curve, because friction falls with w and the patch gives way with s.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 1.16–1.17, figure 2.1.

    Checked by tests/unit/laboratory/test_creep_curve.py.

    Examples
    --------
    >>> curve = creep_curve(speed=20.0, load=50e3, slip_speed=[0.1, 0.2], adhesion=[0.2, 0.3])
    >>> curve.creepage.tolist(), curve.force.tolist()
    ([0.005, 0.01], [10000.0, 15000.0])
    """

    speed: float
    load: float
    creepage: FloatArray
    force: FloatArray

    @property
    def slip_speed(self) -> FloatArray:
        """Slip speed w = s v [m/s]."""
        return self.creepage * self.speed

    @property
    def adhesion(self) -> FloatArray:
        """Adhesion used μ = T/Q [-]."""
        return self.force / self.load

    @property
    def initial_slope(self) -> float:
        """Slope dT/ds at the origin [N], from the first two points with creepage.

        The secants T/s of both are drawn out to s = 0, which a curve with a straight beginning
        follows to the second order.
        """
        first = int(np.searchsorted(self.creepage, 0.0, side="right"))
        if self.creepage.size < first + 2:
            raise RailgripError(
                Problem("creepage", "the initial slope needs two points with creepage")
            )
        s = self.creepage[first : first + 2]
        near, far = self.force[first : first + 2] / s
        return float(near - s[0] * (far - near) / (s[1] - s[0]))

    @property
    def peak(self) -> Peak:
        """Greatest force and its place, between the points by a parabola."""
        k = int(np.argmax(self.force))
        s, force = self.creepage[k], self.force[k]
        is_at_the_end = k == self.force.size - 1
        if k > 0 and not is_at_the_end:
            s, force = _top(self.creepage[k - 1 : k + 2], self.force[k - 1 : k + 2])
        return Peak(
            float(s), float(s * self.speed), float(force), float(force / self.load), is_at_the_end
        )

    @property
    def effective_branch(self) -> CreepCurve:
        """The rising branch, to the greatest of the points."""
        return self._part(slice(None, int(np.argmax(self.force)) + 1))

    @property
    def ineffective_branch(self) -> CreepCurve:
        """The falling branch, from the greatest of the points."""
        return self._part(slice(int(np.argmax(self.force)), None))

    def creepage_at(self, adhesion: float) -> float:
        """Return where the effective branch reaches an adhesion, NaN where it does not."""
        branch = self.effective_branch
        reached = np.flatnonzero(branch.adhesion >= adhesion)
        if not reached.size:
            return float("nan")
        low = max(0, int(reached[0]) - 1)
        part = slice(low, int(reached[0]) + 1)
        return float(np.interp(adhesion, branch.adhesion[part], branch.creepage[part]))

    def to_csv(self, path: str | os.PathLike[str]) -> Path:
        """Write slip speed, creepage, force and adhesion as the columns of a CSV file."""
        columns = (self.slip_speed, self.creepage, self.force, self.adhesion)
        with write_aside(path) as aside, aside.open("w", encoding="utf-8", newline="") as file:
            file.write("slip_speed_m_s,creepage,force_N,adhesion\n")
            for row in zip(*columns, strict=True):
                file.write(",".join(f"{value:.9g}" for value in row) + "\n")
        return Path(path)

    def _part(self, part: slice) -> CreepCurve:
        return CreepCurve(self.speed, self.load, self.creepage[part], self.force[part])


def creep_curve(
    *,
    speed: float,
    load: float,
    creepage: ArrayLike | None = None,
    slip_speed: ArrayLike | None = None,
    force: ArrayLike | Callable[[float], float] | None = None,
    adhesion: ArrayLike | Callable[[float], float] | None = None,
) -> CreepCurve:
    """Creep curve from any of its four forms.

    Parameters
    ----------
    speed, load : float
        Speed of the train [m/s] and wheel load [N], > 0.
    creepage, slip_speed : array, optional
        Where: one of both, rising, ≥ 0; `CREEPAGES` if neither is given.
    force, adhesion : array or function, optional
        How much: one of both, [N] or [-]. A function is called with each creepage.

    Returns
    -------
    CreepCurve
        The curve, which holds all four forms.

    Raises
    ------
    RailgripError
        ``speed: must be positive and finite; got -20.0 m/s``, and likewise for NaN, empty arrays,
        arrays of different length, falling creepage, or a form given twice.

    Examples
    --------
    >>> line = creep_curve(speed=20.0, load=50e3, force=lambda creepage: 10e6 * creepage)
    >>> round(line.initial_slope)
    10000000
    """
    speed = checked_number("speed", speed, "m/s", least=0.0)
    load = checked_number("load", load, "N", least=0.0)
    if creepage is not None and slip_speed is not None:
        raise RailgripError(Problem("", "give creepage or slip_speed, not both"))
    name, given = ("adhesion", adhesion) if force is None else ("force", force)
    if given is None or (force is not None and adhesion is not None):
        raise RailgripError(Problem("", "give either force or adhesion"))
    if slip_speed is not None:
        where = _rising("slip_speed", slip_speed) / speed
    else:
        where = _rising("creepage", CREEPAGES if creepage is None else creepage)
    much = checked_array(name, [given(s) for s in where.tolist()] if callable(given) else given)
    if much.size != where.size:
        raise RailgripError(
            Problem(name, "must have as many points as the creepage",
                    got=f"{much.size} and {where.size}")
        )  # fmt: skip
    return CreepCurve(speed, load, where, much * load if force is None else much)


def _rising(name: str, values: ArrayLike) -> FloatArray:
    array = checked_array(name, values)
    if array[0] < 0.0 or (np.diff(array) <= 0.0).any():
        raise RailgripError(
            Problem(name, "must rise from point to point and not be negative",
                    cure="sort the points and give magnitudes")
        )  # fmt: skip
    return array


def _top(x: FloatArray, y: FloatArray) -> tuple[float, float]:
    """Return the vertex of the parabola through three points, the middle one greatest."""
    left, right = (y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1])
    bend = (right - left) / (x[2] - x[0])
    if bend >= 0.0:
        return float(x[1]), float(y[1])
    # the tangent in the middle point, then the way to where it is level
    tangent = left + bend * (x[1] - x[0])
    way = -0.5 * tangent / bend
    return float(x[1] + way), float(y[1] + way * (tangent + bend * way))
