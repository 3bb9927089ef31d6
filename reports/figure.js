// A figure: title, definition, legend, and its charts.

const element = (name, attributes = {}, ...children) => {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
};

// Calls fill() when the folded section around an element is opened for the first time.
function whenOpened(home, fill) {
  const fold = home.closest("section > details");
  let filled = false;
  const open = () => { if (fold.open && !filled) { filled = true; fill(); } };
  fold.addEventListener("toggle", open);
  open();
}

const waiting = new Map();  // canvas holder -> function that creates its chart
const watcher = new IntersectionObserver(entries => {
  for (const e of entries) if (e.isIntersecting) draw(e.target);
}, {rootMargin: "600px"});

function draw(holder) {
  const make = waiting.get(holder);
  if (!make) return;
  waiting.delete(holder);
  watcher.unobserve(holder);
  make();
}

const redraw = new Map();  // canvas holder -> function that creates its chart again
function redrawAll() {
  for (const [holder, make] of redraw) {
    if (!holder.isConnected) { redraw.delete(holder); continue; }
    if (waiting.has(holder)) continue;
    Chart.getChart(holder.firstElementChild)?.destroy();
    make();
  }
}
darkMode.addEventListener("change", redrawAll);

// Before printing, draws all open charts in dark ink at their printed size, because the browser only scales a canvas.
// Folded sections are not printed; report.csv has their rows.
function toPaper() {
  onPaper = true;
  [...waiting.keys()].filter(holder => !holder.closest("details:not([open])")).forEach(draw);
  redrawAll();
  for (const holder of document.querySelectorAll(".canvas"))
    Chart.getChart(holder.firstElementChild)?.resize(holder.closest(".single") ? 700 : 345, 300);
}
function fromPaper() {
  onPaper = false;
  redrawAll();
  for (const holder of document.querySelectorAll(".canvas")) Chart.getChart(holder.firstElementChild)?.resize();
}

function forget(container) {  // destroys the charts of a container, before it is filled again
  for (const holder of container.querySelectorAll(".canvas")) {
    watcher.unobserve(holder);
    waiting.delete(holder);
    Chart.getChart(holder.firstElementChild)?.destroy();
  }
  container.replaceChildren();
}

// Returns the element that holds a chart. The chart is created when this element comes near the view. make()
// returns its datasets and scales; `right` is the padding [px], `tooltip` the options of the tooltip.
function chartHolder(label, right, tooltip, make) {
  const canvas = element("canvas", {role: "img", "aria-label": label});
  const holder = element("div", {class: "canvas"}, canvas);
  const create = () => {
    const {datasets, scales, plugins = [], pluginOptions = {}} = make();
    return new Chart(canvas, {type: "line", data: {datasets}, plugins, options: {
      animation: false, maintainAspectRatio: false, devicePixelRatio: Math.max(2, devicePixelRatio),
      layout: {padding: {right, top: 4}}, interaction: {mode: "nearest", intersect: false}, scales,
      plugins: {legend: {display: false}, tooltip, ...pluginOptions}}});
  };
  waiting.set(holder, create);
  redraw.set(holder, create);
  watcher.observe(holder);
  return holder;
}

const chartAxis = (title, ticks, rest) => ({grid: {color: FAINT()}, title: {display: true, text: title, color: INK(), font: FONT},
  ticks: {color: INK(), font: FONT, autoSkip: false, maxRotation: 0, ...ticks}, ...rest});
const setTicks = (axis, values) => { axis.ticks = values.map(value => ({value})); };

// The powers of ten in [min, max] whose exponent is a multiple of `step`.
function powersOfTen(min, max, step) {
  const all = [];
  for (let e = Math.ceil(Math.log10(min)); e <= Math.log10(max) + 1e-9; ++e) if (e % step === 0) all.push(10 ** e);
  return all;
}
const decadeAxis = (title, min, max, step, rest = {}) => chartAxis(title, {callback: v => power(Math.round(Math.log10(v)))},
  {type: "logarithmic", min, max, afterBuildTicks: axis => setTicks(axis, powersOfTen(min, max, step)), ...rest});

// The markers of points in legends, as SVG paths around (16, 6).
const MARKERS = {circle: "M12 6a4 4 0 1 0 8 0a4 4 0 1 0-8 0", triangle: "M16 2l5 8h-10z", rect: "M12 2h8v8h-8z",
  rectRot: "M16 1l5 5l-5 5l-5-5z", crossRot: "M12 2l8 8m0-8l-8 8", cross: "M16 1v10m-5-5h10",
  star: "M12 2l8 8m0-8l-8 8M16 1v10m-5-5h10"};

// An SVG of paths, which are given by their attributes. It shows `width` pixels around x = 16.
function drawing(width, ...paths) {
  const made = (name, attributes) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    return node;
  };
  const svg = made("svg", {width, height: 12, viewBox: `${16 - width / 2} 0 ${width} 12`, "aria-hidden": "true"});
  svg.append(...paths.map(attributes => made("path", attributes)));
  return svg;
}

