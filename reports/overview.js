// The first screen: a sentence for each subject, the charts of the block that tells most, and the three answers.

// The seven regions of the angle; page_numbers() in C++ decides to which one a row belongs.
const REGIONS = [{key: "zero", name: "θ < 10⁻⁷", brief: "≈0"}, {key: "small", name: "θ 10⁻⁷…⁠10⁻²", brief: "small"},
  {key: "moderate", name: "θ 10⁻²…⁠π⁠−⁠1", brief: "mid"}, {key: "near-pi", name: "π − θ 10⁻⁷…⁠1", brief: "<π"},
  {key: "pi", name: "π − θ < 10⁻⁷", brief: "≈π"}, {key: "beyond", name: "θ > π", brief: ">π"}, {key: "all", name: "without angle", brief: "no θ"}];
const regionOf = row => REGIONS.find(r => r.key === row.region);

const epsOf = row => find("subjects", s => s.name === row.subject && s.scalar === row.scalar)?.eps ?? 2 ** -52;
const judgedError = row => row.rule === "excess" ? row.max_excess : row.max_eps;
const isNumber = x => typeof x === "number";
// The digits of the scalar, and those that the worst case of a row lost: all of them if no number came back.
const digitsOfScalar = row => -Math.log10(epsOf(row));
function digitsLost(row) {
  if (notFinite(row) || row.wrong_branch > 0 || !isNumber(judgedError(row))) return digitsOfScalar(row);
  return Math.min(digitsOfScalar(row), Math.max(0, Math.log10(Math.max(judgedError(row), 1))));
}
const digitsKept = row => digitsOfScalar(row) - digitsLost(row);
const severity = row => (row.status === "fail" ? 100 : 0) + digitsLost(row) + (notFinite(row) ? 3 : 0) + (row.wrong_branch > 0 ? 2 : 0);
// Of the rows of one cell and region, page_numbers() marks the worst; it alone has its input on the page.
const worstOf = rows => rows.find(r => r.worst?.shown && rows.every(o => ["region", "subject", "operation", "scalar"]
  .every(name => o[name] === r[name]))) ?? rows.reduce((a, b) => severity(b) > severity(a) ? b : a);
function errorWords(row) {
  if (notFinite(row)) return "NaN or Inf";
  if (row.wrong_branch > 0) return "wrong branch";
  return `${digitsLost(row).toFixed(1)} of ${digitsOfScalar(row).toFixed(1)} digits lost`;
}
const plural = (n, what) => `${n} ${what}${n === 1 ? "" : "s"}`;

// Where a subject fails, its worst operations first, each with all its regions by what happens there: "log3_matrix
// (rotation vector) in double: NaN or Inf at θ < 10⁻⁷, up to 7.4 of 15.7 digits lost at π − θ < 10⁻⁷". Of a page with many
// subjects, one operation each.
function whereItFails(failing) {
  const operations = unique(failing.map(r => r.operation)).map(o => failing.filter(r => r.operation === o))
    .map(own => ({worst: worstOf(own), own})).sort((a, b) => severity(b.worst) - severity(a.worst));
  const place = ({worst, own}) => {
    const same = REGIONS.map(r => own.filter(row => row.scalar === worst.scalar && regionOf(row) === r)).filter(rows => rows.length).map(worstOf);
    const kind = row => notFinite(row) ? "NaN or Inf" : row.wrong_branch > 0 ? "wrong branch" : "";
    const parts = unique(same.map(kind)).map(k => same.filter(row => kind(row) === k)).map(rows => {
      const where = listed(rows.filter(r => regionOf(r).key !== "all").map(r => regionOf(r).name));
      const top = rows.reduce((a, b) => severity(b) > severity(a) ? b : a);
      return {top, text: `${rows.length > 1 && !kind(top) ? "up to " : ""}${errorWords(top)}${where ? ` at ${where}` : ""}`};
    });
    const texts = parts.sort((a, b) => severity(b.top) - severity(a.top)).map(p => p.text);
    return `${worst.operation} (${worst.block}) in ${worst.scalar}: ${texts.join(", ")}`;
  };
  const told = subjects.length > 6 ? 1 : 2, more = operations.slice(told).map(o => o.worst.operation);
  return operations.slice(0, told).map(place).join("; ")
    + (more.length > 3 ? `; and ${more.length} further operations` : more.length ? `; and ${listed(more)}` : "");
}

