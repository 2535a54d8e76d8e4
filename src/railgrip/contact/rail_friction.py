"""The friction of one state of the rail head, as the creep laws read it."""

from typing import NamedTuple


class RailFriction(NamedTuple):
    """Friction between wheel and rail in one condition (dry, wet, leaves …).

    Parameters
    ----------
    static_friction : float
        Friction coefficient μ0 as the slip speed goes to zero, ≥ 0 [-].
    friction_ratio : float
        Friction at a very high slip speed over `static_friction`, A, 0 … 1 [-].
    friction_decay : float
        How quickly it falls with the slip speed, B, ≥ 0 [s/m].
    adhesion_reduction : float
        Reduction of the initial slope in the area of adhesion, k_A, 0 < k_A ≤ 1 [-].
    slip_reduction : float
        Reduction in the area of slip, k_S, 0 < k_S ≤ k_A [-].

    References
    ----------
    .. [1] O. Polach, Creep forces in simulations of traction vehicles running on adhesion limit,
       Wear 258 (2005) 992–1000, doi:10.1016/j.wear.2004.03.046.

    Examples
    --------
    >>> DRY_POLACH_2005.static_friction
    0.55
    """

    static_friction: float
    friction_ratio: float
    friction_decay: float
    adhesion_reduction: float
    slip_reduction: float


DRY_POLACH_2005 = RailFriction(0.55, 0.40, 0.60, 1.00, 0.40)
"""Dry rail; read from the fits A = 0.4, B = 1.6 μ0 − 0.28, k_A = 2.8 μ0 − 0.54, k_S = 1.2 μ0 − 0.26
that Open Rails publishes, which pass through Polach's dry and wet columns."""

WET_POLACH_2005 = RailFriction(0.30, 0.40, 0.20, 0.30, 0.10)
"""Wet rail; source as for `DRY_POLACH_2005`."""
