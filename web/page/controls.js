"use strict";
// The fields, the search, and everything that the user does.

/* Fields */

const nameOf = k => `${NAMES[k % 4]} ${k < 4 ? "start" : "end"}`;

function makeFields() {
  for (let k = 0; k < 8; k++) {
    const point = (k >> 1) + (k & 1 ? 4 : 0);
    const inputs = COORDINATES.map((axis, index) => {
      const input = element("input", { inputMode: "decimal", spellcheck: false, autocomplete: "off", ariaLabel: `${nameOf(point)} ${axis}` });
      input.dataset.at = `${point} ${index}`;
      return element("td", {}, input);
    });
    byId("points").tBodies[0].append(element("tr", {}, element("th", { scope: "row", textContent: `${NAMES[point % 4]}${point > 3 ? "′" : ""}`, title: nameOf(point) }), ...inputs));
  }
  byId("thresholds").append(...THRESHOLDS.map(([name, about, unit], k) => {
    const range = element("input", { type: "range", min: -18, max: 3, step: 0.1, ariaLabel: name });
    const number = element("input", { inputMode: "decimal", spellcheck: false, autocomplete: "off", ariaLabel: `${name}, exactly` });
    range.dataset.threshold = number.dataset.threshold = k;
    return element("div", { className: "threshold" }, element("code", { textContent: name }), number, range, element("small", { textContent: `${about}; in ${unit}` }));
  }));
}

/* Every field shows the state, but for one that is being typed in. */
function fields() {
  if (!state) return;
  for (const input of document.querySelectorAll("#points input")) {
    const [point, axis] = input.dataset.at.split(" ").map(Number);
    write(input, written(state.points[point][axis]));
  }
  for (const input of document.querySelectorAll("#thresholds input")) {
    const value = state.thresholds[Number(input.dataset.threshold)];
    write(input, input.type === "range" ? (value > 0 ? Math.log10(value) : -18) : written(value));
  }
  write(byId("radius"), state.radius[1] ? state.radius.map(written).join(" + ") : written(state.radius[0]));
  byId("kind").value = state.kind;
  byId("shell").textContent = `echo '${JSON.stringify(queryOf(state))}' | tunnelproof explain -`;
  galleryLabel();
  selection();
}

function write(input, text) {
  if (input === document.activeElement && input.dataset.is === "typed") return;
  input.value = input.title = text;
  input.removeAttribute("aria-invalid");
}

/* The point that is selected, in the fields. */
function selection() {
  for (const row of byId("points").rows) row.className = Number(row.querySelector("input").dataset.at.split(" ")[0]) === view.selected ? "selected" : "";
  exactField();
}

function exactField() {
  const [point, axis] = (field ?? `${view.selected ?? 0} 0`).split(" ").map(Number), value = state.points[point][axis];
  byId("exact").textContent = `${nameOf(point)} ${COORDINATES[axis]} = ${hexadecimal(value)}\nexactly ${shortened(exactDecimal(value), 120)}`;
}

/* Applies the numbers that were typed, or says what is wrong with them. */
function typed(input, apply, { isSize = false, most = 1 } = {}) {
  input.dataset.is = "";
  const parts = most > 1 ? input.value.split("+") : [input.value];
  const wrong = parts.length > most ? `At most ${most} numbers are added.` : parts.map(part => refusal(part, isSize)).find(Boolean);
  if (wrong) {
    input.setAttribute("aria-invalid", true);
    return notice(`${wrong} Nothing is changed.`);
  }
  apply(parts.map(read));
}

/* Searching */

const FAMILIES = ["near_coplanar", "temporarily_parallel", "near_parallel", "point_on_line", "lattice", "grazing", "temporarily_point", "triple_root"];

