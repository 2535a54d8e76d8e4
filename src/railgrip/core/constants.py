"""Constants that more than one storey needs, SI."""

GRAVITY = 9.81
"""Acceleration of gravity, m/s² (the value of EN 14531-1 and of the braking formulas)."""

ATMOSPHERE = 1.0e5
"""Absolute pressure outside the brake, Pa (technical: 1 bar, as brake tables use it)."""

ZERO_CELSIUS = 273.15
"""0 °C in K."""

STEFAN_BOLTZMANN = 5.670374419e-8
"""W/(m² K⁴), CODATA 2018."""
