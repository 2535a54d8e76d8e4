"""The folder of a campaign: whole parts only, refused when foreign, damaged, old or changed."""

import json
import resource
import shutil
import sys
from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from pathlib import Path

import pytest

import railgrip
from railgrip.campaign import cluster, manifest
from railgrip.campaign.campaign_file import campaign_from, read_campaign_file
from railgrip.campaign.collecting import mark_of
from railgrip.campaign.exporting import catalogue, export
from railgrip.campaign.parquet import connect, quoted
from railgrip.campaign.replaying import replay
from railgrip.campaign.running import run_campaign
from railgrip.campaign.store import REDO
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


def test_a_latin_hypercube_keeps_its_number_of_runs(tmp_path) -> None:
    latin = {"sampling": {"method": "latin"}, "chunk": 16}
    run_campaign(asked(runs=16, **latin), tmp_path / "latin")
    with pytest.raises(RailgripError, match=r"Latin hypercube, .*; got 32; allowed: 16; try"):
        run_campaign(asked(runs=32, **latin), tmp_path / "latin")


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
    note_file = folder / manifest.MANIFEST
    note = json.loads(note_file.read_text(encoding="utf-8"))
    note_file.write_text(json.dumps({**note, "railgrip_version": "0.0.1"}), encoding="utf-8")
    with pytest.raises(RailgripError, match=r"of railgrip 0\.0\.1"):
        run_campaign(asked(runs=32), folder)
    note_file.write_text("{", encoding="utf-8")
    with pytest.raises(RailgripError, match="is damaged"):
        run_campaign(asked(runs=32), folder)
    assert part.read_bytes() == whole


