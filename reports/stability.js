// The stability table: hard cases × (subject, scalar), by class. A click on a cell shows its details.

// Ordered from best to worst. A cell shows the worst verdict of all laws of its case.
const VERDICTS = [
  {name: "stable", mark: "✓", text: "within budget"},
  {name: "refused", mark: "R", text: "refused with an error; counted as a failure only if the input is a rotation"},
  {name: "ill-posed", mark: "P", text: "eps · κ ≥ 1: the input determines no digit; neither stable nor a failure"},
  {name: "unmeasured", mark: "0", text: "the law recorded nothing for a block"},
  {name: "unresolved", mark: "?", text: "two precisions or formulas of the oracle disagree"},
  {name: "inaccurate", mark: "I", text: "finite, over budget: digits lost beyond κ"},
  {name: "wrong branch", mark: "B", text: "another logarithm, the opposite quaternion, or a result for an input that is no rotation"},
  {name: "not finite", mark: "N", text: "NaN or Inf"},
  {name: "bad call", mark: "C", text: "not repeatable, an argument was written to, or output was left unwritten"}];
const rankOf = cell => VERDICTS.findIndex(v => v.name === cell.verdict) + (cell.failed ? 100 : 0);
const verdictOf = cell => VERDICTS.find(v => v.name === cell.verdict);

// One entry for each case, with the cells of all its laws in each column, worst first.
function hardCases() {
  const cases = new Map();
  for (const row of numbers.records.flatMap(r => r.hard_cases ?? [])) {
    if (!cases.has(row.name)) cases.set(row.name, {...row, columns: new Map()});
    for (const cell of row.cells) {
      const key = `${cell.subject} ${cell.scalar}`, own = cases.get(row.name).columns;
      if (!own.has(key)) own.set(key, []);
      const input = row.input[cell.scalar], replay = cell.replay || `liecheck replay raw.${row.property}.${cell.subject}.${cell.scalar}.none.${input.join(",")}`;
      own.get(key).push({...cell, property: row.property, input, replay});
    }
  }
  for (const c of cases.values()) for (const own of c.columns.values()) own.sort((a, b) => rankOf(b) - rankOf(a));
  return [...cases.values()];
}

const scalarWidth = scalar => ["float", "double", "float128"].indexOf(scalar);
function stabilityColumns(cases) {
  const all = new Map();
  for (const c of cases) for (const [key, [cell]] of c.columns) all.set(key, cell);
  return [...all].map(([key, {subject, scalar}]) => ({key, subject, scalar}))
    .sort((a, b) => a.subject.localeCompare(b.subject) || scalarWidth(a.scalar) - scalarWidth(b.scalar));
}

const mark = (verdict, extra = "") => element("span", {class: `mark ${verdict.name.replace(" ", "-")}`}, verdict.mark + extra);

function cellDetail(cell) {
  const rule = cell.rule === "excess" ? "eps · κ" : "eps", verdict = verdictOf(cell);
  const size = x => typeof x === "number" ? short(x) : x === "inf" ? "Inf" : "NaN";
  const list = element("dl", {});
  const item = (name, ...value) => list.append(element("dt", {}, name), element("dd", {}, ...value));
  item(`${cell.property}`, mark(verdict), ` ${cell.verdict}${cell.failed ? ", counted as a failure" : ""}: ${verdict.text}`);
  if (cell.refusal) item("error", element("code", {}, cell.refusal));
  else item("worst block", `${cell.operation}, ${cell.block}, band ${cell.band}: error ${size(cell.error)} eps`
    + `${cell.kappa > 0 || typeof cell.kappa === "string" ? `, κ ${size(cell.kappa)}` : ""}, budget ${short(cell.budget)} ${rule}`);
  item("input", element("code", {class: "numbers"}, cell.input.join(" ")));
  const button = element("button", {type: "button", "aria-label": `Copy ${cell.replay}`}, "copy");
  button.addEventListener("click", () => copy(cell.replay, button));
  item("replay", element("code", {}, cell.replay), button);
  return list;
}

function openCell(row, hard, column, button, span) {
  const old = row.nextElementSibling;
  const wasOwn = button.getAttribute("aria-expanded") === "true";
  for (const b of row.querySelectorAll("button[aria-expanded]")) b.setAttribute("aria-expanded", "false");
  if (old?.classList.contains("detail")) old.remove();
  if (wasOwn) return;
  button.setAttribute("aria-expanded", "true");
  row.after(element("tr", {class: "detail"}, element("td", {colspan: String(span)}, element("div", {class: "cell-detail"},
    element("h3", {}, `${hard.name} on ${column.subject} in ${column.scalar}`),
    element("p", {}, `${hard.reason}. Class: ${hard.class}. Origin: ${hard.origin}.`),
    ...hard.expression ? [element("p", {}, element("code", {}, hard.expression))] : [], ...hard.columns.get(column.key).map(cellDetail)))));
}

