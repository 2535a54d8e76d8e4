// The page's data: unpacking, slip, ranges over all axles, other runs brought onto one axis.

function bytes(text) {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
}

function unpack(packed) {
  if (packed.f32 !== undefined) return Array.from(new Float32Array(bytes(packed.f32)));
  if (packed.u16 === undefined) return new Array(packed.n).fill(packed.low);
  const { low, step } = packed;
  return Array.from(new Uint16Array(bytes(packed.u16)), (k) => (k === 65535 ? null : low + k * step));
}

function unpackRun(run) {
  const each = (table, how) => Object.fromEntries(Object.entries(table).map(([k, v]) => [k, how(v)]));
  const made = {
    ...run,
    time: unpack(run.time),
    distance: unpack(run.distance),
    train: each(run.train, unpack),
    axle: each(run.axle, (rows) => rows.map(unpack)),
  };
  if (made.train.acceleration) made.train.deceleration = made.train.acceleration.map((a) => (a === null ? null : -a));
  if (made.axle.dump_valve) made.axle.dump_valve = made.axle.dump_valve.map((row) => row.map((z) => (z === null ? null : Math.round(z))));
  const believed = made.train.reference_speed || made.train.train_speed;
  if (made.axle.wheel_speed && believed) {
    made.axle.slip = made.axle.wheel_speed.map((wheel, axle) => {
      const own = made.axle.unit_reference_speed && made.axle.unit_reference_speed[axle];
      const reference = own && own.some((v) => v > 0) ? own : believed;
      return wheel.map((w, k) => (w === null || reference[k] === null || reference[k] < 3 ? null : 100 * (1 - w / reference[k])));
    });
  }
  return made;
}

function range(rows) {
  const low = rows[0].slice(), high = rows[0].slice();
  for (const row of rows) {
    row.forEach((y, k) => {
      if (y === null) return;
      if (low[k] === null || y < low[k]) low[k] = y;
      if (high[k] === null || y > high[k]) high[k] = y;
    });
  }
  return [low, high];
}

// Values of `y` over ascending `x` at the places `at`; nothing outside.
function onto(at, x, y) {
  let k = 0;
  return at.map((here) => {
    if (here < x[0] || here > x[x.length - 1]) return null;
    while (k < x.length - 2 && x[k + 1] < here) k += 1;
    const width = x[k + 1] - x[k];
    if (y[k] === null || y[k + 1] === null || y[k + 1] === undefined) return y[k];
    return width > 0 ? y[k] + ((y[k + 1] - y[k]) * (here - x[k])) / width : y[k + 1];
  });
}

// A run with everything that belongs to it alone.
function unpackWhole(raw) {
  const run = unpackRun(raw);
  run.vehicle = Object.fromEntries(Object.entries(raw.vehicle).map(([k, rows]) => [k, rows.map(unpack)]));
  run.rail = Object.fromEntries(Object.entries(raw.rail).map(([k, v]) => [k, unpack(v)]));
  run.thresholds = raw.thresholds.map((t) => ({ name: t.name, values: unpack(t.values) }));
  return run;
}

const given = JSON.parse(document.getElementById("data").textContent);
// A page that compares holds whole runs; each can be the one looked at, the others lie behind it.
const runs = given.runs ? given.runs.map((run, key) => ({ ...unpackWhole(run), key })) : null;
let data = null;

function lookAt(key) {
  data = { ...runs[key], ghosts: runs.filter((run) => run.key !== key) };
}

if (runs) lookAt(0);
else if (given.time) data = { ...unpackWhole(given), ghosts: given.ghosts.map((ghost, key) => ({ ...unpackRun(ghost), key })) };

// The axis of all charts: the run's own, and beyond its end that of the runs laid over it.
function axisOver(over) {
  const own = data[over];
  return longer(own, data.ghosts.map((ghost) => ghost[over]));
}

function longer(own, others) {
  const end = own.length ? own[own.length - 1] : 0;
  const beyond = others.flatMap((other) => other.filter((x) => x > end));
  return own.concat(beyond.sort((a, b) => a - b));
}

function railAxis() {
  const others = runs ? data.ghosts.flatMap((ghost) => (ghost.rail.x ? [ghost.rail.x] : [])) : [];
  return longer(data.rail.x || [], others);
}

// The sample of a run next to a place on the axis; null beyond its end.
function sampleAt(run, over, here) {
  const x = run[over];
  if (!x.length || here > x[x.length - 1]) return null;
  let low = 0, high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] <= here) low = middle;
    else high = middle;
  }
  return here - x[low] < x[high] - here ? low : high;
}

const padded = (row, length) => (row.length < length ? row.concat(new Array(length - row.length).fill(null)) : row);
