"""Run a campaign chunk by chunk until it has what it wants; stop at any time, go on later."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import railgrip
from railgrip.campaign import parquet
from railgrip.campaign.batch import Batches
from railgrip.campaign.campaign_file import CampaignFile
from railgrip.campaign.cluster import cluster, failed, remote_table
from railgrip.campaign.collecting import mark_of
from railgrip.campaign.manifest import claim
from railgrip.campaign.statistics import Estimate, judged
from railgrip.campaign.store import Store
from railgrip.core.errors import Problem, RailgripError, unknown_name

Handing = Callable[[Executor, int, int, int], Future[Any]]
"""Hands a chunk (number, first run, last run) to an executor."""
GROWTH = 1.1
"""The interval is looked at whenever the runs have grown by so much."""


class Progress(NamedTuple):
    """How far a campaign is.

    Attributes
    ----------
    runs, of : int
        Runs written; runs asked for at most.
    rate : float
        Runs a second in this session.
    estimate : Estimate or None
        What `until` asks about, when last looked at.
    """

    runs: int
    of: int
    rate: float
    estimate: Estimate | None


def run_campaign(
    campaign: CampaignFile,
    folder: Path,
    *,
    threads: int = 1,
    seconds: float | None = None,
    address: str | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> Store:
    """Run a campaign in its folder, from where it stands, until it ends or the time is up.

    Parameters
    ----------
    campaign : CampaignFile
        What to run.
    folder : Path
        Where its results lie.
    threads : int
        Chunks worked on at once; the results do not depend on it.
    seconds : float, optional
        Time after which no further chunk is begun [s].
    address : str, optional
        Of a Dask scheduler whose workers make the chunks, in place of threads.
    progress : callable, optional
        Called whenever a chunk has been written.

    Returns
    -------
    Store
        Its results. ``ended()`` is empty when the time was up first.

    Raises
    ------
    RailgripError
        Of `parquet.connect`, `manifest.claim` and `Batches`.
    """
    if threads < 1:
        raise RailgripError(Problem("--threads", "must be at least 1", got=f"{threads}"))
    parquet.connect().close()  # refuses before anything is made if DuckDB is not installed
    _refuse_unknown_figure(campaign)
    batches = Batches(campaign)
    store = claim(folder, campaign)
    session = _Session(campaign, store, progress)
    if session.is_over():
        return store
    if address is None:
        with ThreadPoolExecutor(threads) as pool:
            work = _work_of(batches, store)
            session.go(pool, work, 2 * threads if threads > 1 else 1, seconds)
    else:
        with cluster(address) as (executor, workers):
            text, mark = campaign.model_dump_json(by_alias=True), mark_of(campaign.collector)

            def away(pool: Executor, chunk: int, first: int, last: int) -> Future[Any]:
                return pool.submit(remote_table, text, railgrip.__version__, mark, first, last)

            session.go(executor, away, 2 * workers, seconds)
    return store


def _work_of(batches: Batches, store: Store) -> Handing:
    def make(chunk: int, first: int, last: int) -> int:
        return store.write(chunk, batches.table(first, last))

    def hand(pool: Executor, chunk: int, first: int, last: int) -> Future[Any]:
        return pool.submit(make, chunk, first, last)

    return hand


class _Session:
    """One sitting: hands out chunks in order, looks at the interval over the runs from 0 on."""

    def __init__(self, campaign: CampaignFile, store: Store, progress: Any) -> None:
        self.campaign, self.store, self.progress = campaign, store, progress
        self.chunks = -(-campaign.runs // campaign.chunk)
        self.done = store.whole_chunks()
        self.begun = time.monotonic()
        self.made = 0
        self.estimate: Estimate | None = None
        self._looked_at = 0

    def is_over(self) -> bool:
        """Whether what is written is enough already; note the end then."""
        whole = self._unbroken()
        if self._ends_by_width(whole):
            return True
        if whole < self.chunks:
            return False
        if int(self.store.ended().get("runs", 0)) < self.campaign.runs:
            self.store.end(self.campaign.runs, "runs")
        return True

    def _unbroken(self) -> int:
        count = 0
        while count in self.done:
            count += 1
        return count

    def _moments(self, upto: int) -> list[int]:
        """Return the chunk counts at which the interval is looked at: always the same ones."""
        moments, count = [], 1
        while count <= upto:
            moments.append(count)
            count = max(count + 1, int(count * GROWTH))
        return moments

    def _ends_by_width(self, whole: int) -> bool:
        """Whether the interval is narrow enough over the runs at one of the moments."""
        until = self.campaign.until
        if until is None:
            return False
        values = None
        for count in self._moments(whole):
            if count <= self._looked_at:
                continue
            self._looked_at = count
            if values is None:
                values = self.store.read(["run", until.figure])
            runs = min(count * self.campaign.chunk, self.campaign.runs)
            chosen = values[until.figure][values["run"] < runs]
            self.estimate = judged(until, np.asarray(chosen, dtype=float))
            if self.estimate.width <= until.width:
                self.store.end(runs, "width")
                return True
        return False

    def _finish(self, future: Future[Any], chunk: int) -> None:
        """Take note of a chunk; one that was made elsewhere is written here."""
        try:
            made = future.result()
        except RailgripError:
            raise
        except Exception as error:
            first = chunk * self.campaign.chunk
            raise failed(error, first, self.campaign.sampling.seed) from None
        self.made += made if isinstance(made, int) else self.store.write(chunk, made)
        self.done.add(chunk)

    def go(self, pool: Executor, hand: Handing, ahead: int, seconds: Any) -> None:
        """Work until the end, or until the time is up."""
        self.store.go_on()
        waiting = self._todo()
        running: dict[Future[Any], int] = {}
        try:
            while True:
                while len(running) < ahead and not self._is_late(seconds):
                    job = next(waiting, None)
                    if job is None:
                        break
                    running[hand(pool, *job)] = job[0]
                if not running:
                    break
                ready, _ = wait(running, return_when=FIRST_COMPLETED)
                for future in ready:
                    self._finish(future, running.pop(future))
                if self._ends_by_width(self._unbroken()):
                    _drop(running)
                    self.store.drop_beyond(int(self.store.ended()["runs"]))
                    self._tell()
                    return
                self._tell()
        except BaseException:
            _drop(running)
            raise
        if self._unbroken() == self.chunks:
            self.store.end(self.campaign.runs, "runs")

    def _todo(self) -> Iterator[tuple[int, int, int]]:
        size = self.campaign.chunk
        for chunk in range(self.chunks):
            if chunk not in self.done:
                yield chunk, chunk * size, min((chunk + 1) * size, self.campaign.runs)

    def _is_late(self, seconds: float | None) -> bool:
        return seconds is not None and time.monotonic() - self.begun >= seconds

    def _tell(self) -> None:
        if self.progress is not None:
            rate = self.made / max(time.monotonic() - self.begun, 1e-9)
            runs = min(len(self.done) * self.campaign.chunk, self.campaign.runs)
            self.progress(Progress(runs, self.campaign.runs, rate, self.estimate))


def _drop(running: dict[Future[Any], int]) -> None:
    """Cancel what has not begun and wait for what has: its parts are whole and stay."""
    for future in running:
        future.cancel()
    wait(running)


def _refuse_unknown_figure(campaign: CampaignFile) -> None:
    until = campaign.until
    if until is not None and until.figure not in campaign.keep and not campaign.collector:
        raise RailgripError(
            unknown_name("until.figure", "kept figure", until.figure, campaign.keep)
        )