function caseRow(hard, columns) {
  const row = element("tr", {}, element("th", {scope: "row", title: hard.reason}, hard.name));
  for (const column of columns) {
    const cells = hard.columns.get(column.key);
    if (!cells) { row.append(element("td", {class: "absent"}, "–")); continue; }
    const verdict = verdictOf(cells[0]), about = `${hard.name}, ${column.subject} in ${column.scalar}: ${verdict.name}`;
    const button = element("button", {type: "button", class: `mark ${verdict.name.replace(" ", "-")}`, title: about,
      "aria-label": about, "aria-expanded": "false"}, verdict.mark);
    button.addEventListener("click", () => openCell(row, hard, column, button, columns.length + 1));
    row.append(element("td", {}, button));
  }
  return row;
}

// The row of a class shows the failures in each column. The rows of its cases are created when it is opened.
function classBody(name, cases, columns, open) {
  const body = element("tbody"), toggle = element("button", {type: "button", class: "class", "aria-expanded": "false"});
  const head = element("tr", {class: "class"}, element("th", {scope: "rowgroup"}, toggle));
  for (const column of columns) {
    const own = cases.map(c => c.columns.get(column.key)?.[0]).filter(Boolean);
    const worst = own.reduce((a, b) => rankOf(b) > rankOf(a) ? b : a, own[0]);
    const bad = own.filter(c => c.failed).length;
    const text = `${name}, ${column.subject} in ${column.scalar}: ${bad} of ${own.length} failed`;
    head.append(own.length ? element("td", {title: text, "aria-label": text}, mark(verdictOf(worst), bad ? ` ${bad}` : ""))
      : element("td", {class: "absent"}, "–"));
  }
  body.append(head);
  const show = on => {
    toggle.setAttribute("aria-expanded", String(on));
    toggle.textContent = `${on ? "▾" : "▸"} ${name} (${cases.length})`;
    while (body.children.length > 1) body.lastElementChild.remove();
    if (on) body.append(...cases.map(c => caseRow(c, columns)));
  };
  toggle.addEventListener("click", () => show(toggle.getAttribute("aria-expanded") !== "true"));
  show(open);
  return body;
}

function fillMatrix(home, cases, columns, filter) {
  const groups = new Map();
  const bad = c => [...c.columns.values()].some(([worst]) => worst.verdict !== "stable");
  for (const c of cases) {
    if ((filter.unstable && !bad(c)) || (filter.class && c.class !== filter.class)) continue;
    groups.has(c.class) ? groups.get(c.class).push(c) : groups.set(c.class, [c]);
  }
  const bySubject = unique(columns.map(c => c.subject)).map(s => element("th",
    {scope: "colgroup", colspan: String(columns.filter(c => c.subject === s).length)}, s));
  const head = element("thead", {}, element("tr", {}, element("th", {rowspan: "2", scope: "col"}, "class, case"), ...bySubject),
    element("tr", {}, ...columns.map(c => element("th", {scope: "col", class: "scalar"}, c.scalar))));
  const bodies = [...groups].map(([name, own]) => classBody(name, own, columns, filter.open));
  home.replaceChildren(groups.size ? element("table", {class: "matrix"}, head, ...bodies)
    : element("p", {}, "No case for this choice."));
}

function fillStability() {
  const home = document.getElementById("stability-matrix"), cases = hardCases();
  if (!cases.length) return home.append("The records hold no hard cases.");
  const columns = stabilityColumns(cases), filter = {unstable: false, open: false, class: ""};
  home.before(element("ul", {class: "legend"}, ...VERDICTS.map(v => element("li", {}, mark(v), `${v.name}: ${v.text}`)),
    element("li", {}, "–: not offered, or not for this scalar")));
  const form = document.getElementById("stability-controls");
  form.append(choice("class", "class", [["", "all"], ...unique(cases.map(c => c.class)).map(c => [c, c])], ""),
    ...[["unstable", "only unstable rows"], ["open", "every class open"]].map(([name, label]) =>
      element("label", {}, element("input", {type: "checkbox", name}), label)));
  whenChanged(form, event => {
    const data = new FormData(form);
    if (event.target.name === "class" || event.target.name === "unstable")
      form.elements.open.checked = data.get("class") !== "" || data.has("unstable");
    Object.assign(filter, {class: data.get("class"), unstable: data.has("unstable"), open: form.elements.open.checked});
    fillMatrix(home, cases, columns, filter);
  });
  fillMatrix(home, cases, columns, filter);
}

whenOpened(document.getElementById("stability-matrix"), fillStability);
