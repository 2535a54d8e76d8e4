"""`railgrip etcs`: where ETCS warns and brakes before a target."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from railgrip.app.files import folder_of_results
from railgrip.app.inputs import formats_from
from railgrip.app.options import Json
from railgrip.app.screen import print_json, print_table, working

if TYPE_CHECKING:
    from railgrip.control.etcs.supervision import SupervisionLimits
    from railgrip.scenario.supervision import SupervisionCase

FINE = 1.0 / 3.6
"""Step of the speed in the figure, m/s."""


def etcs(
    file: Path,
    /,
    *,
    factors: Path | None = None,
    out: Path | None = None,
    figures: str = "png",
    as_json: Json = False,
) -> int:
    """Compute the ETCS supervision curves of a train before a target.

    Prints each curve as distances before the target over the speed, and writes them with a
    figure. Ends with 2 on bad input.

    Parameters
    ----------
    file
        Train, track, target and national values (TOML).
    factors
        Emergency brake, Kdry and Kwet as `railgrip campaign safety` found them (factors.json),
        instead of the file's.
    out
        Folder of table and figure; ./out/FILE_etcs if not given.
    figures
        Formats of the figure: png,svg,pdf.
    as_json
        Print one JSON object instead of the table, SI units.
    """
    formats = formats_from(figures)
    with working("reading the case"):
        from railgrip.io.supervision_file import read_supervision

        case = read_supervision(file)
        if factors is not None:
            from railgrip.io.safety_factors import with_factors

            case = with_factors(case, factors)
    limits = _limits(case, case.speed_step)
    with working("writing"):
        files = _write(case, limits, out or Path("out") / f"{file.stem}_etcs", formats)
    if as_json:
        print_json(_as_json(case, limits, files))
        return 0
    _show(case, limits)
    print("Written: " + ", ".join(str(path) for path in files))
    return 0


def _limits(case: SupervisionCase, step: float) -> SupervisionLimits:
    import numpy as np

    from railgrip.control.etcs.supervision import supervision_limits

    top = case.ceiling or case.train.top_speed
    steps = math.floor((top - case.target.speed) / step + 1e-9)
    speeds = case.target.speed + step * np.arange(steps + 1)
    if top - speeds[-1] > 1e-6:
        speeds = np.append(speeds, top)
    return supervision_limits(
        case.supervised_train(), case.supervised_track(), case.supervised_target(), speeds,
        driver_reacts=case.driver_reacts, ceiling=case.ceiling,
        release_speed=case.target.release_speed,
    )  # fmt: skip


def _show(case: SupervisionCase, limits: SupervisionLimits) -> None:
    from railgrip.control.etcs.supervision import CURVES

    shown = [n for n in CURVES if any(x == x for x in getattr(limits, n))]
    rows = [
        [f"{3.6 * speed:.4g}", *(_text(getattr(limits, n)[i]) for n in shown)]
        for i, speed in enumerate(limits.speed)
    ]
    heads = [n.upper() if n[-1] in "dit12" and len(n) < 5 else n for n in shown]
    title = case.title or "ETCS supervision"
    print_table(f"{title}: metres before the target", ["km/h", *heads], rows)


def _text(distance: float) -> str:
    return "" if math.isnan(distance) else f"{distance:.2f}"


def _write(
    case: SupervisionCase, limits: SupervisionLimits, folder: Path, formats: list[str]
) -> list[Path]:
    from railgrip.io.supervision_csv import write_supervision
    from railgrip.report.plots import save_figure
    from railgrip.report.supervision_figure import supervision_figure

    picture = supervision_figure(_limits(case, FINE), case.title)
    with folder_of_results(folder) as aside:
        write_supervision(limits, aside / "curves.csv")
        for kind in formats:
            save_figure(picture, aside / f"curves.{kind}")
        names = sorted(path.name for path in aside.iterdir())
    return [folder / name for name in names]


def _as_json(case: SupervisionCase, limits: SupervisionLimits, files: list[Path]) -> dict[str, Any]:
    return {
        "title": case.title,
        **{name: values.tolist() for name, values in limits._asdict().items()},
        "files": [str(path) for path in files],
        "exit_code": 0,
    }
