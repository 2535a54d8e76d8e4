if (!data) return; // a run without traces has tables only

// Colours that colour-blind readers tell apart (Okabe and Ito 2008), lighter ones for the dark.

const dark = window.matchMedia("(prefers-color-scheme: dark)");
let printing = false;

const LIGHT = {
  ink: "#1b2227", soft: "#5a666e", grid: "#e6eaed", ghost: "#9aa5ad",
  many: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"], more: ["#6a3d9a", "#7a6a2f"],
  range: "rgba(0,114,178,0.18)", valves: ["#dde6ec", "#e69f00", "#b2182b"], measured: "#b2182b",
};
const DARK = {
  ink: "#e6eaed", soft: "#a3aeb6", grid: "#2a333b", ghost: "#6d7880",
  many: ["#56b4e9", "#f0823c", "#2fc99a", "#e39bc8", "#f0c24b", "#b5a8ff"], more: ["#ff9d9d", "#c5e17a"],
  range: "rgba(86,180,233,0.20)", valves: ["#2f3a43", "#d99000", "#ff5d5d"], measured: "#ff8f8a",
};
const look = () => (dark.matches && !printing ? DARK : LIGHT);

// A page that compares gives each run a colour; the same ones stand in page.css.
const runColours = () => look().many.concat(look().more);
const runColour = (run) => runColours()[run.key % runColours().length];
const runDash = (run) => (run.key < runColours().length ? [] : [6, 3]);
const swatch = (run) => Object.assign(document.createElement("i"), { className: `swatch s${run.key % runColours().length}` });
const breakable = (name) => name.replaceAll("_", "_\u200b");

// Few axles: a colour each. Many: the colour of their vehicle.
function axleColour(axle, picked) {
  if (runs) return runColour(data);
  const many = look().many;
  if (picked.length <= many.length) return many[picked.indexOf(axle) % many.length];
  return vehicleColour(data.vehicle_of[axle]);
}

function vehicleColour(vehicle) {
  const many = look().many;
  if (data.vehicles.length <= many.length) return many[vehicle];
  const lightness = look() === DARK ? 70 : 40;
  return `hsl(${200 + (250 * vehicle) / data.vehicles.length} 70% ${lightness}%)`;
}

const shortName = (axle) => `${data.vehicles[data.vehicle_of[axle]]}-${data.places[axle]}`;

const VALVES = ["FILL", "HOLD", "VENT"];

function shown(value, decimals, unit) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text) + (unit ? " " + unit : "");
}
