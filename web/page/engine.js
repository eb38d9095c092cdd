"use strict";
// The judge in WebAssembly: JSON in, JSON out. The worker runs this text too.

/* The module of this text: packed by gzip, in base64. */
async function unpack(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(plain).arrayBuffer());
}

class Judge {
  constructor(module) {
    this.module = module;
  }

  /* The answer to a question; an error says in words what is wrong with it. */
  async ask(question) {
    this.instance ??= await WebAssembly.instantiate(this.module, {});
    const { memory, playground_buffer, playground_answer } = this.instance.exports;
    const text = new TextEncoder().encode(JSON.stringify(question));
    try {
      // The memory may move when it grows, so it is looked at after each call.
      const to = playground_buffer(text.length);
      new Uint8Array(memory.buffer, to, text.length).set(text);
      const length = playground_answer();
      const from = playground_buffer(length);
      const answer = JSON.parse(new TextDecoder().decode(new Uint8Array(memory.buffer, from, length)));
      if (answer.error) throw new Error(answer.error);
      return answer.ok;
    } catch (error) {
      // After a trap nothing in its memory can be relied on.
      if (error instanceof WebAssembly.RuntimeError) this.instance = null;
      throw error;
    }
  }
}
