// The page of the playground as a user has it, target/web/index.html in Chromium: every control, by mouse, finger and keyboard, on a
// desk and on a telephone, light and dark, without an error on the console and without a request.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { after, before, test } from "node:test";
import { gzipSync } from "node:zlib";

import { Browser } from "./chromium.mjs";

const FILE = new URL("../../target/web/index.html", import.meta.url);
const MODULE = new URL("../../target/web/module.wasm", import.meta.url);
let browser;

before(() => { browser = Browser.open(); });
after(() => browser.close());

async function opened(options = {}, hash = "") {
  const page = await browser.page(FILE.href + hash, options);
  await page.until("document.documentElement.dataset.ready && said");
  return page;
}

async function closed(page) {
  assert.deepEqual(page.problems, []);
  assert.deepEqual(page.requests.filter(url => !/^(file|blob|data):/.test(url)), [], "it asks the network");
  await page.close();
}

const text = (page, selector) => page.value(`document.querySelector(${JSON.stringify(selector)}).textContent`);
const chip = (page, method) => text(page, `[data-method=${method}] .chip`);
const points = page => page.value("JSON.stringify(state.points)");
const spot = (page, k) => page.value(`(() => { const r = view.canvas.getBoundingClientRect(); return [view.spots[${k}][0] + r.left, view.spots[${k}][1] + r.top]; })()`);
/* Waits until what is shown is of the state as it is. */
const settled = page => page.until("!isWaiting").then(() => page.value("new Promise(done => requestAnimationFrame(() => setTimeout(done, 60)))"));
const choose = async (page, id) => { await page.choose("#gallery", id); await settled(page); };

