"""The results of a campaign: parts that are whole, and nothing half-written.

Every part is one chunk of runs in a Parquet file, written under a temporary name, flushed to the
disk and renamed. What bears a part's name is whole, so a campaign that was killed goes on with the
chunks that have none.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from railgrip.campaign.batch import Table
from railgrip.campaign.campaign_file import CampaignFile
from railgrip.campaign.json_file import read_json, write_json
from railgrip.campaign.parquet import is_sound, read_table, reason, write_table
from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError

END, PARTS = "end.json", "parts"
REDO = "delete this file and run the campaign again: only its runs are redone"
_PART = re.compile(r"part-(\d{9,})\.parquet")


class Store:
    """The folder in which a campaign lives.

    Parameters
    ----------
    folder : path
        Made by `manifest.claim`; `manifest.open_campaign` opens one that is there.
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
        files = (_PART.fullmatch(file.name) for file in (self.folder / PARTS).iterdir())
        return sorted(int(found[1]) for found in files if found)

    def parts(self) -> list[Path]:
        """Return the files that are written, in the order of their runs."""
        return [self.part(chunk) for chunk in self.chunks_done()]

    def write(self, chunk: int, table: Table) -> int:
        """Write the results of a chunk and return how many runs they are.

        Raises
        ------
        RailgripError
            ``out/dry/parts/part-000000003.parquet: cannot be written; got No space left …``
        """
        target = self.part(chunk)
        try:
            with write_aside(target) as aside:
                write_table(table, aside)
        except Exception as error:  # DuckDB raises its own kinds, of which OSError is none
            got = error.problems[0].got if isinstance(error, RailgripError) else reason(error)
            cure = "make room or choose another --out, then run it again: it goes on"
            raise RailgripError(Problem(str(target), "cannot be written", got, cure=cure)) from None
        return len(table["run"])

    def read(self, names: list[str] | None = None) -> dict[str, Any]:
        """Return columns over all runs that are written, ordered by run.

        Raises
        ------
        RailgripError
            Where nothing is written yet, a column is not known, or a part is damaged.
        """
        if not self.chunks_done():
            raise RailgripError(
                Problem(str(self.folder), "holds no results yet", cure="railgrip campaign run")
            )
        try:
            return read_table(self.parts(), names)
        except Exception as error:
            self.refuse_damaged()
            raise RailgripError(
                Problem(str(self.folder / PARTS), "cannot be read", reason(error))
            ) from None

    def refuse_damaged(self) -> None:
        """Compare every part with its check sums.

        Raises
        ------
        RailgripError
            ``…/part-000000002.parquet: is damaged; try: delete this file and run …``
        """
        for part in self.parts():
            if not is_sound(part):
                raise RailgripError(Problem(str(part), "is damaged", cure=REDO))

    def whole_chunks(self) -> set[int]:
        """Return the chunks that hold all their runs; the last one may have been shorter before.

        Raises
        ------
        RailgripError
            Of `refuse_damaged`, also where a part holds the runs of another.
        """
        self.refuse_damaged()
        found, size = set(), self.campaign.chunk
        for chunk in self.chunks_done():
            part, first = self.part(chunk), chunk * size
            runs = read_table([part], ["run"])["run"]
            if not 0 < len(runs) <= size or runs[0] != first or runs[-1] != first + len(runs) - 1:
                raise RailgripError(Problem(str(part), "is damaged", cure=REDO))
            if len(runs) >= min(size, self.campaign.runs - first):
                found.add(chunk)
        return found

    def end(self, runs: int, why: str) -> None:
        """Note that the campaign has ended, and why."""
        if self.ended() != {"runs": runs, "why": why}:
            write_json(self.folder / END, {"runs": runs, "why": why})

    def go_on(self) -> None:
        """Take back an end that was noted before."""
        (self.folder / END).unlink(missing_ok=True)

    def drop_beyond(self, runs: int) -> None:
        """Remove parts that were begun ahead of an end that they came after."""
        for chunk in self.chunks_done():
            if chunk * self.campaign.chunk >= runs:
                self.part(chunk).unlink()

    def ended(self) -> dict[str, Any]:
        """Return how the campaign ended; empty while it has not."""
        path = self.folder / END
        return read_json(path) if path.exists() else {}
