// The page: which axles and runs are drawn, over what, and the values under the cursor.

const byId = (id) => document.getElementById(id);
const element = (tag, text, more) => Object.assign(document.createElement(tag), { textContent: text }, more);

const state = {
  over: "time",
  x: axisOver("time"),
  zoom: null,
  picked: data.axles.map((_, k) => k),
  hidden: new Set(),
};
if (runs || data.axles.length > MANY) state.picked = [data.worst];
let charts = [];
let rebuilding = false;

const links = {
  zoomed(from) {
    if (rebuilding) return;
    rebuilding = true;
    const { min, max } = from.scales.x;
    state.zoom = min === null || (min <= state.x[0] && max >= state.x[state.x.length - 1]) ? null : [min, max];
    for (const { made, chart } of charts) {
      if (made !== from && !chart.rail) made.setScale("x", { min, max });
    }
    rebuilding = false;
  },
  cursor(u, chart, lines) {
    keyOf(u, chart, lines);
    if (!chart.rail && u.cursor.idx !== null && u.cursor.idx !== undefined && u.cursor.left >= 0) readout(u.cursor.idx);
  },
  focus(u, chart, lines) { keyOf(u, chart, lines); },
};

// The line of colours, names and values above a chart.
function keyOf(u, chart, lines) {
  const key = byId(`key-${chart.id}`);
  const at = u && u.cursor.left >= 0 ? u.cursor.idx : null;
  const parts = [];
  const item = (line, words) => {
    const span = element("span", "");
    const mark = element("i", "", { className: line.dash && line.dash.length ? (line.dash[0] > 2 ? "dash" : "dots") : "" });
    mark.style.setProperty("--c", line.colour);
    span.append(mark, words);
    if (line.values && at !== null && at !== undefined) span.append(" ", element("b", shown(line.values[at], chart.decimals, chart.unit)));
    parts.push(span);
  };
  for (const line of lines) if (line.named) item(line, line.label);
  for (const [g, ghost] of data.ghosts.entries()) {
    const own = lines.filter((line) => line.ghost === g + 1);
    if (own.length) item(own.findLast((line) => line.whole) || { ...own[0], values: null }, ghost.name);
  }
  const axleLines = lines.filter((line) => line.axle !== undefined);
  const focused = u && lines[u.series.findIndex((s, k) => k > 0 && s._focus) - 1];
  if (focused && (focused.axle !== undefined || focused.ghost)) item(focused, focused.label);
  else if (runs && axleLines.length) item(axleLines[0], chart.train ? `wheel ${axleLines.map((line) => line.label).join(", ")}` : data.name);
  else if (axleLines.length && axleLines.length <= 6) axleLines.forEach((line) => item(line, line.label));
  else if (axleLines.length) {
    for (const vehicle of new Set(axleLines.map((line) => data.vehicle_of[line.axle]))) {
      item({ colour: vehicleColour(vehicle), values: null }, `axles of ${data.vehicles[vehicle]}`);
    }
  }
  if (lines.some((line) => line.top)) {
    const span = element("span", "");
    const mark = element("i", "", { className: "block" });
    mark.style.setProperty("--c", look().range);
    span.append(mark, `range of all ${data.axles.length} axles`);
    parts.push(span);
  }
  if (lines.some((line) => line.label === "available")) parts.push(element("span", "dashed: available"));
  if (lines.some((line) => line.label === "its reference")) parts.push(element("span", "dashed, thin: reference of the axle's own unit"));
  if (lines.some((line) => line.label === "asked")) parts.push(element("span", "dotted: asked"));
  if (chart.valves) {
    VALVES.forEach((name, k) => {
      const span = element("span", "");
      const mark = element("i", "", { className: "block" });
      mark.style.setProperty("--c", look().valves[k]);
      span.append(mark, name);
      parts.push(span);
    });
  }
  key.replaceChildren(...parts);
}

const COLUMNS = [
  ["wheel_speed", "km/h", 1], ["slip", "slip %", 1], ["brake_cylinder_pressure", "bar", 2], ["dump_valve", "valve", 0],
  ["adhesion_used", "used", 3], ["adhesion_available", "avail.", 3], ["disc_temperature", "°C", 0],
].filter(([name]) => data.axle[name]);

const HEADS = { train_speed: "train, km/h", wheel_speed: "wheel, km/h", slip: "slip, %", brake_cylinder_pressure: "cylinder, bar", contact_force: "force, kN",
  flash_temperature: "flash, K", disc_temperature: "disc, °C", rail_friction: "rail friction", deceleration: "brakes, m/s²" };
const DECIMALS = { train_speed: 1, wheel_speed: 1, slip: 1, brake_cylinder_pressure: 2, contact_force: 1, flash_temperature: 0, disc_temperature: 0, rail_friction: 3, deceleration: 2 };

