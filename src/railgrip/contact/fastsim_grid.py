"""Kalker's simplified theory on a grid of cells, as FASTSIM and its modifications use it."""

import math
from typing import NamedTuple

from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact

CELLS = 50
"""Strips across the patch, and cells in each, of the registered laws."""
_LEAST_TRACTION, _LEAST_SQUARE = 1e-12, 1e-24


class Flexibilities(NamedTuple):
    """Displacement of the surface over the traction at the same point, L1, L2, L3 [m/Pa].

    Parameters
    ----------
    longitudinal, lateral, spin : float
        For each creepage the one with which the whole patch, sticking, gives Kalker's force.
    """

    longitudinal: float
    lateral: float
    spin: float


def flexibilities(contact: RollingContact) -> Flexibilities:
    """Flexibilities that give linear theory's forces: L1 = 8a/(3 G C11), L2 with C22, and
    L3 = π a²/(4 G √(ab) C23).

    Examples
    --------
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> [f"{value:.4g}" for value in flexibilities(base)]
    ['5.138e-14', '5.643e-14', '4.248e-14']
    """
    shear, a = contact.shear_modulus, contact.a
    root = math.sqrt(a * contact.b)
    return Flexibilities(
        8.0 * a / (3.0 * shear * contact.c11),
        8.0 * a / (3.0 * shear * contact.c22),
        math.pi * a * a / (4.0 * shear * root * contact.c23),
    )


def next_traction(
    size: float, along: float, across: float, rise_x: float, rise_y: float, bound: float
) -> tuple[float, float, float]:
    """Traction of the next cell of a strip, towards the trailing edge.

    Parameters
    ----------
    size, along, across : float
        Traction in the cell before [Pa], and its direction, a unit vector.
    rise_x, rise_y : float
        What it would rise by, if the surfaces stuck [Pa].
    bound : float
        Greatest traction in this cell, friction times pressure, ≥ 0 [Pa].

    Returns
    -------
    tuple of float
        Traction, ≤ bound, and its direction.

    Notes
    -----
    Where friction does not hold the trial traction T, it gives way by λ along the mean of the old
    and the new direction: B n' + λ (n + n')/2 = T, solved by λ = (|T|² − B²)/(B + T·n),
    n' ∥ T − λ n/2. Kalker cuts T down to B; that is of first order in the length of a cell where
    spin turns the traction, this of second. As T turns away from n, the share of n fades out.

    Examples
    --------
    >>> traction, along, across = next_traction(3.0, 1.0, 0.0, 1.0, 3.0, 10.0)
    >>> round(traction, 6), round(along, 6), round(across, 6)
    (5.0, 0.8, 0.6)
    """
    trial_x, trial_y = size * along + rise_x, size * across + rise_y
    square = max(trial_x * trial_x + trial_y * trial_y, _LEAST_SQUARE)
    trial = math.sqrt(square)
    held = min(trial, bound)
    straight = max(trial_x * along + trial_y * across, 0.0)
    given_way = (trial - held) * (trial + held)
    back = 0.5 * given_way * straight / (max(held + straight, _LEAST_TRACTION) * trial)
    turned_x, turned_y = trial_x - back * along, trial_y - back * across
    shrink = 1.0 / math.sqrt(max(square - back * (2.0 * straight - back), _LEAST_SQUARE))
    return held, shrink * turned_x, shrink * turned_y


class Strip(NamedTuple):
    """What is the same in all cells of a strip along the track.

    Parameters
    ----------
    y, edge : float
        Where the strip lies, and where its leading edge is: x_l = a √(1 − y²/b²) [m].
    rise_x, rise_y, turning : float
        Rise of the sticking traction over half the strip, along and across the track; that across
        changes with x by the spin, `turning` · x/x_l [Pa].
    bound : float
        Greatest traction in the middle of the strip [Pa].
    """

    y: float
    edge: float
    rise_x: float
    rise_y: float
    turning: float
    bound: float


