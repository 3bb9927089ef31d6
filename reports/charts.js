// Charts: a pair (near 0, near pi) for each block of an operation, created when it comes into view.

// The colours of Okabe and Ito (2008) and four of Tol's, on white and on a dark page, each with a marker shape for readers
// of a black and white copy. A library has the same one everywhere: numbers.looks.
const LOOKS = [
  {light: "#0072b2", dark: "#5ab4ec", shape: "circle"}, {light: "#d55e00", dark: "#ff8a3d", shape: "triangle"},
  {light: "#009e73", dark: "#2fcf9f", shape: "rect"}, {light: "#cc79a7", dark: "#e79cc6", shape: "rectRot"},
  {light: "#882255", dark: "#d9629f", shape: "circle"}, {light: "#e69f00", dark: "#f3bd3f", shape: "star"},
  {light: "#56b4e9", dark: "#a9dcfa", shape: "cross"}, {light: "#000000", dark: "#f2f2f2", shape: "crossRot"},
  {light: "#44aa99", dark: "#7fd6c8", shape: "triangle"}, {light: "#999933", dark: "#d0d06a", shape: "rect"},
  {light: "#661100", dark: "#c9806f", shape: "rectRot"}];
const STATISTICS = {
  max_eps: {name: "max", dash: [], width: 2}, p99_eps: {name: "p99", dash: [7, 4], width: 1.3},
  median_eps: {name: "median", dash: [1.5, 3], width: 1.5}};
const KINDS = {
  theta: {head: "near 0", title: "rotation angle θ = ‖φ‖ ≥ 0 [rad]", reverse: false},
  pi_minus_theta: {head: "near π", title: "π − θ ≥ 0 [rad], θ grows to the right", reverse: true}};
const FONT = {size: 12, family: "system-ui, 'DejaVu Sans', Helvetica, sans-serif"};

// The colours of canvases follow the page: light, dark, or paper, which is light.
const darkMode = matchMedia("(prefers-color-scheme: dark)");
let onPaper = false;
const isDark = () => darkMode.matches && !onPaper;
const INK = () => isDark() ? "#e8e8e8" : "#1b1b1b", PAPER = () => isDark() ? "#15181c" : "#ffffff", FAINT = () => isDark() ? "#2c3138" : "#ececec",
  SLOT = () => isDark() ? "#262b32" : "#e9e9e9", SOFT = () => isDark() ? "#b4b4b4" : "#555";

function lookOf(subject) {
  const i = numbers.looks[subject] % LOOKS.length, {light, dark, shape} = LOOKS[i];
  return {color: isDark() ? dark : light, variable: `var(--look-${i})`, shape};
}

function short(value) {
  if (typeof value === "string") return value === "inf" ? "Inf" : "NaN";
  if (value === 0) return "0";
  return value >= 0.01 && value < 1e4 ? String(+value.toPrecision(3)) : value.toExponential(2).replace("e+", "e");
}

const count = (n, what) => n > 0 ? [`${n} ${what}`] : [];
const outcomes = row => [...count(row.not_finite, "NaN or Inf"), ...count(row.wrong_branch, "wrong branch"),
  ...count(row.refused, "refused"), ...count(row.not_repeatable, "not repeatable"),
  ...count(row.argument_written, "with an argument written to"), ...count(row.output_unwritten, "with unwritten output"),
  ...count(row.crashed, "crashed"), ...count(row.environment_changed, "with another rounding mode left behind"),
  ...count(row.printed, "with text on standard output"), ...count(row.outside_domain, "outside the domain"), ...count(row.ill_posed, "ill-posed"),
  ...count(row.unresolved, "unresolved"), ...count(row.unmeasured, "unmeasured")];

// As in the pictures of the first screen, a mark is filled if it is over budget.
const markFill = (c, color) => c.raw?.row?.status === "fail" ? color : PAPER();

