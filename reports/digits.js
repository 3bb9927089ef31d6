// The table of operations by libraries: the digits that the worst case keeps in each region. A cell opens its regions.

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
  const command = `liecheck replay ${worst.id}`;
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
  const line = element("tr", {"data-region": region.key}, element("th", {scope: "row"}, region.name), number(digitsKept(row).toFixed(1)),
    element("td", {}, `${row.block}, ${row.band}`),
    number(notFinite(row) ? "NaN or Inf" : row.wrong_branch > 0 ? "wrong branch" : `${short(judgedError(row))} ${rule}`), number(short(row.budget)),
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

function openDigits(line, button, operation, subject, own, span) {
  const open = button.getAttribute("aria-expanded") === "true";
  for (const old of document.querySelectorAll("#digits-table tr.detail")) old.remove();
  for (const b of document.querySelectorAll("#digits-table button.digits")) b.setAttribute("aria-expanded", "false");
  chosen.open = open ? "" : `${operation}:${subject}`;
  if (open) return;
  button.setAttribute("aria-expanded", "true");
  const heads = ["region", "digits kept", "worst block and band", "error found", "budget", "status", "NaN", "wrong branch", "worst case"];
  const inside = REGIONS.map(region => [region, own.filter(r => regionOf(r) === region)])
    .filter(([region, rows]) => rows.length && (!chosen.region || chosen.region === region.key)).map(([region, rows]) => regionRows(region, rows));
  const ns = latencyOf(own[0]), title = `${operation} of ${subject} in ${chosen.scalar}${ns ? `, ${short(ns)} ns a call` : ""}`;
  line.after(element("tr", {class: "detail"}, element("td", {colspan: String(span)}, element("div", {class: "cell-detail"},
    element("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": title}, element("table", {}, element("caption", {}, title),
      element("thead", {}, element("tr", {}, ...heads.map(h => element("th", {scope: "col"}, h)))), element("tbody", {}, ...inside.flatMap(i => i.lines))))))));
  const worst = inside.find(i => i.row === worstOf(inside.map(j => j.row)));
  worst?.toggle.click();
}

// A cell: seven small boxes with whole digits, or the one of the chosen region; below them what else happened.
function digitsCell(operation, subject, own) {
  const boxes = element("span", {class: "boxes", "aria-hidden": "true"}), spoken = [];
  for (const region of REGIONS.filter(r => !chosen.region || r.key === chosen.region)) {
    const rows = own.filter(r => regionOf(r) === region);
    if (!rows.length) { boxes.append(element("i", {class: "none"}, "·")); continue; }
    const row = worstOf(rows), bad = rows.some(r => r.status === "fail"), judged = bad || rows.some(r => r.status === "pass");
    const text = notFinite(row) ? "N" : row.wrong_branch > 0 ? "B" : chosen.region ? digitsKept(row).toFixed(1) : String(Math.floor(digitsKept(row) + .05));
    boxes.append(element("i", {class: bad ? "fail" : judged ? "pass" : "open", title: `${region.name}: ${errorWords(row)}`}, text));
    spoken.push(`${region.name}: ${bad ? "over budget, " : ""}${errorWords(row)}`);
  }
  const bad = own.some(r => r.status === "fail"), ns = latencyOf(own[0]);
  const nan = sum(own, "not_finite"), branch = sum(own, "wrong_branch"), cliff = cliffsOf(own[0]);
  const happened = [...cliff.length ? ["cliff"] : [], ...nan ? [`${nan} NaN`] : [], ...branch ? [`${branch} branch`] : []];
  const time = ns ? `${short(ns)} ns` : "", notes = [...happened, time];
  return element("button", {type: "button", class: `digits ${bad ? "fail" : "pass"}`, "aria-expanded": "false",
    "data-operation": operation, "data-subject": subject},
  element("span", {class: "spoken"}, `${operation}, ${subject}: ${bad ? "fails" : "no failure"}. ${[...spoken, ...notes].join("; ")}`), boxes, element("span", {class: "notes", "aria-hidden": "true"},
    element("b", {}, [...bad ? ["✗"] : [], ...happened].join(" · ")), happened.length && ns ? " · " : " ", time));
}

function fillDigits() {
  const home = document.getElementById("digits-table"), rows = visible().filter(r => r.count > (r.outside_domain ?? 0)
    && (!chosen.region || regionOf(r).key === chosen.region));
  const shown = subjects.filter(s => rows.some(r => r.subject === s)), body = element("tbody");
  for (const operation of operations.filter(o => (!chosen.operation || o === chosen.operation) && rows.some(r => r.operation === o))) {
    const line = element("tr", {}, element("th", {scope: "row"}, operation));
    for (const s of shown) {
      const own = rows.filter(r => r.subject === s && r.operation === operation);
      if (!own.length) { line.append(element("td", {class: "absent"}, "–")); continue; }
      const button = digitsCell(operation, s, own);
      button.addEventListener("click", () => { openDigits(line, button, operation, s, own, shown.length + 1); writeState(); });
      line.append(element("td", {}, button));
    }
    body.append(line);
  }
  const names = REGIONS.filter(r => !chosen.region || r.key === chosen.region).map(r => r.name).join(" | ");
  home.replaceChildren(element("table", {}, element("caption", {}, `Digits that the worst case found keeps, ${chosen.scalar}: ${names}`),
    element("thead", {}, element("tr", {}, element("th", {scope: "col"}, "operation"),
      ...shown.map(s => element("th", {scope: "col"}, swatch(s), ` ${s}`, chosen.region ? "" : element("span", {class: "boxes heads", "aria-hidden": "true"},
        ...REGIONS.map(r => element("i", {title: r.name}, r.brief))))))), body));
  const wanted = [...home.querySelectorAll("button.digits")].find(b => `${b.dataset.operation}:${b.dataset.subject}` === chosen.open);
  if (wanted) wanted.click();
}
