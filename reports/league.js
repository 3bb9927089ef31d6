const record = JSON.parse(document.getElementById("numbers").textContent);
const $ = id => document.getElementById(id);
const QUESTIONS = {
  "": ["anywhere", "The worst case of every operation but those off unit, at every angle."],
  "near-zero": ["near 0", "Angles below 1e-3."],
  "1e-8": ["at 1e-8", "Angles about 1e-8, where many libraries change from a closed form to a series."],
  "near-pi": ["near π", "Angles within 1e-3 of π, and π."],
  "off-unit": ["off unit", "Operations on quaternions of any norm: normalize and those whose names end in _any_norm."],
  "1kHz": ["in a 1 kHz loop", "The quickest first; libraries with a result that is NaN, on a wrong branch or missing come last."],
};
const value = x => typeof x === "number" ? x : Infinity;
const shown = x => x === Infinity ? "∞" : x === 0 ? "0" : x < 1000 ? x.toPrecision(3) : x.toExponential(1);
const time = ns => !ns ? "—" : ns < 1000 ? `${ns.toFixed(0)} ns` : ns < 1e6 ? `${(ns / 1000).toPrecision(3)} µs` : `${(ns / 1e6).toPrecision(3)} ms`;

function element(tag, properties = {}, ...children) {
  const e = Object.assign(document.createElement(tag), properties);
  e.append(...children);
  return e;
}
function concerns(question, cell, band) {
  if (question === "near-zero") return band.axis === "theta" && band.high <= 1.5e-3;
  if (question === "near-pi") return band.axis === "pi_minus_theta" && band.high <= 1.5e-3 || band.band === "pi";
  if (question === "1e-8") return band.axis === "theta" && band.low <= 1e-8 && 1e-8 <= band.high;
  return /_any_norm$|^normalize$/.test(cell.operation) === (question === "off-unit");
}
const grade = (bad, eps) => bad ? "F" : eps <= 64 ? "A" : eps <= 1e4 ? "B" : eps <= 1e8 ? "C" : "D";

