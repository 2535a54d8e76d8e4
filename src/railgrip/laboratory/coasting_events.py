"""What may change next in a run under the coasting law: signed functions for event location."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from railgrip.control.coasting.coasting_law import AnnouncedTarget
from railgrip.laboratory.train_control import CRAWL, TINY, Situation, TrainControl

Array = NDArray[np.float64]
Signed = Callable[[float, Array], float]


def events_after(
    control: TrainControl, state: Array, now: Situation
) -> dict[str, tuple[Signed, float]]:
    """Return what may come next: signed function and direction, by name."""
    law, ahead, found = control.law, now.targets, dict[str, tuple[Signed, float]]()
    followed = now.followed if now.mode == "brake" else None
    free: Signed = lambda t, y: control.free(y[1], now.gradient, now.command)  # noqa: E731
    others = [target for target in ahead if target is not followed]
    above: Signed = lambda t, y: law.above_braking(  # noqa: E731
        y[0], y[1], _current(control, t, others)
    )
    place = _next_place(control, float(state[0]), ahead)
    name = "target" if any(target.position == place for target in ahead) else "line"
    found[name] = (lambda t, y: y[0] - place, 1.0)
    if now.command.is_acting:
        found["release"] = (
            lambda t, y: law.above_release(y[0], y[1], _current(control, t, ahead)),
            -1.0,
        )
    elif now.command.is_ready and now.mode != "brake":
        found["coasting"] = (
            lambda t, y: law.above_coasting(y[0], y[1], _current(control, t, ahead)),
            1.0,
        )
    found["braking"] = (above, 1.0)
    if followed is not None:
        needed: Signed = lambda t, y: control.needed(t, y[1], followed)  # noqa: E731
        found["off the curve"] = (lambda t, y: needed(t, y) + TINY - free(t, y), 1.0)
    elif now.command.must_brake:
        found["below"] = (lambda t, y: above(t, y) + TINY, -1.0)
    if law.parameters.least_speed > 0.0:
        rising = 1.0 if law.state.is_slow else -1.0
        found["least speed"] = (lambda t, y: law.above_least_speed(y[1]), rising)
    if law.past_station_limit(float(state[0]), ahead) < -TINY:
        found["station"] = (lambda t, y: law.past_station_limit(y[0], ahead), 1.0)
    if now.mode == "free":
        found["permitted speed"] = (lambda t, y: y[1] - now.limit, 1.0)
    if now.mode in ("cruise", "hold"):
        found["too slow"] = (free, -1.0)
    found["crawl"] = (lambda t, y: y[1] - CRAWL, -1.0)
    return found


def _current(
    control: TrainControl, time: float, targets: Sequence[AnnouncedTarget]
) -> Sequence[AnnouncedTarget]:
    """Return the targets; the end of a continuous authority has moved since the last event."""
    if control.authority is None or control.authority.period > 0.0:
        return targets
    now = control.authority.target(time)
    return [target if target in control.targets else now for target in targets]


def _next_place(control: TrainControl, position: float, ahead: Sequence[AnnouncedTarget]) -> float:
    """Return where the next target, limit or gradient begins."""
    moving = control.authority is not None and control.authority.period == 0.0
    places = [t.position for t in ahead if not moving or t in control.targets]
    places += [*control.limits.begins, *control.gradient.begins]
    return min((place for place in places if place > position + TINY), default=np.inf)


def located(function: Signed, direction: float) -> Signed:
    """Return a signed function as SciPy wants its events: it ends the integration."""

    def event(t: float, y: Array) -> float:
        return function(t, y)

    event.terminal = True  # type: ignore[attr-defined]
    event.direction = direction  # type: ignore[attr-defined]
    return event
