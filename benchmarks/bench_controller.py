"""What one call of each registered controller costs, for each axle of the four-car train.

Compiled, as the kernel calls it, with the signals of a slide (half the axles at 80 % of the train's
speed); through the Python object, as `railgrip check` and any plain controller do; and in a batch
on random rail, by looking at the processor's clock before and after each step. There signals are
less regular than in the first, and the plant has used the caches in between. A call as such is
counted in the first alone: in the batch a step that does nothing is subtracted.

    python benchmarks/bench_controller.py [--quick] [--out FILE]
"""

from __future__ import annotations

from typing import Any

import numba
import numba.extending
import numpy as np
from _common import best_of, options, report
from llvmlite import ir

import railgrip as rg
from railgrip.compiler import compiled as as_function
from railgrip.compiler import entry, inlined
from railgrip.control import contract as ctl
from railgrip.control.plain_form import KernelController
from railgrip.core import registry
from railgrip.engine.controllers import compiled, plain_step
from railgrip.engine.plug_ins import call_step, controller_step

AXLES = 16
SCENARIO = rg.load("random_rail")
SPENT = np.zeros(1, dtype=np.int64)
"""Ticks of the processor's clock that the steps of a batch have taken."""


@entry
def _many(controller, parameters, setup, state, measured, command, dt, calls):
    for turn in range(calls):
        # the train slows by 1 m/s² and gains it again: a jump would be told as a broken sensor
        speed = 25.0 + abs(15.0 - 0.01 * (turn % 3000))
        for axle in range(measured.shape[0]):
            measured[axle, 0] = speed if axle % 2 == 0 else 0.8 * speed
        call_step(controller, parameters, setup, state, measured, command, dt)


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
        _many(ready.step, *arrays, ctl.command_array(AXLES), controller.period, count)

    def slow() -> None:
        state = controller.reset(setup)
        for _ in range(plain_calls):
            plain_step(controller, state, columns, controller.period)

    fast(1)
    return best_of(5, lambda: fast(calls)).cpu / calls, best_of(3, slow).cpu / plain_calls


@numba.extending.intrinsic
def _clock(context: Any) -> Any:
    """Return the processor's clock, in its own ticks."""
    number = numba.types.int64

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        kind = ir.FunctionType(ir.IntType(64), ())
        return builder.call(builder.module.declare_intrinsic("llvm.readcyclecounter", (), kind), ())

    return number(), generate


@numba.extending.intrinsic
def _note(context: Any, ticks: Any) -> Any:
    """Add to `SPENT`."""

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        number = ir.IntType(64)
        place = builder.inttoptr(number(SPENT.ctypes.data), number.as_pointer())
        builder.store(builder.add(builder.load(place, typ=number), given[0]), place)

    return numba.types.void(numba.types.int64), generate


@entry
def clock():
    return _clock()


def _do_nothing(parameters, setup, state, measured, command, dt):  # type: ignore[no-untyped-def]
    pass


def watched(controller: Any, function: Any) -> Any:
    """Return a controller with a function for its step, which notes in `SPENT` how long it took."""
    inner, call = as_function(controller_step(function)), inlined(call_step)

    def step(parameters, setup, state, measured, command, dt):  # type: ignore[no-untyped-def]
        begin = _clock()
        call(inner, parameters, setup, state, measured, command, dt)
        _note(_clock() - begin)

    class Watched(KernelController):
        pass

    Watched.kernel, Watched.initial = staticmethod(step), staticmethod(controller.initial)
    Watched.state_size = staticmethod(controller.state_size)
    return Watched(controller.parameters, controller.period)


def watch(controller: Any, runs: int) -> tuple[float, float]:
    """Return the seconds of a step for one axle in a batch, and of a whole axle-tick."""
    SPENT[0] = 0
    began = clock()
    done = best_of(1, lambda: rg.simulate(SCENARIO, runs=runs, controller=controller))
    ticks_per_second = (clock() - began) / done.wall
    axle_ticks = AXLES * float(done.result.data["stopping_time"].sum()) / SCENARIO.run.step
    return SPENT[0] / ticks_per_second / axle_ticks, done.cpu / axle_ticks


def cost_in_batch(controller: Any, runs: int, rounds: int) -> tuple[float, float]:
    """Return the seconds of a step for one axle in a batch, and of the plant's axle-tick.

    The best of each: others may use the machine. Looking at the clock costs a little, which is
    seen on a step that does nothing.
    """
    works, idles = watched(controller, controller.kernel), watched(controller, _do_nothing)
    for one in (works, idles):
        rg.simulate(SCENARIO, runs=16, controller=one)
    step, whole = np.min([watch(works, runs) for _ in range(rounds)], axis=0)
    idle = min(watch(idles, runs)[0] for _ in range(2))
    return step - idle, whole - step


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
