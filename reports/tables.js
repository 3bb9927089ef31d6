// Tables of bands: all figures of the charts, and the worst case of each band with its replay command.

function replayCell(row) {
  if (!row.worst?.id) return element("td", {}, "—");
  const command = `liecheck replay ${row.worst.id}`;
  const button = element("button", {type: "button", "aria-label": `Copy ${command}`}, "copy");
  button.addEventListener("click", () => copy(command, button));
  return element("td", {}, element("code", {class: "replay"}, command), button);
}

async function copy(text, button) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {  // an old browser, or a page from file:// without a clipboard
    const area = element("textarea", {readonly: ""});
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
    button.focus();
  }
  button.textContent = "copied";
  setTimeout(() => { button.textContent = "copy"; }, 1500);
}

const number = text => element("td", {class: "number"}, text);
// A band without cases has no error. It shows "—", because 0 would mean exact results.
const measured = (row, name) => number(row.count > 0 ? short(row[name]) : "—");

// `first` names the columns that, together with the band, identify a row.
function bandTable(caption, rows, first) {
  const heads = [...first, "band", "cases", "max [eps], a lower bound", "p99 [eps]", "median [eps]", "max excess",
    "judged by", "budget", "status", "other outcomes", "worst case"];
  const body = element("tbody");
  for (const row of rows) {
    const cells = [...first.map(name => element("td", {}, row[name])), element("th", {scope: "row"}, row.band),
      number(String(row.count)), measured(row, "max_eps"), measured(row, "p99_eps"), measured(row, "median_eps"),
      measured(row, "max_excess"), element("td", {}, row.rule), number(short(row.budget)),
      element("td", {}, element("span", {class: `status ${row.status}`}, row.status)),
      element("td", {}, outcomes(row).join(", ") || "none"), replayCell(row)];
    body.append(element("tr", {}, ...cells));
  }
  const head = element("thead", {}, element("tr", {}, ...heads.map(h => element("th", {scope: "col"}, h))));
  return element("div", {class: "scroll dense", tabindex: "0", role: "region", "aria-label": caption},
    element("table", {}, element("caption", {}, caption), head, body));
}

// The same table, folded. It is filled when opened, because a page may have tens of thousands of rows.
function foldedTable(caption, rows, first) {
  const fold = element("details", {}, element("summary", {}, `${caption} (${rows.length} rows)`));
  fold.fill = () => { if (fold.children.length === 1) fold.append(bandTable(caption, rows, first)); };
  fold.addEventListener("toggle", () => { if (fold.open) fold.fill(); });
  return fold;
}
