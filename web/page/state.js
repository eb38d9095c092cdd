"use strict";
// The state, its text in the link, and numbers as the bits that they are.

const NAMES = ["A", "B", "C", "D"];
const PUBLISHED = [1e-6, 1e-6, 1e-9, 2.220446049250313e-14, 2.220446049250313e-14];
const THRESHOLDS = [
  ["dist", "Points no farther apart are the same", "m"],
  ["dist_1d", "The same in one coordinate", "m"],
  ["t", "Times no farther apart are the same", "steps"],
  ["coefficients_quadratic", "Coefficients of cross products no larger are 0", "m²"],
  ["coefficients_cubic", "Coefficients of f no larger are 0", "m³"],
];

/* A number as the shortest text that is read as the same bits. */
function written(value) {
  if (Object.is(value, -0)) return "-0";
  const [plain, exponential] = [String(value), value.toExponential()];
  return exponential.length < plain.length ? exponential : plain;
}

/* Whether a comma may stand between thousands or before decimals: 1,000. */
const isAmbiguous = text => /^\s*[-+−]?[1-9]\d{0,2}(,\d{3})+\s*$/.test(text);

/* The number that a text stands for: decimal, or hexadecimal as C writes it; NaN if it is none. */
function read(text) {
  if (isAmbiguous(text)) return NaN;
  const hex = /^\s*([-+]?)0x([0-9a-f]+)(?:\.([0-9a-f]*))?(?:p([-+]?\d+))?\s*$/i.exec(text);
  if (!hex) return text.trim() === "" ? NaN : Number(text.replace(",", ".").replace("−", "-"));
  const [, sign, whole, fraction = "", power = "0"] = hex;
  const digits = Number(`0x${whole}${fraction}`), exponent = Number(power) - 4 * fraction.length;
  // In two parts, so that neither is too large or too small to be a number.
  const half = Math.trunc(exponent / 2);
  const value = digits * 2 ** half * 2 ** (exponent - half);
  return sign === "-" ? -value : value;
}

/* Why a text is not taken for a number; nothing if it is. A size is not below 0. */
function refusal(text, isSize = false) {
  const value = read(text), quoted = `“${text.trim()}”`;
  if (isAmbiguous(text)) return `${quoted} can be read in two ways. Write it without a comma, or with a point before decimals.`;
  if (Number.isNaN(value)) return `${quoted} is no number.`;
  if (!Number.isFinite(value)) return `${quoted} is beyond the largest f64.`;
  return isSize && value < 0 ? `${quoted} is below 0.` : "";
}

const cell = new DataView(new ArrayBuffer(8));
function bitsOf(value) { cell.setFloat64(0, value); return cell.getBigInt64(0); }
function ofBits(bits) { cell.setBigInt64(0, bits); return cell.getFloat64(0); }

/* The number so many f64 further up; -0 and 0 are one. No finite number if there are not so many. */
function nudged(value, count) {
  const bits = bitsOf(value);
  const order = bits < 0n ? -(bits & 0x7fffffffffffffffn) : bits;
  const next = order + BigInt(count);
  return next < 0n ? -ofBits(-next) : ofBits(next);
}

/* An f64 as a hexadecimal float. */
function hexadecimal(value) {
  const bits = bitsOf(value) & 0x7fffffffffffffffn, sign = Object.is(value, -0) || value < 0 ? "-" : "";
  let exponent = Number(bits >> 52n), fraction = bits & 0xfffffffffffffn;
  if (exponent === 0 && fraction === 0n) return `${sign}0x0p+0`;
  const lead = exponent === 0 ? 0 : 1;
  exponent = (exponent || 1) - 1023;
  const digits = fraction.toString(16).padStart(13, "0").replace(/0+$/, "");
  return `${sign}0x${lead}${digits ? "." + digits : ""}p${exponent < 0 ? "" : "+"}${exponent}`;
}

/* All decimal digits of an f64, which are finitely many. */
function exactDecimal(value) {
  const bits = bitsOf(value) & 0x7fffffffffffffffn, sign = value < 0 ? "−" : "";
  const stored = Number(bits >> 52n), fraction = bits & 0xfffffffffffffn;
  const mantissa = stored ? fraction | 1n << 52n : fraction, exponent = (stored || 1) - 1075;
  if (exponent >= 0) return sign + (mantissa << BigInt(exponent)).toString();
  // m / 2^k = m 5^k / 10^k
  const places = -exponent;
  const digits = (mantissa * 5n ** BigInt(places)).toString().padStart(places + 1, "0");
  const decimals = digits.slice(-places).replace(/0+$/, "");
  return sign + digits.slice(0, -places) + (decimals ? "." + decimals : "");
}

