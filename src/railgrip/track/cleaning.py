"""Sliding wheels clean the rail: contaminated and clean friction blended by the energy received."""

from __future__ import annotations

from railgrip.core.formulas.elementary import exp_decay


def left_contaminant(energy_per_metre: float, cleaning_rate: float) -> float:
    """Return the share of the contaminant that is still on the rail (1 − λ).

    Parameters
    ----------
    energy_per_metre : float
        Friction energy W that the rail has received, ≥ 0 [J/m].
    cleaning_rate : float
        τ, ≥ 0 [m/J]; 0 where sliding does not clean (leaves).

    Returns
    -------
    float
        exp(−τ W), 1 … 0.

    Notes
    -----
    λ = 1 − exp(−τ W). The remembered τ = 1.9e-4 m/J is not confirmed: it is a parameter of the
    rail condition. Here the five numbers of the friction state are blended, and the creep law is
    evaluated once with the blend; the source blends the two forces. Both agree at full slip.

    References
    ----------
    B. Allotta, E. Meli, A. Ridolfi, A. Rindi, Development of an innovative wheel-rail contact
    model for the analysis of degraded adhesion in railway systems, Tribology International 69
    (2014), and Meccanica 49 (2014) 919.

    Examples
    --------
    >>> round(1 - left_contaminant(1600.0, 1.9e-4), 3)
    0.262
    """
    return exp_decay(cleaning_rate * energy_per_metre)


def blended(clean: float, contaminated: float, left: float) -> float:
    """Return one number of the friction state between clean (left = 0) and contaminated (1).

    Examples
    --------
    >>> round(blended(0.28, 0.06, 0.5), 2)
    0.17
    """
    return clean + left * (contaminated - clean)
