// Fills the page when all scripts are read.

if (results.length) {
  readState();
  fillControls();
  fillDigits();
  fillMap();
  fillFigures();
} else {
  document.getElementById("figures").append("The records hold no results.");
  document.getElementById("axisless").append("The records hold no results.");
}
for (const title of document.querySelectorAll("main h2")) {  // a link to itself beside each heading
  const section = title.closest("section");
  const link = anchorOf(section.id, title.textContent), summary = title.closest("summary");
  summary ? summary.parentElement.before(link) : title.append(link);  // a summary is a button: no link inside it
}
for (const line of document.querySelectorAll(".finding code.replay")) {
  const button = element("button", {type: "button", class: "copy", "aria-label": `Copy ${line.textContent}`}, "copy");
  button.addEventListener("click", () => copy(line.textContent, button));
  line.after(button);
}
document.documentElement.dataset.filled = "yes";
window.addEventListener("beforeprint", toPaper);
window.addEventListener("afterprint", fromPaper);
document.addEventListener("click", event => {  // a link to a heading keeps what is chosen in the address
  const at = event.target.closest("a[href^='#']")?.getAttribute("href").slice(1);
  if (at === undefined || !results.length) return;
  event.preventDefault();
  writeState(at);
  goTo(at);
});
window.addEventListener("hashchange", () => {
  if (results.length) { readState(); setControls(); fillDigits(); fillMap(); fillFigures(); }
  goTo(fragment().get("at"));
});
goTo(fragment().get("at"));