// The datasets of one chart: a line for each subject and statistic, broken at every slot.
function datasets(rows, x, y, statistics) {
  const present = subjects.filter(s => rows.some(r => r.subject === s));
  const shift = (s, slot) => slot ? (present.indexOf(s) + .5 - present.length / 2) * x.slot * .8 / present.length : 0;
  const sets = [];
  for (const subject of present) {
    const {color, shape} = lookOf(subject);
    const own = rows.filter(r => r.subject === subject && r.count > 0)
      .sort((a, b) => x.position.get(a.band) - x.position.get(b.band));
    for (const statistic of statistics) {
      const main = statistic === "max_eps", data = [];
      const {dash, width} = STATISTICS[statistic];
      for (const row of own) {
        const at = x.position.get(row.band) + shift(subject, isSlot(row));
        const value = typeof row[statistic] === "number" ? y.place(row[statistic]) : NaN;
        if (isSlot(row)) data.push({x: at, y: NaN});
        data.push({x: at, y: value, row, statistic, radius: main ? 4.5 : isSlot(row) ? 2 : 0});
        if (isSlot(row)) data.push({x: at, y: NaN});
      }
      sets.push({label: subject, data, borderColor: color, backgroundColor: main ? c => markFill(c, color) : PAPER(), borderDash: dash,
        borderWidth: width, pointStyle: shape, pointRadius: c => c.raw?.radius ?? 0, pointBorderWidth: 1.5,
        pointHoverRadius: 7, order: main ? 1 : 2, clip: 8});
    }
    const broken = y.ceilings.flatMap(c => own.filter(c.holds).map(row => ({row, statistic: c.name, y: c.value,
      x: x.position.get(row.band) + shift(subject, isSlot(row))})));
    if (broken.length)
      sets.push({label: subject, data: broken, showLine: false, borderColor: color, backgroundColor: c => markFill(c, color),
        borderWidth: 2, pointStyle: shape, pointRadius: 6, pointHoverRadius: 8, order: 0, clip: 8});
  }
  return sets;
}

// Draws what Chart.js does not: the named grey slots, the budget, and a line below outcomes without an error.
const furniture = {
  id: "furniture",
  beforeDatasetsDraw(chart, _, {x, y, spans}) {
    const {ctx, chartArea: area, scales} = chart, px = v => scales.x.getPixelForValue(v);
    ctx.save();
    if (x.slots) {
      const a = px(x.min), b = px(x.min + x.slot * x.slots);
      ctx.fillStyle = SLOT();
      for (let i = 0; i < x.slots; ++i) {
        const l = px(x.min + x.slot * (i + .04)), r = px(x.min + x.slot * (i + .96));
        ctx.fillRect(Math.min(l, r), area.top, Math.abs(r - l), area.bottom - area.top);
      }
      ctx.strokeStyle = SOFT(); ctx.setLineDash([2, 3]);
      const edge = (b + px(x.low)) / 2;
      ctx.beginPath(); ctx.moveTo(edge, area.top); ctx.lineTo(edge, area.bottom); ctx.stroke();
      ctx.setLineDash([]); ctx.fillStyle = INK(); ctx.font = `11px ${FONT.family}`;
      ctx.textAlign = "right"; ctx.textBaseline = "middle";
      for (const {value, label} of x.ticks.filter(t => t.upright)) {
        ctx.save(); ctx.translate(px(value), area.bottom + 6); ctx.rotate(-Math.PI / 2);
        ctx.fillText(label, 0, 0); ctx.restore();
      }
    }
    if (y.ceilings.length) {
      ctx.strokeStyle = SOFT(); ctx.setLineDash([2, 3]);
      const h = scales.y.getPixelForValue(y.rim);
      ctx.beginPath(); ctx.moveTo(area.left, h); ctx.lineTo(area.right, h); ctx.stroke();
    }
    ctx.strokeStyle = INK(); ctx.lineWidth = 1.2; ctx.setLineDash([10, 3, 2, 3]);
    for (const s of spans) {
      const h = scales.y.getPixelForValue(Math.log10(s.budget));
      ctx.beginPath(); ctx.moveTo(px(s.from), h); ctx.lineTo(px(s.to), h); ctx.stroke();
    }
    ctx.restore();
  }};

// The ends of the horizontal budget line of each band that is judged by the rule forward.
function budgetSpans(rows, x) {
  const spans = new Map();
  for (const r of rows) {
    if (r.rule !== "forward" || !(r.budget > 0)) continue;
    const c = x.position.get(r.band);
    const [from, to] = isSlot(r) ? [c - x.slot / 2, c + x.slot / 2] : [Math.log10(r.low), Math.log10(r.high)];
    spans.set(`${r.budget} ${r.band}`, {budget: r.budget, from, to});
  }
  return [...spans.values()];
}