test("it is small and opens soon, with a tunnel", async () => {
  assert.ok(gzipSync(readFileSync(MODULE), { level: 9 }).length < 2_000_000);
  assert.ok(statSync(FILE).size < 2_000_000);
  const page = await opened();
  const ready = Number(await page.value("document.documentElement.dataset.ready"));
  console.log(`ready after ${ready} ms; ${statSync(FILE).size} bytes`);
  assert.ok(ready < 4000, `${ready} ms`);
  assert.match(await text(page, "#headline"), /^Tunnel/);
  assert.equal(await chip(page, "thesis"), "Tunnel");
  assert.equal(await chip(page, "certified"), "right");
  assert.equal(await text(page, "[data-what=toi]"), "15/29");
  assert.match(await text(page, "header"), /Master's thesis.*five thresholds/s);
  await closed(page);
});

test("the clock plays, pauses and is set", async () => {
  const page = await opened();
  await page.until("time === 1 && !playing", 60);
  await page.click("#play");
  await page.until("playing && time > 0 && time < 0.9");
  await page.click("#play");
  assert.equal(await page.value("playing"), false);
  await page.choose("#time", "0.25");
  assert.equal(await text(page, "#now"), "t = 0.250");
  assert.ok(await page.value("document.querySelectorAll('#marks i').length") >= 2);
  await closed(page);
});

test("points are dragged, by themselves and together where they rest", async () => {
  const page = await opened();
  await choose(page, "rods");
  const from = await spot(page, 2), start = await points(page);
  await page.drag(from, [from[0] + 60, from[1] - 30]);
  await settled(page);
  const moved = JSON.parse(await points(page)), was = JSON.parse(start);
  assert.notDeepEqual(moved[2], was[2]);
  assert.deepEqual(moved.filter((_, k) => k !== 2), was.filter((_, k) => k !== 2));
  const rest = await spot(page, 0);
  await page.drag(rest, [rest[0] - 40, rest[1] - 20]);
  await settled(page);
  const together = JSON.parse(await points(page));
  assert.deepEqual(together[0], together[4]);
  assert.notDeepEqual(together[0], was[0]);
  const end = await spot(page, 0);
  await page.drag(end, [end[0] + 30, end[1] + 50], { modifiers: 8 });
  const alone = JSON.parse(await points(page));
  assert.deepEqual(alone[0], together[0]);
  assert.notDeepEqual(alone[4], together[0]);
  await page.click("#rest");
  await choose(page, "rods");
  const free = await spot(page, 0);
  await page.drag(free, [free[0] + 30, free[1] + 50]);
  const freely = JSON.parse(await points(page));
  assert.notDeepEqual(freely[0], freely[4]);
  await closed(page);
});

test("what is undone is as it was, and is done again", async () => {
  const page = await opened();
  await choose(page, "rods");
  const first = await points(page), from = await spot(page, 3);
  await page.drag(from, [from[0], from[1] + 80]);
  const second = await points(page);
  assert.notEqual(first, second);
  await page.click("#undo");
  assert.equal(await points(page), first);
  await page.click("#redo");
  assert.equal(await points(page), second);
  await page.key("z", 2);
  assert.equal(await points(page), first);
  await page.key("z", 10);
  assert.equal(await points(page), second);
  await closed(page);
});

test("snapping makes small multiples of the unit", async () => {
  const page = await opened();
  await choose(page, "turning");
  await page.click("#snap");
  const from = await spot(page, 6);
  await page.drag(from, [from[0] + 37, from[1] - 11]);
  await settled(page);
  const isWhole = await page.value("state.points.flat().every(x => Number.isInteger(x / unit) && Math.abs(x / unit) < 100)");
  assert.ok(isWhole, await points(page));
  await closed(page);
});

test("coordinates are typed, and moved by one f64", async () => {
  const page = await opened();
  await choose(page, "rods");
  const field = "#points input[data-at='2 2']";
  await page.type(field, "0.1");
  await settled(page);
  assert.equal(await page.value("state.points[2][2]"), 0.1);
  await page.value(`document.querySelector("${field}").focus()`);
  assert.match(await text(page, "#exact"), /0x1\.999999999999ap-4\nexactly 0\.1000000000000000055511151231257827021181583404541015625/);
  await page.key("ArrowUp");
  assert.equal(await page.value("state.points[2][2]"), 0.1 + 2 ** -56);
  await page.key("ArrowDown", 8);
  assert.equal(await page.value("(0.1 - state.points[2][2]) / 2 ** -56"), 1023);
  await page.type(field, "-0x1.8p-3");
  assert.equal(await page.value("state.points[2][2]"), -0.1875);
  await page.type(field, "nonsense");
  assert.equal(await page.value("state.points[2][2]"), -0.1875);
  assert.equal(await page.value(`document.querySelector("${field}").getAttribute("aria-invalid")`), "true");
  await closed(page);
});

test("a point is moved on the canvas by keyboard", async () => {
  const page = await opened();
  await choose(page, "rods");
  await page.value("view.canvas.focus()");
  await page.key("n");
  await page.key("n");
  assert.equal(await page.value("view.selected"), 1);
  const start = await points(page);
  for (const key of ["ArrowUp", "ArrowRight", "PageUp"]) await page.key(key);
  const moved = JSON.parse(await points(page))[1], was = JSON.parse(start)[1];
  assert.ok(moved.every((x, axis) => Math.abs(x - was[axis]) === 0.125), `${was} ${moved}`);
  assert.equal(await page.value("pause() ?? playing"), false);
  await page.value("time = 0.2");
  await page.key(" ");
  await page.until("playing && time > 0.2");
  await closed(page);
});

test("thresholds change the answer of the thesis' method, and go back", async () => {
  const page = await opened();
  await choose(page, "rods");
  assert.equal(await chip(page, "thesis"), "right");
  await page.choose("#thresholds input[type=range][data-threshold='4']", "3");
  await settled(page);
  assert.equal(await chip(page, "thesis"), "Tunnel");
  assert.equal(await chip(page, "certified"), "right");
  await page.click("#reset");
  await settled(page);
  assert.equal(await chip(page, "thesis"), "right");
  for (const k of [0, 1, 2, 3]) await page.choose(`#thresholds input[type=range][data-threshold='${k}']`, "-18");
  await page.type("#thresholds input[data-threshold='0']:not([type=range])", "1e-3");
  await settled(page);
  assert.deepEqual(await page.value("state.thresholds"), [1e-3, 0, 0, 0, 2.220446049250313e-14]);
  await page.type("#thresholds input[data-threshold='0']:not([type=range])", "-1");
  assert.equal(await page.value("state.thresholds[0]"), 1e-3);
  await closed(page);
});

test("radius, kind and scale", async () => {
  const page = await opened();
  await choose(page, "rods");
  await page.type("#radius", "0.5 + 0.25");
  await settled(page);
  assert.deepEqual(await page.value("state.radius"), [0.5, 0.25]);
  assert.match(await text(page, "[data-what=kind]"), /contact at the radius/);
  assert.equal(await chip(page, "thesis"), "not asked");
  await page.type("#radius", "-1");
  assert.deepEqual(await page.value("state.radius"), [0.5, 0.25]);
  await page.type("#radius", "0");
  await page.choose("#kind", "vertex-face");
  await settled(page);
  assert.match(await text(page, "[data-what=case]"), /general|coplanar|degenerate/);
  await choose(page, "rods");
  for (let k = 0; k < 24; k++) await page.click("#smaller");
  await settled(page);
  assert.equal(await chip(page, "thesis"), "Tunnel");
  assert.equal(await text(page, "[data-what=toi]"), "3/5");
  for (let k = 0; k < 24; k++) await page.click("#larger");
  await settled(page);
  assert.equal(await chip(page, "thesis"), "right");
  await closed(page);
});

test("the view turns, zooms and fits", async () => {
  const page = await opened();
  const camera = () => page.value("JSON.stringify(view.camera)"), start = await camera();
  const box = await page.value("(() => { const r = view.canvas.getBoundingClientRect(); return [r.left + 30, r.top + 30]; })()");
  await page.drag(box, [box[0] + 80, box[1] + 20]);
  await page.click("#zoom-in");
  await page.click("#zoom-out");
  await page.mouse("mouseWheel", box, { deltaX: 0, deltaY: -200, button: "none", buttons: 0 });
  assert.notEqual(await camera(), start);
  await page.click("#fit");
  assert.equal(await camera(), start);
  await closed(page);
});

test("every motion of the gallery has an answer, and tunnelproof is right", async () => {
  // Nothing plays by itself: drawing takes most of the time.
  const page = await opened({ still: true });
  const ids = await page.value("gallery.flatMap(group => group.entries.map(entry => entry.id))");
  assert.ok(ids.length > 50, `${ids.length}`);
  assert.equal(new Set(ids).size, ids.length);
  for (const id of ids) {
    await choose(page, id);
    assert.equal(await chip(page, "certified"), "right", id);
    assert.equal(await chip(page, "oracle"), "right", id);
    const drawn = await page.value("[...document.querySelectorAll('.chart:not([hidden]) path')].every(path => !/NaN|Infinity/.test(path.getAttribute('d')))");
    assert.ok(drawn, id);
  }
  await closed(page);
});

test("a link holds the state, bit for bit", async () => {
  const page = await opened();
  await choose(page, "turning");
  await page.type("#points input[data-at='0 0']", "0.1");
  await page.type("#points input[data-at='5 1']", "-0");
  await page.type("#points input[data-at='7 2']", "5e-324");
  await page.type("#radius", "0.1 + 0.2");
  await page.choose("#thresholds input[type=range][data-threshold='2']", "-3");
  await page.choose("#time", "0.625");
  const bits = page => page.value("[...state.points.flat(), ...state.radius, ...state.thresholds, time].map(x => bitsOf(x).toString(16)).join()");
  const hash = await page.value("address()"), said = await bits(page);
  assert.ok(said.includes("-8000000000000000"), said);
  const other = await opened({}, hash);
  assert.equal(await bits(other), said);
  assert.equal(await other.value("address()"), hash);
  await other.value("location.hash = '#kind=edge-edge&points=1,2'");
  await closed(other);
  await page.value("prompt = () => null");
  await page.click("#link");
  await page.click("#copy");
  assert.match(await text(page, "#shell"), /tunnelproof explain -/);
  await closed(page);
});

const notice = page => page.value("document.querySelector('#notice').hidden ? '' : document.querySelector('#notice').textContent");
const isInvalid = (page, selector) => page.value(`document.querySelector(${JSON.stringify(selector)}).getAttribute("aria-invalid") === "true"`);
const THRESHOLD = "#thresholds input[data-threshold='0']:not([type=range])";
const GOOD = `kind=edge-edge&points=${Array.from({ length: 24 }, (_, k) => k % 5).join()}`;

test("a link without points opens the page all the same, and it says so", async () => {
  for (const hash of ["#kind=edge-edge&points=%", "#state", `#${GOOD},1`]) {
    const page = await opened({}, hash);
    assert.match(await notice(page), /damaged.*points.*Nothing/, hash);
    assert.match(await text(page, "#headline"), /^Tunnel/, hash);
    await choose(page, "rods");
    assert.equal(await notice(page), "");
    await closed(page);
  }
  const page = await opened({}, `#${GOOD}`);
  assert.equal(await notice(page), "");
  await page.value("location.hash = '#kind=edge-edge&points=1'");
  await page.until("!document.querySelector('#notice').hidden");
  await closed(page);
});

test("what is wrong in a link is named, and the rest of it is shown", async () => {
  const parts = ["radius=-1", "radius=1,2,3", "radius=x", "thresholds=-1", "thresholds=-1,0,0,0,0", "view=0,0,0", "view=0.1", "t=7", "t=-1", "zoom=0"];
  for (const part of parts) {
    const page = await opened({}, `#${GOOD}&${part}&radius2=1`);
    const said = await notice(page), [name] = part.split("=");
    assert.ok(said.includes("damaged") && said.includes(name) && said.includes("radius2"), `${part}: ${said}`);
    assert.deepEqual(await page.value("[state.radius, state.thresholds, time, view.camera.zoom]"), [[0, 0], await page.value("PUBLISHED"), 0, 1], part);
    assert.equal(await page.value("state.points.flat().join()"), GOOD.replace(/.*=/, ""));
    await closed(page);
  }
  const page = await opened({}, `#${GOOD.replace("edge-edge", "edge")}&radius=0.25&t=0.5&view=1e300,1e300,1e300`);
  assert.match(await notice(page), /kind/);
  assert.deepEqual(await page.value("[state.radius, time, state.kind]"), [[0.25, 0], 0.5, "edge-edge"]);
  const { yaw, pitch, zoom } = await page.value("view.camera");
  assert.ok(Math.abs(yaw) < 6.3 && Math.abs(pitch) < 1.6 && zoom === 20);
  await closed(page);
});

test("a damaged link stays in the address until something is changed", async () => {
  const later = () => new Promise(resolve => setTimeout(resolve, 600));
  for (const hash of ["#kind=edge-edge&points=1,2", `#${GOOD}&radius=-1`]) {
    const page = await opened({}, hash);
    await page.value("start()");
    await page.until("time === 1 && !playing", 60);
    await later();
    assert.equal(await page.value("location.hash"), hash);
    await page.click("#zoom-in");
    await later();
    assert.equal(await page.value("location.hash"), await page.value("address()"));
    await closed(page);
  }
});

test("without an answer nothing stays of the one before", async () => {
  const page = await opened();
  const shown = "document.querySelectorAll('#verdicts tr, [data-what], .chart svg, #marks i').length + document.querySelector('#f-text').textContent.length";
  assert.ok(await page.value(shown) > 10);
  await page.value("judge.ask = async () => { throw new Error('no judge is in'); }");
  await choose(page, "rods");
  await page.until("document.querySelector('#headline').textContent === 'No answer.'");
  assert.equal(await page.value(shown), 0);
  assert.match(await text(page, "#answer"), /no judge is in/);
  await page.value("delete judge.ask");
  await page.click("#undo");
  await settled(page);
  assert.match(await text(page, "#headline"), /^Tunnel/);
  assert.equal(await text(page, "[data-what=toi]"), "15/29");
  await closed(page);
});

test("no coordinate goes beyond the largest f64, and it says why", async () => {
  const page = await opened(), field = "#points input[data-at='0 0']", largest = Number.MAX_VALUE;
  await page.type(field, `${largest}`);
  const before = await points(page);
  const refused = async (words) => {
    assert.match(await notice(page), words);
    assert.equal(await points(page), before);
    await page.value("notice('')");
  };
  await page.value(`document.querySelector("${field}").focus()`);
  await page.key("ArrowUp");
  await refused(/beyond the largest f64/);
  await page.click("#larger");
  await refused(/no exact f64/);
  await page.value("view.selected = 0; view.canvas.focus()");
  const keys = ["ArrowUp", "ArrowRight", "PageUp", "ArrowDown", "ArrowLeft", "PageDown"];
  for (const key of keys) {
    await page.key(key);
    if (await notice(page)) break;
  }
  assert.match(await notice(page), /beyond the largest f64/);
  assert.ok(await page.value("state.points.flat().every(Number.isFinite)"));
  await page.type(field, "1e309");
  assert.match(await notice(page), /1e309.*beyond/);
  await closed(page);
});

test("the picture fits again when a far move is undone", async () => {
  const page = await opened();
  await choose(page, "rods");
  const unit = await page.value("frame.unit"), extent = "Math.max(...[0, 1, 2].map(k => { const of = state.points.map(p => frame.to(p)[k]); return Math.max(...of) - Math.min(...of); }))";
  await page.type("#points input[data-at='7 0']", "1e6");
  await settled(page);
  assert.notEqual(await page.value("frame.unit"), unit);
  await page.click("#undo");
  await settled(page);
  assert.equal(await page.value("frame.unit"), unit);
  assert.equal(await page.value(extent), 1);
  await page.click("#redo");
  await page.type("#points input[data-at='7 0']", "1");
  assert.ok(await page.value(extent) >= 0.25);
  await closed(page);
});

test("what is no number is refused in words, and a correction is taken", async () => {
  const page = await opened(), field = "#points input[data-at='0 0']";
  await choose(page, "rods");
  for (const [selector, typed, words, corrected, value] of [
    [field, "1,000", /two ways/, "1000", "state.points[0][0] === 1000"], [field, "1,000,000", /two ways/, "-0,5", "state.points[0][0] === -0.5"],
    [field, "nonsense", /no number/, "0.5", "state.points[0][0] === 0.5"], ["#radius", "-1", /below 0/, "0,125", "state.radius[0] === 0.125"],
    ["#radius", "1 + 2 + 3", /two|2 numbers/, "1 + 2", "state.radius[1] === 2"], [THRESHOLD, "-1", /below 0/, "0.1", "state.thresholds[0] === 0.1"],
  ]) {
    await page.type(selector, typed);
    assert.match(await notice(page), words);
    assert.ok(await isInvalid(page, selector), typed);
    await page.type(selector, corrected);
    assert.equal(await isInvalid(page, selector), false, corrected);
    assert.equal(await notice(page), "");
    assert.ok(await page.value(value), corrected);
    // By another way than the field.
    await page.type(selector, typed);
    await page.click("#undo");
    assert.equal(await isInvalid(page, selector), false);
    assert.notEqual(await page.value(`document.querySelector(${JSON.stringify(selector)}).value`), typed);
  }
  await closed(page);
});

test("the gallery says when its motion was changed", async () => {
  const page = await opened(), label = () => page.value("document.querySelector('#gallery').selectedOptions[0].textContent");
  assert.equal(await label(), "Gallery…");
  await choose(page, "rods");
  const title = await label();
  await page.type("#points input[data-at='0 0']", "0.3");
  assert.equal(await label(), `Changed: ${title}`);
  await page.click("#undo");
  assert.equal(await label(), title);
  await page.type("#radius", "0.1");
  assert.equal(await label(), `Changed: ${title}`);
  await choose(page, "rods");
  assert.equal(await label(), title);
  await page.value(`location.hash = "#${GOOD}"`);
  await page.until("!chosen");
  assert.equal(await label(), "Gallery…");
  await closed(page);
});

test("a time near an end of the step is not rounded to it", async () => {
  const page = await opened();
  await choose(page, "rods");
  const falls = (from, to) => page.value(`edit(next => {
    next.points = [[-1, 0, 0], [1, 0, 0], [0, -1, ${from}], [0, 1, ${from}], [-1, 0, 0], [1, 0, 0], [0, -1, ${to}], [0, 1, ${to}]];
  })`).then(() => settled(page));
  for (const [from, to, words] of [
    [1, -4.8e-9, /t.≈.0\.999999995/], [1, 0, /t.=.1\./], [0, 1, /t.=.0\./], [5e-324, -1e308, /t.just above 0/], [1, -2e-16, /t.≈.0\.99999999999999/], [1, -1, /t.=.0\.5\./], [1, -2, /t.≈.0\.333333\./],
  ]) {
    await falls(from, to);
    assert.match(`${await text(page, "#headline")} ${await text(page, "#sentence")}`, words);
  }
  await choose(page, "rods");
  assert.match(await text(page, "#headline"), /t.=.0\.6\./);
  assert.equal(await page.value("about(0.5, { beside: [0.50000001] }) !== about(0.50000001, { beside: [0.5] })"), true);
  await closed(page);
});

test("a radius that is beyond f64 as a sum has its chart", async () => {
  const page = await opened();
  await choose(page, "rods");
  for (const power of [0, -1060, 1022]) {
    await page.value(`edit(next => { next.points = next.points.map(point => point.map(x => x * 2 ** ${power})); }, { fit: true })`);
    await page.type("#radius", "1e308 + 1e308");
    await settled(page);
    assert.match(await text(page, "#d-chart"), /2e308 m/);
    const drawn = await page.value("document.querySelector('#d-chart').innerHTML");
    assert.ok(!/NaN|Infinity/.test(drawn), drawn);
    await page.type("#radius", "0");
    await choose(page, "rods");
  }
  await closed(page);
});

test("numbers of any size have an answer, and are scaled no farther than they are exact", async () => {
  const page = await opened();
  for (const [button, power] of [["larger", 1018], ["smaller", -1068]]) {
    await choose(page, "rods");
    await page.value(`edit(next => { next.points = next.points.map(point => point.map(x => x * 2 ** ${power})); }, { fit: true })`);
    const count = await page.value(`(() => { let k = 0; for (; k < 20 && document.querySelector("#notice").hidden; k++) document.querySelector("#${button}").click(); return k; })()`);
    assert.ok(count > 1 && count < 20, `${count}`);
    await settled(page);
    assert.equal(await chip(page, "certified"), "right");
    assert.equal(await text(page, "[data-what=toi]"), "3/5");
  }
  await page.type("#points input[data-at='0 0']", "1.7976931348623157e308");
  await page.type("#points input[data-at='4 0']", "-1.7976931348623157e308");
  await page.type("#radius", "1e308 + 1e308");
  await settled(page);
  assert.equal(await chip(page, "certified"), "right");
  await closed(page);
});

test("a low window cuts off no text", async () => {
  const page = await opened({ width: 1100, height: 420 });
  await settled(page);
  assert.equal(await page.value("document.querySelector('#banner').scrollHeight - document.querySelector('#banner').clientHeight"), 0);
  await closed(page);
});

test("the button to copy a link keeps its name", async () => {
  const page = await opened();
  await page.value("prompt = () => null; Object.defineProperty(navigator, 'clipboard', { value: { writeText: async () => {} } })");
  await page.click("#link");
  await page.until("document.querySelector('#link').textContent === 'Copied'");
  await page.click("#link");
  await new Promise(resolve => setTimeout(resolve, 2600));
  assert.equal(await text(page, "#link"), "Copy link");
  await closed(page);
});

test("a search finds a tunnel and makes it small, and can be stopped", async () => {
  const page = await opened();
  await page.click("#find");
  await page.until("gallery && finds.entries.length === 2", 120);
  await settled(page);
  assert.equal(await chip(page, "thesis"), "Tunnel");
  assert.equal(await chip(page, "certified"), "right");
  const found = await page.value("finds.entries[1].id");
  await choose(page, found);
  assert.equal(await chip(page, "thesis"), "Tunnel");
  await page.choose("#fault", "false hit");
  await page.click("#find");
  await page.until("!document.querySelector('#search').hidden");
  await page.click("#cancel");
  assert.equal(await page.value("worker === null && document.querySelector('#search').hidden"), true);
  await closed(page);
});

for (const [width, height, dark] of [[1400, 900, false], [1400, 900, true], [390, 844, false], [390, 844, true]]) {
  test(`it fits ${width} x ${height}, ${dark ? "dark" : "light"}`, async () => {
    const page = await opened({ width, height, dark, mobile: width < 600 });
    assert.equal(await page.value("document.documentElement.scrollWidth - innerWidth"), 0);
    const paper = await page.value("getComputedStyle(document.body).backgroundColor.match(/\\d+/g).slice(0, 3).reduce((a, b) => a + Number(b), 0) / 3");
    assert.equal(paper < 128, dark);
    const small = await page.value(`[...document.querySelectorAll("button, select")].filter(e => e.offsetParent).map(e => [e.id, e.offsetWidth, e.offsetHeight]).filter(([, w, h]) => w < 30 || h < ${width < 600 ? 40 : 30})`);
    assert.deepEqual(small, []);
    const hidden = await page.value(`[...document.querySelectorAll("button, select, input")].filter(e => e.offsetParent).filter(e => { const r = e.getBoundingClientRect(); return r.right > innerWidth + 1 || r.left < -1; }).map(e => e.id)`);
    assert.deepEqual(hidden, []);
    const from = await spot(page, 3), start = await points(page);
    await page.touch(from, [from[0] - 30, from[1] - 25]);
    if (width < 600) assert.notEqual(await points(page), start);
    await closed(page);
  });
}
