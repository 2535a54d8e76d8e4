"""One case of the exact solver, on one core: 48 × 48 cells, longitudinal, and its sisters.

The division of the patch is made once a shape and grid; it is measured apart.

    python benchmarks/bench_exact.py [--quick] [--out FILE]
"""

from __future__ import annotations

import math

from _common import best_of, options, report

from railgrip.contact.rail_friction import DRY_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.laboratory import half_space_patch
from railgrip.laboratory.exact import solve_exact
from railgrip.laboratory.exact_march import march_exact

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
CURVE = [step * 5e-4 for step in range(1, 21)]


def curve(cells: int) -> list[int]:
    """Solve twenty points of the creep curve and return the steps each took."""
    cases = [
        solve_exact(BASE, COULOMB, 20.0, Creepage(creepage, 0.0, 0.0), grid=(cells, cells))
        for creepage in CURVE
    ]
    assert all(case.is_converged for case in cases)
    return [case.newton_steps for case in cases]


def case(creepage: Creepage, rail: RailFriction = COULOMB, cells: int = 48) -> bool:
    return solve_exact(BASE, rail, 20.0, creepage, grid=(cells, cells)).is_converged


def divide() -> None:
    """Divide the patch anew."""
    half_space_patch._patch.cache_clear()
    half_space_patch.half_space_patch(BASE.a, BASE.b, BASE.poisson, 48, 48)


def main() -> None:
    chosen = options(__doc__)
    times = 3 if chosen.quick else 15
    divide()
    along = [
        best_of(times, lambda creepage=creepage: case(Creepage(creepage, 0.0, 0.0))).cpu
        for creepage in CURVE
    ]
    combined = Creepage(3e-3, -3e-3, 0.5)
    rows = [
        ("longitudinal 48 × 48, slowest of 20", 1e3 * max(along), "ms", "asked: under 100"),
        ("longitudinal 48 × 48, mean of 20", 1e3 * sum(along) / len(along), "ms", ""),
        ("combined with spin", 1e3 * best_of(times, lambda: case(combined)).cpu, "ms", ""),
        (
            "the same with falling friction",
            1e3 * best_of(times, lambda: case(combined, DRY_POLACH_2005)).cpu,
            "ms",
            "",
        ),
        (
            "a step of a march",
            1e2 * best_of(1, lambda: march_exact(BASE, COULOMB, 20.0, [combined] * 10)).cpu,
            "ms",
            "",
        ),
        ("dividing the patch, once a shape", 1e3 * best_of(times, divide).cpu, "ms", ""),
    ]
    if not chosen.quick:
        rows.append(
            ("longitudinal 96 × 96, mean of 20", 5e1 * best_of(3, lambda: curve(96)).cpu, "ms", "")
        )
    report("Exact solver, base case, processor time", rows, chosen.out)


if __name__ == "__main__":
    main()
