"use strict";

const witnesses = JSON.parse(document.getElementById("witnesses").textContent);
const tables = [...document.querySelectorAll("table.bench")];

// Sorting.
for (const table of tables) table.tHead.addEventListener("click", (event) => {
  const button = event.target.closest("button");
  if (!button) return;
  const head = button.closest("th");
  const column = head.cellIndex;
  const isUp = head.getAttribute("aria-sort") !== "ascending";
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", isUp ? "ascending" : "descending");
  const key = (row) => column === 0 ? row.cells[0].textContent.trim().toLowerCase() : Number(row.cells[column].dataset.value);
  const rows = [...table.tBodies[0].rows];
  rows.sort((a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0) * (isUp ? 1 : -1));
  table.tBodies[0].append(...rows);
});

// Vectors.
const plus = (p, q, by = 1) => p.map((x, k) => x + by * q[k]);
const minus = (p, q) => plus(p, q, -1);
const dot = (p, q) => p.reduce((sum, x, k) => sum + x * q[k], 0);
const length = (p) => Math.hypot(...p);

const section = document.getElementById("witness");
const canvas = section.querySelector("canvas");
const slider = section.querySelector("input");
const output = section.querySelector("output");
let shown = null;

// What is drawn: where the points of each body are at a time, the radii, and which bodies move. A body is its first point and
// the ways from there to others, of which it is all sums (of a triangle those with weights up to 1 together).
function sceneOf(witness) {
  if (witness.poses) return turning(witness);
  const { points, passing, radii } = translated(witness);
  const at = (body, time) => points[body].map((p) => (body === 0 ? plus(p, passing, time) : p));
  return { at, radii, moving: [0], passing: length(passing), frame: "It moves with the second body. " };
}

// Bodies whose centres and quaternions move on lines, in space.
function turning(witness) {
  const count = witness.kind === "turning-vertex-turning-face" ? 1 : 2;
  const local = witness.local.map((point) => point.map(Number));
  const poses = witness.poses.map((pose) => pose.map(Number));
  const base = poses[2].slice(0, 3);
  const at = (body, time) => {
    const [start, end] = poses.slice(2 * body, 2 * body + 2);
    const sign = dot(start.slice(3), end.slice(3)) < 0 ? -1 : 1;
    const mean = (p, q, by = 1) => p.map((x, k) => (1 - time) * x + time * by * q[k]);
    const centre = minus(mean(start.slice(0, 3), end.slice(0, 3)), base);
    const rotation = mean(start.slice(3), end.slice(3), sign);
    return (body === 0 ? local.slice(0, count) : local.slice(count)).map((point) => plus(centre, rotated(rotation, point)));
  };
  const radii = [witness.radius].flat().map(Number);
  const paths = [0, 1].flatMap((body) => at(body, 0).map((p, i) => length(minus(at(body, 1)[i], p))));
  return { at, radii: [radii[0], radii[1] ?? 0], moving: [0, 1], passing: Math.min(0.5, ...paths), frame: "Both bodies move. " };
}

function rotated([w, ...v], point) {
  const cross = (p, q) => [0, 1, 2].map((k) => p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]);
  const turn = cross(v, point).map((x) => 2 * x);
  return plus(point, plus(turn.map((x) => w * x), cross(v, turn)), 1 / (w * w + dot(v, v)));
}

// The points at the start, in the frame of the second body, and how the first passes it.
function translated(witness) {
  const { bodies } = witness;
  if (bodies) {
    const base = bodies[1].points[0];
    const points = bodies.map(({ points }) => points.map((point) => minus(point, base)));
    return { points, passing: minus(bodies[0].step, bodies[1].step), radii: bodies.map(({ radius }) => radius) };
  }
  const isFace = witness.kind === "vertex-face";
  const numbers = witness.points.map((point) => point.map(Number));
  const sides = isFace ? [[0], [1, 2, 3]] : [[0, 1], [2, 3]];
  const step = (i) => minus(numbers[i + 4], numbers[i]);
  const passing = minus(step(sides[0][0]), step(sides[1][0]));
  const base = numbers[sides[1][0]];
  const points = sides.map((side) => side.map((i) => minus(numbers[i], base)));
  const radii = [witness.radius].flat().map(Number);
  return { points, passing, radii: [radii[0], radii[1] ?? 0] };
}

