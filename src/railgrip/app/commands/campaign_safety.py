"""`railgrip campaign safety`: K_dry_rst, K_wet_rst and the report for the assessor."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from railgrip.app.options import Json
from railgrip.app.screen import print_json, print_table, working
from railgrip.core.errors import Problem, RailgripError

if TYPE_CHECKING:
    from railgrip.campaign.safety.factors import SafetyFactors

TABLE, PAGE = "factors.json", "report.html"


def safety(
    file: str,
    /,
    *,
    out: Path | None = None,
    method: Annotated[str, Parameter(help="formula or plant, instead of the file's.")] = "",
    runs: int | None = None,
    seed: int | None = None,
    threads: int = 1,
    no_report: bool = False,
    as_json: Json = False,
) -> int:
    """Find how surely a train brakes: K_dry_rst and K_wet_rst at EBCL 0 to 9, with intervals.

    A simulation, not an approval. Ends with 1 when a level is not resolved, 2 on bad input.

    Parameters
    ----------
    file
        The safety case (TOML), or the name of a shipped one.
    out
        Folder of table and report; ./out/FILE_safety if not given.
    runs
        Runs for each speed step, instead of the file's number.
    seed
        Seed of all random numbers, instead of the file's.
    threads
        Threads that share the runs of the plant.
    no_report
        Print the table, write no files.
    as_json
        Print one JSON object instead of the tables.
    """
    if threads < 1:
        raise RailgripError(Problem("--threads", "must be at least 1", got=str(threads)))
    with working("reading the case"):
        from railgrip.campaign.safety.case import SafetyCase, find_case, read_safety_case
        from railgrip.campaign.safety.factors import safety_factors
        from railgrip.campaign.safety.safe_braking import as_table, warnings
        from railgrip.scenario.explain import problems_of

        path = find_case(file)
        case = read_safety_case(path)
    given = {"method": method or None, "runs": runs, "seed": seed}
    changes = {name: value for name, value in given.items() if value is not None}
    if changes:
        from pydantic import ValidationError

        try:
            case = SafetyCase.model_validate({**case.model_dump(exclude_unset=True), **changes})
        except ValidationError as error:
            raise RailgripError(problems_of(error, SafetyCase)) from None
    found = safety_factors(case, threads=threads, progress=_tell)
    rows = as_table(found)
    told = warnings(found)
    code = 1 if any("not resolved" in one for one in told) else 0
    content: dict[str, Any] = {
        "title": case.title, "notice": "simulation, not an approval", "method": case.method,
        "seed": case.seed, "runs": [step.dry.runs for step in found.steps], "rows": rows,
        "warnings": told,
    }  # fmt: skip
    files = [] if no_report else _write(found, content, out or Path("out") / f"{path.stem}_safety")
    if as_json:
        print_json({**content, "files": [str(one) for one in files], "exit_code": code})
        return code
    _show(found, rows)
    for one in told:
        print(one, file=sys.stderr)
    if files:
        print(f"Report: {files[1]}\nTable: {files[0]}")
    return code


def _tell(sentence: str) -> None:
    print(sentence, file=sys.stderr, flush=True)


def _show(found: SafetyFactors, rows: list[dict[str, Any]]) -> None:
    table = [
        [
            f"{row['speed'] * 3.6:.4g}",
            f"{row['ebcl']}",
            f"{row['k_dry']:.4f}",
            f"{row['k_dry_low']:.4f} … {row['k_dry_high']:.4f}",
            "–" if row["k_wet"] is None else f"{row['k_wet']:.4f}",
            f"{row['a_brake_safe']:.3f}",
            f"{row['stopping_distance_safe']:.1f}",
        ]
        for row in rows
    ]
    heads = ["from km/h", "EBCL", "K_dry", "95 %", "K_wet", "A_brake_safe m/s²", "stop m"]
    if found.without is not None:
        heads += ["without control: K_dry", "stop m"]
        for cells, row in zip(table, rows, strict=True):
            cells.append(f"{row['without_control_k_dry']:.4f}")
            cells.append(f"{row['without_control_stopping_distance_safe']:.1f}")
    title = f"{found.case.title or found.case.train.title}: simulation, not an approval"
    print_table(title, heads, table)


def _write(found: SafetyFactors, content: dict[str, Any], folder: Path) -> list[Path]:
    import json

    from railgrip.app.screen import as_plain
    from railgrip.campaign.safety.page import write_page
    from railgrip.core.atomic import write_aside

    folder.mkdir(parents=True, exist_ok=True)
    with write_aside(folder / TABLE) as aside:
        text = json.dumps(as_plain(content), indent=2, ensure_ascii=False, allow_nan=False)
        Path(aside).write_text(text + "\n", encoding="utf-8")
    return [folder / TABLE, write_page(found, folder / PAGE)]