const copyOf = state => ({ ...state, points: state.points.map(point => [...point]), radius: [...state.radius], thresholds: [...state.thresholds] });

/* A state of a query as the gallery and the search give it. */
function stateOf(query, thresholds) {
  const number = value => typeof value === "number" ? value : read(value);
  const radius = Array.isArray(query.radius) ? query.radius.map(number) : [number(query.radius ?? 0), 0];
  return { kind: query.kind ?? "edge-edge", points: query.points.map(point => point.map(number)), radius, thresholds: [...thresholds] };
}

/* The query as the commands read it. A zero below 0 and what JSON has no number for are texts. */
function queryOf(state, id = "playground") {
  const number = value => Object.is(value, -0) ? hexadecimal(value) : value;
  const radius = state.radius[1] ? state.radius.map(number) : number(state.radius[0]);
  return { id, kind: state.kind, points: state.points.map(point => point.map(number)), radius };
}

/* The numbers times 2 or 1/2; null if one of them would be rounded or no number. */
function scaled(numbers, factor) {
  const all = numbers.map(x => x * factor);
  return all.every((x, k) => Number.isFinite(x) && x / factor === numbers[k]) ? all : null;
}

/* The whole state as the text after the # of a link. */
function linkOf(state, more) {
  const list = numbers => numbers.map(written).join(",");
  const parts = [`kind=${state.kind}`, `points=${list(state.points.flat())}`];
  if (state.radius.some(Boolean)) parts.push(`radius=${list(state.radius)}`);
  if (state.thresholds.some((value, k) => value !== PUBLISHED[k])) parts.push(`thresholds=${list(state.thresholds)}`);
  parts.push(`t=${written(more.time)}`, `view=${list(more.view)}`);
  return "#" + parts.join("&");
}

/* A text of a link without its escapes; as it is if they are none. */
function unescaped(text) {
  try { return decodeURIComponent(text); } catch { return text; }
}

/* The fields of such a text. */
function fieldsOf(text) {
  return new Map(text.replace(/^#/, "").split("&").filter(Boolean).map(part => {
    const [name, value = ""] = part.split("=");
    return [name, unescaped(value)];
  }));
}

/* What such a text says and, in words, what is wrong with it. There is no state if there are no points. */
function readLink(text) {
  const fields = fieldsOf(text), wrong = [];
  const list = (name, words, isGood, otherwise) => {
    const value = fields.get(name), numbers = value?.split(",").map(read);
    if (numbers?.every(Number.isFinite) && isGood(numbers)) return numbers;
    if (value !== undefined) wrong.push(`${name} has to be ${words}, not “${shortened(value, 40)}”`);
    return otherwise;
  };
  const areSizes = numbers => numbers.every(number => number >= 0);
  const points = list("points", "24 numbers", ({ length }) => length === 24, null);
  if (!points && !fields.has("points")) wrong.push("it has no points");
  const radius = list("radius", "one or two numbers from 0", numbers => numbers.length <= 2 && areSizes(numbers), [0]);
  const thresholds = list("thresholds", "five numbers from 0", numbers => numbers.length === 5 && areSizes(numbers), PUBLISHED);
  const [time] = list("t", "a number from 0 to 1", ([time, ...more]) => !more.length && time >= 0 && time <= 1, [0]);
  const view = list("view", "two angles and a zoom above 0", numbers => numbers.length === 3 && numbers[2] > 0, null);
  const isKind = ["edge-edge", "vertex-face"].includes(fields.get("kind"));
  if (!isKind) wrong.push(`kind has to be edge-edge or vertex-face${fields.has("kind") ? `, not “${shortened(fields.get("kind"), 40)}”` : ""}`);
  for (const name of fields.keys()) if (!["kind", "points", "radius", "thresholds", "t", "view"].includes(name)) wrong.push(`there is no “${shortened(name, 40)}”`);
  const state = points && {
    kind: isKind ? fields.get("kind") : "edge-edge", radius: [radius[0], radius[1] ?? 0], thresholds: [...thresholds],
    points: Array.from({ length: 8 }, (_, k) => points.slice(3 * k, 3 * k + 3)),
  };
  return { state, time, view, wrong };
}