// Every run at the same time or place, for the first axle that is picked: a column each.
function readRuns(at) {
  const here = state.x[at], axle = data.axles[state.picked[0]];
  const place = state.over === "time" ? ["Time", shown(here, 2, "s")] : ["Distance", shown(here, 1, "m")];
  byId("train-values").replaceChildren(...[place, ["Axle", axle || "none picked"]].flatMap(([name, text]) => [element("dt", name), element("dd", text)]));
  const seen = runs.filter((run) => run.key === data.key || !state.hidden.has(run.key));
  const samples = seen.map((run) => sampleAt(run, state.over, here));
  const head = element("tr", "");
  head.append(element("th", "", { scope: "col" }), ...seen.map((run) => {
    const cell = element("th", "", { scope: "col", className: run.key === data.key ? "looked" : "" });
    cell.append(swatch(run), element("span", ` ${breakable(run.name)}`));
    return cell;
  }));
  byId("axle-heads").replaceChildren(head);
  const names = Object.keys(HEADS).filter((name) => runs.some((run) => run.train[name] || run.axle[name]));
  byId("axle-values").replaceChildren(...names.map((name) => {
    const row = element("tr", "");
    row.append(element("th", HEADS[name], { scope: "row" }), ...seen.map((run, k) => {
      const values = run.train[name] || (run.axle[name] && run.axle[name][run.axles.indexOf(axle)]);
      const text = samples[k] === null || !values ? "–" : shown(values[samples[k]], DECIMALS[name]);
      return element("td", text, { className: run.key === data.key ? "looked" : "" });
    }));
    return row;
  }));
}

function readout(at) {
  if (runs) return readRuns(at);
  const pairs = [
    ["Time", shown(data.time[at], 2, "s")], ["Distance", shown(data.distance[at], 1, "m")],
    ["Train", data.train.train_speed && shown(data.train.train_speed[at], 1, "km/h")],
    ["Reference", data.train.reference_speed && shown(data.train.reference_speed[at], 1, "km/h")],
    ["Deceleration", data.train.deceleration && shown(data.train.deceleration[at], 2, "m/s²")],
    ["Demand", data.train.brake_demand && shown(data.train.brake_demand[at], 0, "%")],
  ];
  byId("train-values").replaceChildren(...pairs.filter((pair) => pair[1]).flatMap(([name, text]) => [element("dt", name), element("dd", text)]));
  byId("axle-values").replaceChildren(...state.picked.map((axle) => {
    const row = element("tr", "");
    row.append(element("th", data.axles[axle], { scope: "row" }));
    for (const [name, , decimals] of COLUMNS) {
      const value = data.axle[name][axle][at];
      const valve = name === "dump_valve" ? VALVES[value] || "–" : null;
      row.append(element("td", valve || shown(value, decimals), { className: valve || "" }));
    }
    return row;
  }));
}

function rebuild() {
  rebuilding = true;
  charts.forEach(({ made }) => made.destroy());
  charts = [];
  for (const chart of CHARTS) {
    const place = byId(`chart-${chart.id}`);
    if (!place) continue;
    const empty = chart.valves && (!state.picked.length || !data.axle.dump_valve);
    place.parentElement.hidden = empty;
    if (empty) continue;
    const made = makeChart(chart, state, place, links);
    if (!made) continue;
    charts.push({ chart, made });
    keyOf(null, chart, chart.valves ? [] : linesOf(chart, { ...state, x: chart.rail ? railAxis() : state.x }));
  }
  byId("picked").textContent = `${state.picked.length} of ${data.axles.length}`;
  document.querySelectorAll("[data-axle]").forEach((button) => {
    const axle = Number(button.dataset.axle);
    button.setAttribute("aria-pressed", String(state.picked.includes(axle)));
    button.style.setProperty("--key", state.picked.includes(axle) ? axleColour(axle, state.picked) : "transparent");
  });
  readout(0);
  rebuilding = false;
}

function pick(axles) {
  state.picked = [...new Set(axles)].sort((a, b) => a - b);
  rebuild();
}

function zoomTo(min, max) {
  const first = state.x[0], last = state.x[state.x.length - 1];
  const width = Math.min(Math.max(max - min, (last - first) / 500), last - first);
  const left = Math.min(Math.max(min, first), last - width);
  const one = charts.find(({ chart }) => !chart.rail);
  if (one) one.made.setScale("x", { min: left, max: left + width });
}

function moveZoom(shift, factor) {
  const [min, max] = state.zoom || [state.x[0], state.x[state.x.length - 1]];
  const width = max - min, centre = (min + max) / 2 + shift * width;
  zoomTo(centre - (factor * width) / 2, centre + (factor * width) / 2);
}

