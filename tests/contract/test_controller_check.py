"""Each way to break the contract is found by the check that is there for it, in one sentence."""

import numpy as np
import pytest

from railgrip.campaign.controller_check import check_controller, longest_lock
from railgrip.control.contract import FILL, VENT, Command


class Sound:
    """Vents beyond 20 % slip, for eight seconds at most; each test breaks one thing of it."""

    period = 0.01

    def reset(self, setup):
        return {"reference": 0.0, "released": np.zeros(setup.n_axles)}

    def step(self, state, measured, dt):
        speed = np.nan_to_num(np.abs(measured.wheel_speed), nan=state["reference"])
        speed[speed > 150.0] = 0.0
        state["reference"] = max(speed.max(), state["reference"] - 1.5 * dt)
        slides = speed < 0.8 * state["reference"] - 0.5
        state["released"] = np.where(slides, state["released"] + dt, 0.0)
        valve = np.where(slides & (state["released"] < 8.0), VENT, FILL)
        one = np.ones(len(valve))
        return Command(valve, one, 0 * one, state["reference"])


def bench(cls):
    """Return name → result of the checks on the bench."""
    results = check_controller(cls)
    for result in results:
        assert "\n" not in result.sentence
        assert "Traceback" not in result.sentence
    return {result.name: result for result in results}


def failing(cls, name, *words):
    result = bench(cls)[name]
    assert not result.passed
    for word in words:
        assert word in result.sentence
    return result


def test_a_sound_one_passes_the_bench():
    names = ["shape", "determinism", "states apart", "faulty sensors", "standstill"]
    names += ["stop without slides", "locking axle", "safety timer"]
    results = bench(Sound)
    assert [name for name in results if results[name].passed][:8] == names


def test_a_code_that_is_none():
    class Bad(Sound):
        def step(self, state, measured, dt):
            return (
                super()
                .step(state, measured, dt)
                ._replace(dump_valve=np.full(len(measured.wheel_speed), 3.0))
            )

    failing(Bad, "shape", "dump_valve", "got 3", "VENT (2)")


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("dynamic_share", np.full(4, 1.2), ["dynamic_share", "0..1"]),
        ("dynamic_share", np.full(4, np.nan), ["no finite number"]),
        ("sanding", np.full(4, 0.5), ["sanding"]),
        ("reference_speed", np.nan, ["reference_speed"]),
        ("reference_speed", "fast", ["ValueError"]),
        ("dump_valve", 0.0, ["one number", "one value for each axle"]),
        ("dump_valve", ["a", "b", "c", "d"], ["not an array of numbers"]),
    ],
)
def test_values_that_are_none(field, value, words):
    class Bad(Sound):
        def step(self, state, measured, dt):
            command = super().step(state, measured, dt)
            return command._replace(**{field: value}) if len(measured[0]) == 4 else command

    failing(Bad, "determinism", *words)


def test_something_else_than_a_command():
    class Bad(Sound):
        def step(self, state, measured, dt):
            return tuple(super().step(state, measured, dt))

    failing(Bad, "shape", "returned tuple", "Command")


def test_no_period():
    class Bad(Sound):
        period = None

    failing(Bad, "shape", "period", "0.001 to 0.5 s")


def test_chance():
    class Bad(Sound):
        def step(self, state, measured, dt):
            command = super().step(state, measured, dt)
            return command._replace(
                sanding=np.random.default_rng().integers(0, 2, len(measured[0]))
            )

    failing(Bad, "determinism", "another sanding")


def test_a_state_kept_in_the_class():
    shared = {"reference": 0.0}

    class Bad(Sound):
        def reset(self, setup):
            return {"released": np.zeros(setup.n_axles), **shared}

        def step(self, state, measured, dt):
            state["reference"] = max(state["reference"], shared["reference"])
            command = super().step(state, measured, dt)
            shared["reference"] = state["reference"] + 1.0
            return command

    assert not bench(Bad)["states apart"].passed


def test_writing_into_what_was_measured():
    class Bad(Sound):
        def step(self, state, measured, dt):
            measured.wheel_speed[0] += 1.0
            return super().step(state, measured, dt)

    failing(Bad, "shape", "wrote into measured.wheel_speed")


def test_stumbling_over_nan():
    class Bad(Sound):
        def step(self, state, measured, dt):
            int(measured.wheel_speed[0])
            return super().step(state, measured, dt)

    failing(Bad, "faulty sensors", "ValueError")


def test_creeping_release_at_a_stand():
    class Bad(Sound):
        def step(self, state, measured, dt):
            command = super().step(state, measured, dt)
            stands = measured.wheel_speed < 0.1
            return command._replace(dump_valve=np.where(stands, VENT, command.dump_valve))

    failing(Bad, "standstill", "VENT", "allowed FILL")


def test_releasing_where_nothing_slides():
    class Bad(Sound):
        def step(self, state, measured, dt):
            command = super().step(state, measured, dt)
            return command._replace(
                dump_valve=np.where(measured.brake_cylinder_pressure > 2.5e5, VENT, FILL)
            )

    failing(Bad, "stop without slides", "VENT", "s into a stop")


def test_sleeping():
    class Bad(Sound):
        def step(self, state, measured, dt):
            command = super().step(state, measured, dt)
            return command._replace(dump_valve=np.zeros(len(measured.wheel_speed)))

    failing(Bad, "locking axle", "never released")


def test_releasing_all_for_one():
    class Bad(Sound):
        def step(self, state, measured, dt):
            command = super().step(state, measured, dt)
            return command._replace(
                dump_valve=np.full(len(measured.wheel_speed), command.dump_valve.max())
            )

    failing(Bad, "locking axle", "did not slide")


def test_no_safety_timer():
    class Bad(Sound):
        def step(self, state, measured, dt):
            state["released"][:] = 0.0
            return super().step(state, measured, dt)

    failing(Bad, "safety timer", "safety timer", "10 s")


def test_a_class_that_cannot_be_made():
    class Bad(Sound):
        def __init__(self, needed):
            self.needed = needed

    failing(Bad, "shape", "TypeError", "needed")


def test_the_line_of_the_file_is_named(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(
        "class Mine:\n    period = 0.01\n    def reset(self, setup):\n        return 0\n"
        "    def step(self, state, measured, dt):\n        return 1 / 0\n"
    )
    results = check_controller(path)
    assert "ZeroDivisionError" in results[0].sentence
    assert "line 6" in results[0].sentence


def test_a_file_that_is_none_is_one_failed_check():
    results = check_controller("nowhere/my_wsp.py")
    assert [result.passed for result in results] == [False]


def test_longest_lock_counts_only_above_30_kmh():
    xarray = pytest.importorskip("xarray")
    time = np.arange(0.0, 10.0, 0.02)
    train = 20.0 - time
    wheel = np.where((time > 2.0) & (time <= 3.0), 0.0, train)
    wheel = np.where(train < 30 / 3.6 - 1.0, 0.0, wheel)
    data = xarray.Dataset(
        {
            "train_speed": (("run", "time"), train[None]),
            "wheel_speed": (("run", "axle", "time"), np.stack([train, wheel])[None]),
        },
        coords={"time": time},
    )
    assert longest_lock(data) == pytest.approx(1.0, abs=0.021)
