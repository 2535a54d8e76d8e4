// The charts: what each draws, and how they share cursor and zoom.

const CHARTS = [
  { id: "speed", unit: "km/h", decimals: 1, axle: "wheel_speed", under: "unit_reference_speed", underLabel: "its reference", train: { train_speed: "train", reference_speed: "reference" }, floor: 0, height: 320 },
  { id: "slip", unit: "%", decimals: 1, axle: "slip", thresholds: true, height: 240 },
  { id: "pressure", unit: "bar", decimals: 2, axle: "brake_cylinder_pressure", floor: 0, height: 220 },
  { id: "valve", valves: true },
  { id: "adhesion", unit: "", decimals: 3, axle: "adhesion_used", under: "adhesion_available", dotted: "adhesion_asked", floor: 0, height: 260 },
  { id: "found", unit: "", decimals: 3, axle: "rail_friction", floor: 0, height: 220 },
  { id: "force", unit: "kN", decimals: 1, axle: "contact_force", height: 220 },
  { id: "deceleration", unit: "m/s²", decimals: 2, train: { deceleration: "train" }, height: 190 },
  { id: "motor", unit: "kN", decimals: 1, axle: "dynamic_force", height: 200 },
  { id: "flash", unit: "K", decimals: 0, axle: "flash_temperature", floor: 0, height: 200 },
  { id: "temperature", unit: "°C", decimals: 0, axle: "disc_temperature", height: 220 },
  { id: "reservoir", unit: "bar", decimals: 2, vehicle: "reservoir_pressure", height: 190 },
  { id: "rail", unit: "", decimals: 3, rail: { rail_friction_before: "before", rail_friction_after: "after the train" }, floor: 0, height: 200 },
  { id: "energy", unit: "kJ/m", decimals: 2, rail: { rail_energy: "received" }, floor: 0, height: 160 },
  { id: "sand", unit: "g/m", decimals: 1, rail: { rail_sand: "laid" }, floor: 0, height: 140 },
];
const MANY = 24;
const SIDE = 62; // room for the names of the axles beside their strips
const PAGE_WIDTH = 660; // fits A4 and Letter between their margins

// Everything one chart draws: [{label, values, colour, width, dash, axle}], on the axis x.
function linesOf(chart, state) {
  const c = look();
  const lines = [];
  const { x, over, picked } = state;
  const add = (label, values, more) => lines.push({ label, values: padded(values, x.length), width: 1.2, ...more });
  const rows = chart.axle && data.axle[chart.axle];
  if (rows && rows.length > MANY) {
    const [low, high] = range(rows);
    add("greatest of all axles", high, { colour: "transparent", width: 0, top: true });
    add("least of all axles", low, { colour: "transparent", width: 0 });
  }
  data.ghosts.forEach((ghost, g) => {
    if (state.hidden.has(ghost.key)) return;
    const style = ghost.measured ? { colour: c.measured, dash: [5, 3] }
      : runs ? { colour: runColour(ghost) + "b8", dash: runDash(ghost) }
      : { colour: c.ghost, dash: [[], [6, 3], [2, 3], [8, 3, 2, 3]][g % 4] };
    const put = (label, values, width, whole) => add(label, onto(x, ghost[over], values), { ...style, width, whole, ghost: g + 1 });
    const table = (chart.axle && ghost.axle[chart.axle]) || [];
    for (const axle of picked) {
      const k = ghost.axles.indexOf(data.axles[axle]);
      if (table[k]) put(`${ghost.name}, ${data.axles[axle]}`, table[k], 0.8);
    }
    for (const name of chart.rail && runs ? Object.keys(chart.rail) : []) {
      if (name === "rail_friction_before" || !ghost.rail[name]) continue;
      add(ghost.name, onto(x, ghost.rail.x, ghost.rail[name]), { ...style, width: 1, whole: true, ghost: g + 1 });
    }
    for (const name of Object.keys(chart.train || {})) {
      if (runs && name === "reference_speed") continue;
      if (ghost.train[name]) put(ghost.name, ghost.train[name], name === "reference_speed" ? 0.8 : 1.8, name !== "reference_speed");
    }
  });
  if (rows) {
    for (const axle of picked) {
      const colour = axleColour(axle, picked);
      const under = chart.under && data.axle[chart.under];
      if (under) add(chart.underLabel || "available", under[axle], { colour, dash: [4, 3], width: 1, quiet: true });
      const dotted = chart.dotted && picked.length <= 4 && data.axle[chart.dotted];
      if (dotted) add("asked", dotted[axle], { colour, dash: [1, 3], width: 1, quiet: true });
      add(data.axles[axle], rows[axle], { colour, axle, dash: runs ? runDash(data) : [], width: runs ? 1.8 : picked.length > 6 ? 1 : 1.4 });
    }
  }
  for (const [k, row] of ((chart.vehicle && data.vehicle[chart.vehicle]) || []).entries()) {
    add(data.vehicles[k] || `V${k + 1}`, row, { colour: vehicleColour(k), named: data.vehicles.length <= 8 });
  }
  if (chart.thresholds) {
    const top = 1.2 * Math.max(10, ...rows.map((row) => row.reduce((most, y) => Math.max(most, y), 0)));
    const below = (values) => values.map((y) => (y !== null && y <= top ? y : null));
    data.thresholds.forEach((t, k) => add(t.name, below(t.values), { colour: c.soft, dash: [[6, 3], [8, 3, 2, 3], [2, 3]][k % 3], named: true }));
  }
  for (const [name, label] of Object.entries(chart.train || {})) {
    // with several units the reference is drawn axle by axle
    if (data.train[name] && !(name === "reference_speed" && data.axle.unit_reference_speed)) {
      const whole = runs ? { colour: runColour(data), dash: runDash(data), width: 2.4 } : { colour: c.ink, width: 2 };
      add(runs && name !== "reference_speed" ? data.name : label, data.train[name], name === "reference_speed"
        ? { colour: c.soft, dash: [6, 3], named: true } : { ...whole, named: true });
    }
  }
  for (const [name, label] of Object.entries(chart.rail || {})) {
    const first = name === "rail_friction_before";
    const colour = first ? c.ink : runs ? runColour(data) : c.many[2];
    const values = data.rail[name] && (runs ? onto(x, data.rail.x, data.rail[name]) : data.rail[name]);
    if (values) add(runs && !first ? data.name : label, values, { colour, named: true, width: runs && !first ? 1.8 : 1.2, fill: chart.id !== "rail" && !runs });
  }
  return lines;
}

