"""Where controllers keep what they remember: one flat array for a train, the axles side by side.

First come the values of the train, then the axles in groups of sixteen. Within a group the axles'
values of one field stand side by side, so that a loop over the axles becomes packed arithmetic: all
fields of an axle lie at fixed distances, whoever they belong to. Of one axle,
``state[axle_base(axle) + SPEED]`` is its wheel speed.

Every controller that builds on the ordinary protection has the same room; what it does not use
costs nothing.
"""

from __future__ import annotations

from typing import Final

GROUP: Final = 16
"""Axles that stand side by side: the distance between two fields of one axle."""
MOST_GROUPS: Final = 100_000
"""More than any train has."""

# The train: the ordinary protection first (`conventional_state`).
SYSTEM: Final = 13  # then the adaptive supervisor (`adaptive_state`)
OWN_TRAIN: Final = 30  # then temperature control or traction (`temperature_state`, …)
N_TRAIN: Final = 3 * GROUP

# Each axle, in the same order.
OF_SUPERVISOR: Final = 31
OWN: Final = 42
SCRATCH: Final = 90 * GROUP
"""Five places for what only passes from one loop to the next: others use them again in the same
step. The less a step touches, the more of it stays in the processor's first cache."""
N_AXLE: Final = 95


def axle_base(axle: int) -> int:
    """Return where the values of an axle begin.

    Examples
    --------
    >>> axle_base(0), axle_base(2), axle_base(16)
    (48, 50, 1568)
    """
    return N_TRAIN + axle // GROUP * (GROUP * N_AXLE) + axle % GROUP


def groups(n_axles: int) -> int:
    """Return the number of groups.

    The compiler packs a loop over a group's axles only if it sees that no place is negative, and
    sees that only because groups are bounded.

    Examples
    --------
    >>> groups(4), groups(17)
    (1, 2)
    """
    return max(0, min((n_axles + GROUP - 1) // GROUP, MOST_GROUPS))


def n_places(n_axles: int) -> int:
    """Return how many places the groups have: the axles', then empty ones.

    A pass over a group goes over all of its places, since a loop of fixed length is packed without
    a remainder. Empty places hold a wheel whose sensor is not believed, so that they count nowhere.

    Examples
    --------
    >>> n_places(4), n_places(16)
    (16, 16)
    """
    return GROUP * groups(n_axles)


def group_base(group: int) -> int:
    """Return where the values of a group's first axle begin.

    Examples
    --------
    >>> group_base(1) == axle_base(16)
    True
    """
    return N_TRAIN + group * (GROUP * N_AXLE)


def state_size(n_axles: int) -> int:
    """Return the length of the state array.

    Examples
    --------
    >>> state_size(16)
    1568
    """
    return group_base(groups(n_axles))
