"""The optimum of one leg, for a time or for a price of time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.optimum import grid as units
from railgrip.campaign.optimum.flat_out import DONE, TOO_WEAK, flat_out
from railgrip.campaign.optimum.newton import FOUND, newton
from railgrip.campaign.optimum.workspace import Point, new_point, new_work
from railgrip.core.errors import Problem, RailgripError
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

NEAREST = 1e-6
"""A supplement below this share of the least time is mixed from two runs."""
SHORT = 1e-4
"""A time may fall short of the least one by this share: so much the grid is off at the most."""
_FACTORS = (1.0, 1.5, 2.2, *(0.8**k for k in range(1, 25)))
"""Supplements that are tried in turn, over the one asked for: if it has no run, slower ones to mix
from, then faster ones."""
GUESSES = (0.9, 0.3, 0.03)
"""Shares of the supplement that first guesses use up. A slow one is near, but may not climb; the
last is nearly the fastest run, which does."""
TURNS = 2
"""How often nodes are put to where the fastest run turns from pulling to braking."""
LOWEST = 1e-4
"""The least square of speed between the stops, in the grid's unit: 0.1 m/s."""


class Profile(NamedTuple):
    """One run on the grid.

    Attributes
    ----------
    square : array (node)
        Square of the speed over that of the grid's unit.
    motor, friction : array (interval)
        Braking by motors and by friction, per dynamic mass.
    price : float
        Of time, W: what a second more would save; nan for the fastest run.
    is_optimal : bool
        False where no optimum was found for the time: the run lies between those of other times,
        or is that of a shorter one.
    """

    square: Array
    motor: Array
    friction: Array
    price: float
    is_optimal: bool = True


