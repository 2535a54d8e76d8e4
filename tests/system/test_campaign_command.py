"""`railgrip campaign` as a user has it: killed, resumed, replayed, spread over workers."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from railgrip.campaign.campaign_file import read_campaign_file
from railgrip.campaign.manifest import open_campaign
from railgrip.campaign.running import run_campaign

FILE = """
title = "Stops from a walk"
scenario = "wagon_100"
runs = 384
chunk = 32
keep = ["stopping_distance", "stopping_time"]
[[variable]]
quantity = "run.speed"
name = "speed"
distribution = { kind = "uniform", low = "60 km/h", high = "100 km/h" }
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "walk.toml"
    path.write_text(FILE, encoding="utf-8")
    return path


def parts(folder: Path) -> dict[str, bytes]:
    files = sorted((folder / "parts").glob("part-*.parquet"))
    return {path.name: path.read_bytes() for path in files}


def started(tmp_path: Path, *words: str) -> "subprocess.Popen[str]":
    command = [sys.executable, "-m", "railgrip.app", "campaign", "run", "walk.toml", *words]
    return subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True)


def wait_for_parts(folder: Path, count: int) -> None:
    deadline = time.monotonic() + 200
    while len(list((folder / "parts").glob("part-*.parquet"))) < count:
        assert time.monotonic() < deadline
        time.sleep(0.002)


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    """The campaign, never interrupted."""
    home = tmp_path_factory.mktemp("whole")
    (home / "walk.toml").write_text(FILE, encoding="utf-8")
    run_campaign(read_campaign_file(home / "walk.toml"), home / "whole")
    return home / "whole"


def test_killed_and_resumed_it_is_as_if_never_interrupted(railgrip, file, whole, tmp_path) -> None:
    made = 0
    for number in (signal.SIGKILL, signal.SIGINT):
        process = started(tmp_path, "--out", "walk", "--no-report")
        wait_for_parts(tmp_path / "walk", made + 2)
        process.send_signal(number)
        process.communicate(timeout=60)
        assert process.returncode != 0
        assert made + 2 <= len(parts(tmp_path / "walk")) < 12
        made = len(parts(tmp_path / "walk"))
    done = railgrip("campaign", "run", "walk.toml", "--out", "walk", "--no-report")
    assert done.returncode == 0, done.stderr
    assert parts(tmp_path / "walk") == parts(whole)
    told = json.loads(railgrip("campaign", "status", "walk", "--json").stdout)
    assert told["runs"] == 384
    assert told["ended"] == {"runs": 384, "why": "runs"}
    again = railgrip("replay", "walk", "300")
    assert again.returncode in (0, 1), again.stderr  # 1: a limit of the scenario is missed
    table = open_campaign(whole).read(["run", "stopping_distance"])
    with xr.open_dataset(tmp_path / "walk" / "replay-300" / "result.nc") as data:
        np.testing.assert_array_equal(data["stopping_distance"][0], table["stopping_distance"][300])
        assert data.sizes["time"] > 500


def test_clear_sentences(railgrip, file) -> None:
    assert "is no time" in railgrip("campaign", "run", "walk.toml", "--time", "soon").stderr
    cuda = railgrip("campaign", "run", "walk.toml", "--device", "cuda")
    assert cuda.returncode == 2
    assert "--device: this version of railgrip has no GPU backend; got 'cuda'; all" in cuda.stderr
    assert (
        "device 'tpu' unknown" in railgrip("campaign", "run", "walk.toml", "--device", "tpu").stderr
    )
    none = railgrip("campaign", "run", "walk.toml", "--threads", "0")
    assert "--threads: must be at least 1; got 0" in none.stderr
    late = railgrip("campaign", "run", "walk.toml", "--time", "1e-9 s")
    assert late.returncode == 0
    assert "no chunk was begun yet; run it again to go on" in late.stderr
    assert "holds no campaign" in railgrip("campaign", "status", ".").stderr
    assert "did you mean 'dry_emergency'" in railgrip("campaign", "run", "dry_emergenci").stderr


def test_a_worker_dies_and_the_bytes_are_the_same(file, whole, tmp_path) -> None:
    scheduler_file = tmp_path / "scheduler.json"
    dask = [sys.executable, "-m", "dask"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": tmp_path}
    where = ["--scheduler-file", str(scheduler_file)]
    local = ["--host", "127.0.0.1", "--no-dashboard"]
    scheduler = subprocess.Popen([*dask, "scheduler", *where, *local, "--port", "0"], **quiet)
    worker = [*dask, "worker", *where, "--nthreads", "1", "--no-nanny", "--no-dashboard",
              "--death-timeout", "60"]  # fmt: skip
    workers = [subprocess.Popen(worker, **quiet) for _ in range(2)]
    try:
        deadline = time.monotonic() + 60
        while not scheduler_file.exists() or not scheduler_file.read_text():
            assert time.monotonic() < deadline
            time.sleep(0.05)
        address = json.loads(scheduler_file.read_text())["address"]
        process = started(tmp_path, "--out", "far", "--no-report", "--cluster", address)
        wait_for_parts(tmp_path / "far", 2)
        workers[0].kill()
        process.communicate(timeout=200)
        assert process.returncode == 0
    finally:
        for one in (*workers, scheduler):
            one.kill()
            one.wait()
    assert parts(tmp_path / "far") == parts(whole)
