"""The pictures every brake engineer looks for, as matplotlib figures.

Import this package late: it loads matplotlib. No figure touches pyplot's state or the user's
settings, and none needs a screen.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from railgrip.core.errors import Problem, RailgripError, nearest
from railgrip.report.plots.adhesion import adhesion
from railgrip.report.plots.air import air
from railgrip.report.plots.deceleration import deceleration
from railgrip.report.plots.energy import energy
from railgrip.report.plots.flash import flash
from railgrip.report.plots.hero import hero
from railgrip.report.plots.pressure import pressure
from railgrip.report.plots.rail import rail
from railgrip.report.plots.slip import slip
from railgrip.report.plots.speeds import speeds
from railgrip.report.plots.style import styled
from railgrip.report.plots.temperature import temperature
from railgrip.report.view import View, dataset_of

__all__ = ["FORMATS", "figures", "hero", "save_figure", "save_figures"]

FORMATS = ("png", "svg", "pdf")
POINTS = 1500
"""Points of a curve: more than a picture has columns."""

_PICTURES: dict[str, tuple[tuple[str, ...], Callable[[View], Figure]]] = {
    "speeds_time": (("wheel_speed",), speeds),
    "speeds_distance": (("wheel_speed", "train_position"), partial(speeds, over="distance")),
    "slip": (("wheel_speed",), slip),
    "pressure": (("brake_cylinder_pressure",), pressure),
    "adhesion": (("adhesion_available", "adhesion_used"), adhesion),
    "rail": (
        ("rail_friction_before", "rail_friction_after", "rail_energy", "train_position"),
        rail,
    ),
    "flash": (("flash_temperature",), flash),
    "temperature": (("disc_temperature",), temperature),
    "deceleration": (("acceleration",), deceleration),
    "energy": (("energy_kinetic_initial",), energy),
    "air": (("reservoir_pressure",), air),
}


def figures(
    result: Any, run: int = 0, *, thresholds: Mapping[str, float] | None = None
) -> dict[str, Figure]:
    """Return every picture that the result has the data for.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave, with traces.
    run : int
        Which run of the batch.
    thresholds : mapping, optional
        Slip thresholds to draw, see `railgrip.report.thresholds`; those of the run if not given.

    Returns
    -------
    dict of matplotlib.figure.Figure
        By name: ``speeds_time``, ``speeds_distance``, ``slip``, ``pressure``, ``adhesion``,
        ``rail``, ``flash``, ``temperature``, ``deceleration``, ``energy``, ``air``.
    """
    view = View(dataset_of(result), run, most=POINTS)
    drawn: dict[str, Figure] = {}
    for name, (needed, draw) in _PICTURES.items():
        if all(view.has(signal) for signal in ("train_speed", *needed)):
            drawn[name] = slip(view, thresholds) if draw is slip else draw(view)
    return drawn


def save_figures(
    result: Any, folder: str | Path, formats: Sequence[str] = FORMATS, run: int = 0
) -> list[Path]:
    """Save every picture in every format as ``<name>.<format>``.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave, with traces.
    folder : str or Path
        Made if it is not there.
    formats : sequence of str
        Some of ``png``, ``svg``, ``pdf``.
    run : int
        Which run of the batch.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    RailgripError
        ``formats: picture format 'jpeg' unknown; allowed: png, svg, pdf``
    """
    for wanted in formats:
        if wanted not in FORMATS:
            guess = nearest(wanted, FORMATS) or "png"
            what = f"picture format '{wanted}' unknown"
            raise RailgripError(Problem("formats", what, allowed=", ".join(FORMATS), cure=guess))
    place = Path(folder)
    place.mkdir(parents=True, exist_ok=True)
    written = []
    for name, picture in figures(result, run).items():
        _lay_out(picture)
        for wanted in formats:
            written.append(save_figure(picture, place / f"{name}.{wanted}"))
    return written


def _lay_out(picture: Figure) -> None:
    """Settle the layout once instead of again for each format: it takes longer than drawing."""
    with styled():
        engine = picture.get_layout_engine()
        if engine is not None:
            engine.execute(picture)
            picture.set_layout_engine("none")


def save_figure(picture: Figure, path: str | Path) -> Path:
    """Save one picture, byte for byte the same each time, in the format its name ends in."""
    from railgrip.core.atomic import write_aside

    target = Path(path)
    kind = target.suffix.lstrip(".")
    dateless = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind, {})
    with write_aside(target) as aside, styled():
        picture.savefig(aside, format=kind, metadata=dateless)
    return target
