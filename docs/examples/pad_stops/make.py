"""Make stops.mf4: what instruments on one axle of a coach see while it brakes 30 times.

The stops are simulated; the faults of the measurement are added: an offset of 3 % per stop, noise
of 2 % that dies out over 1 s, a temperature sensor that lags by 3 s, and outliers. The pad is
true_pad.toml. Run it again with: python make.py
"""

from pathlib import Path

import numpy as np
from scipy.signal import lfilter

import railgrip as rg

HERE = Path(__file__).parent
STOPS, STEP, SEED = 30, 0.2, 4


def main() -> None:
    """Simulate, spoil, write."""
    random = np.random.default_rng(SEED)
    pieces, begin = [], 0.0
    for number in range(1, STOPS + 1):
        piece = spoiled(simulated(random), random)
        piece["time"] = piece["time"] + begin
        piece["stop"] = np.full(len(piece["time"]), float(number))
        begin = piece["time"][-1] + 600.0
        pieces.append(piece)
    write({name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]})


def simulated(random: np.random.Generator) -> dict[str, np.ndarray]:
    """One stop from a speed, a disc temperature and three levels of brake."""
    levels = random.uniform(0.35, 1.0, 3)
    speed = random.uniform(80.0, 200.0)
    third = speed / 3.6 / 0.8 / 3.0
    result = rg.simulate(rg.load({
        "extends": "coach_120",
        "train": {"extends": "coach_disc",
                  "brakes": {"disc": {"pad": str(HERE / "true_pad.toml")}}},
        "wsp": {"controller": "none"},
        "run": {"speed": f"{speed} km/h", "ambient": f"{random.uniform(-20.0, 50.0)} degC",
                "trace": f"{STEP} s",
                "demand": [{"at": k * third, "level": x} for k, x in enumerate(levels)]},
    }))  # fmt: skip
    one = result.data.isel(run=0) if "run" in result.data.dims else result.data
    axle = one.isel(axle=1)
    good = np.isfinite(one["train_speed"].values)
    return {
        "time": one["time"].values[good],
        "v": one["train_speed"].values[good],
        "T": axle["disc_temperature"].values[good],
        "F": axle["clamp_force"].values[good],
        "mu": axle["pad_friction"].values[good],
    }


def spoiled(true: dict[str, np.ndarray], random: np.random.Generator) -> dict[str, np.ndarray]:
    """The stop as the instruments tell it."""
    n = len(true["time"])
    decay = np.exp(-STEP / 1.0)
    noise = lfilter([np.sqrt(1 - decay**2)], [1.0, -decay], random.standard_normal(n))
    factor = np.exp(0.03 * random.standard_normal() + 0.02 * noise)
    factor[random.random(n) < 0.01] *= random.uniform(0.5, 1.5)
    lag = np.exp(-STEP / 3.0)
    start = true["T"][0]
    sensed = lfilter([1.0 - lag], [1.0, -lag], true["T"] - start) + start
    torque = true["mu"] * factor * true["F"] * 0.247
    return {
        "time": true["time"],
        "v": true["v"] * 3.6 * (1 + 0.001 * random.standard_normal(n)),
        "T": sensed + 0.5 * random.standard_normal(n),
        "F": true["F"] / 1e3 * (1 + 0.004 * random.standard_normal(n)),
        "M": torque / 1e3,
    }


def write(columns: dict[str, np.ndarray]) -> None:
    """Write the channels as MDF4, compressed."""
    from asammdf import MDF, Signal

    units = {"v": "km/h", "T": "degC", "F": "kN", "M": "kN*m", "stop": ""}
    signals = [
        Signal(columns[name].astype("<f4"), columns["time"], name=name, unit=unit)
        for name, unit in units.items()
    ]
    with MDF(version="4.10") as file:
        file.append(signals, common_timebase=True)
        file.save(HERE / "stops.mf4", overwrite=True, compression=2)


if __name__ == "__main__":
    main()
