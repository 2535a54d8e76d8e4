"""What a leg of a trip leaves to the next one: warm discs, and rail that has been worked on."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from railgrip.core.formulas.two_node_heat import DiscHeat, film_coefficient, two_node_heat_rates
from railgrip.engine import layout as at
from railgrip.engine.plan import Way
from railgrip.engine.result import Result

Array = NDArray[np.float64]

DISC = ("RING_MASS", "HUB_MASS", "CONDUCTANCE", "DISC_SURFACE", "HEAT_SHARE", "FILM_STILL",
        "FILM_WIND", "EMISSIVITY", "AMBIENT")  # fmt: skip
"""Of the axle's parameters, in the order of `DiscHeat`."""


class Left(NamedTuple):
    """What the next leg begins with.

    Parameters
    ----------
    discs : ndarray (axle, 2)
        Temperatures of friction ring and hub, [°C].
    position, energy, sand : ndarray (cell)
        Of the rail's cells, [m], with what wheels have rubbed there, [J/m], and the sand, [kg/m].
    """

    discs: Array
    position: Array
    energy: Array
    sand: Array

    def lay(self, way: Way) -> Way:
        """Return a line whose rail is as it was left; where no train was, it is fresh."""
        if self.position.size < 2:
            return way
        last = self.position[-1]
        count = max(int((last - way.origin) / way.cell_length) + 1, 0)
        places = way.origin + (np.arange(count) + 0.5) * way.cell_length
        return way._replace(
            earlier_energy=np.interp(places, self.position, self.energy, 0.0, 0.0),
            earlier_sand=np.interp(places, self.position, self.sand, 0.0, 0.0),
        )


def what_is_left(run: Result, table: Array, stand: float) -> Left:
    """Return what a leg leaves, after some seconds at the stop.

    Parameters
    ----------
    run : Result
        The leg, with its traces.
    table : ndarray (1 + axle, parameter)
        The train as `lower_train` lays it out.
    stand : float
        Time until the next departure, ≥ 0, [s].

    Examples
    --------
    >>> import railgrip as rg
    >>> from railgrip.engine.lower_train import lower_train
    >>> scenario = rg.load("dry_emergency")
    >>> run, table = rg.simulate(scenario), lower_train(scenario)[0]
    >>> now, later = (what_is_left(run, table, stand).discs[0] for stand in (0.0, 600.0))
    >>> bool(now[0] > now[1]), bool(now[0] - later[0] > 10.0), bool(later[1] > now[1])
    (True, True, True)
    """
    rings, hubs = (run.data[name].values[0, :, -1] for name in ("disc_temperature",
                                                                "hub_temperature"))  # fmt: skip
    names = at.AXLE_PARAMETERS.split()
    columns = [table[1:, names.index(name)] for name in DISC]
    discs = [
        cooled(DiscHeat(*(float(column[axle]) for column in columns)), ring, hub, stand)
        for axle, (ring, hub) in enumerate(zip(rings.tolist(), hubs.tolist(), strict=True))
    ]
    rail = run.data["rail_energy"]
    return Left(
        np.array(discs),
        np.asarray(rail["cell"].values, dtype=float),
        np.nan_to_num(rail.values[0]),
        np.nan_to_num(run.data["rail_sand"].values[0]),
    )


def cooled(disc: DiscHeat, ring: float, hub: float, stand: float) -> tuple[float, float]:
    """Return the temperatures of ring and hub after a stand.

    Parameters
    ----------
    disc : DiscHeat
        Its masses, surface and films; one without a mass stays as it is.
    ring, hub : float
        When the train came to stand, [°C].
    stand : float
        ≥ 0, [s].

    Notes
    -----
    `two_node_heat_rates` without friction, in still air.

    Examples
    --------
    >>> disc = DiscHeat(65.0, 55.0, 450.0, 2.0, 0.9, 9.0, 3.0, 0.7, 20.0)
    >>> [round(x, 1) for x in cooled(disc, 200.0, 40.0, 60.0)]
    [134.2, 112.2]
    """
    if stand <= 0.0 or disc.ring_mass <= 0.0 or disc.hub_mass <= 0.0:
        return ring, hub
    still = film_coefficient(disc.film_still, disc.film_wind, 0.0)
    done = solve_ivp(
        lambda _, both: two_node_heat_rates(disc, both[0], both[1], 0.0, still),
        (0.0, stand), (ring, hub), method="LSODA", rtol=1e-6, atol=1e-3,
    )  # fmt: skip
    return float(done.y[0, -1]), float(done.y[1, -1])