function swatch(subject) {
  const {variable, shape} = lookOf(subject);
  return drawing(32, {d: "M0 6h32" + MARKERS[shape], style: `stroke: ${variable}; fill: ${variable}`, "stroke-width": 1.8});
}

function legend(rows, statistics) {
  const list = element("ul", {class: "legend", "aria-label": "Legend"});
  for (const s of subjects.filter(s => rows.some(r => r.subject === s)))
    list.append(element("li", {}, swatch(s), s));
  list.append(element("li", {}, statistics.map(s => ({max_eps: "max found: solid", p99_eps: "p99: dashed", median_eps: "median: dotted"})[s]).concat("filled mark: over budget").join(", ")));
  const above = OUTCOMES.filter(o => rows.some(o.holds)).map(o => o.name), largest = 10 ** ceilingOf(rows);
  if (rows.some(r => r.max_eps > largest)) above.unshift("worst inputs far above all others");
  if (above.length) list.append(element("li", {}, `at the top edge: ${above.join("; ")}`));
  return list;
}

// A description of a chart for screen readers.
function spoken(rows, head) {
  const parts = subjects.flatMap(s => {
    const own = rows.filter(r => r.subject === s && r.count > 0);
    if (!own.length) return [];
    const worst = own.reduce((a, b) => notFinite(b) || (!notFinite(a) && b.max_eps > a.max_eps) ? b : a);
    return [`${s} at most ${notFinite(worst) ? "NaN or Inf" : short(worst.max_eps) + " eps"}, in ${worst.band}`];
  });
  return `Error in eps ${head}, log-log. Largest found: ${parts.join("; ")}.`;
}

function plot(rows, kind, y, statistics, foot) {
  const {head, title, reverse} = KINDS[kind], x = horizontalAxis(rows);
  for (const t of x.ticks) t.upright = t.label.length > 3 && rows.some(r => isSlot(r) && slotName(r.band) === t.label);
  const ticks = source => ({minRotation: 0, callback: v => source.find(t => t.value === v && !t.upright)?.label ?? ""});
  const tooltip = {callbacks: {title: items => items.length ? `${items[0].raw.row.band}` : "", label: item => tip(item.raw)}};
  const holder = chartHolder(spoken(rows, head), 14, tooltip, () => ({
    datasets: datasets(rows, x, y, statistics), plugins: [furniture], pluginOptions: {furniture: {x, y, spans: budgetSpans(rows, x)}},
    scales: {
      x: chartAxis(title, ticks(x.ticks), {type: "linear", reverse, min: x.min, max: x.max, afterFit: axis => { axis.height = foot; },
        afterBuildTicks: axis => setTicks(axis, roomy(x.ticks, x.max - x.min, axis.chart.width - 90).map(t => t.value))}),
      y: chartAxis("error [eps]", ticks(y.ticks), {type: "linear", min: y.min, max: y.max, afterFit: axis => { axis.width = 66; },
        afterBuildTicks: axis => setTicks(axis, y.ticks.map(t => t.value))})}}));
  const budgets = unique(budgetSpans(rows, x).map(s => s.budget)).sort((a, b) => a - b);  // in the heading, where they cover no data
  return element("div", {class: "plot"}, element("p", {class: "head"}, head, element("span", {class: "budget"},
    budgets.length ? `dash-dot line: budget ${budgets.map(short).join(", ")} eps` : "")), holder);
}

function tip({row, statistic}) {
  const values = Object.entries(STATISTICS).map(([k, s]) => `${k === statistic ? "▸ " : ""}${s.name} ${short(row[k])}`);
  return [`${row.subject}: ${values.join(", ")} eps`, `${row.count} cases; the maximum is a lower bound`,
    `rule ${row.rule}: ${row.rule === "excess" ? `excess ${short(row.max_excess)}, ` : ""}budget ${short(row.budget)}, ${row.status}`,
    ...outcomes(row)];
}

// The charts of rows of one scalar and one block of an operation, with one vertical range.
function charts(rows, statistics, kinds = ["theta", "pi_minus_theta"]) {
  const shown = kinds.map(k => [k, rows.filter(r => r.axis === k)]).filter(([, own]) => own.some(r => r.count > 0));
  const pair = element("div", {class: shown.length > 1 ? "pair" : "pair single"});
  const y = verticalAxis(shown.flatMap(([, own]) => own), statistics);
  const foot = some => {  // height of the axis, with room for the names of slots
    const longest = Math.max(0, ...some.filter(isSlot).map(r => slotName(r.band).length));
    return longest > 3 ? 34 + 5.8 * Math.min(longest, 18) : 50;
  };
  const stacked = matchMedia("(max-width: 760px)").matches;  // side by side, both charts get the same height
  for (const [kind, own] of shown)
    pair.append(plot(own, kind, y, statistics, foot(stacked ? own : shown.flatMap(([, some]) => some))));
  return pair;
}
