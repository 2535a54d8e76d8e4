"""What a campaign's folder says of itself: who may go on in it, and who is refused."""

from __future__ import annotations

import platform
from pathlib import Path
from typing import Any

import numpy as np

import railgrip
from railgrip.campaign.campaign_file import CampaignFile, campaign_from
from railgrip.campaign.collecting import mark_of
from railgrip.campaign.json_file import read_json, write_json
from railgrip.campaign.store import PARTS, Store
from railgrip.core.errors import Problem, RailgripError

MANIFEST = "campaign.json"
FORMAT = 2
FREE = {"runs", "until", "title", "source"}
"""What may change when a campaign goes on; a Latin hypercube's number of runs may not."""


def claim(folder: Path, campaign: CampaignFile) -> Store:
    """Take a folder for a campaign, or go on in the one that it was begun in.

    Raises
    ------
    RailgripError
        ``out/dry: holds a campaign of railgrip 0.0.9; …``, ``… was begun with another scenario;
        …``, ``… is not empty and holds no campaign``, ``… cannot be used``.
    """
    if not (folder / MANIFEST).exists():
        _make(folder)
        write_json(folder / MANIFEST, _manifest(campaign))
        return Store(folder, campaign)
    _make_parts(folder)
    begun = open_campaign(folder)
    _sweep(folder)
    if not begun.chunks_done():  # nothing is there yet that a change could spoil
        write_json(folder / MANIFEST, _manifest(campaign))
        return Store(folder, campaign)
    _refuse_changed(folder, begun.campaign, campaign)
    _refuse_other_collector(folder, campaign)
    # fewer runs than before leave the others where they are, to be looked at and replayed
    noted = campaign.model_copy(update={"runs": max(campaign.runs, begun.campaign.runs)})
    if _dump(noted) != _dump(begun.campaign):
        write_json(folder / MANIFEST, {**read_json(folder / MANIFEST), "campaign": _dump(noted)})
    return Store(folder, campaign)


def open_campaign(folder: Path) -> Store:
    """Open the folder of a campaign.

    Raises
    ------
    RailgripError
        Where it holds none, a damaged one, or one of another version.
    """
    path = folder / MANIFEST
    if not path.is_file():
        raise RailgripError(Problem(str(folder), "holds no campaign"))
    note = read_json(path)
    form, version = note.get("format"), note.get("railgrip_version", "?")
    if (form, version) != (FORMAT, railgrip.__version__):
        what = f"holds a campaign of railgrip {version}"
        what += f" in format {form}" if version == railgrip.__version__ else ""
        cure = f"go on with that version, or begin anew in another folder ({railgrip.__version__})"
        raise RailgripError(Problem(str(folder), what, cure=cure))
    if not (folder / PARTS).is_dir():
        raise RailgripError(Problem(str(folder / PARTS), "there is no such folder"))
    try:
        return Store(folder, campaign_from(note["campaign"], folder))
    except (RailgripError, KeyError, TypeError) as error:
        raise RailgripError(Problem(str(path), "is damaged", got=str(error)[:200])) from None


def _sweep(folder: Path) -> None:
    """Remove what a killed process had begun to write."""
    for begun in (*folder.glob(".campaign-*.json"), *folder.glob(".end-*.json"),
                  *(folder / PARTS).glob(".part-*.parquet")):  # fmt: skip
        begun.unlink(missing_ok=True)


def _make(folder: Path) -> None:
    names = (path.name for path in folder.iterdir()) if folder.is_dir() else ()
    others = sorted(name for name in names if not name.startswith(".campaign-"))
    if others and (others != [PARTS] or any((folder / PARTS).iterdir())):
        what = "is not empty and holds no campaign"
        raise RailgripError(Problem(str(folder), what, others[0], cure="another --out"))
    _make_parts(folder)


def _make_parts(folder: Path) -> None:
    try:
        (folder / PARTS).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RailgripError(
            Problem(str(folder), "cannot be used", error.strerror or "", cure="another --out")
        ) from None


def _refuse_changed(folder: Path, begun: CampaignFile, asked: CampaignFile) -> None:
    before, now = _dump(begun), _dump(asked)
    free = FREE - {"runs"} if asked.sampling.method == "latin" else FREE
    changed = [key for key in now if key not in free and before.get(key) != now[key]]
    if changed == ["runs"]:
        what = "holds a Latin hypercube, which has as many runs as it was laid out for"
        got, cure = f"{asked.runs}", "another --out, or sampling.method = 'random'"
        raise RailgripError(Problem(str(folder), what, got, f"{begun.runs}", cure=cure))
    if changed:
        what = f"was begun with another {' and '.join(changed)}"
        cure = "another --out, or the file as it was"
        raise RailgripError(Problem(str(folder), what, cure=cure))


def _refuse_other_collector(folder: Path, asked: CampaignFile) -> None:
    if read_json(folder / MANIFEST).get("collector_sha256") != mark_of(asked.collector):
        what = f"was begun when '{Path(asked.collector).name}' was written otherwise"
        cure = "another --out, or the collector's file as it was"
        raise RailgripError(Problem(str(folder), what, cure=cure))


def _manifest(campaign: CampaignFile) -> dict[str, Any]:
    import numba
    import scipy

    return {
        "format": FORMAT,
        "railgrip_version": railgrip.__version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "numba": numba.__version__,
        "seed": campaign.sampling.seed,
        "collector_sha256": mark_of(campaign.collector),
        "campaign": _dump(campaign),
    }


def _dump(campaign: CampaignFile) -> dict[str, Any]:
    return campaign.model_dump(mode="json", by_alias=True)