function timeOf(toi) {
  if (toi === null || toi === undefined) return null;
  return Number(typeof toi === "object" ? toi.below : toi);
}

// A point of a body by as many numbers from 0 to 1 as it has ways: of a triangle v turns from one way to the other.
function span(points, [u, v, w]) {
  const ways = points.slice(1).map((point) => minus(point, points[0]));
  const weights = ways.length === 2 ? [u * (1 - v), u * v] : [u, v, w];
  return ways.reduce((sum, way, i) => plus(sum, way, weights[i]), points[0]);
}

// About where the two are nearest at a time: by samples, finer and finer.
function nearest(scene, time) {
  const both = [0, 1].map((body) => scene.at(body, time));
  const count = both[0].length + both[1].length - 2;
  const grid = count > 3 ? [-1, 0, 1] : [-1, -0.5, 0, 0.5, 1];
  let best = { distance: Infinity, places: Array(count).fill(0.5) };
  for (let reach = 0.5; reach > 1e-8; reach *= 0.6) {
    const start = best.places;
    for (let sample = 0; sample < grid.length ** count; sample += 1) {
      const places = start.map((x, i) => Math.min(1, Math.max(0, x + reach * grid[Math.floor(sample / grid.length ** i) % grid.length])));
      const [p, q] = [span(both[0], places), span(both[1], places.slice(both[0].length - 1))];
      const distance = length(minus(p, q));
      if (distance < best.distance) best = { distance, places, p, q };
    }
  }
  return best;
}

function show(button, scrolls = true) {
  const witness = witnesses[button.dataset.witness];
  const scene = sceneOf(witness);
  const [exact, said] = [timeOf(witness.exact), timeOf(witness.said)];
  const time = exact ?? said ?? 0.5;
  const { p, q } = nearest(scene, time);
  const sizes = [0, 1].map((body) => scene.at(body, 0)).map((body) => Math.max(...body.map((point) => length(minus(point, body[0])))));
  const reach = Math.max(scene.radii[0] + scene.radii[1], scene.passing * 0.6, Math.min(...sizes) * 0.6, 1e-9);
  section.querySelector("#frame").textContent = scene.frame;
  shown = { scene, centre: plus(p, minus(q, p), 0.5), reach, turn: [0.6, 0.4], zoom: 1, exact, said };
  for (const other of document.querySelectorAll("[data-witness][aria-pressed]")) other.removeAttribute("aria-pressed");
  button.setAttribute("aria-pressed", "true");
  section.hidden = false;
  section.querySelector("h2").textContent = `${witness.method}: ${title(witness)}`;
  section.querySelector("#said").textContent = `Exact answer: ${answer(exact !== null, exact)}. It says: ` +
    (witness.lapse ? `nothing (${witness.lapse.kind})` : answer(witness.is_hit, said)) + ".";
  section.querySelector("pre").textContent = `tunnelproof explain ${witness.id}`;
  slider.value = time;
  draw();
  if (scrolls) section.scrollIntoView({ block: "nearest" });
}

const answer = (isHit, time) => (isHit ? `contact at ${time} of the step` : "no contact");

function title(witness) {
  const by = witness.severity === null ? "" : Number(witness.severity).toPrecision(3);
  const words = {
    missed: witness.fault === "tunnel" ? "missed, one passes through the other" : "missed contact",
    within: "missed contact, with margin",
    start: "missed contact at the start",
    false: `false hit, ${by} m apart at the least`,
    late: `late by ${by} of the step`,
    early: `early by ${by} of the step`,
    crashed: "no answer",
  };
  return `${words[witness.key]} (${witness.id})`;
}

