"""Orifice and filling: what is refused."""

from __future__ import annotations

import math

import pytest

from railgrip.brake.filling import Distributor, distributor
from railgrip.brake.orifice import orifice_time, rate_constant_fill, rate_constant_vent
from railgrip.core.errors import RailgripError


@pytest.mark.parametrize(
    ("start", "end", "other"),
    [(3e5, 0.0, 0.0), (3e5, 3.5e5, 0.0), (1e5, 7e5, 7e5), (1e5, 0.5e5, 7e5), (1e5, math.nan, 7e5)],
)
def test_a_pressure_out_of_reach_is_refused(start: float, end: float, other: float) -> None:
    with pytest.raises(RailgripError, match="the pressure never gets there"):
        orifice_time(start, end, other, 1.0)


@pytest.mark.parametrize("time", [0.0, -1.0, math.nan, math.inf])
def test_a_time_must_be_positive(time: float) -> None:
    with pytest.raises(RailgripError, match="time must be positive"):
        rate_constant_vent(3e5, 1e5, time)
    with pytest.raises(RailgripError, match="time must be positive"):
        rate_constant_fill(1e5, 3e5, 7e5, time)


def test_a_rate_constant_must_be_positive() -> None:
    with pytest.raises(RailgripError, match="rate constant must be positive"):
        orifice_time(3e5, 1e5, 0.0, 0.0)


def test_no_way_takes_no_time() -> None:
    assert orifice_time(3e5, 3e5, 0.0, 1.0) == 0.0


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"pressure": 0.3e5}, "above 0.4 bar"),
        ({"pressure": math.nan}, "above 0.4 bar"),
        ({"inshot": 0.95}, "inshot is out of range"),
        ({"inshot": -0.1}, "inshot is out of range"),
        ({"inshot": 0.1, "inshot_time": 5.0}, "longer than the filling"),
        ({"fill_time": 0.0}, "time must be positive"),
    ],
)
def test_an_impossible_distributor_is_refused(options: dict[str, float], sentence: str) -> None:
    usual = {"pressure": 3.8e5, "fill_time": 4.0, "release_time": 15.0}
    with pytest.raises(RailgripError, match=sentence):
        _made(**{**usual, **options})


def _made(
    pressure: float,
    fill_time: float,
    release_time: float,
    inshot: float = 0.0,
    inshot_time: float = 0.5,
) -> Distributor:
    return distributor(pressure, fill_time, release_time, inshot=inshot, inshot_time=inshot_time)
