// The map: the error over the angle and the scale of the translation, a small panel for each library, log-log. The left
// half of a panel is theta from 1e-16 to 1, the right half pi - theta from 1 to 1e-16, so that a cliff is a line.

const mapsOf = numbers.records.flatMap(r => r.maps ? r.maps.panels.map(p => ({...p, scales: r.maps.scales, angles: r.maps.angles})) : []);
const CELL = {width: 8, height: 13, left: 40, top: 4};  // [px]; the left margin holds the labels of the scales

const isWrong = error => typeof error === "string";  // "inf": NaN or Inf, wrong branch, or no result
const heavier = (a, b) => a === null ? b : b === null || isWrong(a) ? a : isWrong(b) ? b : Math.max(a, b);
const worstOnMap = errors => errors.flat().reduce(heavier, null);
const weight = error => isWrong(error) ? 17 : Math.log10(Math.max(1, error ?? 1));

// The operation and block whose maps show most, of those chosen; of each subject one panel, with the larger error of all laws.
function tellingMap() {
  const groups = new Map();
  for (const p of mapsOf) {
    if (p.scalar !== drawnScalar() || chosen.hidden.has(p.subject) || (chosen.operation && p.operation !== chosen.operation)) continue;
    const key = `${p.operation}, ${p.block}`, group = groups.get(key) ?? groups.set(key, new Map()).get(key), old = group.get(p.subject);
    group.set(p.subject, !old ? p : {...p, errors: p.errors.map((row, i) => row.map((e, j) => heavier(e, old.errors[i][j])))});
  }
  const score = panels => panels.reduce((n, p) => n + weight(worstOnMap(p.errors)), panels.length / 10);
  return [...groups.values()].map(g => [...g.values()]).sort((a, b) => score(b) - score(a))[0] ?? [];
}

const rangeText = (low, factor) => `${power(Math.round(Math.log10(low)))} to ${power(Math.round(Math.log10(low * factor)))}`;
const mapWords = error => error === null ? "not measured" : isWrong(error) ? "NaN or Inf, wrong branch or no result" : `${short(error)} eps`;
function placeWords(panel, row, column) {
  const {axis, low} = panel.angles[column];
  return `${axis === "theta" ? "θ" : "π − θ"} ${rangeText(low, 10)} rad, translation ${rangeText(panel.scales[row], 100)} m`;
}

function mapPanel(panel, tell) {
  const make = (name, attributes, ...children) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.append(...children);
    return node;
  };
  const {scales, angles, errors} = panel, {width, height, left, top} = CELL;
  const half = angles.findIndex(a => a.axis !== "theta"), gap = column => column >= half && half > 0 ? 6 : 0;
  const x = column => left + column * width + gap(column), y = row => top + (scales.length - 1 - row) * height;
  const right = x(angles.length), bottom = top + scales.length * height;
  const worst = worstOnMap(errors), at = errors.flatMap((r, i) => r.map((e, j) => [e, i, j])).find(([e]) => e === worst);
  const svg = make("svg", {viewBox: `0 0 ${right + 20} ${bottom + 32}`, role: "img", "aria-label":
    `${panel.operation}, ${panel.block}, of ${panel.subject}: largest error ${mapWords(worst)}${at ? `, at ${placeWords(panel, at[1], at[2])}` : ""}`});
  const paths = new Map();
  errors.forEach((line, row) => line.forEach((error, column) => {
    const look = error === null ? "none" : isWrong(error) ? "wrong" : Math.min(16, Math.ceil(weight(error)));
    const outline = look === "none" ? `M${x(column)} ${y(row) + height}l${width} ${-height}` : `M${x(column)} ${y(row)}h${width}v${height}h${-width}z`;
    paths.set(look, (paths.get(look) ?? "") + outline);
  }));
  for (const [look, d] of paths) svg.append(make("path", {d, ...typeof look === "number" ? {class: "heat", "fill-opacity": look / 16} : {class: look}}));
  for (const [from, to] of [[0, half], [half, angles.length]])
    if (to > from) svg.append(make("rect", {x: x(from), y: top, width: (to - from) * width, height: bottom - top, class: "frame"}));
  const label = (text, at, down, anchor = "middle") => svg.append(make("text", {x: at, y: down, "text-anchor": anchor}, text));
  scales.forEach((low, row) => { if (row % 2 === 0) label(power(Math.round(Math.log10(low))), left - 4, y(row) + height + 3, "end"); });
  angles.forEach(({axis, low}, column) => {
    const e = Math.round(Math.log10(low));
    if (e % 4 === 0 && e < 0) label(power(e), axis === "theta" ? x(column) : x(column) + width, bottom + 12);
  });
  if (half > 0) label("1", x(half) - 3, bottom + 12);
  label("θ [rad]", x(0) + half * width / 2, bottom + 26);
  if (half < angles.length) label("π − θ [rad]", x(half) + (angles.length - half) * width / 2, bottom + 26);
  svg.addEventListener("pointermove", event => {
    const box = svg.getBoundingClientRect(), unit = (right + 20) / box.width;
    const px = (event.clientX - box.left) * unit, py = (event.clientY - box.top) * unit;
    const column = angles.findIndex((_, i) => px >= x(i) && px < x(i) + width), row = scales.findIndex((_, i) => py >= y(i) && py < y(i) + height);
    if (column >= 0 && row >= 0) tell(`${panel.subject}: ${placeWords(panel, row, column)}: ${mapWords(errors[row][column])}.`);
  });
  return element("figure", {class: "map"}, element("figcaption", {}, swatch(panel.subject), element("b", {}, panel.subject), ` worst: ${mapWords(worst)}`), svg);
}

function mapLegend() {
  const item = (text, ...style) => element("li", {}, element("span", {class: "heat-box", style: style.join(";")}), text);
  return element("ul", {class: "legend", "aria-label": "Legend"}, ...[0, 4, 8, 12, 16].map(e =>
    item(e ? `${power(e)} eps` : "1 eps or less", `background: color-mix(in srgb, var(--ink) ${e / .16}%, transparent)`)),
  item("NaN or Inf, wrong branch or no result", "background: var(--bad)"), item("no such number in this scalar", "background: repeating-linear-gradient(135deg, var(--soft) 0 1px, transparent 1px 4px)"));
}

function fillMap() {
  const home = document.getElementById("map-panels"), panels = tellingMap(), title = document.getElementById("map-what");
  document.getElementById("map").hidden = !mapsOf.length;
  title.textContent = panels.length ? `${panels[0].operation}, ${panels[0].block}, ${drawnScalar()}.` : "This operation has no translation, or nobody was asked for it.";
  const said = element("p", {class: "note", "aria-live": "off"}, panels.length ? "Point at a panel to read one cell." : "");
  home.replaceChildren(...panels.length ? [mapLegend()] : [], element("div", {class: "maps"}, ...panels
    .sort((a, b) => subjects.indexOf(a.subject) - subjects.indexOf(b.subject)).map(p => mapPanel(p, text => { said.textContent = text; }))), said);
}