const listed = words => words.length > 1 ? `${words.slice(0, -1).join(", ")} and ${words.at(-1)}` : words.join("");

// What is said of a subject without a failing row.
function verdictWithoutFailure(subject) {
  const own = results.filter(r => r.subject === subject), of = name => numbers.records.flatMap(r => r[name] ?? []);
  const broken = of("hard_cases").flatMap(h => h.cells).filter(c => c.subject === subject && c.failed).length;
  if (!own.some(r => r.status === "pass")) return ["open", "incomplete: nothing was judged."];
  if (broken) return ["fail", `wrong: ${plural(broken, "hard case")} fail, no band is over its budget.`];
  const wrong = of("wrong_calls").find(c => c.subject === subject);
  if (wrong) return ["fail", `wrong where adapters are probed, and no law looks: ${wrong.sentence}.`];
  const open = own.some(r => ["unresolved", "unmeasured"].includes(r.status)) || of("not_measured").some(m => m.subject === subject);
  return open ? ["open", "incomplete: what was measured is within budget, but not all was measured."]
    : ["pass", "within budget in every measured band: no error was found."];
}

function fillSentences(home) {
  const list = element("ul", {class: "sentences"});
  const all = subjects.map(s => ({s, failing: results.filter(r => r.subject === s && r.status === "fail")}));
  for (const {s, failing} of all) {
    const where = unique(failing.map(r => r.operation)).length;
    const [kind, text] = failing.length ? ["fail", `wrong in ${plural(where, "operation")}: ${whereItFails(failing)}.`] : verdictWithoutFailure(s);
    const mark = {fail: "✗", pass: "✓", open: "?"}[kind];
    const control = s === "textbook" ? " (the positive control, meant to fail)" : "";
    list.append(element("li", {class: kind}, element("span", {class: `verdict-mark ${kind}`, "aria-hidden": "true"}, mark), swatch(s),
      element("b", {}, s), `${control} is ${text}`));
  }
  home.append(list);
}

// "textbook loses 7.4 digits (exp6, θ < 10⁻⁷)" for each failing subject, or their names if they are many.
function whoIsWrong(failed) {
  const worst = s => results.filter(r => r.subject === s && r.status === "fail").reduce((a, b) => severity(b) > severity(a) ? b : a);
  const words = row => `${row.subject} ${notFinite(row) || row.wrong_branch > 0 ? `has ${errorWords(row)}` : `loses ${digitsLost(row).toFixed(1)} digits`}`
    + ` (${row.operation}, ${regionOf(row).name})`;
  return failed.length <= 4 ? `${failed.map(s => words(worst(s))).join("; ")}.` : `${failed.join(", ")}.`;
}

// "exp6: 6.4 digits in 21 ns (bullet, float), 15.4 in 48 ns (eigen, double)": the steps of the front of one operation,
// after up to four of the judged libraries that are not on it.
function priceOfDigits() {
  const rows = numbers.records.flatMap(r => r.cost?.rows ?? []).filter(r => ["float", "double"].includes(r.scalar) && isNumber(r.error)
    && r.subject !== "call" && !r.subject.includes("@") && r.sets.at(-1).latency);
  const ns = r => r.sets.at(-1).latency.ns, steps = [];
  const operation = ["exp6", ...unique(rows.map(r => r.operation))].find(o => rows.some(r => r.operation === o));
  for (const r of rows.filter(r => r.operation === operation).sort((a, b) => ns(a) - ns(b)))
    if (!steps.length || r.error < .1 * steps.at(-1).error) steps.push(r);  // each step gains a digit or more
  const digits = r => Math.min(-Math.log10(r.error), -Math.log10(r.eps)).toFixed(1);
  const others = rows.filter(r => r.operation === operation && r.scalar === "double" && subjects.includes(r.subject)
    && !steps.some(s => s.subject === r.subject)).slice(0, 4);
  const front = steps.map((r, i) => `${digits(r)}${i || others.length ? "" : " digits"} in ${short(ns(r))} ns (${r.subject}, ${r.scalar})`).join(", ");
  const own = others.map((r, i) => `${r.subject} gives ${digits(r)}${i ? "" : " digits"} in ${short(ns(r))} ns`).join(", ");
  return `${operation}${others.length ? ` in double: ${own}. The fastest for its digits: ` : ": "}${front}. Digits are those of the worst timed input.`;
}

