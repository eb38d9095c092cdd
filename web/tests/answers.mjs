// What the certified path says in WebAssembly: `node answers.mjs MODULE`, queries on the standard input, a line each. Prints what
// `playground answers` prints.
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), {});
const { memory, playground_buffer, playground_answer } = instance.exports;

function answer(question) {
  const text = new TextEncoder().encode(question);
  const to = playground_buffer(text.length);
  new Uint8Array(memory.buffer, to, text.length).set(text);
  const length = playground_answer();
  return new TextDecoder().decode(new Uint8Array(memory.buffer, playground_buffer(length), length));
}

const lines = readFileSync(0, "utf8").split("\n").filter(Boolean);
process.stdout.write(lines.map(line => answer(`{"ask":"certified","query":${line}}`) + "\n").join(""));
