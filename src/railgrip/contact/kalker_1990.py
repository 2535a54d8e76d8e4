"""Kalker's linear theory: creepage coefficients and the initial slope of the creep curve."""

import csv
import math
from functools import cache
from importlib.resources import files
from typing import NamedTuple

from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.patch import hertz_1882

_NAMES = ("c11", "c22", "c23", "c33")
_STEP = 0.1


class KalkerCoefficients(NamedTuple):
    """Creepage coefficients of an elliptic patch.

    Parameters
    ----------
    c11 : float
        Longitudinal force by longitudinal creepage [-].
    c22 : float
        Lateral force by lateral creepage [-].
    c23 : float
        Lateral force by spin, and spin moment by lateral creepage [-].
    c33 : float
        Spin moment by spin [-].
    """

    c11: float
    c22: float
    c23: float
    c33: float


def kalker_coefficients(a: float, b: float, poisson: float) -> KalkerCoefficients:
    """Creepage coefficients for the semi-axes of a patch (Kalker 1990).

    Choose it to set up a calculation; it reads a table and does not belong in an inner loop.

    Parameters
    ----------
    a, b : float
        Semi-axes along and across the track, > 0 [m].
    poisson : float
        Poisson's ratio, 0 … 0.5 [-].

    Returns
    -------
    KalkerCoefficients
        C11, C22, C23, C33 [-].

    Raises
    ------
    RailgripError
        "the semi-axes must be positive and finite" or "Poisson's ratio is outside Kalker's table".

    Notes
    -----
    Fx = −G ab C11 ξ; Fy = −G ab C22 η − G (ab)^(3/2) C23 φ;
    Mz = G (ab)^(3/2) C23 η − G (ab)² C33 φ.
    Between the rows of the table linear in g = short/long semi-axis, then a parabola in ν through
    the reciprocals 1/C at ν = 0, ¼, ½ (through C itself for C33). Below g = 0.1 Kalker's
    asymptotes take over with a step at g = 0.1, their own error there: with a < b up to 1.8 % in
    C11, 2.5 % in C22, 6.3 % in C23 and 5.5 % in C33; with a > b 4.4, 3.1, 1.0 and 6.7 %. C33 and
    its asymptotes are quoted from memory, unverified; in the range of the table C33 is within 3 %
    of the exact half-space method.

    References
    ----------
    .. [1] J. J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, Kluwer 1990,
       table E.3, doi:10.1007/978-94-015-7889-9.

    Checked by tests/reference/kalker_base_case, 1e-6.

    Examples
    --------
    >>> round(kalker_coefficients(7.191978e-3, 5.409966e-3, 0.28).c11, 5)
    4.55047
    """
    _refuse_bad_input(a, b, poisson)
    g = min(a, b) / max(a, b)
    if g < _STEP:
        return _short_asymptote(g, poisson) if a < b else _long_asymptote(g, poisson)
    rows = _table()["a" if a < b else "b"]
    index = min(int(g / _STEP) - 1, len(rows) - 2)
    share = (g - rows[index][0]) / (rows[index + 1][0] - rows[index][0])
    between = [
        low + share * (high - low)
        for low, high in zip(rows[index][1], rows[index + 1][1], strict=True)
    ]
    c11, c22, c23 = (
        1.0 / _over_poisson([1.0 / node for node in between[k : k + 3]], poisson) for k in (0, 3, 6)
    )
    return KalkerCoefficients(c11, c22, c23, _over_poisson(between[9:], poisson))


def kalker_slope(
    load: float,
    wheel_radius: float,
    wheel_transverse_radius: float,
    rail_transverse_radius: float,
    young: float,
    poisson: float,
) -> float:
    """Initial slope of the longitudinal creep curve of one wheel, G a b C11.

    The slope grows with load^(2/3), for the shape of the ellipse does not depend on the load.

    Parameters
    ----------
    load, wheel_radius, wheel_transverse_radius, rail_transverse_radius, young, poisson : float
        As in `railgrip.core.formulas.patch.hertz_1882`.

    Returns
    -------
    float
        Slope [N per unit creepage].

    Raises
    ------
    RailgripError
        From `hertz_1882` and `kalker_coefficients`.

    Examples
    --------
    >>> round(kalker_slope(100e3, 0.46, math.inf, 0.3, 210e9, 0.28) / 1e6, 4)
    14.5237
    """
    patch = hertz_1882(
        load, wheel_radius, wheel_transverse_radius, rail_transverse_radius, young, poisson
    )
    shear_modulus = young / (2.0 * (1.0 + poisson))
    return shear_modulus * patch.a * patch.b * kalker_coefficients(patch.a, patch.b, poisson).c11


def _over_poisson(nodes: list[float], poisson: float) -> float:
    """Lagrange parabola through the values at ν = 0, ¼, ½."""
    at_0, at_quarter, at_half = nodes
    return (
        8.0 * (poisson - 0.25) * (poisson - 0.5) * at_0
        - 16.0 * poisson * (poisson - 0.5) * at_quarter
        + 8.0 * poisson * (poisson - 0.25) * at_half
    )


def _short_asymptote(g: float, poisson: float) -> KalkerCoefficients:
    """Patch much shorter along the track than across, g = a/b → 0."""
    pi, drift = math.pi, 1.0 - poisson
    c23 = pi * math.sqrt(g) / (3.0 * drift) * (1.0 + poisson * (math.log(16.0 / g) - 5.0))
    return KalkerCoefficients(
        pi * pi / (4.0 * drift), pi * pi / 4.0, c23, pi * pi / (16.0 * drift * g)
    )


def _long_asymptote(g: float, poisson: float) -> KalkerCoefficients:
    """Patch much longer along the track than across, g = b/a → 0."""
    pi, drift = math.pi, 1.0 - poisson
    spread = math.log(16.0 / (g * g))
    excess = 3.0 - math.log(4.0)
    along = spread - 2.0 * poisson
    across = drift * spread + 2.0 * poisson
    spin = drift * spread - 2.0 + 4.0 * poisson
    return KalkerCoefficients(
        2.0 * pi / (along * g) * (1.0 + excess / along),
        2.0 * pi / (across * g) * (1.0 + drift * excess / across),
        2.0 * pi / (3.0 * g * math.sqrt(g) * spin),
        0.25 * pi * (1.0 - poisson * (spread - 2.0) / spin),
    )


@cache
def _table() -> dict[str, list[tuple[float, list[float]]]]:
    """Rows (g, twelve coefficients) by the shorter semi-axis, rising in g to the circle."""
    source = files("railgrip") / "data" / "contact" / "kalker_1990.csv"
    lines = [line for line in source.read_text("utf-8").splitlines() if line[:1] != "#"]
    table: dict[str, list[tuple[float, list[float]]]] = {"a": [], "b": []}
    columns = [f"{name}_{nu}" for name in _NAMES for nu in (0, 25, 50)]
    for row in csv.DictReader(lines):
        values = [float(row[column]) for column in columns]
        table[row["short_axis"]].append((float(row["g"]), values))
    circle = table["a"][-1]
    return {"a": table["a"], "b": sorted([*table["b"], circle])}


def _refuse_bad_input(a: float, b: float, poisson: float) -> None:
    if not (0.0 < a < math.inf and 0.0 < b < math.inf):
        raise RailgripError(
            Problem("", "the semi-axes must be positive and finite", got=f"a = {a} m, b = {b} m")
        )
    if not 0.0 <= poisson <= 0.5:
        raise RailgripError(
            Problem(
                "", "Poisson's ratio is outside Kalker's table", got=f"{poisson}", allowed="0 … 0.5"
            )
        )
