"""One run of a dataset as plain arrays, cut off where the run ended."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from railgrip.core.errors import Problem, RailgripError
from railgrip.report.thin import Thinner

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]


def dataset_of(result: Any) -> xr.Dataset:
    """Return the dataset of a result; a dataset is its own."""
    data: xr.Dataset = result if hasattr(result, "data_vars") else result.data
    return data


@dataclass(frozen=True)
class View:
    """One run as plain arrays in SI units.

    Parameters
    ----------
    dataset : xarray.Dataset
        A result with the names of the signal catalogue.
    run : int
        Which run, counted from 0.
    most : int
        Traces are thinned to about this many points, their peaks kept; 0: every point.

    Raises
    ------
    RailgripError
        ``run: there is no run 3; allowed: 0 to 0``
    """

    dataset: xr.Dataset
    run: int = 0
    most: int = 0

    def __post_init__(self) -> None:
        runs = self.dataset.sizes.get("run", 1)
        if not 0 <= self.run < runs:
            what = f"there is no run {self.run}"
            raise RailgripError(Problem("run", what, allowed=f"0 to {runs - 1}"))

    def has(self, name: str) -> bool:
        """Whether the dataset carries any number under this name."""
        return name in self.dataset and bool(np.isfinite(self._all(name)).any())

    def get(self, name: str) -> Array:
        """Values of a signal, time last and only until the end of the run."""
        if name not in self.dataset:
            known = ", ".join(sorted(str(key) for key in self.dataset.data_vars))
            raise RailgripError(f"the result has no '{name}'; it has: {known}")
        values = self._all(name)
        if "time" in self.dataset[name].dims:
            return self._thin(values[..., : self._steps])
        return values

    def number(self, name: str) -> float:
        """A single outcome of the run, NaN where the dataset has none."""
        return float(self._all(name)) if name in self.dataset else float("nan")

    def _all(self, name: str) -> Array:
        variable = self.dataset[name]
        if "run" in variable.dims:
            variable = variable.isel(run=self.run)
        if "time" in variable.dims:
            variable = variable.transpose(..., "time")
        return np.asarray(variable.values, dtype=np.float64)

    @cached_property
    def _steps(self) -> int:
        if "train_speed" not in self.dataset:
            return 0
        finite = np.flatnonzero(np.isfinite(self._all("train_speed")))
        return int(finite[-1]) + 1 if len(finite) else 0

    @cached_property
    def _thin(self) -> Thinner:
        return Thinner(self._steps, self.most or self._steps)

    @cached_property
    def time(self) -> Array:
        """Time from the start of the record, s."""
        if self._steps == 0:
            return np.empty(0)
        every = np.asarray(self.dataset["time"].values, dtype=np.float64)[: self._steps]
        return self._thin.axis(every)

    @cached_property
    def distance(self) -> Array:
        """Distance run from the start of the record, m."""
        if "train_position" not in self.dataset:
            return np.full(len(self.time), np.nan)
        position = self._all("train_position")[: self._steps]
        return self._thin.axis(position - position[:1])

    @cached_property
    def start(self) -> float:
        """Position on the line where the record starts, m."""
        return float(self.get("train_position")[0])

    @cached_property
    def axles(self) -> list[str]:
        """Labels of the axles, front first."""
        return [str(label) for label in self.dataset["axle"].values]

    @cached_property
    def _owners(self) -> list[str]:
        """The vehicle's part of each axle's label: C1-V2 of C1-V2-B1-A1."""
        found = [re.match(r".*?V\d+", label) for label in self.axles]
        return [match.group() if match else "V1" for match in found]

    @cached_property
    def vehicle_of(self) -> list[int]:
        """Index of the vehicle of each axle, read from the label."""
        order = {owner: k for k, owner in enumerate(dict.fromkeys(self._owners))}
        return [order[owner] for owner in self._owners]

    @cached_property
    def vehicles(self) -> list[str]:
        """Names of the vehicles, front first; without C1 where the train is one unit."""
        owners = list(dict.fromkeys(self._owners))
        units = {owner.partition("-V")[0] for owner in owners}
        return [owner.rpartition("-")[2] for owner in owners] if len(units) == 1 else owners

    @cached_property
    def places(self) -> list[str]:
        """The rest of each axle's label, within its vehicle: B1-A1 of C1-V2-B1-A1."""
        pairs = zip(self.axles, self._owners, strict=True)
        return [label.removeprefix(owner).strip("-") or label for label, owner in pairs]

    @cached_property
    def title(self) -> str:
        """Title of the scenario."""
        return str(self.dataset.attrs.get("title") or "Untitled run")

    @cached_property
    def scenario(self) -> dict[str, Any]:
        """The scenario as the dataset carries it, empty if it carries none."""
        try:
            read = json.loads(str(self.dataset.attrs.get("scenario_json", "{}")))
        except ValueError:
            return {}
        return read if isinstance(read, dict) else {}

    @cached_property
    def slip(self) -> Array:
        """Slip as the controller counts it (axle, time); NaN below 3 km/h.

        Where no controller gives a reference speed, the train's speed stands in for it.
        """
        reference = self.get("reference_speed" if self.has_reference else "train_speed")
        if self.has("unit_reference_speed"):  # an axle's slip is what its own unit counts
            reference = self.get("unit_reference_speed")
            reference = np.where(reference > 0, reference, self.get("train_speed"))
        known = np.where(reference > 3 / 3.6, reference, np.nan)
        return np.asarray(1.0 - self.get("wheel_speed") / known)

    @cached_property
    def has_reference(self) -> bool:
        """Whether a controller gave a reference speed."""
        return self.has("reference_speed") and bool((self.get("reference_speed") > 0).any())

    @cached_property
    def worst_axle(self) -> int:
        """Index of the axle that slid most: by energy, else by its greatest slip."""
        if self.has("axle_slid_energy"):
            return int(np.nanargmax(self.get("axle_slid_energy")))
        greatest = np.nanmax(np.nan_to_num(self.slip), axis=1)
        return int(np.argmax(greatest))
