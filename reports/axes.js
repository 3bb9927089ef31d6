// Axes. A logarithmic axis has no place for 0, subnormals or bands of hundreds of decades. Each such band
// gets a named column, a "slot". Chart.js gets a linear axis of log10, with the slots at one end.

const WIDE = 2.5;  // a band of more decades is a slot

const superscript = n => String(n).replace(/./g, c => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻");
const power = e => e === 0 ? "1" : "10" + superscript(e);

function isSlot(row) {
  return !(row.low > 0) || !(row.high > 0) || Math.log10(row.high) - Math.log10(row.low) > WIDE;
}

function slotName(band) {
  return band.replace(/^(theta|pi-theta) (?=\d)/, "").replace("theta^2", "θ²").replace("theta", "θ")
    .replace(/^pi$/, "π").replace(/1e(-?\d+)/g, (_, e) => power(+e)).replace("..", "…");
}

// The horizontal axis for rows of one axis kind: the position of each band, the ticks, and the ends of the axis.
// Slots come before the decades. Near pi the axis is drawn reversed, so the slots are on the right.
function horizontalAxis(rows) {
  const bands = new Map();
  for (const row of rows) if (!bands.has(row.band)) bands.set(row.band, row);
  const decades = [...bands.values()].filter(r => !isSlot(r));
  const slots = [...bands.values()].filter(isSlot).sort((a, b) => a.high - b.high || a.low - b.low);
  const low = Math.round(Math.min(0, ...decades.map(r => Math.log10(r.low))));
  const high = Math.ceil(Math.max(...decades.map(r => Math.log10(r.high)), low + 1));
  const position = new Map(), ticks = [];
  for (const r of decades) position.set(r.band, (Math.log10(r.low) + Math.log10(r.high)) / 2);
  const slot = Math.max(1.7, .075 * (high - low));  // width of a slot in decades: room for an upright name on a phone
  const first = low - 1.5 - slot * slots.length;
  slots.forEach((r, i) => {
    const x = first + slot * (i + .5);
    position.set(r.band, x);
    ticks.push({value: x, label: slotName(r.band)});
  });
  for (let e = high; e >= low; --e) ticks.push({value: e, label: power(e), decade: high - e});
  ticks.sort((a, b) => a.value - b.value);
  return {position, ticks, slots: slots.length, slot, low, min: slots.length ? first : low, max: high};
}

// The vertical axis for a set of rows: log10 of the error in eps. Below it are one level for all errors below
// 10^SMALLEST and one for 0. Above it are levels ("ceilings") for a wrong branch and for NaN or Inf.
const SMALLEST = -3;  // log10; all smaller errors share one tick, above that of 0

function verticalAxis(rows, statistics) {
  const largest = ceilingOf(rows);
  const values = rows.flatMap(r => statistics.map(s => r[s])).filter(v => typeof v === "number" && !(v > 10 ** largest));
  const logs = values.filter(v => v > 0).map(Math.log10).filter(v => v >= SMALLEST);
  logs.push(...rows.filter(r => r.rule === "forward" && r.budget > 0).map(r => Math.log10(r.budget)));
  const least = Math.floor(Math.min(0, ...logs)), most = Math.ceil(Math.max(1, ...logs) + .2);
  const gap = Math.max(1, .11 * (most - least));  // keeps the labels of these levels from overlapping others
  const below = values.some(v => v > 0 && Math.log10(v) < SMALLEST);
  const tiny = below ? least - gap : least;
  const floor = values.some(v => v === 0) ? tiny - gap : tiny;
  const far = {name: `> ${power(largest)}`, lines: [`> ${power(largest)}`], holds: r => r.max_eps > 10 ** largest && !notFinite(r)};
  const seen = [far, ...OUTCOMES].filter(o => rows.some(o.holds));
  const ticks = [];
  if (below) ticks.push({value: tiny, label: "< 10⁻³"});
  if (floor < tiny) ticks.push({value: floor, label: "0"});
  const step = Math.ceil((most - least) / 9);
  for (let e = least; e <= most; e += step) ticks.push({value: e, label: power(e)});
  const ceilings = seen.map((o, i) => ({...o, value: most + (2 + 3 * i) * gap}));
  for (const c of ceilings) ticks.push({value: c.value, label: c.lines});
  const place = v => v > 10 ** largest ? NaN : v === 0 ? floor : Math.log10(v) >= SMALLEST ? Math.log10(v) : tiny;
  const top = ceilings.length ? ceilings.at(-1).value + 1.3 * gap : most + .4 * gap;
  return {ticks, ceilings, rim: most + .6 * gap, place, min: floor - .4 * gap, max: top};
}

// The ticks that fit into `width` pixels: all slots, and each (or each 2nd, 5th, …) decade not near a slot.
function roomy(ticks, span, width) {
  const decade = width / span;
  const step = [1, 2, 5, 10, 20, 50].find(s => s * decade >= 38) ?? 100;
  const slots = ticks.filter(t => t.decade === undefined);
  const clear = t => slots.every(s => Math.abs(s.value - t.value) * decade >= 26);
  return ticks.filter(t => t.decade === undefined || (t.decade % step === 0 && clear(t)));
}

// The top of the axis as log10: a single freak input, far above what 99 of 100 cases show, is drawn at the top edge
// and does not press all other lines together.
function ceilingOf(rows) {
  const usual = rows.flatMap(r => [r.p99_eps, r.rule === "forward" ? r.budget : 1]).filter(v => typeof v === "number" && v < 1e18);
  return Math.ceil(Math.log10(Math.max(10, ...usual))) + 2;
}

const notFinite = row => row.not_finite > 0 || typeof row.max_eps === "string";
// Outcomes without an error in eps are drawn on levels of their own above the axis.
const OUTCOMES = [
  {name: "wrong branch", lines: ["wrong", "branch"], holds: row => row.wrong_branch > 0},
  {name: "NaN or Inf", lines: ["NaN", "or Inf"], holds: notFinite}];