@contextmanager
def no_file_beyond(size: int) -> Iterator[None]:
    """As on a full disk: the system refuses to write more than so many bytes into a file."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def test_a_full_disk_loses_nothing(tmp_path) -> None:
    folder = tmp_path / "full"
    run_campaign(asked(runs=48, chunk=16), folder)
    kept = parts(folder)
    largest = max(len(part) for part in kept.values())
    noted = (folder / manifest.MANIFEST).read_bytes()
    with no_file_beyond(100), pytest.raises(RailgripError, match="json: cannot be written; got Fi"):
        run_campaign(asked(runs=64, chunk=16), folder)
    assert (folder / manifest.MANIFEST).read_bytes() == noted
    many = asked(runs=512, chunk=512)
    sentence = "parquet: cannot be written; got File too large; .*goes on"
    with no_file_beyond(largest + 2000), pytest.raises(RailgripError, match=sentence):
        run_campaign(many, tmp_path / "many")
    assert not parts(tmp_path / "many")
    assert run_campaign(many, tmp_path / "many").ended()["runs"] == 512
    assert parts(folder) == kept


@pytest.mark.parametrize("ending", ["csv", "parquet", "nc"])
def test_no_room_for_an_export(done, tmp_path, ending) -> None:
    target = tmp_path / f"runs.{ending}"
    sentence = f"runs.{ending}: cannot be written; got File too large"
    with no_file_beyond(500), pytest.raises(RailgripError, match=sentence):
        export(manifest.open_campaign(done), target)
    assert not list(tmp_path.iterdir())


def test_a_byte_that_flipped_is_found(done, tmp_path) -> None:
    folder = tmp_path / "rotten"
    shutil.copytree(done, folder)
    part = sorted((folder / "parts").iterdir())[1]
    whole = part.read_bytes()
    part.write_bytes(whole[:300] + bytes([whole[300] ^ 1]) + whole[301:])
    for use in (
        lambda: run_campaign(asked(), folder),
        lambda: export(manifest.open_campaign(folder), tmp_path / "runs.csv"),
    ):
        with pytest.raises(
            RailgripError, match=r"part-000000001\.parquet: is damaged; try: delete"
        ):
            use()
    assert [str(problem) for problem in catalogue(tmp_path)[2]] == [
        f"{part}: is damaged; try: {REDO}"
    ]
    part.unlink()
    assert run_campaign(asked(), folder).ended() == {"runs": 100, "why": "runs"}
    assert parts(folder) == parts(done)


def test_files_of_others_among_the_parts_are_left_alone(done, tmp_path) -> None:
    folder = tmp_path / "shared"
    shutil.copytree(done, folder)
    for name in ("part-abc.parquet", "note.txt"):
        (folder / "parts" / name).write_text("mine", encoding="utf-8")
    store = run_campaign(asked(), folder)
    assert len(store.read(["run"])["run"]) == 100
    assert (folder / "parts" / "part-abc.parquet").read_text(encoding="utf-8") == "mine"


def test_more_runs_than_at_first_are_known_to_the_folder(tmp_path) -> None:
    folder = tmp_path / "grown"
    run_campaign(asked(runs=32), folder)
    store = run_campaign(asked(runs=96), folder, seconds=0.0)
    assert not store.ended()  # it goes on: what was the end is none any more
    run_campaign(asked(runs=96), folder)
    store = run_campaign(asked(runs=32), folder)
    assert store.ended() == {"runs": 96, "why": "runs"}
    grown = manifest.open_campaign(folder)
    assert grown.campaign.runs == 96
    assert replay(grown, 90)[1] == {"speed": grown.read(["speed"])["speed"][90]}


def test_what_a_killed_process_left_is_swept_up(done, tmp_path) -> None:
    folder = tmp_path / "killed"
    (folder / "parts").mkdir(parents=True)
    (folder / ".campaign-a1b2c3d4.json").write_text("{", encoding="utf-8")
    run_campaign(asked(runs=50), folder)
    half = folder / "parts" / ".part-000000002-a1b2c3d4.parquet"
    half.write_bytes(b"PAR1")
    run_campaign(asked(), folder)
    assert not half.exists()
    assert parts(folder) == parts(done)


def test_a_collector_that_was_rewritten_is_noticed(tmp_path) -> None:
    file, folder = tmp_path / "mine.py", tmp_path / "walk"
    body = "def mine(figures):\n    return {{'own': {} * figures['stopping_time']}}\n"

    def table(factor: int, **more):
        file.write_text(body.format(factor), encoding="utf-8")
        return asked(collector=f"{file}:mine", chunk=16, **more)

    run_campaign(table(1, runs=16), folder)
    before = parts(folder)
    with pytest.raises(
        RailgripError, match=r"was begun when 'mine\.py:mine' was written otherwise"
    ):
        run_campaign(table(2, runs=32), folder)
    assert parts(folder) == before
    assert len(run_campaign(table(1, runs=32), folder).chunks_done()) == 2
    text = table(2, runs=32).model_dump_json(by_alias=True)
    with pytest.raises(RailgripError, match="a worker has another collector"):
        cluster.remote_table(text, railgrip.__version__, mark_of(""), 0, 16)


def test_a_cluster_that_does_not_answer(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(cluster, "PATIENCE", 0.2)
    with pytest.raises(RailgripError, match="no Dask scheduler answers at tcp://127"):
        run_campaign(asked(), tmp_path / "far", address="tcp://127.0.0.1:1")
    with pytest.raises(RailgripError, match="no Dask scheduler answers at nowhere"):
        run_campaign(asked(), tmp_path / "far", address="nowhere://x")
    with pytest.raises(RailgripError, match="is no address; got 'nowhere'; try: tcp"):
        run_campaign(asked(), tmp_path / "far", address="nowhere")


def test_a_cluster_that_goes_away() -> None:
    sentence = "--cluster: the scheduler went away; what is written stays; try: run it again"
    assert sentence in str(cluster.failed(CancelledError(), 64, 1))
    assert "chunk from run 64 (seed 1) failed: KeyError" in str(cluster.failed(KeyError(), 64, 1))


def test_a_run_that_there_is_not_cannot_be_replayed(done) -> None:
    with pytest.raises(RailgripError, match="no such run; got 100; allowed: 0 to 99"):
        replay(manifest.open_campaign(done), 100)


def test_a_read_only_folder(tmp_path, monkeypatch) -> None:
    def shut(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "mkdir", shut)
    with pytest.raises(RailgripError, match="cannot be used; got Permission denied"):
        manifest.claim(tmp_path / "walk", asked())


def test_export_and_catalogue(done, tmp_path) -> None:
    import xarray as xr

    store = manifest.open_campaign(done)
    lines = export(store, tmp_path / "all.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 101
    assert lines[0].startswith("run,speed,stopping_distance")
    with xr.open_dataset(export(store, tmp_path / "all.nc")) as data:
        assert data["stopping_distance"].attrs["units"] == "m"
        assert data.sizes["run"] == 100
    with pytest.raises(RailgripError, match="csv, nc, parquet"):
        export(store, tmp_path / "all.xls")
    path, found, left_out = catalogue(done.parent)
    assert ([one.folder for one in found], left_out) == ([done], [])
    with connect() as connection:
        connection.execute(f"ATTACH '{quoted(path)}' AS c")
        assert connection.execute("SELECT count(*) FROM c.run").fetchone() == (100,)


def test_without_duckdb_nothing_is_begun(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "duckdb", None)
    with pytest.raises(RailgripError, match="duckdb is not installed; try: pip install"):
        run_campaign(read_campaign_file("dry_emergency"), tmp_path / "out")
    assert not (tmp_path / "out").exists()
