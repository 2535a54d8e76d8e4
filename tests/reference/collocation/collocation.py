"""Direct collocation of the energy-optimal run with CasADi and IPOPT: a way of its own.

Forces are constant between nodes, the square of speed follows a Hermite–Simpson rule, limits of
power hold at both ends of each interval. It shares no code with the method that it checks; line
and train come from the source files, read here by themselves.
"""

import itertools
import json

import numpy as np

from railgrip import data

G = 9.81


def read(kind, name):
    return json.loads(data.path(kind, name).read_text(encoding="utf-8"))


def train_of(name):
    file = read("point_trains", name)

    def number(key, scale, default=0.0):
        return file[key]["value"] * scale if key in file else default

    return {
        "mass": number("mass", 1.0),
        "dynamic": number("mass", 1.0) * (1 + number("rho", 0.01)),
        "force": number("max traction force", 1e3),
        "power": number("max traction power", 1e3),
        "motor": number("max reg braking force", 1e3),
        "motor_power": number("max reg braking power", 1e3),
        "friction": number("max pn braking force", 1e3),
        "up": number("max acceleration", 1.0, 10.0),
        "down": number("max deceleration", 1.0, 10.0),
        "top": number("max speed", 1 / 3.6),
        "resistance": (
            number("rolling resistance r0", 1e3),
            number("rolling resistance r1", 3.6e3),
            number("rolling resistance r2", 12.96e3),
        ),
        "drive": number("efficiency traction", 0.01),
        "back": number("efficiency reg brake", 0.01),
    }


def steps(rows, places, scale):
    at = np.array([row[0] for row in rows])
    value = np.array([row[1] for row in rows]) * scale
    return value[np.searchsorted(at, places, "right") - 1]


def solve(train, line, begin, end, time=None, step=20.0, final=1.0, power_at="ends"):
    """Return the least energy for a time, J; the least time, s, if none is asked for.

    ``line`` is a shipped name or a table with "speed limits", "gradients" and "drags" (from,
    to, N s²/m² more) of the same shape. ``power_at``: limits of power hold at both "ends" of each
    interval, or in the "middle" of it. The force is constant there, so the former takes a share of
    the step off the train's power.
    """
    import casadi as ca

    file = read("lines", line) if isinstance(line, str) else line
    tunnels = file.get("drags", [])
    marks = {row[0] for row in file["speed limits"]["values"]}
    marks |= {at for tunnel in tunnels for at in tunnel[:2]}
    edges = [begin, *sorted(mark for mark in marks if begin < mark < end), end]
    parts = [
        np.linspace(a, b, max(1, int(np.ceil((b - a) / step))) + 1)[:-1]
        for a, b in itertools.pairwise(edges)
    ]
    near = np.array([0.5, 1.0, 2.0, 3.5, 5.5, 8.0, 11.0, 15.0])
    places = np.unique(np.concatenate([*parts, [end], begin + near, end - near]))
    places = places[np.append(True, np.diff(places) > 0.2)]
    places[-1] = end
    middle = 0.5 * (places[1:] + places[:-1])
    width = np.diff(places)
    # the mean gradient of each interval, from the height of the track
    slopes = file.get("gradients", {"values": [[0.0, 0.0]]})["values"]
    at = np.array([row[0] for row in slopes] + [1e7])
    height = np.concatenate([[0.0], np.cumsum(np.diff(at) * [row[1] / 1e3 for row in slopes])])
    slope = np.diff(np.interp(places, at, height)) / width
    limit = np.minimum(steps(file["speed limits"]["values"], middle, 1 / 3.6), train["top"]) ** 2
    upper = np.minimum(np.append(limit, limit[-1]), np.append(limit[0], limit))

    n, m = width.size, train["dynamic"]
    z = ca.MX.sym("z", n + 1)
    pull, motor, friction = (ca.MX.sym(name, n) for name in ("pull", "motor", "friction"))
    r0, r1, r2 = train["resistance"]
    for enters, leaves, drag in tunnels:
        r2 = r2 + np.where((enters <= middle) & (middle < leaves), drag, 0.0)

    def change(square):
        resists = (r0 + r1 * ca.sqrt(square) + r2 * square) / m
        return 2 * (pull - motor - friction - resists - G * slope * train["mass"] / m)

    first, last = z[:n], z[1:]
    f0, f1 = change(first), change(last)
    half = 0.5 * (first + last) + width / 8 * (f0 - f1)
    defect = last - first - width / 6 * (f0 + 4 * change(half) + f1)
    seconds = ca.sum1(2 * width / (ca.sqrt(first) + ca.sqrt(last)))
    energy = ca.sum1(width * (pull / train["drive"] - train["back"] * motor))
    acceleration = (last - first) / (2 * width)
    if power_at == "ends":
        paces = (ca.sqrt(first), ca.sqrt(last))
    else:
        paces = (ca.sqrt(0.5 * (first + last)),) * 2
    conditions = [defect, acceleration, *(pull * pace for pace in paces)]
    power, back = train["power"] / m, train["motor_power"] / m
    low = [np.zeros(n), np.full(n, -train["down"]), np.zeros(n), np.zeros(n)]
    high = [np.zeros(n), np.full(n, train["up"]), np.full(n, power), np.full(n, power)]
    conditions += [motor * pace for pace in paces]
    low += [np.zeros(n), np.zeros(n)]
    high += [np.full(n, back), np.full(n, back)]
    if time is not None:
        conditions.append(seconds)
        low.append(np.zeros(1))
        high.append(np.full(1, time))
    lower = np.ones(n + 1)
    lower[[0, -1]] = final**2
    upper[[0, -1]] = final**2
    cap = lambda force: np.full(n, force / m)  # noqa: E731
    problem = {
        "x": ca.vertcat(z, pull, motor, friction),
        "f": seconds / 1e3 if time is None else energy / 1e3,
        "g": ca.vertcat(*conditions),
    }
    options = {"ipopt.print_level": 0, "print_time": False, "ipopt.tol": 1e-8}
    solver = ca.nlpsol("optimum", "ipopt", problem, options)
    guess = np.concatenate([np.full(n + 1, 0.5 * limit.min()), np.full(3 * n, 1e-2)])
    found = solver(
        x0=guess,
        lbx=np.concatenate([lower, np.zeros(3 * n)]),
        ubx=np.concatenate(
            [upper, cap(train["force"]), cap(train["motor"]), cap(train["friction"])]
        ),
        lbg=np.concatenate(low),
        ubg=np.concatenate(high),
    )
    assert solver.stats()["success"], solver.stats()["return_status"]
    value = float(found["f"]) * 1e3
    return value * m if time is not None else value
