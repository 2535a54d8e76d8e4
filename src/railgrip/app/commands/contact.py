"""`railgrip contact`: what one wheel can transmit, by every law."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from railgrip.app import contact_output
from railgrip.app.contact_options import Geometry, Motion, Output, Range
from railgrip.app.contact_words import (
    laws_from,
    pair_from,
    rail_from,
    state_from,
    sweep_from,
    told_as,
)
from railgrip.app.inputs import formats_from
from railgrip.app.screen import print_json, working
from railgrip.core.errors import Problem, RailgripError, unknown_name

if TYPE_CHECKING:
    from railgrip.app.contact_words import Sweep
    from railgrip.scenario.contact_state import ContactState

FORMS = {"--over": ("creepage", "slip-speed"), "--show": ("adhesion", "force")}
NO_GEOMETRY, NO_MOTION, NO_RANGE, NO_OUTPUT = Geometry(), Motion(), Range(), Output()


def contact(
    *,
    geometry: Geometry = NO_GEOMETRY,
    motion: Motion = NO_MOTION,
    laws: Annotated[str, Parameter(name=["--laws", "--law"])] = "",
    reference: str = "",
    varied: Range = NO_RANGE,
    output: Output = NO_OUTPUT,
) -> int:
    """Compute the contact of one wheel: patch, pressure, slopes, creep forces, temperature.

    One case, or a sweep; several laws stand side by side. Quantities carry their units, as in
    --load "100 kN"; a bare number is in SI. Ends with 2 on bad input.

    Parameters
    ----------
    laws
        Laws of `railgrip list rolling-laws`, or "exact"; several with commas, or "all".
    reference
        Law from which differences are taken; the first, or "exact" with "all".
    """
    formats = formats_from(output.figures) or ["png"]
    _refuse_unknown_forms(output, varied)
    with working("reading"):
        sweep = sweep_from(varied)
        state = state_from(motion, varied.sweep)
        pair, rail = pair_from(geometry), rail_from(geometry)
        usual = "fastsim_1982" if output.with_map else "polach_2005"
        names, base = laws_from(laws or usual, reference)
        mapped = _law_of_the_map(names) if output.with_map else ""
    with working("computing"):
        from railgrip.laboratory.contact_case import contact_case
        from railgrip.laboratory.law_comparison import compare_laws

        with told_as({"": "--pair"}):
            case = contact_case(pair, state.load)
        found = compare_laws(names, case.contact, rail, **_points(state, sweep))
        patch, rises = _map(mapped, case.contact, rail, state) if mapped else (None, None)
    computed = contact_output.Computed(
        title=_title(pair.title, geometry, state, sweep),
        case=case,
        found=found,
        reference=base,
        temperatures=(state.wheel_temperature, state.rail_temperature),
        swept=sweep.variable if sweep else "",
        over=output.over,
        show=output.show,
        patch=patch,
        rises=rises,
    )
    files = []
    if output.out is not None or output.figures or mapped:
        with working("writing"):
            folder = output.out or Path("out") / "contact"
            files = contact_output.write(computed, folder, formats)
    if output.as_json:
        print_json(contact_output.as_json(computed, files))
        return 0
    contact_output.show(computed)
    if files:
        print("Written: " + ", ".join(str(path) for path in files))
    return 0


def _refuse_unknown_forms(output: Output, varied: Range) -> None:
    for (option, known), word in zip(FORMS.items(), (output.over, output.show), strict=True):
        if word not in known:
            raise RailgripError(unknown_name(option, "form", word, known))
    if output.over == "slip-speed" and varied.sweep not in ("creepage", "lateral"):
        what = "slip speed belongs to a sweep of creepage or lateral"
        raise RailgripError(Problem("--over", what, cure="--sweep creepage"))


def _points(state: ContactState, sweep: Sweep | None) -> dict[str, Any]:
    names = ("load", "speed", "longitudinal", "lateral", "spin")
    given: dict[str, Any] = {name: getattr(state, name) for name in names}
    if sweep is not None:
        import numpy as np

        given[sweep.variable] = np.linspace(sweep.begin, sweep.end, sweep.points)
    return given


def _law_of_the_map(names: list[str]) -> str:
    from railgrip.laboratory.patch_map import MAPPED_LAWS

    for name in names:
        if name in MAPPED_LAWS:
            return name
    what = "none of the laws says what happens within the patch"
    cure = f"--law {MAPPED_LAWS[0]}"
    raise RailgripError(Problem("--map", what, ", ".join(names), ", ".join(MAPPED_LAWS), cure))


def _map(law: str, contact: Any, rail: Any, state: ContactState) -> tuple[Any, Any]:
    from railgrip.contact.rolling_contact import Creepage
    from railgrip.laboratory.patch_map import patch_map
    from railgrip.laboratory.patch_temperature import patch_rises

    creepage = Creepage(state.longitudinal, state.lateral, state.spin)
    patch = patch_map(law, contact, rail, state.speed, creepage)
    try:
        return patch, patch_rises(patch, contact, state.speed, creepage)[0]
    except RailgripError:  # a surface too slow to be taken strip by strip: a map without it
        return patch, None


def _title(pair: str, geometry: Geometry, state: ContactState, sweep: Sweep | None) -> str:
    rail = f"friction {geometry.friction}" if geometry.friction else f"{geometry.rail} rail"
    quantities = {
        "load": f"{1e-3 * state.load:g} kN",
        "speed": f"{3.6 * state.speed:g} km/h",
        "longitudinal": f"creepage {100 * state.longitudinal:g} %",
        "lateral": f"lateral {100 * state.lateral:g} %",
        "spin": f"spin {state.spin:g} 1/m",
    }
    fixed = [
        text
        for name, text in quantities.items()
        if (sweep is None or name != sweep.variable) and getattr(state, name) != 0.0
    ]
    return ", ".join([pair or geometry.pair, *fixed, rail])
