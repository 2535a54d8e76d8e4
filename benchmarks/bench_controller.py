"""What one call of each registered controller costs, for each axle of the four-car train.

Compiled, as the kernel calls it; through the Python object, as `railgrip check` and any plain
controller do. The signals are those of a slide: half the axles at 80 % of the train's speed. Beside
the compiled calls stands the plant: an axle-tick of a batch on random rail less its control call.

    python benchmarks/bench_controller.py [--quick] [--out FILE]
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
from _common import best_of, options, report

import railgrip as rg
from railgrip.compiler import entry
from railgrip.control import contract as ctl
from railgrip.core import registry
from railgrip.engine.controllers import compiled, plain_step

AXLES = 16


@entry
def _many(controller, parameters, setup, state, measured, command, dt, calls):
    for call in range(calls):
        # the train slows by 1 m/s² and gains it again: a jump would be told as a broken sensor
        speed = 25.0 + abs(15.0 - 0.01 * (call % 3000))
        for axle in range(measured.shape[0]):
            measured[axle, 0] = speed if axle % 2 == 0 else 0.8 * speed
        controller(parameters, setup, state, measured, command, dt)


def call_costs(controller: Any, calls: int, plain_calls: int) -> tuple[float, float]:
    """Return the seconds of one call for the train, compiled and plain."""
    setup = ctl.Setup(
        n_axles=AXLES,
        period=controller.period,
        wheel_radius=np.full(AXLES, 0.425),
        motored=np.zeros(AXLES, dtype=bool),
        braked=np.ones(AXLES, dtype=bool),
    )
    ready = compiled(controller, AXLES)
    columns = np.zeros((AXLES, ctl.N_MEASURED), order="F")
    columns[:, ctl.CYLINDER_PRESSURE] = 3e5
    columns[:, ctl.BRAKE_DEMAND] = columns[:, ctl.EMERGENCY] = 1.0
    columns[:, ctl.WHEEL_SPEED] = 40.0
    arrays = (ready.parameters, ctl.setup_array(setup), np.zeros(ready.state_size), columns)
    ready.initial(*arrays)

    def fast(count: int) -> None:
        _many(ready.kernel, *arrays, ctl.command_array(AXLES), controller.period, count)

    def slow() -> None:
        state = controller.reset(setup)
        for _ in range(plain_calls):
            plain_step(controller, state, columns, controller.period)

    fast(1)
    return best_of(5, lambda: fast(calls)).cpu / calls, best_of(3, slow).cpu / plain_calls


def batch_cost(controller: Any, runs: int) -> float:
    """Return the seconds of one axle-tick of a batch."""
    scenario = rg.load("random_rail")
    rg.simulate(scenario, runs=16, controller=controller)
    done = best_of(3, lambda: rg.simulate(scenario, runs=runs, controller=controller))
    ticks = AXLES * float(done.result.data["stopping_time"].sum()) / scenario.run.step
    return done.cpu / ticks


def main() -> None:
    chosen = options(__doc__)
    calls, plain_calls, runs = (20_000, 500, 32) if chosen.quick else (200_000, 5_000, 512)
    rows = []
    for name in registry.names("railgrip.controllers"):
        controller = registry.resolve("railgrip.controllers", name)()
        quick, plain = call_costs(controller, calls, plain_calls)
        axle = quick / AXLES
        plant = batch_cost(controller, runs) - axle
        rows += [
            (f"{name}: compiled, an axle", axle * 1e9, "ns", ""),
            (f"{name}: over the plant's axle-tick", axle / plant * 100, "%", "goal: 15"),
            (f"{name}: compiled, the train", quick * 1e6, "µs", "goal: 2"),
            (f"{name}: plain Python, the train", plain * 1e6, "µs", ""),
        ]
    report(
        f"One control call, {AXLES} axles (Numba {numba.__version__})",
        rows,
        chosen.out,
    )


if __name__ == "__main__":
    main()
