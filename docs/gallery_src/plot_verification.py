"""
Simulated against published
===========================

Stops and figures that others have published, beside what this version of railgrip gives. The same
comparisons are tests in ``tests/reference``, with the tolerance and its reason.
"""

# %%

from typing import NamedTuple

import railgrip as rg


class Row(NamedTuple):
    """One figure, published and simulated."""

    what: str
    source: str
    unit: str
    published: float
    simulated: float


def stopping_distance(name):
    """Simulate a shipped scenario; return its stopping distance in m."""
    return float(rg.simulate(rg.load(name)).data["stopping_distance"][0])


def braked_weight(name):
    """Braked weight of a shipped scenario's train by its data sheet, in % of its mass."""
    scenario = rg.load(name)
    return 100 * scenario.train.braked_weight / scenario.mass


def wheel_force(rail, creepage=0.01, train_speed=20.0):
    """Polach's force on the base geometry: wheel of 0.46 m, rail of 0.3 m, 100 kN."""
    from railgrip.contact.polach_2005 import polach_2005

    return polach_2005(rail, 100e3, SLOPE, creepage * train_speed, creepage)


# %%
# The stops. The braked weight of a vehicle, in per cent of its mass, follows from the stopping
# distance s of the slip test (UIC 544-1): 52 840/s − 10 from 100 km/h, 83 634/s − 19 from 120 km/h.

from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005

SLOPE = 14.523733e6  # G a b C11 of the base geometry, N
wagon = stopping_distance("wagon_100")
coach = stopping_distance("coach_120")
rows = [
    Row("EMU from 100 km/h, stepped in time", "EN 14531-1 example", "m", 496.1,
        stopping_distance("en14531_100")),
    Row("Laden wagon from 100 km/h", "measured", "m", 596.0, wagon),
    Row("Braked weight of the laden wagon", "its data sheet", "%", braked_weight("wagon_100"),
        52840 / wagon - 10),
    Row("Braked weight of the coach", "its data sheet (illustrative)", "%",
        braked_weight("coach_120"), 83634 / coach - 19),
    Row("Creep force, dry, 1 % at 20 m/s", "Polach 2005", "N", 35940.38,
        wheel_force(DRY_POLACH_2005)),
    Row("Creep force, wet, 1 % at 20 m/s", "Polach 2005", "N", 16138.10,
        wheel_force(WET_POLACH_2005)),
]  # fmt: skip


class Table(list):
    """Rows as a table of the page."""

    def _repr_html_(self):
        body = "".join(
            f"<tr><td>{row.what}</td><td>{row.source}</td><td>{row.published:g} {row.unit}</td>"
            f"<td>{row.simulated:.7g} {row.unit}</td>"
            f"<td>{row.simulated / row.published - 1:+.2%}</td></tr>"
            for row in self
        )
        heads = "".join(
            f"<th>{head}</th>" for head in ("figure", "source", "published", "simulated", "error")
        )
        return f"<table><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>"


Table(rows)

# %%
# No train can stop faster than the friction lets it: on level rail without resistance the distance
# is at least v²/2τg. What a stop on constant adhesion, without sand, makes of it:

scenario = rg.load("dry_emergency").with_(
    {
        "rail.condition": {"contaminated": {"static_friction": 0.08, "friction_ratio": 1.0}},
        "train.sander.rail_friction": 0.0,
        "train.resistance": {"constant": 0.0, "linear": 0.0, "quadratic": 0.0},
    }
)
result = rg.simulate(scenario)
bound = scenario.run.speed**2 / (2 * 0.08 * 9.81)
print(f"bound {bound:.1f} m, simulated {float(result.data['stopping_distance'][0]):.1f} m")
