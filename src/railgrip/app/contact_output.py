"""What `railgrip contact` shows and writes of what it has computed."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from railgrip.app.files import folder_of_results
from railgrip.app.screen import as_plain, print_table

if TYPE_CHECKING:
    from railgrip.laboratory.contact_case import ContactCase
    from railgrip.laboratory.law_comparison import LawComparison
    from railgrip.laboratory.patch_map import PatchMap


class Computed(NamedTuple):
    """A case or a sweep, all of it.

    Parameters
    ----------
    title : str
        In words: pair, load, speed, rail.
    case : ContactCase
        Patch, pressure, slopes.
    found : LawComparison
        What the laws say.
    reference : str
        Law from which differences are taken.
    temperatures : (float, float)
        With which wheel and rail enter [°C].
    swept : str
        Name of what is varied, empty for a single case.
    over, show : str
        Form of the curves.
    patch : PatchMap or None
        Fields over the patch.
    rises : ndarray or None
        Rise of the wheel's surface over the patch [K].
    """

    title: str
    case: ContactCase
    found: LawComparison
    reference: str
    temperatures: tuple[float, float]
    swept: str
    over: str
    show: str
    patch: PatchMap | None
    rises: Any


def show(computed: Computed) -> None:
    """Print the tables."""
    from railgrip.report import contact_tables as tables

    case, found, reference = computed.case, computed.found, computed.reference
    print(f"{computed.title}\n")
    print_table("Contact", ["", ""], tables.contact_rows(case, found.rail))
    columns = ["initial slope", "kN per unit creepage", "against Kalker's table"]
    print_table("Slope of the creep curve", columns, tables.slope_rows(case))
    if not computed.swept:
        heads, rows = tables.law_rows(found, reference, *computed.temperatures)
        print_table("Creep forces", heads, rows)
    else:
        form = (computed.over, computed.show)
        heads, rows = tables.sweep_rows(found, computed.swept, *form)
        print_table(tables.sweep_title(computed.swept, *form), heads, rows)
        print_table("Summary", *tables.summary_rows(found, computed.swept, reference, *form))
    if not all(forces.is_valid.all() for forces in found.forces.values()):
        print(f"{tables.BEYOND} beyond what the law declares itself good for")
    for warning in tables.warnings(found, *computed.temperatures):
        print(warning)


def as_json(computed: Computed, files: Sequence[Path]) -> dict[str, Any]:
    """Return what `--json` prints, in SI."""
    case, found = computed.case, computed.found
    points = ("speed", "load", "longitudinal", "lateral", "spin", "slip_speed")
    laws = {
        law: {
            **{name: array.tolist() for name, array in forces._asdict().items()},
            "adhesion": found.adhesion(law).tolist(),
            "difference": found.difference(law, computed.reference).tolist(),
            "friction_power": found.friction_power(law).tolist(),
            "flash_rise": found.flash_rise(law).tolist(),
            "surface_temperature": found.surface_temperature(law, *computed.temperatures).tolist(),
        }
        for law, forces in found.forces.items()
    }
    return {
        "title": computed.title,
        "geometry": case.geometry._asdict(),
        "contact": {
            **case.contact._asdict(),
            "greatest_pressure": case.patch.greatest_pressure,
            "approach": case.patch.approach,
        },
        "rail": found.rail._asdict(),
        "wheel_temperature": computed.temperatures[0],
        "rail_temperature": computed.temperatures[1],
        "slopes": case.slopes._asdict(),
        "swept": computed.swept,
        "points": {name: getattr(found, name).tolist() for name in points},
        "reference": computed.reference,
        "laws": laws,
        "files": [str(path) for path in files],
        "exit_code": 0,
    }


def write(computed: Computed, folder: Path, formats: Sequence[str]) -> list[Path]:
    """Write data and figures into a folder, all or nothing; return their paths."""
    from railgrip.io.contact_csv import write_comparison, write_map

    with folder_of_results(folder) as aside:
        write_comparison(computed.found, aside / "forces.csv", computed.reference)
        if computed.patch is not None:
            write_map(computed.patch, aside / "map.csv", computed.rises)
        text = json.dumps(as_plain(as_json(computed, [])), indent=2, ensure_ascii=False)
        (aside / "contact.json").write_text(text + "\n", encoding="utf-8")
        for name, picture in _figures(computed).items():
            from railgrip.report.plots import save_figure

            for kind in formats:
                save_figure(picture, aside / f"{name}.{kind}")
        names = sorted(path.name for path in aside.iterdir())
    return [folder / name for name in names]


def _figures(computed: Computed) -> dict[str, Any]:
    pictures: dict[str, Any] = {}
    found = computed.found
    if computed.swept:
        from railgrip.report.contact_figures import curves_figure

        pictures["curves"] = curves_figure(
            found, computed.swept, title=computed.title,
            over=computed.over, show=computed.show, reference=computed.reference,
        )  # fmt: skip
    if computed.patch is not None:
        from railgrip.report.contact_maps import map_figure

        speed = float(found.speed[0])
        pictures["map"] = map_figure(computed.patch, speed, computed.rises, title=computed.title)
    return pictures
