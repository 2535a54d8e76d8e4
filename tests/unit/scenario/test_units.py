import math

import pytest
from pydantic import BaseModel, Field, ValidationError

from railgrip.scenario.conversion import conversion, si_value
from railgrip.scenario.units import Gradient, Power, Pressure, Speed, Temperature, Volume


class Sample(BaseModel):
    speed: Speed = Field(default=0.0, ge=0)
    pressure: Pressure = 0.0
    temperature: Temperature = 0.0
    gradient: Gradient = 0.0
    volume: Volume = 0.0
    power: Power = 0.0


@pytest.mark.parametrize(
    ("field", "text", "value"),
    [
        ("speed", "36 km/h", 10.0),
        ("speed", "36km/h", 10.0),
        ("speed", 10, 10.0),
        ("pressure", "3.8 bar", 380000.0),
        ("temperature", "20 degC", 20.0),
        ("temperature", "-20 °C", -20.0),
        ("temperature", "293.15 K", 20.0),
        ("temperature", 20.0, 20.0),
        ("gradient", "12 ‰", 0.012),
        ("gradient", "1.2 %", 0.012),
        ("gradient", "-0.012", -0.012),
        ("volume", "12 l", 0.012),
        ("power", "6.4e3 kW", 6.4e6),
    ],
)
def test_reads(field, text, value):
    assert getattr(Sample(**{field: text}), field) == value


@pytest.mark.parametrize(
    "wrong",
    [
        "160",
        "160 bar",
        "km/h",
        "fast",
        "",
        "160 km/h please",
        "0x10 m/s",
        "1,5 m/s",
        "nan m/s",
        "1e400 m/s",
        math.nan,
        math.inf,
        True,
        None,
        [1],
        10**400,
        "1 m**9**9**9**9/s",
        "1 (m/s)^9^9^9^9",
        "1 m/s" + " " * 10**6,
        "1 __import__('os')",
    ],
)
def test_refuses_with_the_allowed_unit(wrong):
    with pytest.raises(ValidationError) as caught:
        Sample(speed=wrong)
    (error,) = caught.value.errors()
    assert "m/s" in error["ctx"]["allowed"]
    assert "160 km/h" in error["ctx"]["allowed"]


def test_range_is_checked_in_si():
    with pytest.raises(ValidationError, match="greater than or equal to 0"):
        Sample(speed="-1 km/h")


def test_unit_of_another_dimension_has_no_conversion():
    assert conversion("kg", "m") is None
    assert conversion("km/h", "m/s") == pytest.approx((1 / 3.6, 0.0))


@pytest.mark.parametrize(
    ("text", "value"),
    [("5 km/h", 1.38888888888889), ("20 %", 0.2), ("80 degC", 80.0), ("3", 3.0), ("x", None)],
)
def test_parameters_of_any_dimension(text, value):
    assert si_value(text) == value
