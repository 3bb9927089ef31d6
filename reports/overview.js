// What the scripts know of the regions of the angle and of the digits that a row loses. Both are decided in regions.cpp;
// the first screen is written there, too.

const REGIONS = [{key: "zero", name: "θ < 10⁻⁸"}, {key: "small", name: "θ 10⁻⁸…⁠10⁻²"}, {key: "moderate", name: "θ 10⁻²…⁠π⁠−⁠1"},
  {key: "near-pi", name: "π − θ 10⁻⁸…⁠1"}, {key: "pi", name: "π − θ < 10⁻⁸"}, {key: "beyond", name: "θ > π"}, {key: "all", name: "without angle"}];
const regionOf = row => REGIONS.find(r => r.key === row.region);

const subjectOf = row => find("subjects", s => s.name === row.subject && s.scalar === row.scalar);
const epsOf = row => subjectOf(row)?.eps ?? 2 ** -52;
const judgedError = row => row.rule === "excess" ? row.max_excess : row.max_eps;
const digitsOfScalar = row => -Math.log10(epsOf(row));
const digitsKept = row => digitsOfScalar(row) - row.lost;
const severity = row => (row.status === "fail" ? 100 : row.status === "expected" ? 50 : 0) + row.lost + (notFinite(row) ? 3 : 0) + (row.outcome === "wrong branch" ? 2 : 0);
// Of the rows of one cell and region, page_numbers() marks the worst; it alone has its input on the page.
const worstOf = rows => rows.find(r => r.worst?.shown && rows.every(o => ["region", "subject", "operation", "scalar"]
  .every(name => o[name] === r[name]))) ?? rows.reduce((a, b) => severity(b) > severity(a) ? b : a);
function errorWords(row) {
  if (row.outcome) return row.outcome === "bad call" ? outcomes(row).join(", ") : row.outcome;
  return `${row.lost.toFixed(1)} of ${digitsOfScalar(row).toFixed(1)} digits lost`;
}

const anchorOf = (id, text) => element("a", {class: "anchor", href: `#${id}`, "aria-label": `Link to: ${text}`}, "#");
