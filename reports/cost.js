// Error against time: two charts for each operation, one of float and double and one of every precision.

const costs = numbers.records.flatMap(r => r.cost ? [r.cost] : []);
const SCALARS = {float: 3.6, double: 5.5, float128: 7, "double-double": 7, digits50: 7, digits100: 7};  // the radius of a mark
const NATIVE = ["float", "double"];
const DOUBLE_EPS = 2 ** -52;

// The points of one operation: x [ns], y [eps of double].
function costPoints(rows, kind) {
  return rows.filter(r => r.error !== null && !r.subject.includes("@") && r.sets.at(-1)[kind]).map(row => {
    const all = row.sets.at(-1);
    return {row, all, x: all[kind].ns, error: typeof row.error === "number" ? row.error : Infinity,
      dominated: row["dominated_" + kind]};
  });
}

const costName = row => `${row.subject} ${row.scalar}`;
const costDigits = error => error > 0 ? `${(-Math.log10(error)).toFixed(1)} digits` : "exact";

// Draws names next to the points, undominated points first. A name that would overlap another is left out.
const costNames = {
  id: "costNames",
  afterDatasetsDraw(chart) {
    const {ctx, chartArea: area, scales} = chart, taken = [];
    const points = chart.data.datasets.flatMap(d => d.named ? d.data : []);
    const at = p => [scales.x.getPixelForValue(p.x), scales.y.getPixelForValue(p.y)];
    for (const p of points) { const [x, y] = at(p); taken.push([x - 5, y - 5, x + 5, y + 5]); }
    ctx.save(); ctx.textBaseline = "middle"; ctx.textAlign = "left";
    for (const p of [...points].sort((a, b) => Boolean(a.dominated) - Boolean(b.dominated))) {
      ctx.font = `${p.dominated ? 400 : 600} 11px ${FONT.family}`; ctx.fillStyle = p.dominated ? SOFT() : INK();
      const text = costName(p.row), width = ctx.measureText(text).width, [x, y] = at(p);
      for (const [left, top] of [[x + 8, y - 7], [x - width - 8, y - 7], [x - width / 2, y - 21], [x - width / 2, y + 8], [x + 8, y + 4], [x - width - 8, y + 4]]) {
        const box = [left, top, left + width, top + 13];
        if (box[0] < area.left || box[2] > area.right || box[1] < area.top || box[3] > area.bottom) continue;
        if (taken.some(t => t[0] < box[2] && box[0] < t[2] && t[1] < box[3] && box[1] < t[3])) continue;
        ctx.lineWidth = 4; ctx.strokeStyle = PAPER(); ctx.strokeText(text, left, top + 7);
        ctx.fillText(text, left, top + 7); taken.push(box);
        break;
      }
    }
    ctx.restore();
  }};

function costPlot(head, points, kind, names) {
  const seen = points.filter(p => Number.isFinite(p.error) && p.error > 0).map(p => p.error / DOUBLE_EPS);
  const room = 10 ** (1.2 + .06 * Math.log10(Math.max(10, ...seen) / Math.min(1, ...seen)));
  const least = Math.min(1, ...seen) / room, most = Math.max(10, ...seen) * room;
  for (const p of points) p.y = p.error === 0 ? least * 3 : Number.isFinite(p.error) ? p.error / DOUBLE_EPS : most / 3;
  const front = points.filter(p => !p.dominated).sort((a, b) => a.x - b.x);
  const best = front.filter((p, i) => front.slice(0, i).every(q => q.y > p.y));  // if times overlap, neither dominates
  const xs = points.map(p => p.x), low = Math.min(...xs) / 1.8, high = Math.max(...xs) * 2.6;
  const stairs = [];
  best.forEach((p, i) => { stairs.push({x: p.x, y: i ? best[i - 1].y : most}, {x: p.x, y: p.y}); });
  if (best.length) stairs.push({x: high, y: best.at(-1).y});
  const label = `Error against ${kind}, ${head}. Not dominated: ` + best.map(p =>
    `${costName(p.row)}, ${short(p.x)} ns, ${costDigits(p.error)}`).join("; ") + ".";
  const span = Math.log10(most / least), step = [1, 2, 5, 10, 20].find(s => span / s <= 9) ?? 50;
  const mantissas = high / low > 100 ? [1] : high / low > 12 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 7];
  const marks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); ++e)
    marks.push(...mantissas.map(m => m * 10 ** e).filter(v => v >= low && v <= high));
  const tooltip = {filter: item => Boolean(item.raw.row), callbacks: {
    title: items => items.length ? costName(items[0].raw.row) : "", label: item => costTip(item.raw)}};
  const holder = chartHolder(label, 10, tooltip, () => ({
    plugins: [costNames],
    datasets: [
      {named: true, showLine: false, data: points, order: 0, pointRadius: c => SCALARS[c.raw?.row.scalar] ?? 5.5, pointHoverRadius: 8, borderWidth: 2, pointBorderWidth: 2,
        pointStyle: c => c.raw ? lookOf(c.raw.row.subject).shape : "circle", borderColor: c => c.raw ? lookOf(c.raw.row.subject).color : INK(),
        backgroundColor: c => !c.raw || c.raw.dominated ? PAPER() : lookOf(c.raw.row.subject).color},
      {data: stairs, order: 1, borderColor: INK(), borderWidth: 1.5, borderDash: [6, 3], pointRadius: 0, pointHoverRadius: 0, pointHitRadius: 0}],
    scales: {
      x: chartAxis(`${kind} of a call [ns]`, {autoSkip: true,
        callback: v => v >= 1e5 || v < .1 ? power(Math.round(Math.log10(v))) : String(+v.toPrecision(2))},
        {type: "logarithmic", min: low, max: high, afterBuildTicks: axis => setTicks(axis, marks)}),
      y: decadeAxis("largest error found [eps of double]", least, most, step, {afterFit: axis => { axis.width = 62; }})}}));
  return element("div", {class: "plot"}, element("p", {class: "head"}, head), holder);
}

