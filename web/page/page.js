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
  changed();
}

/* What else is to be known. */
function notice(text) {
  byId("notice").textContent = text;
  byId("notice").hidden = !text;
}

function edit(change, options) {
  const next = copyOf(state);
  change(next);
  set(next, options);
}

function step(from, to) {
  if (!from.length) return;
  to.push(copyOf(state));
  state = from.pop();
  changed();
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
  const sizes = state.points.flatMap(frame.to).map(Math.abs);
  return sizes.some(size => !(size < 1.5)) || Math.max(...sizes) < 0.1;
}

const BROKEN_LINK = "The link is incomplete or damaged, so nothing of it is shown.";
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
      headline("bad", "No answer.", error.message);
      draw();
    }
  });
}

let linkTimer;
function link() {
  clearTimeout(linkTimer);
  linkTimer = setTimeout(() => history.replaceState(null, "", address()), 250);
}

function address() {
  const { yaw, pitch, zoom } = view.camera;
  return linkOf(state, { time, view: [yaw, pitch, zoom].map(x => Number(x.toFixed(4))) });
}

function load(query) {
  const next = stateOf(query, state?.thresholds ?? PUBLISHED);
  frame = null;
  set(next, { fit: true });
  view.selected = null;
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) start();
}

/* The motion */

const view = new View(byId("canvas"), {
  select: k => fields(k),
  start: (k, alone) => {
    view.unmoved = copyOf(state);
    const mate = (k + 4) % 8;
    const isAtRest = state.points[k].every((x, axis) => x === state.points[mate][axis]);
    view.moved = isAtRest && byId("rest").checked && !alone ? [k, mate] : isAtRest && k < 4 ? [mate] : [k];
  },
  drag: (_, to) => {
    if (view.unmoved) [past, future, view.unmoved] = [[...past, view.unmoved], [], null];
    edit(next => {
      const place = byId("snap").checked ? to.map(rounded) : to;
      if (place.every(Number.isFinite)) for (const k of view.moved) next.points[k] = [...place];
    }, { remember: false });
  },
  stop: () => changed(),
  turn: () => { view.draw(); link(); },
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
  const radius = state.radius[0] + state.radius[1];
  view.show({ ...state, radius, frame, time, contacts: contacts(), toi: said?.impact?.below, missed: isMissed() });
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

/* Opens what a link says; whether it says something. */
function open(hash) {
  const linked = readLink(hash);
  if (!linked) return false;
  if (linked.view) view.look(...linked.view);
  time = Math.max(0, Math.min(1, linked.time));
  frame = null;
  set(linked.state, { fit: true });
  return true;
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
  if (!open(location.hash)) {
    load(gallery[0].entries[0].query);
    if (location.hash.length > 1) notice(BROKEN_LINK);
  }
  document.documentElement.dataset.ready = Math.round(performance.now());
}

main();
