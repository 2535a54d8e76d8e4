"""From cylinder pressure to clamp force: cylinder, rigging, hysteresis (EN 14531-1)."""

from typing import NamedTuple


class Rigging(NamedTuple):
    """Cylinder and rigging of one axle.

    Parameters
    ----------
    cylinder_area : float
        Piston area of one cylinder, > 0 [m²].
    cylinder_efficiency : float
        Share of the piston force that leaves the cylinder, 0 … 1 [-].
    cylinder_spring : float
        Force of the return spring, ≤ 0 [N].
    rigging_ratio : float
        Force of the rigging over force of the cylinder, > 0 [-].
    rigging_efficiency : float
        Share of it that arrives, 0 … 1 [-].
    rigging_spring : float
        Force of the spring in the rigging, ≤ 0 [N].
    units : float
        Cylinders per axle [-].
    """

    cylinder_area: float
    cylinder_efficiency: float
    cylinder_spring: float
    rigging_ratio: float
    rigging_efficiency: float
    rigging_spring: float
    units: float


def clamp_force(rigging: Rigging, brake_cylinder_pressure: float) -> float:
    """Force on the pads or blocks of one axle, all cylinders together.

    Parameters
    ----------
    rigging : Rigging
        Cylinder and rigging.
    brake_cylinder_pressure : float
        Gauge pressure, ≥ 0 [Pa].

    Returns
    -------
    float
        Clamp force, ≥ 0 [N].

    Notes
    -----
    F_C = p A η_C + spring_C; F_b = F_C i η + spring; each is 0 as long as its spring is stronger.
    The retarding force at the tread is F_b μ 2 r_S/D.

    References
    ----------
    .. [1] EN 14531-1:2015, friction brakes, cylinder and rigging.

    Checked by tests/reference/en_14531_forces, 1e-5.

    Examples
    --------
    >>> rigging = Rigging(324e-4, 0.98, -500.0, 5.0, 0.95, 0.0, 1.0)
    >>> round(clamp_force(rigging, 3.0e5), 1)
    42871.6
    """
    piston = brake_cylinder_pressure * rigging.cylinder_area * rigging.cylinder_efficiency
    push = max(0.0, piston + rigging.cylinder_spring)
    lever = push * rigging.rigging_ratio * rigging.rigging_efficiency
    return rigging.units * max(0.0, lever + rigging.rigging_spring)


def hysteresis(previous: float, nominal: float, share: float) -> float:
    """Clamp force of a caliper that sticks on release: a play operator.

    Parameters
    ----------
    previous : float
        The force so far, ≥ 0 [N].
    nominal : float
        The force without hysteresis, ≥ 0 [N].
    share : float
        Greatest lag on release, share of the nominal force, ≥ 0 [-]; calipers have 0.04 … 0.08.

    Returns
    -------
    float
        Force between nominal and (1 + share) · nominal [N].

    Notes
    -----
    While the nominal force rises, the force follows it. When it falls, the force stays until the
    nominal force is 1/(1 + share) of it, and follows from there. It depends on the way, not on the
    pace: splitting a rise or fall into steps changes nothing.
    Known wrong when the caliper also lags on application; that is in the efficiency.

    Examples
    --------
    >>> round(hysteresis(1000.0, 980.0, 0.06)), round(hysteresis(1000.0, 500.0, 0.06))
    (1000, 530)
    """
    return max(nominal, min(previous, nominal * (1.0 + share)))
