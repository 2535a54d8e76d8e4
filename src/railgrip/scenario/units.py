"""Units come in at the door: annotated floats that read "160 km/h" and hold SI.

A plain number is taken as SI (temperatures: °C). A wrong dimension is refused with the allowed
unit named. Ranges are given with the field: ``tare: Mass = Field(gt=0, le=250e3)``.
"""

from __future__ import annotations

from typing import Annotated

from railgrip.scenario.quantity import Unit

RATIO = Unit("", "", 1.0, "12 %")

Length = Annotated[float, Unit("m", "m", 1.0, "1.2 km")]
Speed = Annotated[float, Unit("m/s", "km/h", 3.6, "160 km/h")]
Time = Annotated[float, Unit("s", "s", 1.0, "0.5 s")]
Angle = Annotated[float, Unit("rad", "mrad", 1e3, "5 mrad")]
Mass = Annotated[float, Unit("kg", "kg", 1.0, "44 t")]
Force = Annotated[float, Unit("N", "N", 1.0, "25 kN")]
Pressure = Annotated[float, Unit("Pa", "bar", 1e-5, "3.8 bar")]
Stress = Annotated[float, Unit("Pa", "GPa", 1e-9, "210 GPa")]
Temperature = Annotated[float, Unit("degC", "°C", 1.0, "20 degC")]
Dimensionless = Annotated[float, RATIO]
Percentage = Annotated[float, Unit("percent", "%", 1.0, "150 %")]
Gradient = Annotated[float, Unit("", "‰", 1e3, "12 ‰")]
Power = Annotated[float, Unit("W", "kW", 1e-3, "1.6 MW")]
Energy = Annotated[float, Unit("J", "J", 1.0, "10 MJ")]
Spin = Annotated[float, Unit("1/m", "1/m", 1.0, "0.5 1/m")]
Area = Annotated[float, Unit("m^2", "cm²", 1e4, "324 cm^2")]
Volume = Annotated[float, Unit("m^3", "l", 1e3, "150 l")]
VolumeFlow = Annotated[float, Unit("m^3/s", "l/min", 6e4, "800 l/min")]
MassFlow = Annotated[float, Unit("kg/s", "g/min", 6e4, "500 g/min")]
MassPerLength = Annotated[float, Unit("kg/m", "g/m", 1e3, "7.5 g/m")]
Acceleration = Annotated[float, Unit("m/s^2", "m/s²", 1.0, "1.2 m/s^2")]
FrictionDecay = Annotated[float, Unit("s/m", "s/m", 1.0, "0.2 s/m")]
LengthPerEnergy = Annotated[float, Unit("m/J", "m/J", 1.0, "1.9e-4 m/J")]
WearRate = Annotated[float, Unit("m^3/J", "cm³/MJ", 1e12, "0.3 cm^3/MJ")]
Conductance = Annotated[float, Unit("W/K", "W/K", 1.0, "450 W/K")]
HeatTransfer = Annotated[float, Unit("W/m^2/K", "W/(m²K)", 1.0, "9 W/m^2/K")]
TorsionalStiffness = Annotated[float, Unit("N*m/rad", "MN·m/rad", 1e-6, "5 MN*m/rad")]
TorsionalDamping = Annotated[float, Unit("N*m*s/rad", "kN·m·s/rad", 1e-3, "2 kN*m*s/rad")]
LinearResistance = Annotated[float, Unit("N/(m/s)", "N/(m/s)", 1.0, "110 N/(m/s)")]
QuadraticResistance = Annotated[float, Unit("N/(m/s)^2", "N/(m/s)²", 1.0, "7 N/(m/s)^2")]