function showHeads() {
  byId("axle-heads").replaceChildren(element("tr", ""));
  byId("axle-heads").firstChild.append(element("th", "axle", { scope: "col" }), ...COLUMNS.map((column) => element("th", column[1], { scope: "col" })));
}

// A button for each vehicle and each of its axles.
function showGroups() {
  byId("groups").replaceChildren();
  data.vehicles.forEach((name, vehicle) => {
    const mine = data.axles.map((_, k) => k).filter((k) => data.vehicle_of[k] === vehicle);
    const group = element("span", "", { className: "group" });
    const whole = element("button", name, { type: "button", title: `All axles of ${name}` });
    whole.addEventListener("click", () => {
      const all = mine.every((k) => state.picked.includes(k));
      pick(all ? state.picked.filter((k) => !mine.includes(k)) : state.picked.concat(mine));
    });
    group.append(whole, ...mine.map((k) => {
      const button = element("button", data.places[k], { type: "button", title: data.axles[k] });
      button.dataset.axle = k;
      button.addEventListener("click", () => pick(state.picked.includes(k) ? state.picked.filter((other) => other !== k) : state.picked.concat(k)));
      return button;
    }));
    byId("groups").append(group);
  });
}

// Boxes that show or hide the runs behind.
function showOthers() {
  const place = byId("others");
  place.hidden = !data.ghosts.length;
  place.querySelectorAll("label").forEach((label) => label.remove());
  data.ghosts.forEach((ghost) => {
    const label = element("label", "");
    const box = element("input", "", { type: "checkbox", checked: !state.hidden.has(ghost.key) });
    box.addEventListener("change", () => {
      if (box.checked) state.hidden.delete(ghost.key);
      else state.hidden.add(ghost.key);
      rebuild();
    });
    if (runs) label.append(box, " ", swatch(ghost), ` ${breakable(ghost.name)}`);
    else label.append(box, ` ${ghost.name}`);
    place.append(label);
  });
}

// Look at another run: it becomes what the others are compared with, and they lie behind it.
function turnTo(key) {
  const names = state.picked.map((axle) => data.axles[axle]);
  lookAt(key);
  state.picked = names.map((name) => data.axles.indexOf(name)).filter((axle) => axle >= 0);
  state.x = axisOver(state.over);
  document.querySelectorAll("[data-against]").forEach((part) => { part.hidden = Number(part.dataset.against) !== key; });
  showGroups();
  showOthers();
  rebuild();
}

function setUp() {
  byId("tools").hidden = false;
  byId("values").hidden = false;
  if (!runs) showHeads();
  document.querySelectorAll("input[name=over]").forEach((input) => input.addEventListener("change", () => {
    state.over = input.value;
    state.x = axisOver(state.over);
    state.zoom = null;
    rebuild();
  }));
  const on = (id, act) => byId(id).addEventListener("click", act);
  on("earlier", () => moveZoom(-0.25, 1));
  on("later", () => moveZoom(0.25, 1));
  on("closer", () => moveZoom(0, 0.5));
  on("wider", () => moveZoom(0, 2));
  on("whole", () => zoomTo(state.x[0], state.x[state.x.length - 1]));
  on("all", () => pick(data.axles.map((_, k) => k)));
  on("none", () => pick([]));
  on("worst", () => pick([data.worst]));
  document.querySelectorAll("input[name=looked]").forEach((input) => input.addEventListener("change", () => turnTo(Number(input.value))));
  showGroups();
  showOthers();
  document.querySelectorAll(".chart").forEach((place) => place.addEventListener("keydown", (event) => {
    const one = charts.find(({ chart }) => `chart-${chart.id}` === place.id);
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!one || !step) return;
    event.preventDefault();
    const u = one.made;
    const width = u.over.clientWidth;
    const left = Math.min(Math.max((u.cursor.left >= 0 ? u.cursor.left : 0) + step * (event.shiftKey ? 25 : 3), 0), width - 1);
    const box = u.over.getBoundingClientRect();
    u.over.dispatchEvent(new MouseEvent("mousemove", { clientX: box.left + left, clientY: box.top + box.height / 2, bubbles: true }));
  }));
  let width = 0;
  new ResizeObserver(() => {
    const now = document.querySelector(".charts").clientWidth;
    if (now === width || printing) return;
    width = now;
    charts.forEach(({ made }) => made.setSize({ width: Math.max(200, now), height: made.height }));
  }).observe(document.querySelector(".charts"));
  dark.addEventListener("change", rebuild);
  const closed = [...document.querySelectorAll("main section > details")];
  const print = (on) => {
    printing = on;
    closed.forEach((part) => { part.open = on; });
    rebuild();
  };
  window.addEventListener("beforeprint", () => print(true));
  window.addEventListener("afterprint", () => print(false));
}

setUp();
rebuild();