class LegProblem:
    """One leg, ready to be solved for any time."""

    def __init__(
        self, journey: Journey, begin: float, end: float, first: float, final: float,
        step: float | None = None,
    ) -> None:  # fmt: skip
        self.position = units.nodes(journey, begin, end, step)
        self.mass = journey.train.dynamic_mass
        square = self._fastest(journey, first, final)
        for _ in range(TURNS):
            self.position = units.with_turns(self.position, square)
            square = self._fastest(journey, first, final)
        self.fastest = self._driven(square)
        self.least_time = self.time_of(square)

    def _fastest(self, journey: Journey, first: float, final: float) -> Array:
        """Fill the grid on the nodes and return the squares of speed of the fastest run."""
        self.grid = units.grid_of(journey, self.position)
        for place, speed in ((0, first), (-1, final)):
            if speed**2 > self.grid.limit[place] * units.SPEED**2 * (1 + 1e-9):
                raise RailgripError(
                    Problem("passing_speed", "is above what is permitted", got=f"{speed:g} m/s")
                )
        square = self.grid.limit.copy()
        square[0], square[-1] = (first / units.SPEED) ** 2, (final / units.SPEED) ** 2
        asked = square[0]
        status = flat_out(self.grid, square)
        if status != DONE or asked > square[0] * (1 + 1e-9):
            _refuse(status, self.position)
        return square

    def time_of(self, square: Array) -> float:
        """Return the running time, s."""
        speed = np.sqrt(square)
        return float(np.sum(2 * self.grid.width / (speed[1:] + speed[:-1])) * units.TIME)

    def energy_of(self, run: Profile) -> float:
        """Return the net energy at the pantograph without auxiliaries, J."""
        traction = self.traction_of(run)
        drawn = self.grid.bounds[5] * traction - self.grid.bounds[6] * run.motor
        return float(np.sum(self.grid.width * drawn) * self.mass * units.LENGTH)

    def traction_of(self, run: Profile) -> Array:
        """Return the traction in the intervals, per dynamic mass."""
        return self._wheel(run.square) + run.motor + run.friction

    def _wheel(self, square: Array) -> Array:
        middle = 0.5 * (square[1:] + square[:-1])
        grid = self.grid
        resists = (
            grid.bounds[0] + grid.bounds[1] * np.sqrt(middle) + grid.drag * middle + grid.slope
        )
        return np.asarray(0.5 * np.diff(square) / grid.width + resists)

    def _driven(self, square: Array, price: float = np.nan) -> Profile:
        """Return the run with given speeds, braked by the motors as far as they can."""
        brake = np.maximum(-self._wheel(square), 0.0)
        middle = np.sqrt(0.5 * (square[1:] + square[:-1]))
        pieces, most = self.grid.brake, self.grid.bounds[3]
        i = np.clip(np.searchsorted(pieces[:, 0], middle, "right") - 1, 0, None)
        limit = pieces[i, 1] + pieces[i, 2] * middle + pieces[i, 3] / middle
        motor = np.minimum(brake, np.clip(limit, 0.0, most))
        return Profile(square, motor, brake - motor, price)

    def for_time(self, time: float) -> Profile:
        """Return the run of least energy for a time, s.

        Where none is found, the nearest that there is, which says so: ``is_optimal``.
        """
        least = self.least_time
        if not time >= least * (1.0 - SHORT):
            raise RailgripError(
                Problem(
                    "time", "is impossible on this line with this train",
                    got=f"{time:.1f} s", allowed=f"from {least:.1f} s",
                )
            )  # fmt: skip
        if time <= least * (1.0 + 1e-12):
            return self.fastest
        share = max(time / least - 1.0, NEAREST)
        for factor in _FACTORS:
            slower = least * (1.0 + share * factor)
            found = self._newton(slower / units.TIME, np.nan)
            if found is None:
                continue
            run = found if slower <= time * (1.0 + 1e-12) else self._mixed(found, time)
            return run if factor == 1.0 else run._replace(is_optimal=False)
        return self.fastest._replace(is_optimal=False)

    def for_price(self, price: float) -> Profile:
        """Return the run that costs least where a second costs ``price``, W."""
        scaled = price * units.TIME / (self.mass * units.LENGTH)
        found = self._newton(0.0, scaled)
        return self.fastest if found is None else found

    def _newton(self, target: float, price: float) -> Profile | None:
        """Return the optimum for a time or a price, from one first guess after another."""
        for aim in GUESSES:
            work = new_work(np.minimum(LOWEST, 0.5 * self.fastest.square), self.grid.limit)
            guess = self._guess(target, aim)
            point = self._point(guess)
            point.clock[1] = price
            spare = target - self.time_of(guess) / units.TIME
            if newton(self.grid, point, work, target, spare) == FOUND:
                worth = float(work.price[0] if target > 0.0 else price)
                # what both brakes and traction did against each other is nothing
                return self._driven(point.square, worth * self.mass * units.LENGTH / units.TIME)
        return None

    def _guess(self, target: float, aim: float) -> Array:
        """Return the fastest run, capped so that it takes a share ``aim`` of the supplement."""
        fastest, least = self.fastest.square, self.least_time / units.TIME
        wanted = least + aim * ((target - least) if target > 0.0 else 0.055 * least)
        low, high = 1e-2, float(fastest.max())
        for _ in range(50):
            cap = 0.5 * (low + high)
            slow = self.time_of(np.minimum(fastest, cap)) / units.TIME > wanted
            low, high = (cap, high) if slow else (low, cap)
        return np.asarray(np.minimum(fastest, high))

    def _point(self, guess: Array) -> Point:
        """Return the point of a first guess of the squares, both brakes a little inside."""
        grid = self.grid
        brake = np.maximum(-self._wheel(guess), 0.0)
        motor = np.minimum(brake, 0.9 * grid.bounds[3])
        friction = brake - motor
        return new_point(
            guess,
            motor + 0.01 if grid.given[3] else 0.0 * motor,
            friction + 0.01 if grid.given[6] else 0.0 * friction,
        )

    def _mixed(self, slower: Profile, time: float) -> Profile:
        """Return a run between the fastest and a slower one, mixed in the squares of speed."""
        low, high = 0.0, 1.0
        for _ in range(60):
            part = 0.5 * (low + high)
            square = (1 - part) * self.fastest.square + part * slower.square
            low, high = (low, part) if self.time_of(square) > time else (part, high)
        square = (1 - high) * self.fastest.square + high * slower.square
        return self._driven(square, slower.price)


def _refuse(status: int, position: Array) -> None:
    place = f"{position[status // 10]:.0f} m"
    if status % 10 == TOO_WEAK or status == DONE:
        raise RailgripError(
            Problem(
                "", "the brakes cannot hold the train here", got=f"too fast at {place}",
                cure="more braking force or a gentler gradient",
            )
        )  # fmt: skip
    raise RailgripError(
        Problem(
            "", "the train cannot climb here and stalls", got=f"a stand at {place}",
            cure="more tractive effort, less mass, or a start with a run-up",
        )
    )  # fmt: skip