function axes(chart, label) {
  const c = look();
  const font = "11px system-ui, sans-serif";
  const one = { stroke: c.soft, font, labelFont: font, labelSize: 16, grid: { stroke: c.grid, width: 1 }, ticks: { stroke: c.grid, size: 4 } };
  return [
    { ...one, label, size: 30, values: (u, ticks) => ticks.map((t) => String(+t.toFixed(6))) },
    { ...one, size: SIDE }, // the heading names the unit; equal widths keep all charts in line
  ];
}

function makeChart(chart, state, place, links) {
  const rail = Boolean(chart.rail);
  const x = rail ? railAxis() : state.x;
  const lines = chart.valves ? [] : linesOf(chart, { ...state, x });
  if (!chart.valves && !lines.length) return null;
  const label = rail || state.over === "distance" ? "Distance from the start, m" : "Time, s";
  const bands = lines.findIndex((line) => line.top);
  const options = {
    width: printing ? PAGE_WIDTH : Math.max(200, place.clientWidth || 600),
    height: chart.valves ? 62 + state.picked.length * 16 : chart.height,
    legend: { show: false },
    scales: {
      x: { time: false, ...(state.zoom && !rail ? { min: state.zoom[0], max: state.zoom[1] } : {}) },
      y: chart.valves ? { dir: -1, range: () => [0, state.picked.length] }
        : { range: (u, low, high) => {
          if (low === null) return [0, 1];
          const bottom = chart.floor === undefined ? low : Math.min(chart.floor, low);
          return uPlot.rangeNum(bottom, high, { min: { pad: 0.05, soft: chart.floor, mode: 1 }, max: { pad: 0.07 } });
        } },
    },
    focus: { alpha: 0.4 },
    cursor: { y: false, drag: { x: true, y: false, setScale: true }, focus: { prox: 10 }, points: { show: !chart.valves, size: 6 },
      sync: rail ? undefined : { key: "stop", setSeries: false, scales: ["x", null], filters: { pub: (kind) => kind === "mousemove" || kind === "mouseleave" } } },
    axes: axes(chart, label),
    series: [{}].concat(lines.map((line) => ({
      label: line.label, stroke: line.colour, width: line.width, dash: line.dash, spanGaps: false,
      fill: line.fill ? look().range : undefined, points: { show: false },
    }))),
    bands: bands < 0 ? [] : [{ series: [bands + 1, bands + 2], fill: look().range }],
    hooks: { setCursor: [(u) => links.cursor(u, chart, lines)], setSeries: [(u, k) => links.focus(u, chart, lines, k)], setScale: rail ? [] : [(u, key) => key === "x" && links.zoomed(u)] },
  };
  if (chart.valves) valveChart(options, state);
  const table = chart.valves ? [x, new Array(x.length).fill(null)] : [x, ...lines.map((line) => line.values)];
  const made = new uPlot(options, table, place);
  touch(made);
  return made;
}

// Dump valves: one coloured strip for each axle instead of lines.
function valveChart(options, state) {
  const rows = state.picked.map((axle) => data.axle.dump_valve[axle]);
  const text = state.picked.map((axle) => shortName(axle));
  options.series.push({ label: "valve", stroke: "transparent" });
  options.axes[1] = { ...options.axes[1], grid: { show: false }, ticks: { show: false },
    splits: () => rows.map((_, k) => k + 0.5), values: () => text };
  options.hooks.drawAxes = [(u) => {
    const colours = look().valves;
    const x = u.data[0];
    u.ctx.save();
    u.ctx.beginPath();
    u.ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    u.ctx.clip();
    rows.forEach((row, k) => {
      const top = u.valToPos(k, "y", true) + 1;
      const height = u.valToPos(k + 1, "y", true) - top - 1;
      for (let i = 0; i < row.length; ) {
        let j = i + 1;
        while (j < row.length && row[j] === row[i]) j += 1;
        if (row[i] !== null) {
          const left = u.valToPos(x[i], "x", true);
          const right = u.valToPos(x[Math.min(j, row.length - 1)], "x", true);
          u.ctx.fillStyle = colours[row[i]];
          u.ctx.fillRect(left, top, Math.max(1, right - left), height);
        }
        i = j;
      }
    });
    u.ctx.restore();
  }];
}

// A finger moves the cursor; the page still scrolls up and down.
function touch(made) {
  const move = (event) => {
    if (event.touches.length !== 1) return;
    const { clientX, clientY } = event.touches[0];
    made.over.dispatchEvent(new MouseEvent("mousemove", { clientX, clientY, bubbles: true }));
  };
  made.over.addEventListener("touchstart", move, { passive: true });
  made.over.addEventListener("touchmove", move, { passive: true });
}
