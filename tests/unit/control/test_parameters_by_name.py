"""Parameters taken by name stand where the array has them: defaults alone would hide a swap."""

import numpy as np

from railgrip.control.conventional_parameters import ConventionalParameters, conventional_of
from railgrip.control.temperature_parameters import (
    TemperatureOnly,
    TemperatureParameters,
    temperature_of,
)

PLACES = np.arange(float(len(TemperatureParameters._fields)))


def test_every_ordinary_parameter_is_read_at_its_place():
    assert conventional_of(PLACES) == ConventionalParameters(
        *PLACES[: len(conventional_of(PLACES))]
    )


def test_every_parameter_of_temperature_control_is_read_behind_them():
    assert temperature_of(PLACES) == TemperatureOnly(*PLACES[len(ConventionalParameters._fields) :])