def strip_at(
    cos: float,
    sin: float,
    contact: RollingContact,
    bound: float,
    flexible: Flexibilities,
    creepage: Creepage,
    is_elliptic: bool,
) -> Strip:
    """Strip at y = b cos ψ of a patch with this traction bound at its centre.

    Examples
    --------
    >>> wheel = RollingContact(100e3, 7e-3, 5e-3, 82e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> rolls = Creepage(0.0, 0.0, 0.0)
    >>> round(strip_at(0.6, 0.8, wheel, 5e8, flexibilities(wheel), rolls, True).edge, 6)
    0.0056
    """
    y, edge = contact.b * cos, contact.a * sin
    turn = creepage.spin / flexible.spin
    return Strip(
        y,
        edge,
        edge * (creepage.longitudinal / flexible.longitudinal - turn * y),
        edge * (creepage.lateral / flexible.lateral),
        edge * edge * turn,
        bound * (sin if is_elliptic else sin * sin),
    )


def greatest_bound(contact: RollingContact, limit: float, half: float, is_elliptic: bool) -> float:
    """Traction bound at the centre that lets the cells together transmit the force `limit` [Pa].

    Examples
    --------
    >>> wheel = RollingContact(100e3, 7e-3, 5e-3, 82e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> round(greatest_bound(wheel, 30e3, 0.01, True) / 1e6, 3)
    409.262
    """
    share = (1.5 if is_elliptic else 2.0) * half / math.sin(half)
    return share * limit / (math.pi * contact.a * contact.b)


def fastsim_on_grid(
    contact: RollingContact,
    limit: float,
    flexible: Flexibilities,
    creepage: Creepage,
    cells: int,
    is_elliptic: bool,
) -> CreepForce:
    """Forces and moment of the simplified theory, strip by strip from the leading edge.

    Parameters
    ----------
    contact : RollingContact
        The contact.
    limit : float
        Friction force of the whole patch, μQ ≥ 0 [N].
    flexible : Flexibilities
        L1, L2, L3.
    creepage : Creepage
        Longitudinal and lateral creepage and spin.
    cells : int
        Strips, and cells in each, ≥ 2.
    is_elliptic : bool
        Traction bound: Hertz's ellipsoid, else Kalker's paraboloid.

    Returns
    -------
    CreepForce
        Forces [N], moment [N m].

    Notes
    -----
    Along a strip at y, from x_l = a √(1 − y²/b²) towards −x_l, the traction rises by
    (s_x/L1 − φ y/L3, s_y/L2 + φ x/L3) per length and is bounded by μ p,
    p = (2Q/πab)(1 − x²/a² − y²/b²) or (3Q/2πab) √(…).
    Centres of strips and cells are y = b cos ψ, x = x_l cos θ with even steps of ψ and θ:
    narrow at the edges, where the traction changes. The cells' pressures are set to sum up to Q.

    Examples
    --------
    See `railgrip.contact.fastsim_1982.fastsim_1982`.
    """
    half = 0.5 * math.pi / cells
    turn_cos, turn_sin = math.cos(2.0 * half), math.sin(2.0 * half)
    first_cos, first_sin = math.cos(half), math.sin(half)
    greatest = greatest_bound(contact, limit, half, is_elliptic)
    force_x = force_y = moment = 0.0
    strip_cos, strip_sin = first_cos, first_sin
    for _ in range(cells):
        strip = strip_at(strip_cos, strip_sin, contact, greatest, flexible, creepage, is_elliptic)
        traction = along = across = strip_x = strip_y = strip_moment = 0.0
        cos, sin, front = first_cos, first_sin, 1.0
        for _ in range(cells):
            step, middle = front - cos, 0.5 * (front + cos)
            traction, along, across = next_traction(
                traction,
                along,
                across,
                step * strip.rise_x,
                step * (strip.rise_y + strip.turning * middle),
                strip.bound * (sin if is_elliptic else sin * sin),
            )
            weight = sin * traction
            strip_x += weight * along
            strip_y += weight * across
            strip_moment += weight * cos * across
            front = cos
            cos, sin = cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin
        weight = strip_sin * strip_sin
        force_x += weight * strip_x
        force_y += weight * strip_y
        moment += weight * (strip.edge * strip_moment - strip.y * strip_x)
        strip_cos, strip_sin = (
            strip_cos * turn_cos - strip_sin * turn_sin,
            strip_sin * turn_cos + strip_cos * turn_sin,
        )
    cell = 4.0 * half * first_sin * contact.a * contact.b
    return CreepForce(cell * force_x, cell * force_y, cell * moment)
