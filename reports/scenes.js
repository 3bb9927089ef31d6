// Work-precision diagrams: error against time per simulated second, one line for each method.

const sweeps = numbers.records.flatMap(r => r.scenes ? [r.scenes] : []);
const ERRORS = {attitude: "attitude [rad]", position: "position [m]", angular_velocity: "angular velocity [rad/s]",
  linear_velocity: "linear velocity [m/s]"};
const METHOD_COLORS = [...LOOKS, {light: "#7f3c8d", dark: "#c58ad0"}];
const POINT_SHAPES = ["circle", "triangle", "rect", "rectRot", "star", "crossRot", "cross"];

const methodName = s => s.subject === "liecheck" ? s.integrator : `${s.subject} ${s.integrator}`;

// A colour and shape for each method, the same in all diagrams. Other simulators have dashed lines.
function methodLooks(sweep) {
  const looks = new Map(), peers = [["#6b6b6b", "#a8a8a8"], ["#000000", "#f2f2f2"], ["#8c564b", "#d09a8f"], ["#8f8f8f", "#7b7b7b"]].map(([light, dark]) => ({light, dark}));
  const subjects = unique(sweep.scenes.flatMap(s => s.series.map(x => x.subject))).filter(s => s !== "liecheck");
  for (const series of sweep.scenes.flatMap(s => s.series)) {
    const name = methodName(series);
    if (looks.has(name)) continue;
    const own = series.subject === "liecheck", i = [...looks.values()].filter(l => l.own === own).length;
    const color = own ? METHOD_COLORS[i % METHOD_COLORS.length] : peers[subjects.indexOf(series.subject) % peers.length];
    looks.set(name, {own, light: color.light, dark: color.dark, get color() { return isDark() ? this.dark : this.light; },
      shape: POINT_SHAPES[i % POINT_SHAPES.length], dash: own ? [] : [5, 3]});
  }
  return looks;
}

function workPrecision(scene, block, looks, withPeers) {
  const lines = scene.series.filter(s => withPeers || s.subject === "liecheck").map(series => ({series, points: series.points
    .filter(p => p.time_ns && !p.diverged && typeof p[block] === "number" && p[block] > 0)
    .map(p => ({x: p.time_ns.median, y: p[block], p, series}))})).filter(l => l.points.length);
  const all = lines.flatMap(l => l.points);
  if (!all.length) return null;
  const decade = (v, f) => 10 ** f(Math.log10(v));
  const low = decade(Math.min(...all.map(p => p.y)), Math.floor), high = decade(Math.min(10, Math.max(...all.map(p => p.y))), Math.ceil);
  const left = Math.min(...all.map(p => p.x)) / 1.5, right = Math.max(...all.map(p => p.x)) * 1.5;
  const best = lines.map(l => `${methodName(l.series)} down to ${short(Math.min(...l.points.map(p => p.y)))}`);
  const label = `${scene.scene}: error of ${block} against time, log-log. Smallest errors: ${best.join("; ")}.`;
  const tooltip = {callbacks: {title: i => i.length ? methodName(i[0].raw.series) : "", label: i => sceneTip(i.raw)}};
  return chartHolder(label, 12, tooltip, () => ({
    datasets: lines.map(({series, points}) => {
      const {color, shape, dash} = looks.get(methodName(series));
      return {label: methodName(series), data: points, borderColor: color, backgroundColor: dash.length ? PAPER() : color, borderDash: dash,
        borderWidth: 1.6, pointStyle: shape, pointRadius: 3.6, pointHoverRadius: 7, pointBorderWidth: 1.4, clip: 6};
    }),
    scales: {x: decadeAxis("time for each simulated second [ns]", left, right, 1),
      y: decadeAxis(`largest error of ${ERRORS[block]}`, low, high, Math.log10(high / low) > 9 ? 2 : 1, {afterFit: axis => { axis.width = 62; }})}}));
}

function sceneTip({p, series}) {
  const time = t => `${short(t.median)} [${short(t.low)}, ${short(t.high)}] ns for each simulated second`;
  const drift = (name, d) => d ? [`${name}: slope ${short(d.slope)} /s, oscillation ${short(d.oscillation)}`] : [];
  return [`${p.steps} steps${p.tolerance ? `, tolerance ${short(p.tolerance)}` : ""}${series.order ? `, order ${series.order}` : ""}`, time(p.time_ns),
    ...Object.entries(ERRORS).filter(([k]) => typeof p[k] === "number").map(([k, name]) => `${name}: ${short(p[k])}`),
    ...drift("energy", p.energy), ...drift("momentum", p.momentum)];
}

function sceneLegend(scenes, looks, withPeers) {
  const list = element("ul", {class: "legend", "aria-label": "Legend"});
  const present = new Set(scenes.flatMap(s => s.series.map(methodName)));
  for (const [name, {own, color, shape, dash}] of looks) {
    if (!present.has(name) || (!own && !withPeers)) continue;
    const stroke = {stroke: color, "stroke-width": 1.6};
    const svg = drawing(32, {d: "M0 6h32", ...stroke, "stroke-dasharray": dash.join(" ")},
      {d: MARKERS[shape], ...stroke, fill: own ? color : "none"});
    list.append(element("li", {}, svg, name));
  }
  return list;
}

document.querySelectorAll(".scene-charts").forEach((home, i) => {
  const sweep = sweeps[i], form = document.querySelectorAll(".scene-controls")[i], looks = methodLooks(sweep);
  const peers = element("input", {type: "checkbox", name: "peers"});
  peers.checked = true;
  form.append(choice("scene", "scene", [["", "all"], ...sweep.scenes.map(s => [s.scene, s.scene])], ""),
    choice("block", "error of", Object.entries(ERRORS), "attitude"));
  if ([...looks.values()].some(l => !l.own)) form.append(element("label", {}, peers, "other simulators"));
  const fill = () => {
    forget(home);
    const shown = sweep.scenes.filter(s => !form.elements.scene.value || s.scene === form.elements.scene.value);
    home.append(sceneLegend(shown, looks, peers.checked));
    const grid = element("div", {class: shown.length > 1 ? "pair" : "pair single"});
    for (const scene of shown) {
      const block = scene.series.some(s => s.points.some(p => p[form.elements.block.value] !== null)) ? form.elements.block.value : "position";
      const chart = workPrecision(scene, block, looks, peers.checked);
      grid.append(element("figure", {class: "plot"}, element("p", {class: "head"}, scene.scene),
        element("figcaption", {}, `${scene.what}. Reference: ${scene.truth}.`), chart ?? element("p", {}, "No run of this scene was timed.")));
    }
    home.append(grid);
  };
  whenChanged(form, fill);
  whenOpened(home, fill);
});