function costTip({row, all, error, dominated}) {
  const time = s => s ? `${short(s.ns)} ns = ${short(s.ratio)} [${short(s.low)}, ${short(s.high)}] references` : "not timed";
  const blocks = all.blocks.map(b => `${b.block}: max ${short(b.max_eps)}, p99 ${short(b.p99_eps)}, median ${short(b.median_eps)} eps of ${row.scalar}`);
  return [`latency ${time(all.latency)}, throughput ${time(all.throughput)}`,
    Number.isFinite(error) ? `${costDigits(error)} in the ${row.worst_block}; a lower bound of the error` : "a case without a result", ...blocks,
    dominated ? `dominated by ${dominated}` : "on the Pareto front"];
}

function costLegend(points, names) {
  const list = element("ul", {class: "legend", "aria-label": "Legend"});
  const mark = s => drawing(14, {d: MARKERS[lookOf(s).shape], stroke: lookOf(s).color, "stroke-width": 1.8, fill: lookOf(s).color});
  for (const s of names.filter(n => points.some(p => p.row.subject === n))) list.append(element("li", {}, mark(s), s));
  const sizes = [["float", "small: float"], ["double", "middle: double"]].filter(([s]) => points.some(p => p.row.scalar === s));
  if (points.some(p => !NATIVE.includes(p.row.scalar))) sizes.push(["wide", "large: wider scalars"]);
  if (sizes.length > 1) list.append(element("li", {}, sizes.map(([, words]) => words).join(", ")));
  list.append(element("li", {}, "filled: on the Pareto front; hollow: dominated; dashed line: the Pareto front"));
  return list;
}

function fillCost(cost, home, kind, operation) {
  forget(home);
  const names = unique(cost.rows.map(r => r.subject)).filter(s => s !== "call" && !s.includes("@"));
  for (const o of unique(cost.rows.map(r => r.operation)).filter(o => !operation || o === operation)) {
    const points = costPoints(cost.rows.filter(r => r.operation === o), kind);
    if (!points.length) continue;
    const native = points.filter(p => NATIVE.includes(p.row.scalar)), wide = native.length < points.length;
    const pair = element("div", {class: wide && native.length ? "pair" : "pair single"});
    if (native.length) pair.append(costPlot("float and double", native, kind, names));
    if (wide) pair.append(costPlot("every precision", points.map(p => ({...p})), kind, names));
    home.append(element("figure", {}, element("h3", {}, o), costLegend(points, names), pair));
  }
}

document.querySelectorAll(".cost-charts").forEach((home, i) => {
  const form = document.querySelectorAll(".cost-controls")[i], cost = costs[i];
  const names = unique(cost.rows.map(r => r.operation));
  const first = names.includes("exp6") ? "exp6" : names[0];
  form.append(choice("kind", "time", [["latency", "latency"], ["throughput", "throughput"]], "latency"),
    choice("operation", "operation", [["", "all"], ...names.map(o => [o, o])], first));
  const fill = () => fillCost(cost, home, form.elements.kind.value, form.elements.operation.value);
  whenChanged(form, fill);
  whenOpened(home, fill);
});
