"""`railgrip tune`: better parameters for a controller, searched in the open and resumable."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from railgrip.app.options import Json
from railgrip.app.screen import print_json, print_table, working
from railgrip.core.errors import Problem, RailgripError

if TYPE_CHECKING:
    from railgrip.campaign.tuning import Tuning
    from railgrip.campaign.tuning_judge import Trial

BEST, TRIALS, PICTURE = "best.toml", "trials.csv", "search.png"


def tune(
    file: Path,
    /,
    *,
    out: Path | None = None,
    trials: int | None = None,
    threads: int = 1,
    as_json: Json = False,
) -> int:
    """Search for better parameters of a controller over a set of scenarios.

    Interrupted, it goes on where it stopped when it is called again with the same folder.

    Parameters
    ----------
    file
        What to tune, where and judged by what (TOML).
    out
        Folder of the search and of its results; ./out/FILE_tuned if not given.
    trials
        How many sets of parameters to try in all, instead of the file's number.
    threads
        Threads that share the runs of each trial.
    as_json
        Print one JSON object instead of the table.
    """
    with working("reading the plan"):
        from railgrip.campaign.tuning import tune as search
        from railgrip.campaign.tuning_plan import read_tuning_plan

        plan = read_tuning_plan(file)
    if trials is not None:
        if trials < 1:
            raise RailgripError(Problem("--trials", "must be at least 1", got=str(trials)))
        plan = plan.model_copy(update={"trials": trials})
    folder = out or Path("out") / f"{file.stem}_tuned"
    found = search(
        plan, folder, folder=file.resolve().parent, threads=threads, progress=_show_progress
    )
    files = _write(found, folder)
    if as_json:
        print_json(_as_json(found, files))
        return 0
    _show(found)
    print(f"Parameters: {files[0]}\nBeside it: {', '.join(path.name for path in files[1:])}")
    return 0


def _show_progress(done: int, of: int, best: float) -> None:
    if sys.stderr.isatty() or done == of or done % 25 == 0:
        end = "\r" if sys.stderr.isatty() and done < of else "\n"
        print(f"trial {done} of {of}, best score {best:.4f}", end=end, file=sys.stderr, flush=True)


def _show(found: Tuning) -> None:
    from railgrip.report.metrics import SOURCES
    from railgrip.report.units import shown, written

    best = found.best[0]
    rows = [
        [one.use, SOURCES[name].label, *_texts(before, after, name, shown, written)]
        for one, before, after in zip(
            found.plan.scenario, found.untuned.figures, best.figures, strict=True
        )
        for name in before
    ]
    print_table(
        found.plan.title or found.plan.controller,
        ["scenario", "mean of", "untuned", "tuned", ""],
        rows,
    )
    if found.plan.front:
        print(f"The front holds {len(found.best)} sets; shown is the first.")
    for name, value in best.parameters.items():
        print(f"{name} = {value:.6g}")
    if best.parameters == {}:
        print("No set that was tried is better than the untuned controller.")


def _texts(before: Any, after: Any, name: str, shown: Any, written: Any) -> list[str]:
    from railgrip.report.metrics import SOURCES

    how = shown(SOURCES[name].variable)
    old, new = before[name], after[name]
    change = f"{new / old - 1.0:+.1%}" if old else ""
    return [written(old * how.factor, how), written(new * how.factor, how), change]


def _write(found: Tuning, folder: Path) -> list[Path]:
    """Write the parameters as a scenario's table, all trials, and the picture."""
    import csv

    import tomli_w

    from railgrip.core.atomic import write_aside
    from railgrip.report.plots.tuning import front, search

    plan = found.plan
    best = [{**dict(plan.fixed), **trial.parameters} for trial in found.best]
    table: dict[str, Any] = {"wsp": {"controller": plan.controller, "parameters": best[0]}}
    with write_aside(folder / BEST) as aside:
        head = '# Parameters found by railgrip tune; take them over with: extends = "best.toml"\n'
        aside.write_text(head + tomli_w.dumps(table), encoding="utf-8")
    scores = plan.front or ("score",)
    with (
        write_aside(folder / TRIALS) as aside,
        aside.open("w", encoding="utf-8", newline="") as file,
    ):
        writer = csv.writer(file)
        writer.writerow([*scores, "keeps_limits", "is_best", *plan.parameters])
        for trial in found.trials:
            values = [trial.parameters[name] for name in plan.parameters]
            writer.writerow([*trial.score, trial.keeps_limits, trial in found.best, *values])
    tried = [trial.score for trial in found.trials]
    made = (
        front(plan.front, tried, [trial.score for trial in found.best])
        if plan.front
        else search([score[0] for score in tried])
    )
    with write_aside(folder / PICTURE) as aside:
        made.savefig(aside, dpi=120)
    return [folder / name for name in (BEST, TRIALS, PICTURE)]


def _as_json(found: Tuning, files: list[Path]) -> dict[str, Any]:
    def told(trial: Trial) -> dict[str, Any]:
        return trial._asdict()

    return {
        "title": found.plan.title,
        "untuned": told(found.untuned),
        "best": [told(trial) for trial in found.best],
        "trials": len(found.trials),
        "files": [str(path) for path in files],
        "exit_code": 0,
    }
