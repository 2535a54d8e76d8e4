"""The same chunks on many machines: Dask hands them out, this process writes what comes back.

A worker that dies loses nothing: the scheduler gives its chunks to others, and a chunk has the
same bytes wherever it was made.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

import railgrip
from railgrip.campaign.batch import Batches, Table
from railgrip.campaign.campaign_file import CampaignFile
from railgrip.campaign.collecting import mark_of
from railgrip.core.errors import Problem, RailgripError

PATIENCE = 10
"""How long an address may take to answer, and a cluster to have a worker, s."""


@lru_cache(maxsize=4)
def _batches(campaign: str) -> Batches:
    return Batches(CampaignFile.model_validate_json(campaign))


def remote_table(campaign: str, version: str, mark: str, first: int, last: int) -> Table:
    """Return the table of a chunk; runs on a worker."""
    if version != railgrip.__version__:
        what = f"a worker has railgrip {railgrip.__version__}, the campaign {version}"
        raise RailgripError(Problem("--cluster", what, cure="install the same version everywhere"))
    batches = _batches(campaign)
    if mark != mark_of(batches.campaign.collector):
        what = "a worker has another collector under this name than the campaign"
        raise RailgripError(Problem("--cluster", what, cure="the same file on every machine"))
    return batches.table(first, last)


@contextmanager
def cluster(address: str) -> Iterator[tuple[Executor, int]]:
    """Give an executor on a Dask cluster, and how many threads its workers have now.

    Parameters
    ----------
    address : str
        Of the scheduler, ``tcp://host:8786``.

    Raises
    ------
    RailgripError
        ``--cluster: is no address; …``, ``… no Dask scheduler answers at tcp://…``, ``… has no
        workers``.
    """
    if not re.search(r"://.|:\d+$", address):
        raise RailgripError(
            Problem("--cluster", "is no address", f"'{address}'", cure="tcp://host:8786")
        )
    distributed = _distributed()
    try:
        client = distributed.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError, ValueError, TypeError):
        cure = "start one: dask scheduler, dask worker ADDRESS"
        what = f"no Dask scheduler answers at {address}"
        raise RailgripError(Problem("--cluster", what, cure=cure)) from None
    try:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            what = f"the scheduler at {address} has no workers"
            raise RailgripError(Problem("--cluster", what, cure=f"dask worker {address}")) from None
        threads = sum(client.nthreads().values())
        with client.get_executor(pure=False) as executor:
            yield executor, threads
    finally:
        client.close()


def failed(error: BaseException, first: int, seed: int) -> RailgripError:
    """Return what to say when a chunk cannot be made, however often it is tried."""
    if "Cancelled" in type(error).__name__:  # Dask's own kind, or that of concurrent.futures
        what = "the scheduler went away; what is written stays"
        return RailgripError(Problem("--cluster", what, cure="run it again: it goes on"))
    what = f"the chunk from run {first} (seed {seed}) failed: {type(error).__name__}: {error}"
    return RailgripError(
        Problem("--cluster", what[:400], cure=f"railgrip replay CAMPAIGN {first}, on this machine")
    )


def _distributed() -> Any:
    try:
        import distributed
    except ImportError:
        cure = "pip install 'railgrip[cluster]'"
        raise RailgripError(Problem("", "dask is not installed", cure=cure)) from None
    return distributed
