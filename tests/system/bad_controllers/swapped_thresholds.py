"""Deliberately bad: lower and upper slip threshold are swapped."""

from railgrip.control.conventional_wsp import ConventionalWSP


class SwappedThresholds(ConventionalWSP):
    def __init__(self, parameters=None, *, period=0.01):
        super().__init__(parameters, period=period)
        given = self.parameters
        swapped = given._replace(
            slip_lower=given.slip_upper, slip_upper=given.slip_lower,
            slip_speed_lower_floor=given.slip_speed_upper_floor,
            slip_speed_upper_floor=given.slip_speed_lower_floor,
        )  # fmt: skip
        super(ConventionalWSP, self).__init__(swapped, period)