function answers(question) {
  const all = [];
  for (const library of record.libraries)
    for (const scalar of ["double", "float"]) {
      const a = {library, scalar, eps: -1, bad: 0, operations: 0, ns: 0, worst: ""};
      for (const cell of library.cells.filter(c => c.scalar === scalar)) {
        const bands = cell.bands.filter(b => concerns(question, cell, b));
        for (const b of bands) {
          const eps = b.bad ? Infinity : value(b.eps);
          a.bad += b.bad;
          if (eps > a.eps) Object.assign(a, {eps, worst: cell.operation});
        }
        if (bands.length) a.operations++, a.ns += cell.ns;
      }
      if (a.operations) all.push({...a, ns: a.ns / a.operations, grade: grade(a.bad, a.eps)});
    }
  const key = question === "1kHz" ? a => [a.grade === "F" ? 1 : 0, a.ns] : a => ["ABCDF".indexOf(a.grade), a.eps];
  return all.sort((a, b) => key(a)[0] - key(b)[0] || (key(a)[1] === key(b)[1] ? 0 : key(a)[1] - key(b)[1]));
}
function table(heads, rows) {
  return element("table", {}, element("thead", {}, element("tr", {}, ...heads.map(h => element("th", {scope: "col"}, h)))),
    element("tbody", {}, ...rows));
}
function showRanking(question) {
  $("why").textContent = QUESTIONS[question][1];
  const cell = (text, number) => element("td", {className: number ? "number" : ""}, text);
  const rows = answers(question).map(a => element("tr", {className: a.library.repaired ? "own" : ""}, element("th", {scope: "row"}, a.library.name),
    element("td", {}, element("span", {className: `grade ${a.grade}`}, a.grade)), cell(shown(a.eps), true), cell(a.worst),
    cell(time(a.ns), true), cell(String(a.operations), true), cell(a.scalar), cell(a.library.version), cell(a.library.language)));
  $("ranking").replaceChildren(table(["library", "grade", "worst [eps]", "in", "a call", "operations", "scalar", "version", "language"], rows));
}
function buttons(form, entries, chosen, choose) {
  form.replaceChildren(...entries.map(([key, text]) => {
    const b = element("button", {type: "button"}, text);
    b.setAttribute("aria-pressed", key === chosen);
    b.onclick = () => { for (const other of form.children) other.setAttribute("aria-pressed", other === b); choose(key); };
    return b;
  }));
}
function showCell(library, cell) {
  const bars = element("div", {className: "bars"});
  for (const b of cell.bands) {
    const eps = b.bad ? Infinity : value(b.eps), width = eps === Infinity ? 100 : Math.max(1, 100 * Math.log10(Math.max(1, eps)) / 16);
    const bar = element("div", {className: `bar ${grade(b.bad, eps)}`});
    bar.style.width = `${width}%`;
    bars.append(element("span", {}, b.band), bar, element("span", {}, b.bad ? `${b.bad} bad` : `${shown(eps)} eps`));
  }
  const facts = [`${cell.cases} cases, ${cell.failed} beyond the limit`, `${cell.digits.toFixed(1)} digits`, time(cell.ns)];
  for (const [count, word] of [[cell.not_finite, "NaN or Inf"], [cell.wrong_branch, "wrong branch"], [cell.refused, "refused"], [cell.crashed, "crashed"]])
    if (count) facts.push(`${count} ${word}`);
  const parts = [element("h3", {}, `${library.name} ${library.version}: ${cell.operation} in ${cell.scalar}`),
    element("p", {}, facts.join(" · ")), bars];
  if (cell.cliff) parts.push(element("p", {}, "Cliff: " + cell.cliff));
  if (cell.failure) {
    if (cell.failure.guess) parts.push(element("p", {}, "Perhaps " + cell.failure.guess + "."));
    parts.push(element("pre", {tabIndex: 0}, cell.failure.text));
  } else parts.push(element("p", {}, "Worst input: " + cell.input.join(", ")), element("pre", {tabIndex: 0}, cell.replay));
  $("detail").replaceChildren(...parts);
  $("detail").scrollIntoView({block: "nearest"});
}
const ON_TREES = /^(tree|frame|told|robot|rnea|aba)_/;
function matrix(scalar, onTrees) {
  const cells = l => l.cells.filter(c => c.scalar === scalar && ON_TREES.test(c.operation) === onTrees);
  const libraries = record.libraries.filter(l => cells(l).length), count = new Map();
  for (const l of libraries) for (const c of cells(l)) count.set(c.operation, (count.get(c.operation) || 0) + 1);
  const operations = [...count.keys()].sort((a, b) => count.get(b) - count.get(a) || (a < b ? -1 : 1));
  const rows = libraries.map(l => element("tr", {className: l.repaired ? "own" : ""}, element("th", {scope: "row"}, l.name), ...operations.map(o => {
    const cell = cells(l).find(c => c.operation === o);
    if (!cell) return element("td", {className: "none", title: `${l.name} does not offer ${o}`}, "–");
    const b = element("button", {type: "button", className: cell.grade, title: `${l.name}, ${o}`}, `${cell.grade} ${cell.digits.toFixed(0)}`);
    b.onclick = () => showCell(l, cell);
    return element("td", {}, b);
  })));
  return table(["library", ...operations], rows);
}
function showMatrix(scalar) {
  $("matrix").replaceChildren(matrix(scalar, false));
}
const others = record.libraries.filter(l => !l.repaired), languages = new Set(others.map(l => l.language));
$("about").textContent = `${others.length} adapters of libraries in ${languages.size} languages (${[...languages].join(", ")}), ` +
  `measured on ${record.date} by liecheck ${record.version} with seed ${record.seed} and ${record.cases} cases of each law.` +
  (record.verdict === "complete" ? "" : " The run was not complete.");
buttons($("questions"), Object.entries(QUESTIONS).map(([k, [t]]) => [k, t]), "", showRanking);
buttons($("scalars"), [["double", "double"], ["float", "float"]], "double", showMatrix);
showRanking("");
showMatrix("double");
if (others.some(l => l.cells.some(c => ON_TREES.test(c.operation)))) $("trees").replaceChildren(matrix("double", true));
else $("trees-section").hidden = true;
const missing = [...record.absent.map(a => `${a.name}: not installed; ${a.get}`), ...record.failed.map(a => `${a.name}: not measured: ${a.why}`)];
if (missing.length) $("absent").replaceChildren(element("h3", {}, "Absent"), element("ul", {}, ...missing.map(m => element("li", {}, m))));
