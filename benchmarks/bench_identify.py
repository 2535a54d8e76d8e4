"""What it costs to find a pad in 500 stops of 1 000 samples, and to read 100 MB of measurement.

The fit is everything from samples to 95 % intervals: blocks, first guess, robust fit with break
points and lag, intervals. The floor is one linear least squares in plain numpy with as many columns
over all samples. The import reads a CSV file of 100 MB (5 MB
with --quick) and counts the bytes that were read from it.

    python benchmarks/bench_identify.py [--quick] [--out FILE]
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from _common import best_of, options, report

from railgrip.io.measured.pad_channels import read_pad_channels
from railgrip.io.measured.pad_reading import read_pad_stops
from railgrip.laboratory.pad_fit import identify_pad
from railgrip.laboratory.pad_fit.data import PadStops
from railgrip.laboratory.pad_fit.shape import hats
from railgrip.laboratory.pad_fit.synthetic import Programme, organic, synthetic_stops

DEMANDED_SECONDS = 3.0
CHANNELS = {
    "channel": [
        {"column": "stop", "signal": "stop"},
        {"column": "mu", "signal": "pad_friction"},
        {"column": "T", "signal": "disc_temperature", "unit": "degC"},
        {"column": "v", "signal": "rubbing_speed", "unit": "m/s"},
        {"column": "F", "signal": "clamp_force", "unit": "N"},
    ]
}


KNOTS = {"temperature": 5, "speed": 4, "clamp_force": 4}


def floor(stops: PadStops) -> np.ndarray:
    """Linear least squares over all samples, with eleven columns as the fit has parameters."""
    columns = [np.ones((len(stops.time), 1))]
    for name, count in KNOTS.items():
        x = stops.influence(name)
        columns.append(hats(np.linspace(x.min(), x.max(), count), x)[:, 1:])
    design = np.concatenate(columns, axis=1)
    return np.linalg.solve(design.T @ design, design.T @ np.log(stops.friction))


def write_csv(stops: PadStops, path: Path, megabytes: float) -> None:
    """Write stops again and again until the file is large enough."""
    rows = np.column_stack([stops.stop, stops.time, stops.friction, stops.temperature,
                            stops.speed, stops.clamp_force])  # fmt: skip
    text = "\n".join(",".join(f"{x:.9g}" for x in row) for row in rows.tolist()) + "\n"
    with path.open("w", encoding="utf-8") as file:
        file.write("stop,time,mu,T,v,F\n")
        for _ in range(max(1, round(megabytes * 1e6 / len(text)))):
            file.write(text)


def bytes_read() -> int:
    """Return how many bytes this process has asked the system for."""
    lines = Path("/proc/self/io").read_text(encoding="utf-8").splitlines()
    return int(lines[0].split()[1])


def main() -> None:
    chosen = options(__doc__)
    programme = Programme(stops=100 if chosen.quick else 500, samples=1000)
    stops = synthetic_stops(organic, programme, seed=1)
    times = 1 if chosen.quick else 3
    plain = best_of(3, lambda: floor(stops)).cpu
    fit = best_of(times, lambda: identify_pad(stops))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "stops.csv"
        few = PadStops(*(column[:20_000] for column in stops))
        write_csv(few, path, 5.0 if chosen.quick else 100.0)
        size = path.stat().st_size
        write_csv(few, Path(folder) / "small.csv", 0.1)
        read_pad_stops(Path(folder) / "small.csv", read_pad_channels(CHANNELS))  # libraries
        before = bytes_read()
        reading = best_of(1, lambda: read_pad_stops(path, read_pad_channels(CHANNELS)))
        share = (bytes_read() - before) / size
    count = f"{programme.stops} stops of 1 000 samples"
    demand = "" if chosen.quick else f"asked: under {DEMANDED_SECONDS:g}"
    rows = [
        (f"fit of {count}, processor time", fit.cpu, "s", demand),
        (f"fit of {count}, by the clock", fit.wall, "s", demand),
        ("plain numpy, linear, no intervals", plain, "s", ""),
        ("fit over plain numpy", fit.cpu / plain, "", ""),
        (f"import of {size / 1e6:.0f} MB CSV", reading.cpu, "s", ""),
        ("bytes read over size of the file", share, "", "asked: under 2"),
    ]
    report("Identification of a pad", rows, chosen.out)


if __name__ == "__main__":
    main()
