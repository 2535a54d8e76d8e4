"""How the creep force follows its steady value: over the relaxation length of the patch."""

import math
from typing import NamedTuple

_RELAXATION_OVER_AXIS = 0.8488263631567752  # 8/(3π)
_SMALL = 1e-2


class RelaxationStep(NamedTuple):
    """One exact step of the relaxation: F₁ = kept F₀ + before S₀ + after S₁.

    Parameters
    ----------
    kept : float
        What is left of the force at the beginning of the step [-].
    before, after : float
        Weights of the steady forces at the beginning and the end of the step [-].
    """

    kept: float
    before: float
    after: float


def relaxation_length(a: float) -> float:
    """Relaxation length of the creep force.

    Parameters
    ----------
    a : float
        Semi-axis of the patch along the track, > 0 [m].

    Returns
    -------
    float
        σ = 8a/(3π) [m]: Kalker's slope over the tangential stiffness K π a b of the patch.

    Notes
    -----
    σ Ḟ + |v| F = |v| F_steady. The same length serves both directions.
    Known wrong when the wavelength of a change is shorter than the patch, which averages over it.

    Checked by tests/reference/wheel_spin and tests/reference/load_cycle.

    Examples
    --------
    >>> round(1e3 * relaxation_length(7.191978e-3), 2)
    6.1
    """
    return _RELAXATION_OVER_AXIS * a


def relaxation_step(rolled: float) -> RelaxationStep:
    """Solve σ dF/dx + F = S exactly over a step in which S runs straight from S₀ to S₁.

    Choose it wherever a force relaxes: it is stable for any step, and a step of infinite length
    gives S₁.

    Parameters
    ----------
    rolled : float
        Distance rolled over the relaxation length, h = ∫ v dt/σ, ≥ 0, `inf` allowed [-].

    Returns
    -------
    RelaxationStep
        Three weights between 0 and 1 that add up to 1.

    Notes
    -----
    With p = (1 − e^(−h))/h: F₁ = e^(−h) F₀ + (p − e^(−h)) S₀ + (1 − p) S₁. Below h = 0.01 the
    series of both brackets are used, which lose no digits.

    Checked by tests/unit/contact/test_relaxation.py, 1e-13.

    Examples
    --------
    >>> relaxation_step(math.inf)
    RelaxationStep(kept=0.0, before=0.0, after=1.0)
    >>> [round(weight, 6) for weight in relaxation_step(1.0)]
    [0.367879, 0.264241, 0.367879]
    """
    h = rolled
    kept = math.exp(-h)
    if h < _SMALL:
        before = h * (0.5 - h * (1.0 / 3.0 - h * (0.125 - h * (1.0 / 30.0 - h / 144.0))))
        after = h * (0.5 - h * (1.0 / 6.0 - h * (1.0 / 24.0 - h * (1.0 / 120.0 - h / 720.0))))
        return RelaxationStep(kept, before, after)
    mean = (1.0 - kept) / h
    return RelaxationStep(kept, mean - kept, 1.0 - mean)
