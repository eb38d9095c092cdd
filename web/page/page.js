"use strict";
// The page: the state, what changes it, and everything that shows it.

const byId = id => document.getElementById(id);
const element = (name, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
};
const COORDINATES = ["x", "y", "z"];
const gallery = JSON.parse(byId("gallery-data").textContent);
const finds = { title: "Found here", entries: [] };

let judge, state, frame, unit, said = null, time = 0, playing = false, before = 0, field = null, worker = null;
let past = [], future = [];
// What was chosen of the gallery; whether the link of the address stays, as it is damaged and nothing was changed since.
let chosen = null, keepsLink = false;

/* Changing the state */

const rounded = value => Math.round(value / unit) * unit || 0;

function set(next, { remember = true, fit = false } = {}) {
  if (remember && state) {
    past.push(copyOf(state));
    if (past.length > 500) past.shift();
    future = [];
  }
  state = next;
  notice("");
  if (fit || !frame) refit();
  keepsLink = false;
  changed();
}

const TOO_LARGE = "A coordinate would be beyond the largest f64, so nothing is changed.";

/* What else is to be known. */
function notice(text) {
  byId("notice").textContent = text;
  byId("notice").hidden = !text;
}

function edit(change, options) {
  const next = copyOf(state);
  change(next);
  if (!next.points.flat().every(Number.isFinite)) return notice(TOO_LARGE);
  set(next, options);
}

function step(from, to) {
  if (!from.length) return;
  to.push(copyOf(state));
  set(from.pop(), { remember: false });
}

function refit() {
  frame = frameOf(state.points);
  unit = 2 ** Math.max(-1074, Math.min(1023, Math.floor(Math.log2(frame.unit / 6))));
  const power = Math.log2(unit);
  const raised = String(power).replace(/./g, sign => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]);
  byId("unit").textContent = power >= 0 && power < 14 ? unit : power < 0 && power > -6 ? `1/${1 / unit}` : `2${raised}`;
}

/* Whether the picture shows too little of the motion, or it too small. */
function isAstray() {
  const points = state.points.map(frame.to), along = [0, 1, 2].map(axis => points.map(point => point[axis]));
  const size = Math.max(...along.map(of => Math.max(...of) - Math.min(...of)));
  return !points.flat().every(x => Math.abs(x) < 1.5) || size < 0.25;
}

let isWaiting = false;
function changed() {
  if (!view.dragged && isAstray()) refit();
  byId("undo").disabled = !past.length;
  byId("redo").disabled = !future.length;
  fields();
  draw();
  link();
  if (isWaiting) return;
  isWaiting = true;
  requestAnimationFrame(async () => {
    isWaiting = false;
    const asked = state;
    try {
      const answer = await judge.ask({ ask: "explain", query: queryOf(asked), thresholds: asked.thresholds });
      if (asked === state) said = answer;
      if (asked === state) tell();
    } catch (error) {
      said = null;
      silence(error.message);
      draw();
    }
  });
}

let linkTimer;
function link(isByUser = false) {
  if (isByUser) keepsLink = false;
  clearTimeout(linkTimer);
  linkTimer = setTimeout(() => keepsLink || history.replaceState(null, "", address()), 250);
}

function address() {
  const { yaw, pitch, zoom } = view.camera;
  return linkOf(state, { time, view: [yaw, pitch, zoom].map(x => Number(x.toFixed(4))) });
}

/* Shows a motion of the gallery. */
function load({ id, title, query }) {
  const next = stateOf(query, state?.thresholds ?? PUBLISHED);
  chosen = { id, title, text: JSON.stringify(queryOf(next)) };
  set(next, { fit: true });
  view.selected = null;
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) start();
}

/* The motion */

const view = new View(byId("canvas"), {
  select: () => selection(),
  start: (k, alone) => {
    view.unmoved = copyOf(state);
    const mate = (k + 4) % 8;
    const isAtRest = state.points[k].every((x, axis) => x === state.points[mate][axis]);
    view.moved = isAtRest && byId("rest").checked && !alone ? [k, mate] : isAtRest && k < 4 ? [mate] : [k];
  },
  drag: (_, to) => {
    const place = byId("snap").checked ? to.map(rounded) : to;
    if (!place.every(Number.isFinite)) return notice(TOO_LARGE);
    if (view.unmoved) [past, future, view.unmoved] = [[...past, view.unmoved], [], null];
    edit(next => { for (const k of view.moved) next.points[k] = [...place]; }, { remember: false });
  },
  stop: () => changed(),
  turn: () => { view.draw(); link(true); },
});

function contacts() {
  const { impact } = said ?? {};
  if (!impact) return [];
  const points = state.points.map(frame.to), at = k => V.mix(points[k], points[k + 4], impact.below);
  if (state.kind === "vertex-face") return [at(0)];
  return impact.parameters.map(([u]) => V.mix(at(0), at(1), u));
}

const isMissed = () => !!said?.subjects.some(subject => subject.name === "thesis" && subject.faults.some(fault => fault === "tunnel" || fault === "missed graze"));

function draw() {
  if (!state) return;
  view.show({ ...state, radius: frame.radius(state.radius), frame, time, contacts: contacts(), toi: said?.impact?.below, missed: isMissed() });
  byId("time").value = time;
  byId("now").textContent = `t = ${time.toFixed(3)}`;
  for (const id of ["f-chart", "d-chart"]) moveNow(byId(id), time);
}

function start() {
  playing = true;
  if (time >= 1) time = 0;
  before = performance.now();
  byId("play").textContent = "Pause";
  requestAnimationFrame(tick);
}

function pause() {
  playing = false;
  byId("play").textContent = "Play";
}

function tick(now) {
  if (!playing) return;
  time = Math.min(1, time + Math.max(0, now - before) / 3500);
  before = now;
  draw();
  if (time < 1) return requestAnimationFrame(tick);
  pause();
  link();
}

/* Opens what a link says, without one the first motion of the gallery; and says what is wrong with the link. */
function open(hash) {
  const linked = hash.length > 1 ? readLink(hash) : { wrong: [] };
  if (linked.state) {
    if (linked.view) view.look(...linked.view);
    time = linked.time;
    chosen = null;
    set(linked.state, { fit: true });
  } else if (!state) {
    load(gallery[0].entries[0]);
    chosen = null;
    galleryLabel();
  }
  if (!linked.wrong.length) return;
  notice(`The link is damaged: ${linked.wrong.join("; ")}. ${linked.state ? "All else of it is shown." : "Nothing of it is shown."}`);
  keepsLink = true;
}

async function main() {
  makeFields();
  makeGallery();
  byId("legend").innerHTML = `<i class="dot"></i> start <i class="dot hollow"></i> end <i class="dot ring"></i> first contact`;
  try {
    judge = new Judge(await unpack(byId("module").textContent));
  } catch (error) {
    return headline("bad", "This browser cannot run the judge.", error.message);
  }
  listen();
  open(location.hash);
  document.documentElement.dataset.ready = Math.round(performance.now());
}

main();
