"""The exact solver from outside: what it refuses, reports and returns."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.core.errors import RailgripError
from railgrip.laboratory import exact
from railgrip.laboratory.exact import exact_law, refine_exact, solve_exact
from railgrip.laboratory.exact_friction import FrictionMemory
from railgrip.laboratory.exact_march import march_exact

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
FALLING = RailFriction(0.5, 0.4, 0.8, 1.0, 1.0)
SOME = Creepage(2e-3, 1e-3, 0.2)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"contact": BASE._replace(load=0.0)}, r"contact\.load: must be positive.*0\.0 N"),
        ({"contact": BASE._replace(load=-1e5)}, r"contact\.load: must be positive.*N"),
        ({"contact": BASE._replace(a=-1e-3)}, r"contact\.a: must be positive.*-0\.001 m"),
        ({"contact": BASE._replace(b=math.inf)}, r"contact\.b: must be positive and finite"),
        ({"contact": BASE._replace(shear_modulus=math.nan)}, r"contact\.shear_modulus"),
        ({"contact": BASE._replace(poisson=0.7)}, r"contact\.poisson.*0\.7.*0 … 0\.5"),
        ({"rail": COULOMB._replace(static_friction=-0.1)}, r"rail\.static_friction.*-0\.1"),
        ({"rail": COULOMB._replace(friction_ratio=1.1)}, r"rail\.friction_ratio.*0 … 1"),
        ({"creepage": Creepage(math.nan, 0.0, 0.0)}, r"creepage\.longitudinal.*nan"),
        ({"creepage": Creepage(0.0, 0.0, math.inf)}, r"creepage\.spin.*inf"),
        ({"rail": FALLING, "speed": 0.0}, r"speed: must be positive.*0\.0 m/s"),
        ({"rail": FALLING, "speed": -3.0}, r"speed: must be positive.*-3\.0 m/s"),
        ({"grid": (7, 48)}, r"grid: no such grid; got \(7, 48\).*8 … 512"),
        ({"grid": (48.0, 48)}, r"grid: no such grid"),
        ({"grid": 48}, r"grid: no such grid; got 48"),
        ({"grid": (1000, 48)}, r"grid: no such grid"),
        ({"memory": FrictionMemory(-1e-6)}, r"memory\.distance: must be finite and not negative"),
    ],
)
def test_bad_input_is_refused_in_words(changes: dict[str, Any], sentence: str) -> None:
    case = {"contact": BASE, "rail": COULOMB, "speed": 20.0, "creepage": SOME, **changes}
    with pytest.raises(RailgripError, match=sentence):
        solve_exact(**case)


def test_all_that_is_wrong_is_said_at_once() -> None:
    with pytest.raises(RailgripError) as caught:
        solve_exact(BASE._replace(load=0.0, poisson=2.0), COULOMB, 20.0, SOME, grid=(1, 1))
    assert len(caught.value.problems) == 3


def test_constant_friction_needs_no_speed() -> None:
    here = solve_exact(BASE, COULOMB, 0.0, SOME, grid=(12, 12)).force
    assert here == solve_exact(BASE, COULOMB, 50.0, SOME, grid=(12, 12)).force


@pytest.mark.parametrize("rail", [COULOMB, FALLING, COULOMB._replace(static_friction=0.0)])
def test_no_creepage_or_no_friction_is_no_force(rail: RailFriction) -> None:
    creepage = SOME if rail.static_friction == 0.0 else Creepage(0.0, 0.0, 0.0)
    solution = solve_exact(BASE, rail, 20.0, creepage, grid=(12, 12))
    assert solution.is_converged
    assert tuple(solution.force) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("grid", [(8, 8), (8, 40), (200, 40), (61, 90)])
def test_any_grid(grid: tuple[int, int]) -> None:
    solution = solve_exact(BASE, COULOMB, 20.0, SOME, grid=grid)
    assert solution.is_converged
    assert solution.pressure.shape == (grid[1], grid[0])
    assert float(solution.pressure.sum()) * solution.cell_area == pytest.approx(100e3, rel=1e-8)
    along = float(solution.traction_x.sum()) * solution.cell_area
    assert solution.force.longitudinal == pytest.approx(along)
    moment = (
        (solution.traction_y * solution.x[None, :]) - (solution.traction_x * solution.y[:, None])
    ).sum() * solution.cell_area
    assert solution.force.spin_moment == pytest.approx(float(moment))


def test_tiny_creepage_is_linear() -> None:
    one, other = (
        solve_exact(BASE, COULOMB, 20.0, Creepage(size, 0.0, 0.0), grid=(24, 24)).force[0] / size
        for size in (1e-12, 1e-7)
    )
    assert one == pytest.approx(other, rel=1e-6)


def test_what_does_not_converge_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    solution = solve_exact(BASE, COULOMB, 20.0, SOME, grid=(12, 12), tolerance=1e-20)
    assert not solution.is_converged
    assert 0.0 < solution.residual < 1e-12
    failed = dataclasses.replace(solution, is_converged=False)
    monkeypatch.setattr(exact, "solve_exact", lambda *_, **__: failed)
    for law in (exact_law, refine_exact):
        with pytest.raises(RailgripError, match="the exact solver did not converge"):
            law(BASE, COULOMB, 20.0, SOME)


def test_extrapolation_lies_beyond_the_finer_grid() -> None:
    force, error = refine_exact(BASE, COULOMB, 20.0, SOME, grid=(24, 24))
    fine = solve_exact(BASE, COULOMB, 20.0, SOME, grid=(44, 44)).force
    np.testing.assert_allclose(np.subtract(force, fine), error, rtol=1e-9)


def test_a_march_is_refused_in_words() -> None:
    with pytest.raises(RailgripError, match="creepages: give at least one"):
        march_exact(BASE, COULOMB, 20.0, [])
    with pytest.raises(RailgripError, match=r"creepage\.lateral"):
        march_exact(BASE, COULOMB, 20.0, [SOME, Creepage(0.0, math.nan, 0.0)], grid=(12, 12))
    start = solve_exact(BASE, COULOMB, 20.0, SOME, grid=(12, 16))
    with pytest.raises(RailgripError, match=r"start: is on another grid; got \(12, 16\)"):
        march_exact(BASE, COULOMB, 20.0, [SOME], grid=(16, 12), start=start)
