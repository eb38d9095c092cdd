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

/* A time in few digits, but in so many that it is not taken for another: an end of the step, or one that it is compared with. */
function about(value, { isExact = true, beside = [] } = {}) {
  if (value === 0 && !isExact) return "just above 0";
  const others = [0, 1, ...beside].filter(other => other !== value);
  const at = (number, digits) => Number(number.toPrecision(digits));
  let digits = 6;
  while (digits < 17 && others.some(other => at(other, digits) === at(value, digits))) digits++;
  const text = at(value, digits);
  return `${text === value && isExact ? "=" : "≈"}\u00a0${text}`;
}

/* Whether a time of impact lies between two f64. */
const isBetween = hit => hit.in_f64.startsWith("[");
// Digits that are all there are.
const isShort = decimals => /^\d(\.\d{1,6})?$/.test(decimals);
const impactAt = (hit, beside = []) => `t\u00a0${isShort(hit.decimals) ? `=\u00a0${hit.decimals}` : about(hit.below, { isExact: !isBetween(hit), beside })}`;

/* The fault that counts: a time of impact that is off by rounding alone is right. */
function faultOf(subject) {
  const [fault] = subject.faults.filter(name => name !== "wrong case" && name !== "differs");
  const off = said.impact && subject.toi !== null ? Math.abs(subject.toi - said.impact.below) : 0;
  return (fault === "late" || fault === "early") && off <= 1e-9 ? undefined : fault;
}

const SAYINGS = {
  tunnel: hit => `It reports no contact, and the two pass through each other: first contact at ${impactAt(hit)}.`,
  "joint tunnel": hit => `It reports no contact, and the two pass through each other: first contact at ${impactAt(hit)}.`,
  "missed graze": hit => `It reports no contact, and the two touch at ${impactAt(hit)}.`,
  "false hit": (_, subject) => `It reports a contact at t\u00a0${about(subject.toi)}. They never touch.`,
  "near hit": (_, subject) => `It reports a contact at t\u00a0${about(subject.toi)}. They never touch, but come within its distance threshold.`,
  late: (hit, subject) => `It reports t\u00a0${about(subject.toi, { beside: [hit.below] })}. They touch before, at ${impactAt(hit, [subject.toi])}.`,
  early: (hit, subject) => `It reports t\u00a0${about(subject.toi, { beside: [hit.below] })}. They touch later, at ${impactAt(hit, [subject.toi])}.`,
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
  const truth = impact && isThick ? `They come as near as the radius, first at ${impactAt(impact)}.` : impact ? `${impact.kind === "crossing" ? "They pass through each other" : impact.crosses ? "They touch, and pass through each other" : "They touch"}, first at ${impactAt(impact)}.` : "They never touch.";
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

/* Nothing is known of the query: of the one before nothing stays. */
function silence(why) {
  headline("bad", "No answer.", why);
  byId("verdicts").tBodies[0].replaceChildren();
  byId("answer").replaceChildren(element("dt", { textContent: "No answer" }), element("dd", { textContent: why }));
  byId("f-title").textContent = "f(t)";
  byId("f-text").textContent = "";
  for (const id of ["f-chart", "d-chart", "marks"]) byId(id).replaceChildren();
}

function verdicts() {
  const rows = said.subjects.map(subject => {
    const [name, about] = METHODS[subject.name], fault = subject.is_asked ? faultOf(subject) : undefined;
    const isByDesign = fault === "early" && subject.name === "additive";
    const tone = !subject.is_asked || isByDesign ? "none" : !fault ? "good" : ["early", "near hit"].includes(fault) ? "warn" : "bad";
    const chip = !subject.is_asked ? "not asked" : fault ? TITLES[fault] : "right";
    const sentence = fault ? (SAYINGS[fault] ?? (() => ""))(said.impact, subject) : !subject.is_asked ? "It does not take such queries." : "";
    // Those that say between which two f64 it is.
    const isRounded = ["certified", "oracle"].includes(subject.name) && said.impact && isBetween(said.impact);
    const claim = !subject.is_asked ? "–" : subject.toi !== null ? `contact at t = ${subject.toi}${isRounded ? "…" : ""}` : subject.claim.startsWith("miss") ? "no contact" : subject.claim;
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
  distanceChart(count);
}

function distanceChart(count) {
  const values = distances(state, frame, count), radius = frame.radius(state.radius), farthest = Math.max(...values);
  const most = Math.max(farthest, radius) || 1;
  // Of the most, which may be infinite.
  const share = value => value === most ? 1 : value / most;
  const label = radius > farthest ? shortProduct([state.radius[0] / 2 + state.radius[1] / 2, 2]) : shortProduct([most, ...frame.factors]);
  const touch = said.impact ? [{ time: said.impact.below, value: share(radius), filled: true, missed: isMissed(), title: "first contact" }] : [];
  byId("d-chart").dataset.label = "The distance over the step";
  chart(byId("d-chart"), { values: values.map(share), low: 0, high: 1.1, labels: [[0, "0"], [1, `${label} m`]], marks: touch, line: radius ? share(radius) : undefined, now: time });
}

/* What each method reports, on the time line. */
function marks() {
  byId("marks").replaceChildren(...said.subjects.filter(subject => subject.toi !== null && subject.name !== "oracle").map(subject => {
    const mark = element("i", { className: subject.name, title: `${METHODS[subject.name][0]}: t = ${subject.toi}` });
    mark.style.left = `${100 * subject.toi}%`;
    return mark;
  }));
}
