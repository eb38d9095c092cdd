"use strict";
// What is said of the query: the headline, each method, the exact answer, charts and marks.

const METHODS = {
  certified: ["tunnelproof", "the certified path: no thresholds"],
  oracle: ["Exact judge", "integers and algebraic numbers"],
  thesis: ["The thesis' method", "five thresholds"],
  additive: ["Additive CCD", "conservative by design"],
};

function headline(tone, text, sentence) {
  byId("banner").className = tone;
  byId("headline").textContent = text;
  byId("sentence").textContent = sentence;
}

const about = value => {
  const text = Number(value.toPrecision(6));
  return `${text === value ? "=" : "≈"} ${text}`;
};

/* The fault that counts: a time of impact that is off by rounding alone is right. */
function faultOf(subject) {
  const [fault] = subject.faults.filter(name => name !== "wrong case" && name !== "differs");
  const off = said.impact && subject.toi !== null ? Math.abs(subject.toi - said.impact.below) : 0;
  return (fault === "late" || fault === "early") && off <= 1e-9 ? undefined : fault;
}

const SAYINGS = {
  tunnel: hit => `It reports no contact, and the two pass through each other: first contact at t ${about(hit.below)}.`,
  "joint tunnel": hit => `It reports no contact, and the two pass through each other: first contact at t ${about(hit.below)}.`,
  "missed graze": hit => `It reports no contact, and the two touch at t ${about(hit.below)}.`,
  "false hit": (_, subject) => `It reports a contact at t ${about(subject.toi)}. They never touch.`,
  "near hit": (_, subject) => `It reports a contact at t ${about(subject.toi)}. They never touch, but come within its distance threshold.`,
  late: (hit, subject) => `It reports t ${about(subject.toi)}. They touch before, at t ${about(hit.below)}.`,
  early: (hit, subject) => `It reports t ${about(subject.toi)}. They touch later, at t ${about(hit.below)}.`,
  "no answer": () => "It has no answer.",
};
const TITLES = {
  tunnel: "Tunnel", "joint tunnel": "Tunnel", "missed graze": "Missed contact", "false hit": "False hit", "near hit": "Near hit",
  late: "Late", early: "Early", "no answer": "No answer",
};

function tell() {
  const [certified, , thesis, additive] = said.subjects;
  const { impact } = said, fault = thesis.is_asked ? faultOf(thesis) : undefined, other = additive.is_asked ? faultOf(additive) : undefined;
  const isThick = state.radius.some(Boolean);
  const truth = impact && isThick ? `They come as near as the radius, first at t ${about(impact.below)}.` : impact ? `${impact.kind === "crossing" ? "They pass through each other" : impact.crosses ? "They touch, and pass through each other" : "They touch"}, first at t ${about(impact.below)}.` : "They never touch.";
  if (certified.faults.length) headline("bad", "tunnelproof is wrong!", "Please report this query: copy the link.");
  else if (fault) headline(fault === "early" || fault === "near hit" ? "warn" : "bad", `${TITLES[fault]}: the thesis' method is wrong.`, SAYINGS[fault](impact, thesis));
  else if (!thesis.is_asked) headline("good", truth, other && other !== "early" ? `Additive CCD: ${TITLES[other].toLowerCase()}.` : `The thesis' method does not take ${state.kind === "vertex-face" ? "faces" : "a radius"}.`);
  else if (other === "early") headline("good", truth, "All methods find this contact. Additive CCD reports it early, as it is made to.");
  else if (other) headline("warn", truth, `The thesis' method agrees. Additive CCD does not: ${TITLES[other].toLowerCase()}.`);
  else headline("good", truth, "All methods agree. Move a point, pick another motion, or find a miss.");
  verdicts();
  exact();
  charts();
  marks();
  draw();
}

function verdicts() {
  const rows = said.subjects.map(subject => {
    const [name, about] = METHODS[subject.name], fault = subject.is_asked ? faultOf(subject) : undefined;
    const isByDesign = fault === "early" && subject.name === "additive";
    const tone = !subject.is_asked || isByDesign ? "none" : !fault ? "good" : ["early", "near hit"].includes(fault) ? "warn" : "bad";
    const chip = !subject.is_asked ? "not asked" : fault ? TITLES[fault] : "right";
    const sentence = fault ? (SAYINGS[fault] ?? (() => ""))(said.impact, subject) : !subject.is_asked ? "It does not take such queries." : "";
    // Those that say between which two f64 it is.
    const isBetween = ["certified", "oracle"].includes(subject.name) && said.impact?.in_f64.startsWith("[");
    const claim = !subject.is_asked ? "–" : subject.toi !== null ? `contact at t = ${subject.toi}${isBetween ? "…" : ""}` : subject.claim.startsWith("miss") ? "no contact" : subject.claim;
    const motion = subject.faults.includes("wrong case") ? `It takes the motion for ${subject.case}.` : subject.case && !fault ? `${subject.case} motion` : "";
    const row = element("tr", {},
      element("th", { scope: "row" }, name, element("small", { textContent: about })),
      element("td", {}, element("span", { className: "claim", textContent: claim }), element("small", { textContent: [isByDesign ? "Early by design: it stops before the contact." : sentence, motion].filter(Boolean).join(" ") })),
      element("td", {}, element("span", { className: `chip ${tone}`, textContent: chip })));
    row.dataset.method = subject.name;
    return row;
  });
  byId("verdicts").tBodies[0].replaceChildren(...rows);
}

