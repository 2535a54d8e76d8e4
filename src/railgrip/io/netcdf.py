"""Results as NetCDF-4: one file that xarray, MATLAB and ncview read."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError

if TYPE_CHECKING:
    import xarray as xr

SMALL = frozenset({"dump_valve", "is_sliding", "alarm", "status"})
"""Whole numbers from 0 to 7: stored in one byte, -1 for none."""


def save(result: Any, path: str | os.PathLike[str]) -> Path:
    """Write a result as compressed NetCDF-4, whole or not at all.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave.
    path : path
        The file, by custom ``….nc``.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    RailgripError
        ``out/stop.nc: cannot be written; got No space left on device``

    Examples
    --------
    >>> import tempfile
    >>> import xarray as xr
    >>> data = xr.Dataset({"stopping_distance": ("run", [1007.0])}, attrs={"seed": 1})
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = open_result(save(data, Path(folder) / "stop.nc"))
    >>> float(found.stopping_distance[0]), found.attrs["seed"]
    (1007.0, 1)
    """
    data: xr.Dataset = result if hasattr(result, "data_vars") else result.data
    target = Path(path)
    plain = data.assign_attrs({name: _attribute(value) for name, value in data.attrs.items()})
    plain.attrs = {name: value for name, value in plain.attrs.items() if value is not None}
    # made in memory: HDF5 can crash while it closes a file on a full disk
    made = plain.to_netcdf(None, engine="h5netcdf", encoding=_encodings(data))
    with write_aside(target) as aside:
        try:
            aside.write_bytes(made)
        except OSError as error:
            reason = error.strerror or str(error)
            raise RailgripError(Problem(str(target), "cannot be written", got=reason)) from None
    return target


def open_result(path: str | os.PathLike[str]) -> xr.Dataset:
    """Read a saved result into memory.

    Parameters
    ----------
    path : path
        A file written by `save`.

    Returns
    -------
    xarray.Dataset
        With the variables, coordinates and attributes that were saved.

    Raises
    ------
    RailgripError
        ``stop.nc: is no complete NetCDF-4 file; try: run the scenario again``
    """
    import xarray as xr

    file = Path(path)
    if not file.exists():
        raise RailgripError(Problem(str(file), "there is no such file"))
    if file.is_dir():
        raise RailgripError(Problem(str(file), "is a folder", cure="name the .nc file in it"))
    try:
        with xr.open_dataset(file, engine="h5netcdf") as opened:
            data: xr.Dataset = opened.load()
    except Exception as error:  # HDF5 raises many kinds: all mean that the file is not whole
        kind = "cannot be read" if isinstance(error, PermissionError) else "is no NetCDF-4 file"
        what = f"{kind}, or not a whole one"
        raise RailgripError(Problem(str(file), what, cure="run the scenario again")) from None
    if "run" not in data.dims:
        what = "is a NetCDF file, but no result of railgrip: it has no dimension 'run'"
        raise RailgripError(Problem(str(file), what))
    for variable in data.variables.values():
        variable.encoding.clear()
    data.attrs = {
        name: value.item() if isinstance(value, np.generic) else value
        for name, value in data.attrs.items()
    }
    return data


def _attribute(value: Any) -> Any:
    """Return an attribute as NetCDF can hold it; tables and lists of texts become JSON."""
    if isinstance(value, bool | np.bool_):
        return int(value)
    if value is None or isinstance(value, str | int | float | np.number):
        return value
    if isinstance(value, np.ndarray) and value.dtype.kind in "iuf":
        return value
    return json.dumps(value, default=str, ensure_ascii=False)


def _encodings(data: xr.Dataset) -> dict[str, dict[str, Any]]:
    encodings: dict[str, dict[str, Any]] = {}
    for key, variable in data.variables.items():
        name = str(key)
        if variable.dtype.kind not in "iufb" or variable.ndim == 0:
            continue
        encoding: dict[str, Any] = {"zlib": True, "complevel": 4, "shuffle": True}
        if name in SMALL:
            encoding["dtype"] = "int8"
            if variable.dtype.kind == "f":
                encoding["_FillValue"] = np.int8(-1)
        elif variable.dtype.kind == "f":
            encoding["_FillValue"] = np.array(np.nan, variable.dtype)
        encodings[name] = encoding
    return encodings
