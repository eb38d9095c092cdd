"use strict";
// Charts over the step, as pictures in the page's colours.

/* The distance of two segments, each [start, end], of numbers near 1. Rounded, for a chart alone. */
function segmentDistance([a, b], [c, d]) {
  const u = V.sub(b, a), v = V.sub(d, c), w = V.sub(a, c);
  const [uu, uv, vv, uw, vw] = [V.dot(u, u), V.dot(u, v), V.dot(v, v), V.dot(u, w), V.dot(v, w)];
  const unit = x => Math.max(0, Math.min(1, x || 0));
  const gap = (s, t) => V.length(V.sub(V.add(w, V.mul(u, s)), V.mul(v, t)));
  const inner = uu * vv - uv * uv;
  const tries = [0, 1].map(s => [s, unit((vw + uv * s) / vv)]).concat([0, 1].map(t => [unit((uv * t - uw) / uu), t]));
  const s = (uv * vw - vv * uw) / inner, t = (uu * vw - uv * uw) / inner;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) tries.push([s, t]);
  return Math.min(...tries.map(([s, t]) => gap(s, t)));
}

/* The distance of a point from a triangle. */
function faceDistance(p, [a, b, c]) {
  const e = V.sub(b, a), f = V.sub(c, a), w = V.sub(p, a), normal = V.cross(e, f), area = V.dot(normal, normal);
  const u = V.dot(V.cross(w, f), normal) / area, v = V.dot(V.cross(e, w), normal) / area;
  if (u >= 0 && v >= 0 && u + v <= 1) return Math.abs(V.dot(w, normal)) / Math.sqrt(area);
  return Math.min(...[[a, b], [b, c], [c, a]].map(edge => segmentDistance([p, p], edge)));
}

/* The distance over the step, in units of the frame. */
function distances(state, frame, count = 240) {
  const points = state.points.map(frame.to);
  return Array.from({ length: count + 1 }, (_, k) => {
    const [a, b, c, d] = [0, 1, 2, 3].map(p => V.mix(points[p], points[p + 4], k / count));
    return state.kind === "edge-edge" ? segmentDistance([a, b], [c, d]) : faceDistance(a, [b, c, d]);
  });
}

const short = value => written(Number(value.toPrecision(2))).replaceAll("-", "−");

/* The same of a product of numbers above 0, which may be beyond f64. */
function shortProduct(factors) {
  const product = factors.reduce((a, b) => a * b), power = factors.reduce((sum, factor) => sum + Math.log10(factor), 0);
  if (Math.abs(power) < 300) return short(product);
  const whole = Math.floor(power);
  return `${Number((10 ** (power - whole)).toPrecision(2))}e${whole}`.replaceAll("-", "−");
}

/* Values over [0, 1] with marks: { time, filled, title, colour }. The labels of the ends are texts. */
function chart(box, { values, low, high, labels, marks, line, now }) {
  const width = 360, height = 130, left = 58, right = 10, top = 10, bottom = 20;
  const x = t => left + t * (width - left - right), y = v => top + (high - v) / (high - low || 1) * (height - top - bottom);
  const path = values.map((v, k) => `${k ? "L" : "M"}${x(k / (values.length - 1)).toFixed(2)} ${y(v).toFixed(2)}`).join("");
  const parts = [0, 0.25, 0.5, 0.75, 1].map(t => `<line class="grid" x1="${x(t)}" x2="${x(t)}" y1="${top}" y2="${height - bottom}"/><text x="${x(t)}" y="${height - 5}" text-anchor="middle">${t}</text>`);
  for (const [value, text] of labels) {
    parts.push(`<line class="${value === 0 ? "zero" : "grid"}" x1="${left}" x2="${width - right}" y1="${y(value)}" y2="${y(value)}"/><text x="${left - 6}" y="${y(value) + 4}" text-anchor="end">${text}</text>`);
  }
  if (line !== undefined) parts.push(`<line class="radius" x1="${left}" x2="${width - right}" y1="${y(line)}" y2="${y(line)}"/>`);
  parts.push(`<path d="${path}"/>`);
  for (const mark of marks) {
    parts.push(`<circle cx="${x(mark.time)}" cy="${y(mark.value)}" r="5" class="${mark.filled ? "touches" : "passes"}${mark.missed ? " missed" : ""}"><title>${mark.title}</title></circle>`);
  }
  parts.push(`<line class="now" x1="${x(now)}" x2="${x(now)}" y1="${top}" y2="${height - bottom}"/>`);
  box.innerHTML = `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${box.dataset.label ?? ""}">${parts.join("")}</svg>`;
  box.dataset.scale = JSON.stringify([left / width, (width - left - right) / width]);
}

/* Moves the line of the clock. */
function moveNow(box, t) {
  const line = box.querySelector(".now");
  if (!line) return;
  const [start, length] = JSON.parse(box.dataset.scale);
  for (const end of ["x1", "x2"]) line.setAttribute(end, 360 * (start + length * t));
}
