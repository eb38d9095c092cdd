"use strict";
// The clock: what is pressed moves it, and views and charts show what it says.
const times = runs.reduce((a, b) => b.frames.length > a.frames.length ? b : a).frames.map(frame => frame.time);
const last = times.length - 1;
let time = times[0], playing = false, before = 0;
const sections = [...document.querySelectorAll(".view")];

const views = sections.map((section, r) => {
  try {
    return view(section, runs[r]);
  } catch (error) {
    section.querySelector(".canvas").append(`This browser draws no 3D: ${error.message}`);
    return null;
  }
}).filter(Boolean);
const plots = charts(times, t => { pause(); seek(t); });

/* The last frame that is not after a time. */
function frameAt(t) {
  let [low, high] = [0, last];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (times[middle] <= t + 1e-9) low = middle; else high = middle - 1;
  }
  return low;
}

const wordsOf = what => marks.get(what).words;

/* How often each thing happened. */
function counted(list) {
  const counts = new Map();
  for (const { what } of list) counts.set(what, (counts.get(what) ?? 0) + 1);
  return [...counts];
}

function seek(t) {
  time = Math.min(times[last], Math.max(times[0], t));
  const k = frameAt(time);
  byId("time").value = k;
  byId("clock").textContent = `${times[k].toFixed(3)} s`;
  sections.forEach((section, r) => {
    const frames = runs[r].frames, events = section.querySelector(".events");
    const happened = counted(frames[k]?.marks ?? []);
    events.textContent = k < frames.length ? happened.map(([what, count]) => `${count} ${wordsOf(what)}`).join(", ") : "this run has ended";
    events.classList.toggle("red", happened.some(([what]) => marks.get(what).is_bad));
  });
  plots.forEach(plot => plot.show(k));
  views.forEach(one => one.show(k));
}

function pause() {
  playing = false;
  byId("play").textContent = "Play";
}

function play() {
  playing = true;
  if (time >= times[last]) time = times[0];
  before = performance.now();
  byId("play").textContent = "Pause";
  requestAnimationFrame(tick);
}

function tick(now) {
  if (!playing) return;
  // The first picture may be from before the button was pressed.
  seek(time + Math.max(0, now - before) / 1000 * Number(byId("speed").value));
  before = now;
  if (time >= times[last]) pause(); else requestAnimationFrame(tick);
}

function step(way) {
  pause();
  seek(times[Math.min(last, Math.max(0, frameAt(time) + way))]);
}

function fit(again) {
  views.forEach(one => one.fit(again));
  plots.forEach(plot => plot.fit());
  seek(time);
}

/* A piece of a legend. */
function entry(words, shade, className = "dot") {
  const one = document.createElement("span"), sign = document.createElement("i");
  sign.className = className;
  sign.style[className === "ring" ? "borderColor" : "background"] = shade;
  one.append(sign, words);
  return one;
}

/* What the colours in the views mean. */
function legend() {
  const all = [];
  if (shown.tone === "tension") {
    const scale = [0, 0.25, 0.5, 0.75, 1].map(share => `#${tint(share * share * most).getHexString()}`);
    const bar = entry(`${Math.round(most).toLocaleString("en")} N or more`, `linear-gradient(90deg,${scale})`, "scale");
    bar.prepend("tension 0 ");
    all.push(bar);
  } else {
    runs[0].names.wires.forEach((name, w) => all.push(entry(name, wireColour(runs[0], w), "bar")));
  }
  const used = new Set(runs.flatMap(run => run.frames.flatMap(frame => frame.kinds)).join(""));
  for (const kind of Object.keys(kinds)) if (used.has(kind) && (kind !== "f" || shown.nodes)) all.push(entry(...kinds[kind]));
  if (shown.contacts && runs.some(run => run.frames.some(frame => frame.contacts.length))) {
    for (const [words, shade] of Object.values(contactLines)) all.push(entry(words, shade, "bar"));
  }
  const happened = new Set(runs.flatMap(run => run.frames.flatMap(frame => frame.marks.map(mark => mark.what))));
  for (const what of happened) all.push(entry(wordsOf(what), marks.get(what).colour, "ring"));
  byId("legend").replaceChildren(...all);
}

/* What happened, on the time line, and below it what the colours mean and how often it did. */
function timeLine() {
  const svg = byId("marks"), seen = [];
  runs.forEach((run, r) => run.frames.forEach((frame, k) => {
    for (const [what, count] of counted(frame.marks)) {
      const tick = document.createElementNS("http://www.w3.org/2000/svg", "rect");
      const height = 10 / runs.length;
      const place = { x: 1000 * k / Math.max(1, last), y: r * height, width: 3, height: height - 0.5, fill: marks.get(what).colour };
      for (const [key, value] of Object.entries(place)) tick.setAttribute(key, value);
      tick.dataset.event = what;
      svg.append(tick);
      seen.push(...Array(count).fill({ what }));
    }
  }));
  byId("mark-legend").replaceChildren(...counted(seen).map(([what, count]) => entry(`${wordsOf(what)} ${count}`, marks.get(what).colour, "bar")));
}

function choices() {
  const add = (value, text) => byId("follow").append(new Option(text, value));
  runs[0].names.wires.forEach((name, w) => add(`wire ${w}`, name));
  runs[0].names.bodies.forEach((name, k) => { if (runs[0].header.bodies[k].shape !== "Plane") add(`body ${k}`, name); });
  // Where a wire is called after a colour it has that colour.
  if (runs[0].colours.wires.some(Boolean)) shown.tone = "name";
  byId("tone").value = shown.tone;
}

function listen() {
  const redraw = () => { legend(); seek(time); };
  byId("time").max = last;
  byId("time").addEventListener("input", event => { pause(); seek(times[Number(event.target.value)]); });
  byId("play").addEventListener("click", () => playing ? pause() : play());
  byId("back").addEventListener("click", () => step(-1));
  byId("on").addEventListener("click", () => step(1));
  byId("fit").addEventListener("click", () => { shown.follow = byId("follow").value = ""; fit(true); });
  byId("follow").addEventListener("change", event => { shown.follow = event.target.value; redraw(); });
  byId("tone").addEventListener("change", event => { shown.tone = event.target.value; redraw(); });
  for (const name of ["names", "nodes", "contacts"]) {
    byId(name).addEventListener("change", event => { shown[name] = event.target.checked; redraw(); });
  }
  addEventListener("keydown", event => {
    if (event.target.matches("input, select, button")) return;
    if (event.key === " ") { event.preventDefault(); playing ? pause() : play(); }
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (way) step(way);
  });
  // Both views see from the same place.
  views.forEach(one => { one.turned = () => views.forEach(other => { if (other !== one) other.copy(one); }); });
  addEventListener("resize", () => fit(false));
  isDark.addEventListener("change", () => location.reload());
}

choices();
listen();
legend();
timeLine();
fit(true);
