// Work-precision diagrams: error against time per simulated second, one line for each method.

const sweeps = numbers.records.flatMap(r => r.scenes ? [r.scenes] : []);
const ERRORS = {attitude: "attitude [rad]", position: "position [m]", angular_velocity: "angular velocity [rad/s]",
  linear_velocity: "linear velocity [m/s]"};
const METHOD_COLORS = [...COST_COLORS, "#7f3c8d"];
const POINT_SHAPES = ["circle", "triangle", "rect", "rectRot", "star", "crossRot", "cross"];

const methodName = s => s.subject === "liecheck" ? s.integrator : `${s.subject} ${s.integrator}`;

// A colour and shape for each method, the same in all diagrams. Other simulators have dashed lines.
function methodLooks(sweep) {
  const looks = new Map(), peers = ["#6b6b6b", "#000000", "#8c564b", "#a9a9a9"];
  const subjects = unique(sweep.scenes.flatMap(s => s.series.map(x => x.subject))).filter(s => s !== "liecheck");
  for (const series of sweep.scenes.flatMap(s => s.series)) {
    const name = methodName(series);
    if (looks.has(name)) continue;
    const own = series.subject === "liecheck", i = [...looks.values()].filter(l => l.own === own).length;
    looks.set(name, {own, color: own ? METHOD_COLORS[i % METHOD_COLORS.length] : peers[subjects.indexOf(series.subject) % peers.length],
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
  const canvas = element("canvas", {role: "img", "aria-label": `${scene.scene}: error of ${block} against time, log-log. Smallest errors: ${best.join("; ")}.`});
  const holder = element("div", {class: "canvas"}, canvas);
  const axis = (title, min, max, step) => ({type: "logarithmic", min, max, grid: {color: "#ececec"}, title: {display: true, text: title, color: INK, font: FONT},
    afterBuildTicks: a => { a.ticks = []; for (let e = Math.ceil(Math.log10(min)); e <= Math.log10(max) + 1e-9; ++e) if (e % step === 0) a.ticks.push({value: 10 ** e}); },
    ticks: {color: INK, font: FONT, autoSkip: false, maxRotation: 0, callback: v => power(Math.round(Math.log10(v)))}});
  waiting.set(holder, () => new Chart(canvas, {
    type: "line",
    data: {datasets: lines.map(({series, points}) => {
      const {color, shape, dash} = looks.get(methodName(series));
      return {label: methodName(series), data: points, borderColor: color, backgroundColor: dash.length ? "#fff" : color, borderDash: dash,
        borderWidth: 1.6, pointStyle: shape, pointRadius: 3.6, pointHoverRadius: 7, pointBorderWidth: 1.4, clip: 6};
    })},
    options: {
      animation: false, maintainAspectRatio: false, devicePixelRatio: Math.max(2, devicePixelRatio), layout: {padding: {right: 12, top: 4}},
      interaction: {mode: "nearest", intersect: false},
      scales: {x: axis("time for each simulated second [ns]", left, right, 1),
        y: {...axis(`largest error of ${ERRORS[block]}`, low, high, Math.log10(high / low) > 9 ? 2 : 1), afterFit: a => { a.width = 62; }}},
      plugins: {legend: {display: false}, tooltip: {callbacks: {title: i => i.length ? methodName(i[0].raw.series) : "", label: i => sceneTip(i.raw)}}}}}));
  watcher.observe(holder);
  return holder;
}

function sceneTip({p, series}) {
  const time = t => `${short(t.median)} [${short(t.low)}, ${short(t.high)}] ns for each simulated second`;
  const drift = (name, d) => d ? [`${name}: slope ${short(d.slope)} /s, oscillation ${short(d.oscillation)}`] : [];
  return [`${p.steps} steps${p.tolerance ? `, tolerance ${short(p.tolerance)}` : ""}${series.order ? `, order ${series.order}` : ""}`, time(p.time_ns),
    ...Object.entries(ERRORS).filter(([k]) => typeof p[k] === "number").map(([k, name]) => `${name}: ${short(p[k])}`),
    ...drift("energy", p.energy), ...drift("momentum", p.momentum)];
}

function sceneLegend(scenes, looks, withPeers) {
  const list = element("ul", {class: "legend", "aria-label": "Legend"}), ns = "http://www.w3.org/2000/svg";
  const marks = {circle: "M12 6a4 4 0 1 0 8 0a4 4 0 1 0-8 0", triangle: "M16 2l5 8h-10z", rect: "M12 2h8v8h-8z", rectRot: "M16 1l5 5l-5 5l-5-5z",
    crossRot: "M12 2l8 8m0-8l-8 8", cross: "M16 1v10m-5-5h10", star: "M12 2l8 8m0-8l-8 8M16 1v10m-5-5h10"};
  const present = new Set(scenes.flatMap(s => s.series.map(methodName)));
  for (const [name, {own, color, shape, dash}] of looks) {
    if (!present.has(name) || (!own && !withPeers)) continue;
    const svg = document.createElementNS(ns, "svg");
    for (const [k, v] of Object.entries({width: 32, height: 12, "aria-hidden": "true"})) svg.setAttribute(k, v);
    for (const [d, extra] of [["M0 6h32", {"stroke-dasharray": dash.join(" ")}], [marks[shape], {fill: own ? color : "#fff"}]]) {
      const path = document.createElementNS(ns, "path");
      for (const [k, v] of Object.entries({d, stroke: color, "stroke-width": 1.6, ...extra})) path.setAttribute(k, v);
      svg.append(path);
    }
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
      grid.append(element("figure", {class: "plot"}, element("h4", {}, scene.scene),
        element("figcaption", {}, `${scene.what}. Reference: ${scene.truth}.`), chart ?? element("p", {}, "No run of this scene was timed.")));
    }
    home.append(grid);
  };
  form.addEventListener("submit", event => event.preventDefault());
  form.addEventListener("change", fill);
  fill();
});
