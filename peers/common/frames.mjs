// A program that answers queries in the binary form of docs/bring-your-own.md, and times each answer. At the end of its
// input it says how long the engine took, in one line of JSON on the standard error.
import fs from "node:fs";

const QUERY = 228;
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

// `answer` returns a time of impact, null for a miss, or undefined for a query that the engine does not take.
export function serve(answer) {
  let input = Buffer.alloc(0);
  const chunk = Buffer.alloc(1 << 16);
  for (;;) {
    const count = read(chunk);
    if (count === 0) break;
    input = Buffer.concat([input, chunk.subarray(0, count)]);
    const answers = [];
    while (input.length >= QUERY) {
      const toi = answer(parse(input));
      const frame = Buffer.alloc(4 + ANSWER);
      frame.writeUInt32LE(ANSWER, 0);
      input.copy(frame, 4, 4, 12);
      frame.writeUInt32LE(toi === undefined ? 2 : toi === null ? 0 : 1, 12);
      frame.writeDoubleLE(toi ?? 0, 20);
      answers.push(frame);
      input = input.subarray(QUERY);
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
