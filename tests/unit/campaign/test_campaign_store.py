"""The folder of a campaign: whole parts only, refused when foreign, damaged, old or changed."""

import json
import os
from pathlib import Path

import pytest

from railgrip.campaign import cluster
from railgrip.campaign import store as stores
from railgrip.campaign.campaign_file import campaign_from
from railgrip.campaign.exporting import catalogue, export
from railgrip.campaign.replaying import replay
from railgrip.campaign.running import run_campaign
from railgrip.core.errors import RailgripError

SPEED = {
    "quantity": "run.speed", "name": "speed",
    "distribution": {"kind": "uniform", "low": "20 km/h", "high": "30 km/h"},
}  # fmt: skip


def asked(**more):
    table = {"scenario": "wagon_100", "runs": 100, "chunk": 32, "variable": [SPEED], **more}
    return campaign_from(table, Path())


def parts(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted((folder / "parts").iterdir())}


@pytest.fixture(scope="module")
def done(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("campaigns") / "done"
    run_campaign(asked(), folder)
    return folder


def test_threads_and_pauses_change_no_byte(done, tmp_path) -> None:
    run_campaign(asked(), tmp_path / "two", threads=2)
    run_campaign(asked(runs=50), tmp_path / "paused")
    run_campaign(asked(), tmp_path / "paused")
    assert parts(tmp_path / "two") == parts(tmp_path / "paused") == parts(done)
    assert len(parts(done)) == 4


def test_a_width_ends_it_where_it_always_ends(done, tmp_path) -> None:
    until = {"figure": "stopping_distance", "width": "2.2 m"}
    for threads in (1, 2):
        store = run_campaign(asked(until=until), tmp_path / f"{threads}", threads=threads)
        assert store.ended() == {"runs": 64, "why": "width"}
    assert parts(tmp_path / "1") == parts(tmp_path / "2")


def test_the_time_is_up_and_it_goes_on(done, tmp_path) -> None:
    store = run_campaign(asked(), tmp_path / "late", seconds=0.0)
    assert not store.ended()
    assert not store.chunks_done()
    run_campaign(asked(), tmp_path / "late")
    assert parts(tmp_path / "late") == parts(done)


def test_what_was_begun_otherwise_is_refused(done) -> None:
    for change in ({"set": {"run.speed": "25 km/h"}}, {"sampling": {"seed": 2}}, {"chunk": 16}):
        before = parts(done)
        with pytest.raises(RailgripError, match="was begun with another"):
            run_campaign(asked(**change), done)
        assert parts(done) == before


def test_foreign_damaged_and_old_folders_are_refused(tmp_path) -> None:
    foreign = tmp_path / "foreign"
    foreign.mkdir()
    (foreign / "thesis.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(RailgripError, match="not empty and holds no campaign"):
        run_campaign(asked(), foreign)
    assert [path.name for path in foreign.iterdir()] == ["thesis.txt"]
    folder = tmp_path / "own"
    run_campaign(asked(runs=32), folder)
    part = next((folder / "parts").iterdir())
    whole = part.read_bytes()
    part.write_bytes(whole[:200])
    with pytest.raises(RailgripError, match="is damaged; try: delete this file"):
        run_campaign(asked(runs=32), folder)
    part.write_bytes(whole)
    manifest = folder / stores.MANIFEST
    note = json.loads(manifest.read_text(encoding="utf-8"))
    manifest.write_text(json.dumps({**note, "railgrip_version": "0.0.1"}), encoding="utf-8")
    with pytest.raises(RailgripError, match=r"of railgrip 0\.0\.1"):
        run_campaign(asked(runs=32), folder)
    manifest.write_text("{", encoding="utf-8")
    with pytest.raises(RailgripError, match="is damaged"):
        run_campaign(asked(runs=32), folder)
    assert part.read_bytes() == whole


def test_a_full_disk_loses_nothing(tmp_path, monkeypatch) -> None:
    folder = tmp_path / "full"
    run_campaign(asked(runs=32), folder)
    kept = parts(folder)

    def full(handle: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(RailgripError, match=r"cannot be written; got .*No space left.*goes on"):
        run_campaign(asked(), folder)
    assert parts(folder) == kept
    monkeypatch.undo()
    assert run_campaign(asked(), folder).ended()["runs"] == 100


def test_a_cluster_that_does_not_answer(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(cluster, "PATIENCE", 0.2)
    with pytest.raises(RailgripError, match="no Dask scheduler answers at tcp://127"):
        run_campaign(asked(), tmp_path / "far", address="tcp://127.0.0.1:1")
    with pytest.raises(RailgripError, match="no Dask scheduler answers at nowhere"):
        run_campaign(asked(), tmp_path / "far", address="nowhere://x")


def test_a_run_that_there_is_not_cannot_be_replayed(done) -> None:
    with pytest.raises(RailgripError, match="no such run; got 100; allowed: 0 to 99"):
        replay(stores.open_campaign(done), 100)


def test_a_read_only_folder(tmp_path, monkeypatch) -> None:
    def shut(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "mkdir", shut)
    with pytest.raises(RailgripError, match="cannot be used; got Permission denied"):
        stores.claim(tmp_path / "walk", asked())


def test_export_and_catalogue(done, tmp_path) -> None:
    import xarray as xr

    store = stores.open_campaign(done)
    lines = export(store, tmp_path / "all.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 101
    assert lines[0].startswith("run,speed,stopping_distance")
    with xr.open_dataset(export(store, tmp_path / "all.nc")) as data:
        assert data["stopping_distance"].attrs["units"] == "m"
        assert data.sizes["run"] == 100
    with pytest.raises(RailgripError, match="csv, nc, parquet"):
        export(store, tmp_path / "all.xls")
    path, count = catalogue(done.parent)
    assert count == 1
    with stores.connect() as connection:
        connection.execute(f"ATTACH '{stores.quoted(path)}' AS c")
        assert connection.execute("SELECT count(*) FROM c.run").fetchone() == (100,)
