"""The source's circuit: adder, subtractor, transistor and relay with hysteresis."""

from __future__ import annotations

from typing import NamedTuple


class CoastingCircuit(NamedTuple):
    """Resistors and scales of the circuit; its state is the relay.

    Parameters
    ----------
    r1, r2, r3 : float
        Input of the distance, input of the target speed, feedback of the adder A, > 0, [Ω].
    r4, r9 : float
        Input of the actual speed and positive feedback at the subtractor S, > 0, [Ω].
    distance_scale : float
        Potential U_z for one metre, > 0, [V/m].
    speed_scale : float
        Potentials U_vz and U_vi for one m/s, > 0, [V s/m].
    supply : float
        Potential fed back through R9 while the transistor conducts, > 0, [V].

    Notes
    -----
    ``U_A = (R3/R1) U_z + (R3/R2) U_vz``. The transistor conducts once ``U_vi > U_A`` and goes on
    until ``U_vi + (R4/R9) U_supply < U_A``. Hence ``k1 = (R3/R1) s_z/s_v``, ``k2 = R3/R2``,
    ``Δ = (R4/R9) U_supply/s_v``. The source names R1/R3 and R2/R3 and the feedback R9, but no
    values and not what lies between; R4 is ours.

    References
    ----------
    .. [1] H. Übel, ES 100 730, figure 3 and claim 4.

    Checked by tests/laws/test_coasting.py: the same curves and the same switching as the formulas.

    Examples
    --------
    >>> circuit = CoastingCircuit(20e3, 10e3, 10e3, 10e3, 150e3, 2e-3, 0.1, 15.0)
    >>> circuit.distance_gain, circuit.speed_gain, circuit.hysteresis
    (0.01, 1.0, 10.0)
    """

    r1: float
    r2: float
    r3: float
    r4: float
    r9: float
    distance_scale: float
    speed_scale: float
    supply: float

    @property
    def distance_gain(self) -> float:
        """k1, [1/s]."""
        return self.r3 / self.r1 * self.distance_scale / self.speed_scale

    @property
    def speed_gain(self) -> float:
        """k2, [1]."""
        return self.r3 / self.r2

    @property
    def hysteresis(self) -> float:
        """Δ, [m/s]."""
        return self.r4 / self.r9 * self.supply / self.speed_scale

    def adder(self, distance: float, target_speed: float) -> float:
        """Return the potential U_A of a distance and a target speed, [V]."""
        currents = (
            self.distance_scale * distance / self.r1 + self.speed_scale * target_speed / self.r2
        )
        return self.r3 * currents

    def curve(self, distance: float, target_speed: float) -> float:
        """Return the speed whose potential equals the adder's, [m/s]."""
        return self.adder(distance, target_speed) / self.speed_scale

    def relay(
        self, was_on: bool, distance: float, target_speed: float, actual_speed: float
    ) -> bool:
        """Return whether the relay is on, and traction off."""
        fed_back = self.r4 / self.r9 * self.supply if was_on else 0.0
        difference = self.speed_scale * actual_speed + fed_back - self.adder(distance, target_speed)
        return difference > 0.0
