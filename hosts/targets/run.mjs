// Runs the digests in WebAssembly: `node run.mjs MODULE COUNT NAME...`, with the names of the parts in
// order. Prints what the program `targets` prints.
import { readFileSync } from "node:fs";

const [file, count, ...names] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(file), {});
names.forEach((name, part) => {
  const digest = BigInt.asUintN(64, instance.exports.tunnelproof_targets_digest(part, Number(count)));
  console.log(`${name} ${digest.toString(16).padStart(16, "0")}`);
});
