"""What one call of each registered controller costs, for each axle of the four-car train.

Compiled, as the kernel calls it, with the signals of a slide (half the axles at 80 % of the train's
speed); through the Python object, as `railgrip check` and any plain controller do; and in a batch
on random rail, by letting the controller step twice. The last is dearer than the first: signals
there are less regular, and the plant has used the caches in between.

    python benchmarks/bench_controller.py [--quick] [--out FILE]
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
from _common import best_of, options, report

import railgrip as rg
from railgrip.compiler import entry, inlined
from railgrip.control import contract as ctl
from railgrip.control.plain_form import KernelController
from railgrip.core import registry
from railgrip.engine.controllers import compiled, plain_step

AXLES = 16
SCENARIO = rg.load("random_rail")


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


def twice(controller: Any) -> Any:
    """Return a controller that steps two times, the second time on a state of its own.

    Its commands are those of the first step: a batch runs the same course, and takes longer by
    what a step costs there, with real signals and with caches that the plant has used.
    """
    kernel, initial = inlined(controller.kernel), inlined(controller.initial)
    size, said = controller.state_size(AXLES), ctl.N_COMMAND

    def step(parameters, setup, state, measured, command, dt):  # type: ignore[no-untyped-def]
        n_axles = measured.shape[0]
        unheard = state[2 * size :].reshape((said, n_axles)).T
        kernel(parameters, setup, state[0:size], measured, command, dt)
        kernel(parameters, setup, state[size : 2 * size], measured, unheard, dt)

    def begin(parameters, setup, state, measured):  # type: ignore[no-untyped-def]
        initial(parameters, setup, state[0:size], measured)
        initial(parameters, setup, state[size : 2 * size], measured)
        unheard = state[2 * size :].reshape((said, measured.shape[0]))
        for axle in range(measured.shape[0]):
            unheard[ctl.DYNAMIC_SHARE, axle] = 1.0
            unheard[ctl.FRICTION_SHARE, axle] = 1.0

    class Twice(KernelController):
        pass

    Twice.kernel, Twice.initial = staticmethod(step), staticmethod(begin)
    Twice.state_size = staticmethod(lambda n_axles: 2 * size + said * n_axles)
    return Twice(controller.parameters, controller.period)


def batch_cost(controller: Any, runs: int) -> float:
    """Return the seconds of one axle-tick of a batch."""
    done = best_of(1, lambda: rg.simulate(SCENARIO, runs=runs, controller=controller))
    ticks = AXLES * float(done.result.data["stopping_time"].sum()) / SCENARIO.run.step
    return done.cpu / ticks


def cost_in_batch(controller: Any, runs: int, rounds: int) -> tuple[float, float]:
    """Return the seconds of a step for one axle in a batch, and of the plant's axle-tick.

    Both batches in turn, the best of each: others may use the machine.
    """
    doubled = twice(controller)
    for one in (controller, doubled):
        rg.simulate(SCENARIO, runs=16, controller=one)
    pairs = [(batch_cost(controller, runs), batch_cost(doubled, runs)) for _ in range(rounds)]
    once = min(pair[0] for pair in pairs)
    step = min(pair[1] for pair in pairs) - once
    return step, once - step


def main() -> None:
    chosen = options(__doc__)
    calls, plain_calls, runs, rounds = 200_000, 5_000, 128, 7
    if chosen.quick:
        calls, plain_calls, runs, rounds = 20_000, 500, 32, 2
    rows = []
    for name in registry.names("railgrip.controllers"):
        controller = registry.resolve("railgrip.controllers", name)()
        quick, plain = call_costs(controller, calls, plain_calls)
        step, plant = cost_in_batch(controller, runs, rounds)
        rows += [
            (f"{name}: compiled, an axle", quick / AXLES * 1e9, "ns", ""),
            (f"{name}: in the batch, an axle", step * 1e9, "ns", ""),
            (f"{name}: over the plant's axle-tick", step / plant * 100, "%", "goal: 15"),
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
