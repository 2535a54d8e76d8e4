"""K_dry_rst of one speed step, all ten levels: by the formula and on the plant.

python benchmarks/bench_safety.py [--quick] [--out FILE]
"""

from __future__ import annotations

from _common import best_of, options, report

import railgrip as rg
from railgrip.campaign.safety.case import find_case, read_safety_case
from railgrip.campaign.safety.factors import safety_factors


def main() -> None:
    chosen = options(__doc__)
    case = read_safety_case(find_case("emu_en14531"))
    rows = []
    for runs in (1, 16):  # compiles, or loads what is compiled
        rg.simulate(case.scenario(100 / 3.6), runs=runs, traces=False)
    for method, runs in (("formula", 20_000), ("plant", 1_500 if chosen.quick else 6_000)):
        one = case.model_copy(
            update={"method": method, "wet": None, "speed_steps": (100 / 3.6,), "runs": runs}
        )
        timing = best_of(1, lambda one=one: safety_factors(one, threads=2))
        dry = timing.result.steps[0].dry
        last = dry.quantile[9]
        demand = "" if chosen.quick else "demanded: "
        rows += [
            (f"{method}: {dry.runs} runs with pilots, wall clock", timing.wall, "s",
             demand and f"{demand}30"),
            (f"{method}: CPU over two", timing.cpu / 2, "s", "wall clock of two free cores"),
            (f"{method}: K_dry at EBCL 9", last.value, "", ""),
            (f"{method}: half its 95 % interval", 0.5 * (last.high - last.low), "",
             demand and f"{demand}0.002"),
        ]  # fmt: skip
    report("K_dry_rst of the EN 14531-1 example from 100 km/h, EBCL 0 to 9", rows, chosen.out)


if __name__ == "__main__":
    main()
