"""The folder of a campaign: a manifest, parts of its results, and nothing half-written.

Every part is one chunk of runs in a Parquet file, written under a temporary name, flushed to the
disk and renamed. What bears a part's name is whole, so a campaign that was killed goes on with the
chunks that have none.
"""

from __future__ import annotations

import json
import os
import platform
from pathlib import Path
from typing import Any

import numpy as np

import railgrip
from railgrip.campaign.batch import Table
from railgrip.campaign.campaign_file import CampaignFile
from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError

MANIFEST, END, PARTS = "campaign.json", "end.json", "parts"
FORMAT = 1
FREE = {"runs", "until", "title", "source"}
"""What may change when a campaign goes on; a Latin hypercube's number of runs may not."""


def connect() -> Any:
    """Return a DuckDB connection; refuse kindly where DuckDB is not installed."""
    try:
        import duckdb
    except ImportError:
        cure = "pip install 'railgrip[campaign]'"
        raise RailgripError(Problem("", "duckdb is not installed", cure=cure)) from None
    # one thread: the same rows give the same bytes
    return duckdb.connect(config={"threads": 1})


class Store:
    """The folder in which a campaign lives.

    Parameters
    ----------
    folder : path
        Made by `claim`; `open_campaign` opens one that is there.
    campaign : CampaignFile
        What is asked in it.
    """

    def __init__(self, folder: Path, campaign: CampaignFile) -> None:
        self.folder, self.campaign = folder, campaign

    def part(self, chunk: int) -> Path:
        """Return where the results of a chunk lie."""
        return self.folder.resolve() / PARTS / f"part-{chunk:09d}.parquet"

    def chunks_done(self) -> list[int]:
        """Return the numbers of the chunks that are written, ascending."""
        files = (self.folder / PARTS).glob("part-*.parquet")
        return sorted(int(file.stem.removeprefix("part-")) for file in files)

    def write(self, chunk: int, table: Table) -> int:
        """Write the results of a chunk and return how many runs they are.

        Raises
        ------
        RailgripError
            ``out/dry/parts/part-000000003.parquet: cannot be written; got No space left …``
        """
        columns = {name: _storable(values) for name, values in table.items()}
        target = self.part(chunk)
        with write_aside(target) as aside:
            try:
                with connect() as connection:
                    connection.register("columns", columns)
                    connection.execute(
                        f"COPY (SELECT * FROM columns) TO '{quoted(aside)}' (FORMAT parquet)"
                    )
                with aside.open("rb+") as file:
                    os.fsync(file.fileno())
            except RailgripError:
                raise
            except Exception as error:  # DuckDB raises its own kinds, of which OSError is none
                got = " ".join(str(error).split())[:200]
                cure = "make room or choose another --out, then run it again: it goes on"
                raise RailgripError(
                    Problem(str(target), "cannot be written", got, cure=cure)
                ) from None
        return len(table["run"])

    def read(self, names: list[str] | None = None) -> dict[str, Any]:
        """Return columns over all runs that are written, ordered by run.

        Raises
        ------
        RailgripError
            Where nothing is written yet, a column is not known, or a part is damaged.
        """
        if not self.chunks_done():
            raise RailgripError(Problem(str(self.folder), "holds no results yet"))
        chosen = "*" if names is None else ", ".join(f'"{name}"' for name in names)
        with connect() as connection:
            try:
                found = connection.execute(
                    f"SELECT {chosen} FROM read_parquet({self.part_list()}) ORDER BY run"
                ).fetchnumpy()
            except Exception as error:
                raise RailgripError(
                    Problem(str(self.folder / PARTS), "cannot be read",
                            " ".join(str(error).split())[:200])
                ) from None  # fmt: skip
        return {name: np.ma.filled(values, np.nan) if np.ma.isMaskedArray(values) else values
                for name, values in found.items()}  # fmt: skip

    def part_list(self) -> str:
        """Return the parts as SQL names them."""
        parts = (f"'{quoted(self.part(chunk))}'" for chunk in self.chunks_done())
        return f"[{', '.join(parts)}]"

    def whole_chunks(self) -> set[int]:
        """Return the chunks that hold all their runs; the last one may have been shorter before.

        Raises
        ------
        RailgripError
            ``…/part-000000002.parquet: is damaged; try: delete this file and run …``
        """
        found, size = set(), self.campaign.chunk
        with connect() as connection:
            for chunk in self.chunks_done():
                part, first = self.part(chunk), chunk * self.campaign.chunk
                try:
                    query = f"SELECT min(run), count(*) FROM read_parquet('{quoted(part)}')"
                    least, count = connection.execute(query).fetchone()
                except Exception:
                    least, count = None, 0
                if least != first or not 0 < count <= size:
                    cure = "delete this file and run the campaign again: only its runs are redone"
                    raise RailgripError(Problem(str(part), "is damaged", cure=cure))
                if count >= min(size, self.campaign.runs - first):
                    found.add(chunk)
        return found

    def end(self, runs: int, why: str) -> None:
        """Note that the campaign has ended, and why."""
        _write_json(self.folder / END, {"runs": runs, "why": why})

    def drop_beyond(self, runs: int) -> None:
        """Remove parts that were begun ahead of an end that they came after."""
        for chunk in self.chunks_done():
            if chunk * self.campaign.chunk >= runs:
                self.part(chunk).unlink()

    def ended(self) -> dict[str, Any]:
        """Return how the campaign ended; empty while it has not."""
        path = self.folder / END
        return dict(_read_json(path)) if path.exists() else {}


