"""Results of campaigns for other programs: one file, or a catalogue of many campaigns."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from railgrip.campaign.store import MANIFEST, Store, connect, open_campaign, quoted
from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.core.signals import SIGNALS
from railgrip.report.metrics import SOURCES

FORMATS = ("csv", "parquet", "nc")


def export(store: Store, target: Path) -> Path:
    """Write all runs into one file, as its ending says: .csv, .parquet or .nc (NetCDF-4)."""
    kind = target.suffix.removeprefix(".").lower()
    if kind not in FORMATS:
        raise RailgripError(unknown_name(str(target), "kind of file", kind, FORMATS))
    if not store.chunks_done():
        raise RailgripError(Problem(str(store.folder), "holds no results yet"))
    with write_aside(target) as aside:
        if kind == "nc":
            _netcdf(store, aside)
        else:
            query = f"SELECT * FROM read_parquet({store.part_list()}) ORDER BY run"
            how = "FORMAT csv, HEADER" if kind == "csv" else "FORMAT parquet"
            with connect() as connection:
                connection.execute(f"COPY ({query}) TO '{quoted(aside)}' ({how})")
    return target


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
    data.to_netcdf(path, engine="h5netcdf")


def catalogue(folder: Path) -> tuple[Path, int]:
    """Build the DuckDB catalogue of all campaigns below a folder anew; return it and how many.

    Table ``campaign`` has a row for each; view ``run`` shows all runs of all campaigns, read from
    their parts. Nothing is lost with it: the parts and manifests are the truth.
    """
    target = folder / "campaigns.duckdb"
    stores = []
    for manifest in sorted(folder.rglob(MANIFEST)):
        try:
            stores.append(open_campaign(manifest.parent))
        except RailgripError:
            continue
    with write_aside(target) as aside:
        aside.unlink()
        _fill(aside, stores)
    return target, len(stores)


def _fill(path: Path, stores: list[Store]) -> None:
    import duckdb

    with duckdb.connect(str(path)) as connection:
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
        full = [store for store in stores if store.chunks_done()]
        selects = [
            f"SELECT '{quoted(s.folder.resolve())}' AS folder, * "
            f"FROM read_parquet('{(s.folder / 'parts').resolve()!s}/part-*.parquet')"
            for s in full
        ]
        if selects:
            connection.execute(f"CREATE VIEW run AS {' UNION ALL BY NAME '.join(selects)}")
