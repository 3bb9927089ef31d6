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
// The inverse of compressed() in html.hpp.
async function expanded(text) {
  const bytes = new Uint8Array(Math.floor(text.length * 4 / 5));
  for (let i = 0, at = 0; i < text.length; i += 5) {
    let four = 0;
    for (let k = i; k < i + 5; ++k) {
      const code = k < text.length ? text.charCodeAt(k) : 120;
      four = four * 85 + code - 35 - (code > 60);
    }
    for (let shift = 24; shift >= 0 && at < bytes.length; shift -= 8) bytes[at++] = four >>> shift;
  }
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
}
async function addScript(id) {  // Chart.js, of which the page has the compressed text
  const script = document.createElement("script");
  script.textContent = await expanded(document.getElementById(id).textContent);
  document.head.append(script);
}
await addScript("chart-library");
const numbers = unpacked(JSON.parse(await expanded(document.getElementById("numbers").textContent)));
const results = numbers.results;
for (const {worst} of results) worst.id = worst.stem + worst.case;
const unique = values => [...new Set(values)];
const subjects = unique(results.map(r => r.subject));
const scalars = unique(results.map(r => r.scalar));
const operations = unique(results.map(r => r.operation));
const find = (list, matches) => numbers.records.flatMap(r => r[list]).find(matches);

const chosen = {scalar: "", operation: "", region: "", open: "", in: "", hidden: new Set(), statistics: ["max_eps", "p99_eps", "median_eps"]};

// The scalar of charts, which show one: the chosen one, or double.
const drawnScalar = () => chosen.scalar || (scalars.includes("double") ? "double" : scalars[0]);
const visible = () => results.filter(r => r.scalar === drawnScalar() && !chosen.hidden.has(r.subject));

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

// Blocks and bands are listed when their section is opened; later changes of the choice list them again.
function fillFigures() {
  for (const [id, fill] of [["blocks", fillBlocks], ["bands", fillBands]]) {
    const fold = document.querySelector(`#${id} > details`);
    fold.ontoggle = () => { if (fold.open) { fold.ontoggle = null; fill(); } };
    fold.ontoggle();
  }
}

const selected = () => visible().filter(r => !chosen.operation || r.operation === chosen.operation)
  .filter(r => !chosen.region || r.region === chosen.region);

function fillBlocks() {
  document.getElementById("selection").textContent = `Shown: ${drawnScalar()}; ${chosen.operation || "all operations"}; `
    + subjects.filter(s => !chosen.hidden.has(s)).join(", ") + ".";
  const home = document.getElementById("figures");
  forget(home);
  for (const group of groups(selected().filter(r => r.axis !== "none"))) {
    const {operation, block, property} = group[0], name = `${operation}, ${block}`;
    const bad = group.some(r => r.status === "fail") ? element("span", {class: "status fail"}, "over budget") : "";
    const fold = element("details", {class: "block"}, element("summary", {}, `${name}, law ${property} `, bad));
    fold.fill = () => {  // drawn when opened: a page may have a hundred blocks
      if (fold.children.length > 1) return;
      const figure = element("figure", {}, element("figcaption", {}, caption(group)));
      if (group.some(r => r.rule === "excess"))
        figure.append(element("p", {class: "note"}, "Some bands are judged by excess; the budget line covers the others."));
      if (group.some(onAxis)) figure.append(legend(group, chosen.statistics), charts(group, chosen.statistics));
      else figure.append(element("p", {}, "No case in these bands was measured."));
      figure.append(foldedTable(`Worst case in each band: ${name}, ${property}`, group, ["subject"]));
      fold.append(figure);
    };
    fold.addEventListener("toggle", () => { if (fold.open) fold.fill(); });
    home.append(fold);
  }
  if (!home.children.length) home.append(element("p", {}, "No results with an angle for this choice."));
}

function fillBands() {
  const other = document.getElementById("axisless"), plain = selected().filter(r => r.axis === "none");
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
    choice("scalar", "scalar", [["", "all"], ...scalars.map(s => [s, s])], chosen.scalar),
    choice("operation", "operation", [["", "all"], ...operations.map(o => [o, o])], chosen.operation),
    choice("region", "region", [["", "all"], ...REGIONS.map(r => [r.key, r.name])], chosen.region),
    boxes("subject", "libraries", subjects.map(s => [s, s]), chosen.hidden),
    boxes("statistic", "lines", Object.entries(STATISTICS).map(([k, s]) => [k, s.name]), new Set()));
  whenChanged(form, () => {
    const data = new FormData(form);
    for (const name of ["scalar", "operation", "region"]) chosen[name] = data.get(name);
    chosen.hidden = new Set(subjects.filter(s => !data.getAll("subject").includes(s)));
    chosen.statistics = Object.keys(STATISTICS).filter(s => data.getAll("statistic").includes(s));
    writeState();
    fillDigits();
    fillMap();
    fillFigures();
  });
}

function setControls() {  // after the address has changed
  const form = document.getElementById("controls");
  for (const name of ["scalar", "operation", "region"]) form.elements[name].value = chosen[name];
  for (const box of form.querySelectorAll("[name=subject]")) box.checked = !chosen.hidden.has(box.value);
}
