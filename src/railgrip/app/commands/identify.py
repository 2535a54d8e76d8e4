"""`railgrip identify`: the functions of a pad from measured stops."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from railgrip.app.files import folder_of_results
from railgrip.app.options import Json
from railgrip.app.screen import print_json, print_table, working

if TYPE_CHECKING:
    from railgrip.campaign.identification import Identification


def identify(
    file: Path,
    /,
    *,
    channels: Annotated[Path, Parameter(name=["--map", "-m"])],
    out: Path | None = None,
    as_json: Json = False,
) -> int:
    """Find the friction of a pad in measured stops or runs of a dynamometer.

    Writes a pad file that a scenario uses directly, a report, and the residuals. What cannot be
    found is said, with the reason; the rest is written.

    Parameters
    ----------
    file
        The measurement: CSV, Parquet, MDF4 or TDMS.
    channels
        Which channel is what, and what shall be found (TOML).
    out
        Folder of the results; ./out/FILE_identified if not given.
    as_json
        Print one JSON object instead of the tables.
    """
    with working("reading the libraries"):
        from railgrip.campaign.identification import identify as search
        from railgrip.campaign.identification import write_identification
    result = search(file, channels, _tell)
    folder = out or Path("out") / f"{file.stem}_identified"
    with folder_of_results(folder) as aside:
        files = [folder / path.name for path in write_identification(result, aside)]
    if as_json:
        print_json(_as_json(result, files))
        return 0
    for problem in result.problems:
        print(f"railgrip: {' '.join(str(problem).split())}", file=sys.stderr)
    _show(result)
    print(f"Pad: {files[0]}\nBeside it: {', '.join(path.name for path in files[1:])}")
    return 0


def _tell(words: str) -> None:
    if sys.stderr.isatty():
        print(f"{words:60s}", end="\r", file=sys.stderr, flush=True)


def _show(result: Identification) -> None:
    rows = []
    for one in result.found.parameters:
        interval = "given" if one.is_fixed else f"{one.low:.4g} to {one.high:.4g}"
        rows.append([one.name, f"{one.value:.4g}", interval, one.unit])
    title = f"{result.channels.title}: {len(result.measured.labels)} stops"
    print_table(title, ["number", "value", "95 % interval", "unit"], rows)
    if result.scores:
        rows = [
            [one.name, str(one.parameters), f"{one.error:.1%}", f"{one.error_within:.1%}",
             f"{one.behind:.2f} ± {one.behind_error:.2f}", "chosen" if one.is_chosen else ""]
            for one in result.scores
        ]  # fmt: skip
        heads = ["law", "numbers", "error", "within a stop", "log-likelihood behind", ""]
        print_table("Laws on stops left out", heads, rows)


def _as_json(result: Identification, files: list[Path]) -> dict[str, Any]:
    return {
        "title": result.channels.title,
        "stops": len(result.measured.labels),
        "parameters": [one._asdict() for one in result.found.parameters],
        "laws": [one._asdict() for one in result.scores],
        "problems": [str(problem) for problem in result.problems],
        "files": [str(path) for path in files],
        "exit_code": 0,
    }