const shortened = (text, most = 260) => text.length > most ? `${text.slice(0, most)}… (${text.length} characters)` : text;

function exact() {
  const { impact, case: motion } = said, rows = [];
  if (impact) {
    const number = impact.fraction ?? `the root of ${impact.root_of === "f" ? "f" : impact.root_of} between ${impact.between[0]} and ${impact.between[1]}`;
    rows.push(["Time of impact", shortened(number), "toi"], ["In decimals", impact.decimals, "decimals"], ["In f64", impact.in_f64]);
    rows.push(["Kind", impact.kind_words, "kind"], ["What touches", impact.features.join(" and ")], ["Where", impact.place]);
  } else {
    rows.push(["Contact", "none during the step", "toi"]);
  }
  rows.push(["Case", `${motion.name}: ${motion.words}`, "case"]);
  if (motion.vanishing.length) rows.push(["Always 0", motion.vanishing.join(", ")]);
  byId("answer").replaceChildren(...rows.flatMap(([name, text, id]) => {
    const value = element("dd", { textContent: text });
    if (id) value.dataset.what = id;
    return [element("dt", { textContent: name }), value];
  }));
}

function charts() {
  const { f, times } = said, count = 240;
  byId("f-title").textContent = f ? "f(t) in m³: 0 where the four points share a plane" : "f(t) is 0 for the whole step: the four points always share a plane";
  byId("f-chart").hidden = !f;
  byId("f-chart").dataset.label = "The polynomial f over the step";
  if (f) {
    const at = t => f.shares.reduceRight((sum, share) => sum * t + share, 0);
    const values = Array.from({ length: count + 1 }, (_, k) => at(k / count));
    const most = Math.max(...values.map(Math.abs)) || 1;
    const largest = f.shares.findIndex(share => Math.abs(share) === Math.max(...f.shares.map(Math.abs)));
    const metre = Number(f.decimals[largest]) / f.shares[largest];
    const label = value => Number.isFinite(metre) ? short(value * metre) : "";
    const marks = state.radius.some(Boolean) ? [] : times.map(when => ({ time: when.value, value: 0, filled: when.touches, missed: isMissed() && when.value === said.impact?.below, title: `t = ${when.exactly}: ${when.words}` }));
    chart(byId("f-chart"), { values, low: -1.1 * most, high: 1.1 * most, labels: [[-most, label(-most)], [0, "0"], [most, label(most)]], marks, now: time });
  }
  const text = f ? `f = 2^${f.exponent} (${f.integers.map((integer, k) => [integer, k]).filter(([integer]) => integer !== "0").map(([integer, k]) => `${integer}${["", " t", " t²", " t³"][k]}`).join(" + ").replaceAll("+ -", "− ")})` : "";
  byId("f-text").textContent = [shortened(text), said.heading, ...times.map(when => `t = ${when.exactly}: ${when.words}`)].filter(Boolean).join("\n");
  const values = distances(state, frame, count), radius = Math.min(1e300, state.radius[0] + state.radius[1]) / frame.unit;
  const most = Math.max(...values.filter(Number.isFinite), radius) || 1;
  const touch = said.impact ? [{ time: said.impact.below, value: radius, filled: true, missed: isMissed(), title: "first contact" }] : [];
  byId("d-chart").dataset.label = "The distance over the step";
  chart(byId("d-chart"), { values: values.map(value => Number.isFinite(value) ? value : 0), low: 0, high: 1.1 * most, labels: [[0, "0"], [most, `${short(most * frame.unit)} m`]], marks: touch, line: radius || undefined, now: time });
}

/* What each method reports, on the time line. */
function marks() {
  byId("marks").replaceChildren(...said.subjects.filter(subject => subject.toi !== null && subject.name !== "oracle").map(subject => {
    const mark = element("i", { className: subject.name, title: `${METHODS[subject.name][0]}: t = ${subject.toi}` });
    mark.style.left = `${100 * subject.toi}%`;
    return mark;
  }));
}
