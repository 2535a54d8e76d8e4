"""Subtly bad: after a release the brake comes back in one sweep, without steps or lead."""

from railgrip.control.conventional_wsp import ConventionalWSP


class HastyFilling(ConventionalWSP):
    def __init__(self, parameters=None, *, period=0.01):
        super().__init__(parameters, period=period)
        hasty = self.parameters._replace(fill_pulse=10.0, fill_hold=0.0, lead_time=0.0)
        super().__init__(hasty, period=period)
