// Finds a query on which the thesis' method fails, and makes it smaller, in parts: so the page knows how far it is. It is
// stopped by ending it.
onmessage = async ({ data: { module, families, fault, thresholds, seed } }) => {
  const judge = new Judge(module);
  try {
    let found = null, start = 0;
    const most = 200000, count = 250;
    for (; !found && start < most; start += count) {
      found = await judge.ask({ ask: "search", search: { families, seed, start, count, fault }, thresholds });
      postMessage({ asked: start + count, most });
    }
    if (!found) return postMessage({ none: start });
    let smaller = { ...found, is_minimal: false }, calls = 250;
    while (!smaller.is_minimal && calls <= 32000) {
      const next = await judge.ask({ ask: "shrink", shrink: { query: smaller.query, fault, calls }, thresholds });
      if (next.bits === smaller.bits) calls *= 2;
      smaller = next;
      postMessage({ bits: smaller.bits, before: found.bits });
    }
    postMessage({ found, smaller });
  } catch (error) {
    postMessage({ error: error.message });
  }
};
