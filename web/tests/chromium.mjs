// Chromium without a window, by its protocol over a pipe: pages are opened, pressed, dragged and typed into as by a user.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const NAMES = ["chromium", "chromium-browser", "google-chrome"];
const found = NAMES.find(name => spawnSync(name, ["--version"]).status === 0);

export class Browser {
  static open() {
    if (!found) throw new Error(`none of ${NAMES.join(", ")} is installed`);
    const folder = mkdtempSync(join(tmpdir(), "playground-"));
    const child = spawn(found, ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--remote-debugging-pipe", `--user-data-dir=${folder}`, "about:blank"],
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    return new Browser(child, folder);
  }

  constructor(child, folder) {
    Object.assign(this, { child, folder, waiting: new Map(), listeners: new Set(), next: 1 });
    let rest = "";
    child.stdio[4].setEncoding("utf8").on("data", text => {
      const messages = (rest + text).split("\0");
      rest = messages.pop();
      messages.forEach(message => this.receive(JSON.parse(message)));
    });
  }

  receive(message) {
    const wait = this.waiting.get(message.id);
    if (!wait) return this.listeners.forEach(listener => listener(message));
    this.waiting.delete(message.id);
    message.error ? wait.reject(new Error(`${wait.method}: ${message.error.message}`)) : wait.resolve(message.result);
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    this.child.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject, method }));
  }

  async page(url, { width = 1400, height = 900, dark = false, mobile = false, still = false } = {}) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const page = new Page(this, sessionId, targetId);
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await page.send(`${domain}.enable`);
    await page.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile });
    if (mobile) await page.send("Emulation.setTouchEmulationEnabled", { enabled: true });
    await page.send("Emulation.setEmulatedMedia", { features: [
      { name: "prefers-color-scheme", value: dark ? "dark" : "light" },
      { name: "prefers-reduced-motion", value: still ? "reduce" : "no-preference" },
    ] });
    await page.send("Page.navigate", { url });
    return page;
  }

  async close() {
    const ended = new Promise(resolve => this.child.once("exit", resolve));
    await this.send("Browser.close");
    await ended;
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  }
}

export class Page {
  constructor(browser, session, target) {
    Object.assign(this, { browser, session, target, problems: [], requests: [] });
    browser.listeners.add(({ sessionId, method, params }) => {
      if (sessionId !== session) return;
      if (method === "Runtime.exceptionThrown") this.problems.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
      if (method === "Runtime.consoleAPICalled" && ["error", "warning"].includes(params.type)) this.problems.push(JSON.stringify(params.args));
      if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level)) this.problems.push(params.entry.text);
      if (method === "Network.requestWillBeSent") this.requests.push(params.request.url);
    });
  }

  send(method, params) { return this.browser.send(method, params, this.session); }

  /* The value of an expression in the page. */
  async value(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /* Waits until an expression is true. */
  async until(expression, seconds = 30) {
    const end = Date.now() + 1000 * seconds;
    for (;;) {
      if (await this.value(`!!(${expression})`).catch(() => false)) return;
      if (Date.now() > end) throw new Error(`it never came to be: ${expression}; ${await this.value("document.body.innerText.slice(0, 400)")}; ${this.problems.join("\n")}`);
      await new Promise(resolve => setTimeout(resolve, 40));
    }
  }

  /* The middle of an element, scrolled into view. */
  async middle(selector) {
    return this.value(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.scrollIntoView({ block: "nearest" }); const r = e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()`);
  }

  async mouse(type, [x, y], more = {}) {
    await this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1, ...more });
  }

  async click(selector) {
    const at = await this.middle(selector);
    await this.mouse("mousePressed", at);
    await this.mouse("mouseReleased", at);
  }

  async drag(from, to, more = {}) {
    await this.mouse("mouseMoved", from, { buttons: 0, button: "none" });
    await this.mouse("mousePressed", from, more);
    for (let k = 1; k <= 8; k++) await this.mouse("mouseMoved", from.map((x, axis) => x + (to[axis] - x) * k / 8), more);
    await this.mouse("mouseReleased", to, more);
  }

  async touch(from, to) {
    const points = ([x, y]) => [{ x, y }];
    await this.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: points(from) });
    for (let k = 1; k <= 8; k++) await this.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: points(from.map((x, axis) => x + (to[axis] - x) * k / 8)) });
    await this.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  }

  /* A key; modifiers: 2 for Control, 8 for Shift. */
  async key(key, modifiers = 0) {
    const text = key.length === 1 && !modifiers ? key : key === "Enter" ? "\r" : undefined;
    const code = { Enter: 13, ArrowUp: 38, ArrowDown: 40, ArrowLeft: 37, ArrowRight: 39, Tab: 9, PageUp: 33, PageDown: 34 }[key] ?? key.toUpperCase().charCodeAt(0);
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", key, text, modifiers, windowsVirtualKeyCode: code });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key, modifiers, windowsVirtualKeyCode: code });
  }

  /* Types a text into a field in place of what is there. */
  async type(selector, text) {
    await this.value(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.focus(); e.select(); })()`);
    await this.send("Input.insertText", { text });
    await this.key("Enter");
    await this.key("Tab");
  }

  /* Chooses a value of a list. */
  async choose(selector, value) {
    await this.value(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.value = ${JSON.stringify(value)}; e.dispatchEvent(new Event("input", { bubbles: true })); e.dispatchEvent(new Event("change", { bubbles: true })); })()`);
  }

  async picture() {
    const { data } = await this.send("Page.captureScreenshot", { format: "png" });
    return Buffer.from(data, "base64");
  }

  async close() { await this.browser.send("Target.closeTarget", { targetId: this.target }); }
}
