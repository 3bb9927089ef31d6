// The table of digits, which digits_section.cpp writes: its filters, and the regions that a cell opens.

// Hexadecimal text of a floating-point number, as printf writes it with %a, as decimal text; rounded if it is beyond double.
function decimalOf(hex) {
  const m = /^([-+]?)0x([0-9a-f]+)\.?([0-9a-f]*)p([-+]?\d+)$/i.exec(hex);
  if (!m) return hex;
  const digits = (m[2] + m[3]).replace(/^0+/, ""), wide = digits.length > 14;
  let value = parseInt(digits.slice(0, 14) || "0", 16), e = +m[4] - 4 * m[3].length + 4 * Math.max(0, digits.length - 14);
  for (; e < -1000; e += 1000) value *= 2 ** -1000;  // in steps, because 2 ** -1074 / 2 ** 52 is 0
  return `${wide ? "≈ " : ""}${m[1]}${value * 2 ** e}`;
}

function latencyOf(row) {
  const own = numbers.records.flatMap(r => r.cost?.rows ?? [])
    .find(c => c.subject === row.subject && c.scalar === row.scalar && c.operation === row.operation);
  return own?.sets.at(-1).latency?.ns;
}

const cliffsOf = row => numbers.records.flatMap(r => r.cliffs ?? [])
  .filter(c => c.subject === row.subject && c.scalar === row.scalar && c.operation === row.operation);
const sum = (rows, name) => rows.reduce((n, r) => n + (r[name] ?? 0), 0);

// The numbers of a list, each in decimal and in hexadecimal.
function numbersTable(title, heads, lines) {
  return element("table", {class: "numbers"}, element("caption", {}, title),
    element("thead", {}, element("tr", {}, ...heads.map(h => element("th", {scope: "col"}, h)))),
    element("tbody", {}, ...lines.map(line => element("tr", {}, ...line.map((text, i) => i ? element("td", {}, element("code", {}, text))
      : element("th", {scope: "row"}, text))))));
}

function worstCase(row) {
  const home = element("div", {class: "worst"}), {worst} = row;
  if (!worst?.id) return home;
  const command = subjectOf(row).replay.replace("ID", () => worst.id);
  const button = element("button", {type: "button", class: "copy", "aria-label": `Copy ${command}`}, "copy");
  button.addEventListener("click", () => copy(command, button));
  home.append(element("p", {}, "Replay: ", element("code", {class: "replay"}, command), button));
  const input = worst.input.map((x, i) => [String(i), decimalOf(x), x]), more = worst.count > input.length;
  home.append(numbersTable(`Worst input${more ? `, the first ${input.length} of ${worst.count} numbers; the replay line has all` : ""}`,
    ["number", "decimal", "hexadecimal"], input));
  if (worst.numbers?.length)
    home.append(numbersTable(`Result of ${worst.call}: what the library returned, and the oracle’s result, rounded. What differs most comes first.`,
      ["number", "got", "expected", "got, hexadecimal", "expected, hexadecimal"],
      worst.numbers.map(n => [n.name, decimalOf(n.got), decimalOf(n.expected), n.got, n.expected])));
  else home.append(element("p", {}, "The replay line prints what the library returned and what is right."));
  return home;
}

// The rows of one region: its figures, and below them, when it is opened, the worst case.
function regionRows(region, rows) {
  const row = worstOf(rows), rule = row.rule === "excess" ? "excess" : "eps";
  const toggle = element("button", {type: "button", class: "case", "aria-expanded": "false"}, "worst input, got, expected");
  const line = element("tr", {"data-region": region.key}, element("th", {scope: "row"}, region.name), number(row.outcome || row.status === "ill-posed" ? "–" : digitsKept(row).toFixed(1)),
    element("td", {}, `${row.block}, ${row.band}`),
    number(row.outcome ? errorWords(row) : `${short(judgedError(row))} ${rule}`), number(short(row.budget)),
    element("td", {}, element("span", {class: `status ${row.status}`}, row.status)), number(String(sum(rows, "not_finite"))),
    number(String(sum(rows, "wrong_branch"))), element("td", {}, toggle));
  const below = element("tr", {hidden: ""}, element("td", {colspan: "9"}));
  toggle.addEventListener("click", () => {
    if (!below.firstElementChild.children.length) below.firstElementChild.append(worstCase(row));
    below.hidden = !below.hidden;
    toggle.setAttribute("aria-expanded", String(!below.hidden));
  });
  return {lines: [line, below], toggle, row};
}

const cellRows = new Map();  // "operation|subject|scalar" -> rows
for (const r of results) {
  if (!(r.count > (r.outside_domain ?? 0))) continue;
  const key = `${r.operation}|${r.subject}|${r.scalar}`;
  cellRows.has(key) ? cellRows.get(key).push(r) : cellRows.set(key, [r]);
}
const rowsOf = button => cellRows.get(`${button.dataset.operation}|${button.dataset.subject}|${button.dataset.scalar}`);

