// What is chosen lives in the fragment of the address: #scalar=float&operation=exp6&at=digits, where `at` is the heading
// that is shown. A plain fragment such as #cost, as links have it, is a heading.

const fragment = () => location.hash.includes("=") ? new URLSearchParams(location.hash.slice(1))
  : new URLSearchParams(location.hash.length > 1 ? {at: location.hash.slice(1)} : {});

function readState() {
  const state = fragment(), one = (name, known) => known.includes(state.get(name)) ? state.get(name) : "";
  chosen.scalar = one("scalar", scalars);
  chosen.operation = one("operation", operations);
  chosen.region = one("region", REGIONS.map(r => r.key));
  chosen.in = one("in", scalars);
  chosen.hidden = new Set(state.getAll("without").filter(s => subjects.includes(s)));
  const [operation, subject] = (state.get("open") ?? "").split(":");
  chosen.open = operations.includes(operation) && subject ? `${operation}:${state.get("open").slice(operation.length + 1)}` : "";
}

function writeState(at = fragment().get("at")) {
  const state = new URLSearchParams();
  for (const name of ["scalar", "operation", "region", "open", "in"]) if (chosen[name]) state.set(name, chosen[name]);
  for (const s of chosen.hidden) state.append("without", s);
  state.set("at", at || "digits");
  history.replaceState(null, "", `#${state}`);
}

// Unfolds the section of a heading and shows it.
function goTo(at) {
  const target = at && document.getElementById(at);
  if (!target) return;
  const fold = target.matches("details") ? target : target.querySelector(":scope > details");
  if (fold) fold.open = true;
  target.scrollIntoView();
}
