// The page: reads the inlined figures, builds the controls and fills the sections.

// The inverse of packed() in html.hpp.
function unpacked(x) {
  if (Array.isArray(x)) return x.map(unpacked);
  if (x === null || typeof x !== "object") return x;
  if (x["*words"]) return x["*at"].map(place => x["*words"][place]);
  if (!x["*keys"]) return Object.fromEntries(Object.entries(x).map(([key, value]) => [key, unpacked(value)]));
  const columns = x["*columns"].map(unpacked);
  return columns[0].map((_, row) => Object.fromEntries(x["*keys"].map((key, i) => [key, columns[i][row]])));
}
const numbers = unpacked(JSON.parse(document.getElementById("numbers").textContent));
const results = numbers.results;
const unique = values => [...new Set(values)];
const subjects = unique(results.map(r => r.subject));
const scalars = unique(results.map(r => r.scalar));
const operations = unique(results.map(r => r.operation));
const find = (list, matches) => numbers.records.flatMap(r => r[list]).find(matches);

const chosen = {
  scalar: scalars.includes("double") ? "double" : scalars[0], operation: "", hidden: new Set(),
  statistics: ["max_eps", "p99_eps", "median_eps"]};

const visible = () => results.filter(r => r.scalar === chosen.scalar && !chosen.hidden.has(r.subject));

function groups(rows) {  // lists of rows with equal operation, block and property, in the order of the records
  const found = new Map();
  for (const r of rows) {
    const key = JSON.stringify([r.operation, r.block, r.property]);
    found.has(key) ? found.get(key).push(r) : found.set(key, [r]);
  }
  return [...found.values()];
}

function caption(rows) {
  const {operation, block, property} = rows[0];
  const o = find("operations", e => e.operation === operation), p = find("properties", e => e.property === property);
  // Older records define a block once for all operations.
  const b = find("blocks", e => e.block === block && (e.operation ?? operation) === operation);
  const unit = b && b.denominator === "absolute" && b.unit !== "1" ? `, in eps · ${b.unit}` : "";
  return [o && `${[o.definition, o.frame].filter(Boolean).join("; ")}.`, b && `Error: ${b.error}, denominator: ${b.denominator}${unit}.`,
    p ? `Law ${property}: ${p.law}.` : `Law ${property}.`].filter(Boolean).join(" ").replace(/\.\./g, ".");
}

const onAxis = r => r.axis !== "none" && r.count > 0;

// The chart at the top: exp6's translation at small angles, or else the block with the largest error.
function fillCover() {
  const section = document.getElementById("cover");
  forget(section);
  const rows = results.filter(r => r.scalar === chosen.scalar && r.axis === "theta" && r.count > 0);
  const size = r => notFinite(r) ? Infinity : r.max_eps;
  const wanted = groups(rows.filter(r => r.operation === "exp6" && r.block === "translation"))[0]
    ?? groups(rows).sort((a, b) => Math.max(...b.map(size)) - Math.max(...a.map(size)))[0];
  if (!wanted) return;
  const {operation, block} = wanted[0];
  const silent = subjects.filter(s => !wanted.some(r => r.subject === s));
  const missing = silent.length ? ` Not offered or not measured in ${chosen.scalar}: ${silent.join(", ")}.` : "";
  section.append(element("h2", {}, `${operation}, ${block}: error towards θ = 0, ${chosen.scalar}`),
    element("figure", {}, element("figcaption", {}, `${caption(wanted)} Largest error found in each band: a lower bound of the true maximum.${missing}`),
      legend(wanted, ["max_eps"]), charts(wanted, ["max_eps"], ["theta"])));
}

function fillFigures() {
  document.getElementById("selection").textContent = `Shown: ${chosen.scalar}; ${chosen.operation || "all operations"}; `
    + subjects.filter(s => !chosen.hidden.has(s)).join(", ") + ".";
  const home = document.getElementById("figures");
  forget(home);
  const rows = visible().filter(r => !chosen.operation || r.operation === chosen.operation);
  for (const group of groups(rows.filter(r => r.axis !== "none"))) {
    const {operation, block, property} = group[0], name = `${operation}, ${block}`;
    const figure = element("figure", {}, element("h3", {}, `${name} `), element("figcaption", {}, caption(group)));
    if (group.some(r => r.rule === "excess"))
      figure.append(element("p", {class: "note"}, "Some bands are judged by excess; the budget line covers the others."));
    if (group.some(onAxis)) figure.append(legend(group, chosen.statistics), charts(group, chosen.statistics));
    else figure.append(element("p", {}, "No case in these bands was measured."));
    figure.append(foldedTable(`Worst case in each band: ${name}, ${property}`, group, ["subject"]));
    home.append(figure);
  }
  if (!home.children.length) home.append(element("p", {}, "No results with an angle for this choice."));

  const other = document.getElementById("axisless");
  const plain = rows.filter(r => r.axis === "none");
  other.replaceChildren(...operations.map(o => [o, plain.filter(r => r.operation === o)]).filter(([, own]) => own.length)
    .map(([o, own]) => foldedTable(o, own, ["subject", "block", "property"])));
  if (!plain.length) other.append(element("p", {}, "No results for this choice."));
}

function choice(name, label, options, value) {
  const select = element("select", {name});
  for (const [v, text] of options) select.append(element("option", {value: v}, text));
  select.value = value;
  return element("label", {}, label, select);
}

function boxes(name, title, options, off) {
  const set = element("fieldset", {}, element("legend", {}, title));
  for (const [v, label] of options) {
    const box = element("input", {type: "checkbox", name, value: v});
    box.checked = !off.has(v);
    set.append(element("label", {}, box, label));
  }
  return set;
}

// Calls fill(event) when a control of the form changes. The form is never submitted.
function whenChanged(form, fill) {
  form.addEventListener("submit", event => event.preventDefault());
  form.addEventListener("change", fill);
}

function fillControls() {
  const form = document.getElementById("controls");
  form.append(
    choice("scalar", "scalar", scalars.map(s => [s, s]), chosen.scalar),
    choice("operation", "operation", [["", "all"], ...operations.map(o => [o, o])], ""),
    boxes("subject", "subjects", subjects.map(s => [s, s]), chosen.hidden),
    boxes("statistic", "lines", Object.entries(STATISTICS).map(([k, s]) => [k, s.name]), new Set()));
  whenChanged(form, event => {
    const data = new FormData(form);
    chosen.scalar = data.get("scalar");
    chosen.operation = data.get("operation");
    chosen.hidden = new Set(subjects.filter(s => !data.getAll("subject").includes(s)));
    chosen.statistics = Object.keys(STATISTICS).filter(s => data.getAll("statistic").includes(s));
    if (event.target.name === "scalar") fillCover();
    fillFigures();
  });
}

if (results.length) {
  fillControls();
  fillCover();
  fillFigures();
} else {
  document.getElementById("figures").append("The records hold no results.");
  document.getElementById("axisless").append("The records hold no results.");
}
window.addEventListener("beforeprint", toPaper);
window.addEventListener("afterprint", fromPaper);