function find() {
  cancel();
  const text = `${byId("engine").textContent}\n${byId("worker").textContent}`;
  worker = new Worker(URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
  const seed = crypto.getRandomValues(new Uint32Array(1))[0], fault = byId("fault").value;
  byId("search").hidden = false;
  byId("progress").removeAttribute("value");
  byId("searching").textContent = "Asking about random motions…";
  worker.onmessage = ({ data }) => {
    if (data.asked) byId("searching").textContent = `${data.asked.toLocaleString("en")} motions asked about…`;
    if (data.bits) byId("searching").textContent = `Found one. Making it smaller: ${data.before} bits, now ${data.bits}…`;
    if (data.error || data.none) {
      cancel();
      headline("warn", "Nothing found.", data.error ?? `The method is right, in this, on ${data.none.toLocaleString("en")} motions. Try other thresholds.`);
    }
    if (!data.found) return;
    cancel();
    const { found, smaller } = data, name = found.query.id;
    finds.entries.unshift({ id: `${name}/shrunk`, title: `${fault}, shrunk from ${name}`, query: smaller.query }, { id: name, title: `${fault}, as found: ${name}`, query: found.query });
    makeGallery();
    load(finds.entries[0]);
  };
  worker.postMessage({ module: judge.module, families: FAMILIES, fault, thresholds: state.thresholds, seed });
}

function cancel() {
  worker?.terminate();
  worker = null;
  byId("search").hidden = true;
}

function makeGallery() {
  const groups = finds.entries.length ? [finds, ...gallery] : gallery;
  byId("gallery").replaceChildren(element("option", { value: "", textContent: "Gallery…" }), ...groups.map(group => element("optgroup", { label: group.title },
    ...group.entries.map(entry => element("option", { value: entry.id, textContent: entry.title })))));
}

/* Which motion of the gallery is shown, and whether it was changed since. */
function galleryLabel() {
  const isSame = chosen?.text === JSON.stringify(queryOf(state));
  byId("gallery").options[0].textContent = !chosen || isSame ? "Gallery…" : `Changed: ${chosen.title}`;
  byId("gallery").value = isSame ? chosen.id : "";
}

/* What the user does */

function listen() {
  const on = (id, name, to) => byId(id).addEventListener(name, to);
  on("play", "click", () => playing ? pause() : start());
  on("time", "input", event => { pause(); time = Number(event.target.value); draw(); link(true); });
  on("undo", "click", () => step(past, future));
  on("redo", "click", () => step(future, past));
  on("find", "click", find);
  on("cancel", "click", cancel);
  on("gallery", "change", event => {
    const entry = [finds, ...gallery].flatMap(group => group.entries).find(({ id }) => id === event.target.value);
    if (entry) { time = 0; load(entry); }
  });
  on("fit", "click", () => { refit(); Object.assign(view.camera, { yaw: 0.6, pitch: 0.42, zoom: 1 }); changed(); link(true); });
  on("zoom-in", "click", () => view.zoom(1.25));
  on("zoom-out", "click", () => view.zoom(0.8));
  on("snap", "change", () => byId("snap").checked && edit(next => { next.points = next.points.map(point => point.map(rounded)); }));
  on("kind", "change", event => edit(next => { next.kind = event.target.value; }));
  on("smaller", "click", () => scale(0.5));
  on("larger", "click", () => scale(2));
  on("reset", "click", () => edit(next => { next.thresholds = [...PUBLISHED]; }));
  on("link", "click", () => copy(byId("link"), location.href.replace(/#.*/, "") + address()));
  on("copy", "click", () => copy(byId("copy"), byId("shell").textContent));
  on("radius", "input", event => { event.target.dataset.is = "typed"; });
  on("radius", "change", event => typed(event.target, parts => edit(next => { next.radius = [parts[0], parts[1] ?? 0]; }), { isSize: true, most: 2 }));
  pointFields();
  thresholdFields();
  addEventListener("keydown", keys);
  new ResizeObserver(draw).observe(view.canvas);
  addEventListener("hashchange", () => open(location.hash));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
}

function pointFields() {
  const box = byId("points");
  const at = input => input.dataset.at.split(" ").map(Number);
  box.addEventListener("focusin", ({ target }) => { field = target.dataset.at; view.selected = at(target)[0]; selection(); view.draw(); });
  box.addEventListener("input", ({ target }) => { target.dataset.is = "typed"; });
  box.addEventListener("change", ({ target }) => {
    const [point, axis] = at(target);
    typed(target, ([value]) => edit(next => { next.points[point][axis] = value; }));
  });
  box.addEventListener("keydown", event => {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!way) return;
    event.preventDefault();
    const [point, axis] = at(event.target);
    event.target.dataset.is = "";
    edit(next => { next.points[point][axis] = nudged(next.points[point][axis], way * (event.shiftKey ? 1024 : 1)); });
  });
}

function thresholdFields() {
  const box = byId("thresholds");
  const put = (input, value) => edit(next => { next.thresholds[Number(input.dataset.threshold)] = value; });
  box.addEventListener("input", ({ target }) => {
    if (target.type !== "range") { target.dataset.is = "typed"; return; }
    const power = Number(target.value);
    put(target, power <= -18 ? 0 : Number((10 ** power).toPrecision(2)));
  });
  box.addEventListener("change", ({ target }) => {
    if (target.type !== "range") typed(target, ([value]) => put(target, value), { isSize: true });
  });
}

function scale(factor) {
  const points = state.points.map(point => scaled(point, factor)), radius = scaled(state.radius, factor);
  if (!radius || points.includes(null)) return notice("A coordinate or the radius has no exact f64 there, so nothing is scaled.");
  edit(next => { Object.assign(next, { points, radius }); }, { fit: true });
}

function keys(event) {
  const isField = event.target.matches("input:not([type=range]), select");
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z" && !isField) {
    event.preventDefault();
    return event.shiftKey ? step(future, past) : step(past, future);
  }
  if (isField || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === " " && !event.target.matches("button")) { event.preventDefault(); return playing ? pause() : start(); }
  if (event.target !== view.canvas) return;
  if (event.key.toLowerCase() === "n") {
    view.selected = ((view.selected ?? (event.shiftKey ? 8 : -1)) + (event.shiftKey ? 7 : 1)) % 8;
    field = null;
    selection();
    return view.draw();
  }
  const ways = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [1, 1], ArrowDown: [1, -1], PageUp: [2, -1], PageDown: [2, 1] };
  const [along, way] = ways[event.key] ?? [];
  if (way === undefined || view.selected === null) return;
  event.preventDefault();
  // Along the axis that runs most nearly that way on the screen.
  const towards = view.axes[along], axis = COORDINATES.map((_, k) => k).sort((a, b) => Math.abs(towards[b]) - Math.abs(towards[a]))[0];
  edit(next => { next.points[view.selected][axis] += way * Math.sign(towards[axis]) * unit * (byId("snap").checked ? 1 : 0.125); });
}

async function copy(button, text) {
  const label = button.dataset.label ??= button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = "Copied";
  } catch {
    prompt("Copy this:", text);
  }
  setTimeout(() => { button.textContent = label; }, 1200);
}