function draw() {
  if (!shown) return;
  const { scene, centre, reach, turn, zoom } = shown;
  const time = Number(slider.value);
  output.textContent = time.toFixed(3);
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  const scale = (0.42 * Math.min(width, height) * zoom) / reach;
  const [ca, sa, cb, sb] = [Math.cos(turn[0]), Math.sin(turn[0]), Math.cos(turn[1]), Math.sin(turn[1])];
  const place = (point) => {
    const [x, y, z] = minus(point, centre);
    const [u, v] = [ca * x + sa * y, ca * y - sa * x];
    return [width / 2 + scale * u, height / 2 - scale * (cb * z + sb * v)];
  };
  const style = getComputedStyle(document.body);
  const colours = ["--red", "--blue"].map((name) => style.getPropertyValue(name));
  const body = (which, when, alpha) => {
    const points = scene.at(which, when).map(place);
    context.globalAlpha = alpha;
    context.strokeStyle = context.fillStyle = colours[which];
    context.lineCap = context.lineJoin = "round";
    const paths = points.length === 4 ? facesOf(points) : [points];
    for (const face of paths) {
      path(context, face);
      context.lineWidth = Math.max(2 * scene.radii[which] * scale, 0.5);
      context.stroke();
      if (face.length > 2) context.fill();
    }
    context.globalAlpha = Math.min(1, alpha * 2.5);
    context.lineWidth = 1.5;
    for (const face of paths) {
      path(context, face);
      context.stroke();
    }
  };
  for (const which of scene.moving) for (const end of [0, 1]) body(which, end, 0.12);
  for (const which of [1, 0]) body(which, time, 0.4);
  context.globalAlpha = 1;
}

// The faces of a box from a corner and those beside it.
function facesOf([corner, ...beside]) {
  const ways = beside.map((point) => minus(point, corner));
  return [0, 1, 2].flatMap((normal) => {
    const [p, q] = [ways[(normal + 1) % 3], ways[(normal + 2) % 3]];
    return [corner, beside[normal]].map((at) => [at, plus(at, p), plus(plus(at, p), q), plus(at, q)]);
  });
}

function path(context, points) {
  context.beginPath();
  context.moveTo(...points[0]);
  points.slice(1).forEach((point) => context.lineTo(...point));
  // A line without length is not drawn, not even its round ends.
  if (points.length === 1) context.lineTo(points[0][0] + 0.01, points[0][1]);
  if (points.length > 2) context.closePath();
}

for (const table of tables) table.tBodies[0].addEventListener("click", (event) => {
  const button = event.target.closest("[data-witness]");
  if (button) show(button);
});
slider.addEventListener("input", draw);
addEventListener("resize", draw);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);

// Turning and zooming, with one pointer or two.
const pointers = new Map();
const apart = () => {
  const [p, q] = [...pointers.values()];
  return Math.hypot(p[0] - q[0], p[1] - q[1]);
};
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
});
canvas.addEventListener("pointermove", (event) => {
  const before = pointers.get(event.pointerId);
  if (!before) return;
  const distance = pointers.size === 2 ? apart() : 0;
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
  if (pointers.size === 2) shown.zoom *= apart() / (distance || 1);
  else shown.turn = [shown.turn[0] + (event.clientX - before[0]) / 120, shown.turn[1] + (event.clientY - before[1]) / 120];
  draw();
});
for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  shown.zoom *= Math.exp(-event.deltaY / 400);
  draw();
}, { passive: false });

// The worst missed contact, to begin with: one that is deeper than a margin, if there is any.
const worst = (key) => tables[0].querySelector(`tr:not(.own) [data-witness$="/${key}"]`);
const first = worst("within") ?? worst("missed");
if (first) show(first, false);