def claim(folder: Path, campaign: CampaignFile) -> Store:
    """Take a folder for a campaign, or go on in the one that it was begun in.

    Raises
    ------
    RailgripError
        ``out/dry: holds a campaign of railgrip 0.0.9; …``, ``… was begun with other values of
        scenario; …``, ``… is not empty and holds no campaign``, ``… cannot be used``.
    """
    try:
        (folder / PARTS).mkdir(parents=True, exist_ok=(folder / MANIFEST).exists())
    except FileExistsError:
        raise RailgripError(
            Problem(str(folder), "is not empty and holds no campaign", cure="another --out")
        ) from None
    except OSError as error:
        raise RailgripError(
            Problem(str(folder), "cannot be used", error.strerror or "", cure="another --out")
        ) from None
    if not (folder / MANIFEST).exists():
        others = [path.name for path in folder.iterdir() if path.name != PARTS]
        if others:
            (folder / PARTS).rmdir()
            what = "is not empty and holds no campaign"
            raise RailgripError(Problem(str(folder), what, others[0], cure="another --out"))
        _write_json(folder / MANIFEST, _manifest(campaign))
        return Store(folder, campaign)
    begun = open_campaign(folder)
    _refuse_changed(folder, begun.campaign, campaign)
    for left in (folder / PARTS).glob(".part-*"):  # of a run that was killed while writing
        left.unlink()
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
    note = _read_json(path)
    if note.get("format") != FORMAT or note.get("railgrip_version") != railgrip.__version__:
        what = f"holds a campaign of railgrip {note.get('railgrip_version', '?')}"
        cure = f"go on with that version, or begin anew in another folder ({railgrip.__version__})"
        raise RailgripError(Problem(str(folder), what, cure=cure))
    from railgrip.campaign.campaign_file import campaign_from

    try:
        return Store(folder, campaign_from(note["campaign"], folder))
    except (RailgripError, KeyError, TypeError) as error:
        raise RailgripError(Problem(str(path), "is damaged", got=str(error)[:200])) from None


def _refuse_changed(folder: Path, begun: CampaignFile, asked: CampaignFile) -> None:
    before, now = (one.model_dump(mode="json", by_alias=True) for one in (begun, asked))
    free = FREE - {"runs"} if asked.sampling.method == "latin" else FREE
    changed = [key for key in now if key not in free and before.get(key) != now[key]]
    if changed:
        what = f"was begun with another {' and '.join(changed)}"
        cure = "another --out, or the file as it was"
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
        "campaign": campaign.model_dump(mode="json", by_alias=True),
    }


def _write_json(path: Path, content: dict[str, Any]) -> None:
    with write_aside(path) as aside:
        text = json.dumps(content, indent=1, ensure_ascii=False)
        aside.write_text(text + "\n", encoding="utf-8")


def _read_json(path: Path) -> dict[str, Any]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise RailgripError(Problem(str(path), "is damaged", got=str(error)[:100])) from None
    if not isinstance(found, dict):
        raise RailgripError(Problem(str(path), "is damaged", got="no table"))
    return found


def _storable(values: Any) -> Any:
    return np.ascontiguousarray(values)


def quoted(path: Path) -> str:
    """Return a path as it can stand between SQL's quotes."""
    return str(path).replace("'", "''")
