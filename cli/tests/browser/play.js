"use strict";
// Uses every control of the page of a run, and says what was wrong, and what the page looks like.
// The charts are drawn a little after the page is loaded.
addEventListener("load", () => setTimeout(() => {
  const all = selector => [...document.querySelectorAll(selector)];
  const wrong = [], used = new Set();
  const expect = (is, what) => { if (!is) wrong.push(what); };
  const start = { tone: byId("tone").value, legend: all("#legend > span").map(one => one.textContent) };
  const canvas = all(".canvas canvas");
  const at = () => Number(byId("time").value);
  const click = id => { used.add(id); byId(id).click(); };
  const choose = (id, value) => { used.add(id); byId(id).value = value; byId(id).dispatchEvent(new Event("change")); };
  const tick = id => { used.add(id); byId(id).click(); };
  const picture = () => { seek(time); return canvas[0].toDataURL(); };
  const legendNow = () => byId("legend").textContent;

  // How much of the picture is used.
  const seen = views.map(one => toSee.map(point => point.clone().project(one.camera)));
  const fills = seen.map(points => Math.max(...["x", "y"].map(axis => {
    const of = points.map(point => point[axis]);
    return (Math.max(...of) - Math.min(...of)) / 2;
  })));
  const pictures = k => { seek(times[k]); return canvas.map(one => one.toDataURL()); };
  const [first, final] = [pictures(0), pictures(last)];
  seek(times[0]);
  const names = all(".view:first-child .over .name").map(one => one.textContent);
  expect(all(".values b").every(one => one.textContent), "a chart without values");
  expect(all(".chart").every(one => one.scrollWidth <= one.clientWidth), "a chart wider than its box");

  // Single steps, by buttons and keys; the time line.
  seek(times[0]);
  click("on");
  click("on");
  expect(at() === 2, "two steps on");
  click("back");
  expect(at() === 1, "one step back");
  for (const [key, to] of [["ArrowRight", 2], ["ArrowLeft", 1]]) {
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
    expect(at() === to, `${key} leads to ${at()}`);
  }
  used.add("time");
  byId("time").value = last;
  byId("time").dispatchEvent(new Event("input"));
  expect(byId("clock").textContent === `${times[last].toFixed(3)} s`, "the time line moves the clock");

  // What is drawn, and how.
  const before = picture();
  for (const tone of ["name", "tension"]) { choose("tone", tone); expect(byId("tone").value === tone && legendNow(), "the legend of colours"); }
  choose("tone", start.tone === "name" ? "tension" : "name");
  expect(picture() !== before, "another colour");
  choose("tone", start.tone);
  tick("nodes");
  expect(picture() !== before && legendNow().includes("free node"), "nodes");
  tick("nodes");
  const named = all(".over .name").length;
  tick("names");
  expect(all(".over .name").length === 0, "no names");
  tick("names");
  expect(all(".over .name").length === named, "names");
  const contacts = legendNow().includes("normal of a contact");
  tick("contacts");
  expect(!legendNow().includes("normal of a contact"), "no contacts");
  tick("contacts");
  expect(legendNow().includes("normal of a contact") === contacts, "contacts");
  expect(picture() === before, "as before");

  // The camera: follows each thing, is turned in all views at once, and sees all again.
  const places = () => views.map(one => one.camera.position.toArray().join());
  const home = places();
  for (const option of [...byId("follow").options].slice(1)) {
    choose("follow", option.value);
    seek(times[0]);
    const from = views[0].controls.target.clone();
    seek(times[last]);
    const [what, k] = option.value.split(" ");
    if (what === "body") {
      const [then, now] = [0, last].map(i => runs[0].frames[Math.min(i, runs[0].frames.length - 1)].bodies[k]);
      const gap = [0, 1, 2].map(axis => Math.abs(views[0].controls.target.toArray()[axis] - from.toArray()[axis] - now[axis] + then[axis]));
      expect(Math.max(...gap) < 1e-6, `follows ${option.text}`);
    }
  }
  click("fit");
  expect(byId("follow").value === "" && places().join() === home.join(), "sees all again");
  canvas[0].dispatchEvent(new WheelEvent("wheel", { deltaY: 240, clientX: 50, clientY: 50, bubbles: true, cancelable: true }));
  views[0].controls.update();
  expect(places()[0] !== home[0], "zooms");
// Each view rounds for itself as it turns.
  const apart = Math.max(...views.map(one => one.camera.position.distanceTo(views[0].camera.position)));
  expect(apart < 1e-12 * extent(toSee) + 1e-12, `views see from ${places().join(" and ")}`);
  click("fit");

  // The charts.
  const plot = document.querySelector(".chart .u-over"), area = plot.getBoundingClientRect();
  for (const type of ["mousemove", "mousedown", "mouseup", "click"]) {
    plot.dispatchEvent(new MouseEvent(type, { clientX: area.left + area.width / 2, clientY: area.top + 10, bubbles: true }));
  }
  expect(Math.abs(at() - last / 2) <= 2 + last / 50, `a chart leads to ${at()} of ${last}`);
  for (const button of all(".cut")) {
    const words = button.textContent;
    button.click();
    expect(button.textContent !== words, "spikes");
    button.click();
    expect(button.textContent === words, "spikes again");
  }

  /* How much of the legend lies under the controls, before anything is scrolled. */
  const coveredLegend = () => {
    scrollTo(0, 0);
    return Math.max(0, byId("legend").getBoundingClientRect().bottom - byId("controls").getBoundingClientRect().top);
  };

  // At last it plays. The clock of the test is virtual and may run out before a busy machine draws a single frame, so frames are
  // timers of that clock here.
  window.requestAnimationFrame = frame => setTimeout(() => frame(performance.now()), 16);
  seek(times[0]);
  choose("speed", "1");
  click("play");
  const started = performance.now();
  const waiting = setInterval(() => {
    const played = at();
    if (played < 1 && performance.now() - started < 10000) return;
    clearInterval(waiting);
    if (byId("play").textContent === "Pause") {
      document.body.dispatchEvent(new KeyboardEvent("keydown", { key: " ", bubbles: true }));
      expect(byId("play").textContent === "Play", "the space bar pauses");
    }
    const box = one => one.getBoundingClientRect();
    parent.postMessage(JSON.stringify({
      wrong, played, names, tone: start.tone, legend: start.legend,
      width: innerWidth,
      overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth,
      paper: getComputedStyle(document.body).backgroundColor,
      controls: all("#controls button, #controls input, #controls select").map(one => one.id).sort(),
      used: [...used].sort(),
      views: canvas.map((one, r) => ({ width: box(one).width, height: box(one).height, fills: fills[r], drawn: first[r].length, moved: first[r] !== final[r] })),
      covered: coveredLegend(),
      charts: all(".chart canvas").map(one => [one.width, one.toDataURL().length]),
      marks: all("#marks rect").map(one => one.dataset.event),
    }), "*");
  }, 50);
}, 100));
