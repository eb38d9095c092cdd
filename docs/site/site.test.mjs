// The site as files, target/site/html, in Chromium: pages open on a telephone and on a desk, light and dark, without an error on the
// console and without a request elsewhere; the search finds; the playground is there.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { Browser } from "../../web/tests/chromium.mjs";

const ROOT = new URL("../../target/site/html/", import.meta.url);
let browser;

before(() => { browser = Browser.open(); });
after(() => browser.close());

async function closed(page) {
  assert.deepEqual(page.problems, []);
  assert.deepEqual(page.requests.filter(url => !/^(file|blob|data):/.test(url)), [], "it asks the network");
  await page.close();
}

for (const [width, height, dark] of [[1400, 900, false], [390, 844, true]]) {
  for (const path of ["index.html", "docs/certified.html", "src/thesis/text.rs.html"].slice(0, width > 600 ? 3 : 2)) {
    test(`${path} opens at ${width} x ${height}`, async () => {
      const page = await browser.page(new URL(path, ROOT).href, { width, height, dark, mobile: width < 600 });
      await page.until("document.readyState === 'complete' && document.querySelector('h1')");
      assert.equal(await page.value("document.documentElement.scrollWidth - document.documentElement.clientWidth"), 0);
      await page.until(`getComputedStyle(document.body).backgroundColor ${dark ? "!==" : "==="} "rgb(255, 255, 255)"`, 10);
      await closed(page);
    });
  }
}

test("the search finds", async () => {
  const page = await browser.page(new URL("index.html", ROOT).href);
  await page.until("document.readyState === 'complete'");
  await page.click(".md-search__input");
  await page.send("Input.insertText", { text: "subnormal" });
  await page.until("document.querySelectorAll('.md-search-result__item').length > 2");
  await closed(page);
});

test("the playground is in it", async () => {
  const page = await browser.page(new URL("index.html", ROOT).href);
  await page.until("document.readyState === 'complete'");
  await page.value("[...document.querySelectorAll('nav a')].find(link => link.textContent.trim() === 'Playground').click()");
  await page.until("document.documentElement.dataset.ready && said");
  assert.match(await page.value("document.querySelector('#headline').textContent"), /^Tunnel/);
  await closed(page);
});
