"""How deceleration shifts load: body onto the front bogie, bogie onto its front axle."""

from __future__ import annotations

from collections.abc import Sequence


def load_transfer(
    positions: Sequence[float],
    masses: Sequence[float],
    heights: Sequence[float],
    body_mass: float,
    body_height: float,
    traction_heights: Sequence[float],
    wheelbases: Sequence[Sequence[float]],
) -> list[list[float]]:
    """Return the load that each axle gains per deceleration, bogie by bogie.

    Parameters
    ----------
    positions : sequence of float (bogie)
        Pivots behind the vehicle's front [m], front first.
    masses, heights : sequence of float (bogie)
        Mass of each bogie with its wheelsets [kg]; its centre of gravity over the rail [m].
    body_mass, body_height : float
        Mass above the bogies with payload [kg]; its centre of gravity over the rail [m].
    traction_heights : sequence of float (bogie)
        Height at which body and bogie push each other [m].
    wheelbases : sequence of sequences of float (bogie, axle)
        Axles' positions from the middle of their bogie, front positive [m].

    Returns
    -------
    list of lists of float (bogie, axle)
        Gain per deceleration [N/(m/s²)]; positive: heavier in braking; all together zero.

    Notes
    -----
    Quasi-static moments about the rail. The body's inertia m h a tips about the height z at which
    it pushes the bogies: the pivots take ± m (h − z) a/L. Each bogie carries its share of the body
    mass, pushed at z, and itself at its own height: axles take ± (m_share z + m_b h_b) a/b.
    Brake reactions inside the bogie are not resolved, nor is the coupler force. Known wrong when
    one bogie brakes much harder than the other.

    Examples
    --------
    Two bogies 17 m apart with axles at ± 1.25 m:

    >>> gain = load_transfer((4.5, 21.5), (6e3, 6e3), (0.6, 0.6), 40e3, 1.7, (0.8, 0.8),
    ...                      ((1.25, -1.25), (1.25, -1.25)))
    >>> [round(axle) for bogie in gain for axle in bogie]
    [8899, -6781, 6781, -8899]
    """
    n_bogies = len(positions)
    share = body_mass / n_bogies
    middle = sum(positions) / n_bogies
    spread = sum((position - middle) ** 2 for position in positions)
    gains = []
    for i, position in enumerate(positions):
        tipping = body_mass * (body_height - traction_heights[i])
        on_pivot = tipping * (middle - position) / spread if spread else 0.0
        pushed = share * traction_heights[i] + masses[i] * heights[i]
        square = sum(place**2 for place in wheelbases[i])
        n_axles = len(wheelbases[i])
        gains.append(
            [
                on_pivot / n_axles + (pushed * place / square if square else 0.0)
                for place in wheelbases[i]
            ]
        )
    return gains
