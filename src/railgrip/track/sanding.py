"""Sand on the rail: the friction that the wheels behind a sander find."""

from __future__ import annotations

from railgrip.core.formulas.elementary import exp_decay


def sanded_friction(
    friction: float, sand_per_metre: float, sand_friction: float, effective_sand: float
) -> float:
    """Return the static friction of a rail that carries sand.

    Parameters
    ----------
    friction : float
        Static friction without sand.
    sand_per_metre : float
        Sand laid, ≥ 0 [kg/m].
    sand_friction : float
        Friction that plenty of sand gives; a rail that is better already stays as it is.
    effective_sand : float
        Sand for 63 % of the effect, > 0 [kg/m]; illustrative.

    Examples
    --------
    >>> round(sanded_friction(0.05, 0.002, 0.20, 0.002), 4)
    0.1448
    """
    effect = 1.0 - exp_decay(sand_per_metre / effective_sand)
    return friction + effect * max(sand_friction - friction, 0.0)
