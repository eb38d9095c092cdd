"use strict";

const witnesses = JSON.parse(document.getElementById("witnesses").textContent);
const bench = document.getElementById("bench");

// Sorting.
bench.tHead.addEventListener("click", (event) => {
  const button = event.target.closest("button");
  if (!button) return;
  const head = button.closest("th");
  const column = head.cellIndex;
  const isUp = head.getAttribute("aria-sort") !== "ascending";
  for (const other of bench.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", isUp ? "ascending" : "descending");
  const key = (row) => column === 0 ? row.cells[0].textContent.trim().toLowerCase() : Number(row.cells[column].dataset.value);
  const rows = [...bench.tBodies[0].rows];
  rows.sort((a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0) * (isUp ? 1 : -1));
  bench.tBodies[0].append(...rows);
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

// What is drawn, in the frame of the second body.
function sceneOf(witness) {
  const isFace = witness.kind === "vertex-face";
  const numbers = witness.points.map((point) => point.map(Number));
  const bodies = isFace ? [[0], [1, 2, 3]] : [[0, 1], [2, 3]];
  const step = (i) => minus(numbers[i + 4], numbers[i]);
  const passing = minus(step(bodies[0][0]), step(bodies[1][0]));
  const base = numbers[bodies[1][0]];
  const points = bodies.map((body) => body.map((i) => minus(numbers[i], base)));
  const radii = [witness.radius].flat().map(Number);
  return { points, passing, radii: [radii[0], radii[1] ?? 0], isFace };
}

function timeOf(toi) {
  if (toi === null || toi === undefined) return null;
  return Number(typeof toi === "object" ? toi.below : toi);
}

const at = (scene, body, time) => scene.points[body].map((p) => (body === 0 ? plus(p, scene.passing, time) : p));

// About where the two are nearest at a time: by samples, finer and finer.
function nearest(scene, time) {
  const [first, second] = [0, 1].map((body) => at(scene, body, time));
  const span = (points, [u, v]) => points.length < 2 ? points[0]
    : points.length < 3 ? plus(points[0], minus(points[1], points[0]), u)
    : plus(plus(points[0], minus(points[1], points[0]), u * (1 - v)), minus(points[2], points[0]), u * v);
  let best = { distance: Infinity, s: [0.5, 0.5], t: [0.5, 0.5] };
  const grid = [-1, -0.5, 0, 0.5, 1];
  for (let reach = 0.5; reach > 1e-8; reach *= 0.6) {
    const { s, t } = best;
    const near = (x) => grid.map((g) => Math.min(1, Math.max(0, x + g * reach)));
    for (const a of first.length > 1 ? near(s[0]) : [0])
      for (const c of near(t[0]))
        for (const d of second.length > 2 ? near(t[1]) : [0]) {
          const [p, q] = [span(first, [a, 0]), span(second, [c, d])];
          const distance = length(minus(p, q));
          if (distance < best.distance) best = { distance, s: [a, 0], t: [c, d], p, q };
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
  const sizes = scene.points.map((body) => Math.max(...body.map((point) => length(minus(point, body[0])))));
  const reach = Math.max(scene.radii[0] + scene.radii[1], length(scene.passing) * 0.6, Math.min(...sizes) * 0.6, 1e-9);
  shown = { scene, centre: plus(p, minus(q, p), 0.5), reach, turn: [0.6, 0.4], zoom: 1, exact, said };
  for (const other of bench.querySelectorAll("[aria-pressed]")) other.removeAttribute("aria-pressed");
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
    const points = at(scene, which, when).map(place);
    context.globalAlpha = alpha;
    context.strokeStyle = context.fillStyle = colours[which];
    context.lineCap = context.lineJoin = "round";
    path(context, points);
    context.lineWidth = Math.max(2 * scene.radii[which] * scale, 0.5);
    context.stroke();
    if (points.length > 2) context.fill();
    context.globalAlpha = Math.min(1, alpha * 2.5);
    context.lineWidth = 1.5;
    path(context, points);
    context.stroke();
  };
  body(0, 0, 0.12);
  body(0, 1, 0.12);
  body(1, 0, 0.4);
  body(0, time, 0.4);
  context.globalAlpha = 1;
}

function path(context, points) {
  context.beginPath();
  context.moveTo(...points[0]);
  points.slice(1).forEach((point) => context.lineTo(...point));
  if (points.length === 1) context.lineTo(...points[0]);
  if (points.length > 2) context.closePath();
}

bench.tBodies[0].addEventListener("click", (event) => {
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

// The worst missed contact, to begin with.
const first = bench.querySelector('tr:not(.own) [data-witness$="/within"], tr:not(.own) [data-witness$="/missed"]');
if (first) show(first, false);
