"""What one call of the conventional protection costs, for each axle of the four-car train.

Compiled, as the kernel calls it; through the Python object, as `railgrip check` and any plain
controller do. The signals are those of a slide: half the axles at 80 % of the train's speed.

    python benchmarks/bench_controller.py [--quick] [--out FILE]
"""

from __future__ import annotations

import numba
import numpy as np
from _common import best_of, options, report

from railgrip.compiler import entry
from railgrip.control import contract as ctl
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.engine.controllers import compiled, plain_step

AXLES = 16


@entry
def _many(controller, parameters, setup, state, measured, command, dt, calls):
    for call in range(calls):
        # the train slows by 1 m/s², and starts again before it stands
        speed = 40.0 - 0.01 * (call % 3000)
        for axle in range(measured.shape[0]):
            measured[axle, 0] = speed if axle % 2 == 0 else 0.8 * speed
        controller(parameters, setup, state, measured, command, dt)


def main() -> None:
    chosen = options(__doc__)
    calls, plain_calls = (20_000, 2_000) if chosen.quick else (200_000, 20_000)
    controller = ConventionalWSP()
    setup = ctl.Setup(
        n_axles=AXLES,
        period=controller.period,
        wheel_radius=np.full(AXLES, 0.425),
        motored=np.zeros(AXLES, dtype=bool),
        braked=np.ones(AXLES, dtype=bool),
    )
    ready = compiled(controller, AXLES)
    columns = np.zeros((AXLES, ctl.N_MEASURED))
    columns[:, ctl.CYLINDER_PRESSURE] = 3e5
    columns[:, ctl.BRAKE_DEMAND] = columns[:, ctl.EMERGENCY] = 1.0
    columns[:, ctl.WHEEL_SPEED] = 40.0
    arrays = (ready.parameters, ctl.setup_array(setup), np.zeros(ready.state_size), columns)
    ready.initial(*arrays)

    def fast(count):
        _many(ready.kernel, *arrays, ctl.command_array(AXLES), controller.period, count)

    def slow():
        state = controller.reset(setup)
        for _ in range(plain_calls):
            plain_step(controller, state, columns, controller.period)

    fast(1)
    quick = best_of(5, lambda: fast(calls)).cpu / calls
    plain = best_of(3, slow).cpu / plain_calls
    report(
        f"One control call, conventional protection, {AXLES} axles (Numba {numba.__version__})",
        [
            ("compiled, an axle", quick / AXLES * 1e9, "ns", ""),
            ("compiled, the train", quick * 1e6, "µs", ""),
            ("plain Python, the train", plain * 1e6, "µs", ""),
            ("share of the 10 ms period, plain", plain / controller.period * 100, "%", ""),
        ],
        chosen.out,
    )


if __name__ == "__main__":
    main()
