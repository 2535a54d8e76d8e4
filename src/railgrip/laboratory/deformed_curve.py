"""Creep curves deformed by an angle of attack and by a swinging wheel load."""

from __future__ import annotations

import types

import numpy as np
from numpy.typing import ArrayLike

from railgrip.compiler import inlined, numba
from railgrip.contact.angle_of_attack import STRAIGHT, WheelAttitude, attack_creepage
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import RollingContact, RollingLaw
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.laboratory.creep_curve import CreepCurve, creep_curve
from railgrip.laboratory.inputs import checked_number
from railgrip.laboratory.load_cycle import load_cycle, mean_forces

RELAXATIONS = ("constant_length", "constant_stiffness")

_STEPS = 512
_SHORTEST_WAVE = 0.01  # over the semi-axis a


def deformed_curve(
    law: RollingLaw,
    contact: RollingContact,
    rail: RailFriction,
    *,
    speed: float,
    creepage: ArrayLike | None = None,
    attitude: WheelAttitude = STRAIGHT,
    amplitude: float = 0.0,
    frequency: float = 0.0,
    relaxation: str = "constant_length",
    steps: int = _STEPS,
) -> CreepCurve:
    """Creep curve of a wheel that yaws, bounces, or both.

    Choose it to see what a curve of the test bench is worth on a track. Without attitude, amplitude
    and frequency it is the undisturbed curve of the law.

    Parameters
    ----------
    law : function
        Law of rolling contact, a plain function; `along_the_resultant` makes one from a law of the
        plant.
    contact : RollingContact
        The contact under the mean load Q0.
    rail : RailFriction
        State of the rail.
    speed : float
        Speed of the train, > 0 [m/s].
    creepage : array, optional
        Longitudinal creepages s_x = u/v − cos α in the plane of the wheel, rising, ≥ 0;
        `railgrip.laboratory.creep_curve.CREEPAGES` if not given.
    attitude : WheelAttitude
        Angle of attack, and contact angle and radius for the spin.
    amplitude : float
        Amplitude A of the wheel load over its mean, ≥ 0; above 1 the wheel lifts off [-].
    frequency : float
        Frequency of the load, 0 … 100 v/a; 0 is a load that changes slowly [Hz].
    relaxation : {"constant_length", "constant_stiffness"}
        How the force follows; see the notes.
    steps : int
        Steps a cycle; the error falls with their square, 1e-5 of the peak at 512.

    Returns
    -------
    CreepCurve
        Longitudinal force, mean over the load cycle, over s_x.

    Raises
    ------
    RailgripError
        ``amplitude: must not be negative and finite; got -0.1``, and likewise for the other
        numbers; ``frequency: the wave is shorter than a hundredth of the patch``; ``law: cannot be
        compiled``.

    Notes
    -----
    The force follows σ Ḟ + |v| F = |v| F_steady(Q(t)), |F| ≤ μ Q(t), with the load of `load_share`,
    semi-axes ∝ Q^(1/3), slope ∝ Q^(2/3), and

    - ``constant_length``: σ = 8a/(3π) at any creepage, as on the plant;
    - ``constant_stiffness``: σ = (8a/(3π)) F_steady/(slope s). The patch is a spring of one
      stiffness k, Ḟ = k w (1 − F/F_steady), so the more it slides the sooner it follows, and full
      sliding follows the load at once, as friction does. Both agree in the straight beginning;
      beyond it the plant's form remembers too long.

    Only the wavelength v/f counts: f and v together leave the relaxation as it is. What follows:

    - Slow load (v/f ≫ σ): the mean of steady forces. The limit μQ is linear in Q and loses nothing;
      the slope loses because Q^(2/3) is concave, A²/18 for small A: 1.5 % at A = 0.5, 8 % at A = 1,
      14 % at A = 1.5, where the wheel lifts off.
    - Fast load without sliding: the force stands still at the mean of F_steady/σ over that of 1/σ,
      and the slope loses A²/6, three times as much.
    - Fast load with sliding: while the load falls, friction takes force away at once; when it comes
      back, the force needs the length σ to follow. With a constant length a sliding wheel loses
      2Aσ f/v, its peak less; as v/f → 0 the force stays at μ Q_min.

    Peak and slope fall with amplitude, with frequency and with the angle of attack, and further
    with both, and any adhesion on the rising branch needs more creepage. One case falls no further:
    where the angle of attack alone makes the whole patch slide (only laws that end in full sliding
    get there, such as Shen's), a slow load takes nothing more, because μQ is linear in Q. The peak
    itself moves outwards, with one exception: a constant length under a wave shorter than about
    50 σ (0.3 m) cuts the peak off and moves it inwards. At 20 m/s and A = 0.5, 100 Hz lower the
    peak by no more than 0.5 %, hardly more than a slow load does: a strong dependence on frequency
    needs waves of some centimetres, as corrugation has, or small rollers turning slowly.
    Known wrong when v/f is shorter than the patch (2a), over which the contact itself would
    average; and the wheel's own speed is held, although a bouncing wheel slips and grips.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       figures 2.3–2.5: curves of a roller rig, of which only the tendency is compared here.

    Checked by tests/reference/load_cycle (analytic limits) and tests/laws/test_deformed_curves.py.

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.polach_2005 import polach_2005
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> from railgrip.laboratory.resultant import along_the_resultant
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> law = along_the_resultant(polach_2005)
    >>> still = deformed_curve(law, base, DRY_POLACH_2005, speed=20.0)
    >>> bouncing = deformed_curve(
    ...     law, base, DRY_POLACH_2005, speed=20.0, amplitude=0.5, frequency=200.0
    ... )
    >>> round(still.peak.adhesion, 3), round(bouncing.peak.adhesion, 3)
    (0.397, 0.391)
    """
    speed = checked_number("speed", speed, "m/s", least=0.0)
    amplitude = checked_number("amplitude", amplitude, "", least=0.0, or_equal=True)
    frequency = checked_number("frequency", frequency, "Hz", least=0.0, or_equal=True)
    if relaxation not in RELAXATIONS:
        raise RailgripError(unknown_name("relaxation", "form", relaxation, RELAXATIONS))
    checked_number("steps", steps, "", least=1, or_equal=True)
    _refuse_short_waves(contact, speed, frequency)
    _refuse_bad_attitude(attitude)
    places = creep_curve(speed=speed, load=contact.load, creepage=creepage, force=lambda s: 0.0)
    creepages = np.array([attack_creepage(attitude, s) for s in places.creepage.tolist()])
    count = int(steps) if amplitude > 0.0 else 1
    cycle = load_cycle(contact, speed, amplitude, frequency, count)
    steady, memory = np.empty((count + 1, 3)), np.empty((count, 3))
    mean = np.empty((creepages.shape[0], 2))
    shrinks = relaxation == "constant_stiffness"
    try:
        mean_forces(
            _compiled(law), contact, rail, speed, creepages, cycle, shrinks, steady, memory, mean
        )
    except numba.core.errors.NumbaError as error:
        raise RailgripError(
            Problem("law", "cannot be compiled", got=str(error).strip().splitlines()[0],
                    cure="write it with plain numbers and math only")
        ) from error  # fmt: skip
    return creep_curve(speed=speed, load=contact.load, creepage=places.creepage, force=mean[:, 0])


def _compiled(law: RollingLaw) -> object:
    if not isinstance(law, types.FunctionType):
        raise RailgripError(
            Problem("law", "must be a plain Python function", got=type(law).__name__)
        )
    return inlined(law)


def _refuse_short_waves(contact: RollingContact, speed: float, frequency: float) -> None:
    most = speed / (_SHORTEST_WAVE * contact.a)
    if frequency > most:
        raise RailgripError(
            Problem("frequency", "the wave is shorter than a hundredth of the patch",
                    got=f"{frequency:g} Hz at {speed:g} m/s", allowed=f"0 … {most:.0f} Hz")
        )  # fmt: skip


def _refuse_bad_attitude(attitude: WheelAttitude) -> None:
    for name, angle in (
        ("angle_of_attack", attitude.angle_of_attack),
        ("contact_angle", attitude.contact_angle),
    ):
        if not abs(angle) < 0.5 * np.pi:
            raise RailgripError(Problem(name, "must lie between −π/2 and π/2", got=f"{angle} rad"))
    if not attitude.wheel_radius > 0.0:
        raise RailgripError(
            Problem("wheel_radius", "must be positive", got=f"{attitude.wheel_radius} m")
        )
