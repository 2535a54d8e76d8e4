"""Results of campaigns for other programs: one file, or a catalogue of many campaigns."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from railgrip.campaign.manifest import MANIFEST, open_campaign
from railgrip.campaign.parquet import connect, listed, quoted, reason
from railgrip.campaign.store import Store
from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.core.signals import SIGNALS
from railgrip.report.metrics import SOURCES

FORMATS = ("csv", "parquet", "nc")


def export(store: Store, target: Path) -> Path:
    """Write all runs into one file, as its ending says: .csv, .parquet or .nc (NetCDF-4).

    Raises
    ------
    RailgripError
        ``runs.xls: kind of file 'xls' unknown; …``, ``… holds no results yet``, ``… is damaged``,
        ``runs.csv: cannot be written; got No space left on device``
    """
    kind = target.suffix.removeprefix(".").lower()
    if kind not in FORMATS:
        raise RailgripError(unknown_name(str(target), "kind of file", kind, FORMATS))
    if not store.chunks_done():
        raise RailgripError(Problem(str(store.folder), "holds no results yet"))
    store.refuse_damaged()
    with _written(target) as aside:
        if kind == "nc":
            _netcdf(store, aside)
        else:
            query = f"SELECT * FROM read_parquet({listed(store.parts())}) ORDER BY run"
            how = "FORMAT csv, HEADER" if kind == "csv" else "FORMAT parquet"
            with connect() as connection:
                connection.execute(f"COPY ({query}) TO '{quoted(aside)}' ({how})")
    return target


@contextmanager
def _written(target: Path) -> Iterator[Path]:
    """Give a file aside that becomes the target; say so where it cannot be written."""
    try:
        with write_aside(target) as aside:
            yield aside
    except RailgripError:
        raise
    except Exception as error:  # DuckDB raises its own kinds, of which OSError is none
        raise RailgripError(
            Problem(str(target), "cannot be written", reason(error), cure="another place")
        ) from None


def _netcdf(store: Store, path: Path) -> None:
    import xarray as xr

    columns = store.read()
    run = columns.pop("run")
    variables = {}
    for name, values in columns.items():
        source = SOURCES.get(name)
        signal = SIGNALS.get(source.variable) if source else SIGNALS.get(name)
        attrs = {} if signal is None else {"units": signal.unit, "long_name": signal.meaning}
        stored = values.astype(str) if values.dtype.kind == "O" else values
        variables[name] = (("run",), stored, attrs)
    about: dict[str, Any] = {"title": store.campaign.title, "seed": store.campaign.sampling.seed}
    data = xr.Dataset(variables, coords={"run": run}, attrs=about)
    # made in memory: HDF5 can crash while it closes a file on a full disk
    path.write_bytes(data.to_netcdf(None, engine="h5netcdf"))


def catalogue(folder: Path) -> tuple[Path, list[Store], list[Problem]]:
    """Build the DuckDB catalogue of all campaigns below a folder anew.

    Table ``campaign`` has a row for each; view ``run`` shows all runs of all campaigns, read from
    their parts. Nothing is lost with it: the parts and manifests are the truth.

    Returns
    -------
    path : Path
        The catalogue.
    stores : list of Store
        What is in it.
    left_out : list of Problem
        Why others are not: damaged, or of another version.
    """
    target = folder / "campaigns.duckdb"
    stores: list[Store] = []
    left_out: list[Problem] = []
    for manifest in sorted(folder.rglob(MANIFEST)):
        try:
            store = open_campaign(manifest.parent)
            store.refuse_damaged()
            stores.append(store)
        except RailgripError as error:
            left_out += error.problems
    with _written(target) as aside:
        aside.unlink()
        _fill(aside, stores)
    return target, stores, left_out


def _fill(path: Path, stores: list[Store]) -> None:
    with connect(path) as connection:
        connection.execute(
            "CREATE TABLE campaign (folder TEXT, title TEXT, seed UBIGINT, method TEXT, "
            "runs_asked BIGINT, parts BIGINT, ended TEXT)"
        )
        for store in stores:
            campaign = store.campaign
            row = [str(store.folder.resolve()), campaign.title, campaign.sampling.seed,
                   campaign.sampling.method, campaign.runs, len(store.chunks_done()),
                   str(store.ended().get("why", ""))]  # fmt: skip
            connection.execute("INSERT INTO campaign VALUES (?, ?, ?, ?, ?, ?, ?)", row)
        # a pattern, not a list: the view also shows the runs that are written later
        selects = [
            f"SELECT '{quoted(store.folder.resolve())}' AS folder, * "
            f"FROM read_parquet('{quoted(store.part(0).parent)}/part-*[0-9].parquet')"
            for store in stores
            if store.chunks_done()
        ]
        if selects:
            connection.execute(f"CREATE VIEW run AS {' UNION ALL BY NAME '.join(selects)}")