// Closes what is open, and opens the regions of a cell: the worst case of each, and the charts of its worst block.
function openDigits(button) {
  const table = document.getElementById("digits-table"), open = button.getAttribute("aria-expanded") === "true";
  for (const old of table.querySelectorAll("tr.detail")) { forget(old); old.remove(); }
  for (const b of table.querySelectorAll("button.digits[aria-expanded=true]")) b.setAttribute("aria-expanded", "false");
  const {operation, subject, scalar} = button.dataset, own = rowsOf(button);
  chosen.open = open ? "" : `${operation}:${subject}`;
  chosen.in = open ? "" : scalar;
  if (open) return;
  button.setAttribute("aria-expanded", "true");
  const heads = ["region", "digits kept", "worst block and band", "error found", "budget", "status", "NaN", "wrong branch", "worst case"];
  const inside = REGIONS.map(region => [region, own.filter(r => regionOf(r) === region)])
    .filter(([region, rows]) => rows.length && (!chosen.region || chosen.region === region.key)).map(([region, rows]) => regionRows(region, rows));
  const ns = latencyOf(own[0]), cliff = cliffsOf(own[0]).length ? ", with a cliff: a band with a hundred times the error of others" : "";
  const title = `${operation} of ${subject} in ${scalar}${ns ? `, ${short(ns)} ns a call` : ""}${cliff}`;
  const worst = inside.find(i => i.row === worstOf(inside.map(j => j.row))), detail = element("div", {class: "cell-detail"},
    element("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": title}, element("table", {}, element("caption", {}, title),
      element("thead", {}, element("tr", {}, ...heads.map(h => element("th", {scope: "col"}, h)))), element("tbody", {}, ...inside.flatMap(i => i.lines)))));
  const {block, property} = worst.row, block_ = own.filter(r => r.block === block && r.property === property);
  if (block_.some(onAxis)) detail.prepend(element("figure", {}, element("figcaption", {}, caption(block_)), legend(block_, chosen.statistics), charts(block_, chosen.statistics)));
  const line = button.closest("tr");
  line.after(element("tr", {class: "detail"}, element("td", {colspan: String(line.children.length)}, detail)));
  worst.toggle.click();
}

// What a cell says to those who do not see it.
function cellWords(button) {
  const own = rowsOf(button), parts = REGIONS.map(region => [region, own.filter(r => regionOf(r) === region)]).filter(([, rows]) => rows.length)
    .map(([region, rows]) => `${region.name}: ${rows.some(r => r.status === "fail") ? "over budget, " : ""}${errorWords(worstOf(rows))}`);
  const {operation, subject, scalar} = button.dataset, bad = own.some(r => r.status === "fail");
  return `${operation}, ${subject} in ${scalar}: ${bad ? "fails" : "no failure"}. ${parts.join("; ")}`;
}

// Hides what is not chosen, and opens what the address says is open.
function fillDigits() {
  const home = document.getElementById("digits-table"), at = REGIONS.findIndex(r => r.key === chosen.region);
  const off = ({subject, scalar}) => chosen.hidden.has(subject) || (chosen.scalar && scalar && scalar !== chosen.scalar);
  for (const old of home.querySelectorAll("tr.detail")) { forget(old); old.remove(); }
  for (const list of home.querySelectorAll(".boxes")) for (const [i, box] of list.querySelectorAll("i").entries()) box.hidden = at >= 0 && i !== at;
  for (const cell of home.querySelectorAll("[data-subject]:not(button)")) cell.hidden = off(cell.dataset);
  for (const head of home.querySelectorAll("th[colspan]"))
    head.colSpan = Math.max(1, home.querySelectorAll(`tr:nth-child(2) th[data-subject="${CSS.escape(head.dataset.subject)}"]:not([hidden])`).length);
  for (const line of home.querySelectorAll("tbody tr")) {
    const own = [...line.querySelectorAll("td:not([hidden]) button")];
    line.hidden = Boolean(chosen.operation && line.dataset.operation !== chosen.operation) || !own.some(b => at < 0 || rowsOf(b).some(r => regionOf(r) === REGIONS[at]));
  }
  for (const button of home.querySelectorAll("button.digits")) button.setAttribute("aria-expanded", "false");
  const wanted = [...home.querySelectorAll("tr:not([hidden]) td:not([hidden]) button.digits")].find(({dataset: d}) =>
    `${d.operation}:${d.subject}` === chosen.open && (!chosen.in || d.scalar === chosen.in));
  if (wanted) openDigits(wanted);
}

// A cell has the names of its row and its column.
for (const line of document.querySelectorAll("#digits-table tbody tr")) {
  const columns = document.querySelectorAll("#digits-table thead tr:nth-child(2) th");
  for (const [i, cell] of line.querySelectorAll("td").entries()) {
    const {subject, scalar} = columns[i].dataset, button = cell.firstElementChild;
    Object.assign(cell.dataset, {subject, scalar});
    if (!button) continue;
    Object.assign(button.dataset, {operation: line.dataset.operation, subject, scalar});
    button.setAttribute("aria-expanded", "false");
    for (const box of button.children) box.setAttribute("aria-hidden", "true");
    button.prepend(element("span", {class: "spoken"}, cellWords(button)));
  }
}
document.getElementById("digits-table").addEventListener("click", event => {
  const button = event.target.closest("button.digits");
  if (button) { openDigits(button); writeState(); }
});
document.getElementById("digits-table").addEventListener("pointerover", event => {
  if (event.target.matches(".digits i")) event.target.title = cellWords(event.target.parentElement);
});
