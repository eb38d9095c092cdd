// A program that answers queries in the binary form of docs/bring-your-own.md, and times each answer. At the end of its
// input it says how long the engine took, in one line of JSON on the standard error.
import fs from "node:fs";

const ANSWER = 24;

// What an engine prints must not be taken for answers.
console.log = console.info = () => {};

// How much larger the first body is asked to be, in metres.
export const skin = Number(process.env.PEERS_SKIN ?? 0);

const times = [];

// What `call` returns, timed. Only the engine's own call belongs in it.
export function timed(call) {
  const start = process.hrtime.bigint();
  const result = call();
  times.push(Number(process.hrtime.bigint() - start));
  return result;
}

function report() {
  if (times.length === 0) return;
  const sorted = Float64Array.from(times).sort();
  const at = (share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
  const mean_ns = times.reduce((sum, time) => sum + time, 0) / times.length;
  const said = { calls: times.length, mean_ns, median_ns: at(0.5), p99_ns: at(0.99), worst_ns: at(1) };
  fs.writeSync(2, JSON.stringify(said) + "\n");
}

function parse(frame) {
  const number = (i) => frame.readDoubleLE(20 + 8 * i);
  const point = (i) => [0, 1, 2].map((k) => number(2 + 3 * i + k));
  const points = [0, 1, 2, 3].map(point);
  const ends = [4, 5, 6, 7].map(point);
  return {
    isFace: frame.readUInt32LE(12) === 1,
    radii: [number(0), number(1)],
    points,
    steps: points.map((p, i) => p.map((x, k) => ends[i][k] - x)),
  };
}

// Both bodies of a cast of a box: a shape, its points and translation, and by how much it is larger. The skin is that of the
// first body with a radius or, without one, of the first box.
function parseCast(frame) {
  const number = (i) => frame.readDoubleLE(20 + 8 * i);
  const point = (i) => [0, 1, 2].map((k) => number(2 + 3 * i + k));
  const bodies = [0, 1].map((i) => ({
    shape: ["sphere", "edge", "triangle", "box"][frame.readUInt16LE(16 + 2 * i)],
    points: [0, 1, 2, 3].map((k) => point(5 * i + k)),
    step: point(5 * i + 4),
    radius: number(i),
  }));
  const larger = bodies.find((body) => body.radius > 0) ?? bodies.find((body) => body.shape === "box");
  larger.radius += skin;
  return bodies;
}

// `answer` and, for casts of boxes, `answerCast` return a time of impact, null for a miss, or undefined for a query that the
// engine does not take.
export function serve(answer, answerCast) {
  let input = Buffer.alloc(0);
  const chunk = Buffer.alloc(1 << 16);
  for (;;) {
    const count = read(chunk);
    if (count === 0) break;
    input = Buffer.concat([input, chunk.subarray(0, count)]);
    const answers = [];
    while (input.length >= 4 && input.length >= 4 + input.readUInt32LE(0)) {
      const query = input.subarray(0, 4 + input.readUInt32LE(0));
      const toi = query.readUInt32LE(12) === 2 ? answerCast(parseCast(query)) : answer(parse(query));
      const frame = Buffer.alloc(4 + ANSWER);
      frame.writeUInt32LE(ANSWER, 0);
      query.copy(frame, 4, 4, 12);
      frame.writeUInt32LE(toi === undefined ? 2 : toi === null ? 0 : 1, 12);
      frame.writeDoubleLE(toi ?? 0, 20);
      answers.push(frame);
      input = input.subarray(query.length);
    }
    write(Buffer.concat(answers));
  }
  report();
}

function read(chunk) {
  for (;;) {
    try {
      return fs.readSync(0, chunk);
    } catch (error) {
      if (error.code === "EOF") return 0;
      if (error.code !== "EAGAIN") throw error;
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 1);
    }
  }
}

function write(bytes) {
  for (let at = 0; at < bytes.length; ) {
    try {
      at += fs.writeSync(1, bytes, at);
    } catch (error) {
      if (error.code !== "EAGAIN") throw error;
    }
  }
}

const subtract = (p, q) => p.map((x, k) => x - q[k]);

// An edge as a capsule along an axis (0 to 2): its middle, half its length, and the rotation (x y z w) of the axis.
export function capsule([a, b], axis) {
  const along = subtract(b, a);
  const length = Math.hypot(...along);
  const centre = a.map((x, k) => x + 0.5 * along[k]);
  const rotation = [0, 0, 0, 1];
  if (length > 0) {
    const unit = along.map((x) => (x * (along[axis] < 0 ? -1 : 1)) / length);
    const [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
    const w = 1 + unit[axis];
    const norm = Math.hypot(w, unit[next], unit[last]);
    rotation[next] = -unit[last] / norm;
    rotation[last] = unit[next] / norm;
    rotation[3] = w / norm;
  }
  return { centre, half: 0.5 * length, rotation };
}

// The corners of a face relative to the first, which is the origin of its frame.
export function corners(points) {
  return points.slice(1).map((point) => subtract(point, points[1]));
}

const sides = (box) => box.points.slice(1).map((point) => subtract(point, box.points[0]));

// The middle of a box along the axes and half of its sides; null for one that is turned.
export function aligned(box) {
  const [centre, half] = [[...box.points[0]], [0, 0, 0]];
  for (const along of sides(box)) {
    if (along.filter((x) => x !== 0).length !== 1) return null;
    const axis = along.findIndex((x) => x !== 0);
    centre[axis] += 0.5 * along[axis];
    half[axis] = 0.5 * Math.abs(along[axis]) + box.radius;
  }
  return { centre, half };
}

// The corners of a box relative to the first, and two triangles for each face, counterclockwise from outside.
export function hull(box) {
  const ways = sides(box);
  const lengths = ways.map((way) => Math.hypot(...way));
  // Without a skin nothing is rounded.
  const by = lengths.map((length) => (box.radius > 0 ? box.radius / length : 0));
  const corner = (number) => [0, 1, 2].map((k) =>
    ways.reduce((sum, way, side) => sum + ((number >> side) & 1 ? way[k] + by[side] * way[k] : -by[side] * way[k]), 0));
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(corner);
  const [x, y, z] = ways;
  const cross = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
  const isRight = cross[0] * z[0] + cross[1] * z[1] + cross[2] * z[2] > 0;
  const quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  const faces = quads.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]).map(([a, b, c]) => (isRight ? [a, b, c] : [a, c, b]));
  return { corners, faces };
}
