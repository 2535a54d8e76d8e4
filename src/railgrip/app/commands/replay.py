"""`railgrip replay`: one run of a campaign again, with its whole way."""

from __future__ import annotations

from pathlib import Path

from railgrip.app import results
from railgrip.app.screen import print_table, working


def replay(folder: Path, run: int, /, *, out: Path | None = None) -> int:
    """Run one run of a campaign again, with traces and report.

    Parameters
    ----------
    folder
        Folder of the campaign.
    run
        Number of the run.
    out
        Folder for report, data and curves; FOLDER/replay-RUN if not given.
    """
    with working("running"):
        from railgrip.campaign.manifest import open_campaign
        from railgrip.campaign.replaying import replay as again

        result, draws = again(open_campaign(folder), run)
    files = results.write(result, out or folder / f"replay-{run}")
    rows = [[name, f"{value:.6g}" if isinstance(value, float) else f"{value}"]
            for name, value in draws.items()]  # fmt: skip
    print_table(f"Drawn for run {run}", ["variable", "value"], rows)
    results.show(result, f"run {run}")
    results.name_files(files)
    return results.exit_code(result)
