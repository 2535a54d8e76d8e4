"""Where the kinetic energy went."""

from __future__ import annotations

from typing import Any, NamedTuple

from railgrip.report.view import View, dataset_of

TERMS = {
    "energy_brake": "Friction brakes",
    "energy_dynamic": "Dynamic brake",
    "energy_track_brake": "Magnetic track brakes",
    "energy_contact": "Sliding between wheel and rail",
    "energy_resistance": "Running resistance",
    "energy_gradient": "Gradient (uphill positive)",
    "energy_kinetic_final": "Still moving at the end",
}


class EnergyRow(NamedTuple):
    """One term of the balance.

    Attributes
    ----------
    name, label : str
        Variable; name in words.
    energy : float
        J.
    share : float
        Of the initial kinetic energy and the work of traction, 0…1.
    """

    name: str
    label: str
    energy: float
    share: float


def energy_table(result: Any, run: int = 0) -> list[EnergyRow]:
    """Return where the initial kinetic energy and the work of traction went, term by term.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave.
    run : int
        Which run of the batch.

    Returns
    -------
    list of EnergyRow
        The sinks, then ``unexplained``: initial energy less all sinks. No sink is a remainder,
        so this last row is the error of the balance.

    Examples
    --------
    >>> import xarray as xr
    >>> data = xr.Dataset({"energy_kinetic_initial": ("run", [2e6]),
    ...                    "energy_brake": ("run", [1.5e6]),
    ...                    "energy_resistance": ("run", [0.5e6])})
    >>> [(row.label, row.share) for row in energy_table(data)]
    [('Friction brakes', 0.75), ('Running resistance', 0.25), ('Unexplained', 0.0)]
    """
    view = View(dataset_of(result), run)
    initial = view.number("energy_kinetic_initial")
    traction = view.number("energy_traction") if view.has("energy_traction") else 0.0
    initial += traction
    if initial != initial or initial <= 0:
        return []
    rows = []
    for name, label in TERMS.items():
        energy = view.number(name)
        if energy == energy:
            rows.append(EnergyRow(name, label, energy, energy / initial))
    rest = initial - sum(row.energy for row in rows)
    return [*rows, EnergyRow("unexplained", "Unexplained", rest, rest / initial)]
