// node peers/finds/rapier-small-cuboids/test.mjs
import { createRequire } from "node:module";

const require = createRequire(new URL("../../rapier/package.json", import.meta.url));
const RAPIER = require("@dimforge/rapier3d-compat");
await RAPIER.init();

const vector = (x, y, z) => ({ x, y, z });
const identity = { x: 0, y: 0, z: 0, w: 1 };
for (const half of [1, 0.01, 0.005]) {
  // The middle of the second cube is in the first: they overlap, and the first moves on away from the second.
  const [a, b] = [new RAPIER.Cuboid(half, half, half), new RAPIER.Cuboid(half, half, half)];
  const [at, other] = [vector(0, 0, 0), vector(0.5 * half, 0.25 * half, 0.125 * half)];
  const hit = a.castShape(at, identity, vector(-4 * half, 0, 0), b, other, identity, vector(0, 0, 0), 0, 1, true);
  const touches = a.intersectsShape(at, identity, b, other, identity);
  console.log(`half ${half}: intersectsShape ${touches}, castShape ${hit === null ? "null" : hit.time_of_impact}`);
}