function fillAnswers(home) {
  const failed = unique(results.filter(r => r.status === "fail").map(r => r.subject));
  const hard = numbers.records.flatMap(r => r.hard_cases ?? []).flatMap(h => h.cells);
  const bySubject = unique(hard.map(c => c.subject)).map(s => hard.filter(c => c.subject === s))
    .map(own => `${own[0].subject} ${own.filter(c => c.failed).length || "none"} of ${own.length}`);
  const front = numbers.records.flatMap(r => r.cost ? [r.cost] : []).length;
  const advice = document.querySelector(".advice b")?.textContent;
  const answer = (link, question, text) => element("li", {}, element("a", {href: link}, question), element("br"), text);
  home.append(element("ul", {class: "answers"},
    answer("#digits", "Which library is wrong, where, by how many digits?", failed.length ? `${whoIsWrong(failed)} Open a cell of the table.`
      : unique(numbers.records.flatMap(r => r.wrong_calls ?? []).map(c => c.subject)).map(s => `${s} where adapters are probed. `).join("")
        || "None was found to be wrong; the table has every operation."),
    answer("#cost", "What does a digit cost?", front ? `${priceOfDigits()}${advice ? ` For a 1 kHz controller, take ${advice}.` : ""}` : "These records hold no times."),
    answer("#stability", "Are hard cases stable?", !hard.length ? "These records hold no hard cases."
      : hard.some(c => c.failed) ? `Not all. Known difficult inputs that fail: ${bySubject.join(", ")}.` : `Yes: all ${hard.length} known difficult inputs are within budget.`)));
}

// The group of rows in which subjects differ most, by the 99 % lines near 0 and near pi.
function tellingGroup(rows) {
  const spread = some => {
    const tops = subjects.map(s => some.filter(r => r.subject === s && isNumber(r.p99_eps))).filter(own => own.length)
      .map(own => Math.log10(Math.max(1, ...own.map(r => Math.min(r.p99_eps, 1e16)))));
    return tops.length ? Math.max(...tops) - Math.min(...(tops.length > 1 ? tops : [0])) + tops.length / 10 : 0;
  };
  const score = some => {
    const [zero, pi] = Object.keys(KINDS).map(k => some.filter(r => r.axis === k && r.count > 0));
    return zero.length + pi.length ? spread(zero) + spread(pi) + (zero.length && pi.length ? 20 : 0) : -1;
  };
  const scored = groups(rows.filter(r => r.axis !== "none")).map(own => ({own, size: score(own)})).sort((a, b) => b.size - a.size);
  return scored.length && scored[0].size >= 0 ? scored[0].own : null;
}

function fillCover() {
  const section = document.getElementById("cover");
  forget(section);
  const wanted = tellingGroup(visible().filter(r => !chosen.operation || r.operation === chosen.operation));
  if (!wanted) return;
  const {operation, block} = wanted[0], shown = subjects.filter(s => !chosen.hidden.has(s));
  const silent = shown.filter(s => !wanted.some(r => r.subject === s));
  const missing = silent.length ? ` Not offered or not measured: ${silent.join(", ")}.` : "";
  section.append(heading("h2", "cover", `${subjects.length > 1 ? "Where the libraries differ most" : "Where the library errs most near 0 and near π"}: ${operation}, ${block}, ${chosen.scalar}`),
    element("figure", {}, legend(wanted, Object.keys(STATISTICS), true), charts(wanted, Object.keys(STATISTICS), undefined, true),
      element("figcaption", {}, `${caption(wanted, true)}${missing}`)));
}

const anchorOf = (id, text) => element("a", {class: "anchor", href: `#${id}`, "aria-label": `Link to: ${text}`}, "#");

// A heading with a link to itself.
function heading(name, id, text) {
  return element(name, {id: `${id}-title`}, text, anchorOf(id, text));
}
