// The geometry sweep of PhysX, in WebAssembly and single precision: the first body is swept by the difference of the two
// translations against the second one at rest. Where there is no difference, the two are asked for an overlap.
import fs from "node:fs";
import { aligned, capsule, corners, serve, skin, timed } from "../common/frames.mjs";

// It is built for browsers: it is let believe in one.
async function load() {
  const wasmBinary = fs.readFileSync(new URL(import.meta.resolve("physx-js-webidl").replace(".mjs", ".wasm")));
  const { process } = globalThis;
  globalThis.window = globalThis;
  globalThis.process = undefined;
  try {
    const { default: initPhysX } = await import("physx-js-webidl");
    return await initPhysX({ wasmBinary });
  } finally {
    globalThis.process = process;
  }
}

const PhysX = await load();
const allocator = new PhysX.PxDefaultAllocator();
const errors = new PhysX.PxDefaultErrorCallback();
const foundation = PhysX.CreateFoundation(PhysX.PHYSICS_VERSION, allocator, errors);
const cooking = new PhysX.PxCookingParams(new PhysX.PxTolerancesScale());
const { PxHitFlagEnum } = PhysX;
const flags = new PhysX.PxHitFlags(PxHitFlagEnum.eDEFAULT | PxHitFlagEnum.eMESH_BOTH_SIDES);
const hit = new PhysX.PxSweepHit();
const sides = new PhysX.PxMeshGeometryFlags(0);
const scale = new PhysX.PxMeshScale();
const indices = new PhysX.PxArray_PxU32(3);
[0, 1, 2].forEach((i) => indices.set(i, i));

function pose(centre, [x, y, z, w]) {
  const [p, q] = [new PhysX.PxVec3(...centre), new PhysX.PxQuat(x, y, z, w)];
  const transform = new PhysX.PxTransform(p, q);
  PhysX.destroy(p);
  PhysX.destroy(q);
  return transform;
}

// Capsules are along x.
function edge(points, radius) {
  const { centre, half, rotation } = capsule(points, 0);
  const geometry = half === 0 ? new PhysX.PxSphereGeometry(radius) : new PhysX.PxCapsuleGeometry(radius, half);
  return { geometry, pose: pose(centre, rotation) };
}

function face(points) {
  const corner = new PhysX.PxArray_PxVec3(3);
  corners(points).forEach(([x, y, z], i) => {
    const point = new PhysX.PxVec3(x, y, z);
    corner.set(i, point);
    PhysX.destroy(point);
  });
  const desc = new PhysX.PxTriangleMeshDesc();
  Object.assign(desc.points, { count: 3, stride: 12, data: corner.begin() });
  Object.assign(desc.triangles, { count: 1, stride: 12, data: indices.begin() });
  const mesh = PhysX.CreateTriangleMesh(cooking, desc);
  PhysX.destroy(desc);
  PhysX.destroy(corner);
  // A face without area is refused: there is nothing to hit.
  if (PhysX.getPointer(mesh) === 0) return null;
  const geometry = new PhysX.PxTriangleMeshGeometry(mesh, scale, sides);
  return { geometry, pose: pose(points[1], [0, 0, 0, 1]), mesh };
}

function release(body) {
  PhysX.destroy(body.geometry);
  PhysX.destroy(body.pose);
  body.mesh?.release();
}

function bodies({ isFace, points, radii }) {
  if (!isFace) return [edge(points.slice(0, 2), radii[0] + skin), edge(points.slice(2), radii[1])];
  const geometry = new PhysX.PxSphereGeometry(radii[0] + radii[1] + skin);
  return [{ geometry, pose: pose(points[0], [0, 0, 0, 1]) }, face(points)];
}

// A body of a cast of a box, undefined for one that is not asked, or null for one that is refused.
function convex(body) {
  const { shape, points, radius } = body;
  if (shape === "triangle") return face([null, ...points.slice(0, 3)]);
  if (shape !== "box") return radius > 0 ? edge([points[0], points[shape === "edge" ? 1 : 0]], radius) : undefined;
  const box = aligned(body);
  if (box === null) return undefined;
  return { geometry: new PhysX.PxBoxGeometry(...box.half), pose: pose(box.centre, [0, 0, 0, 1]) };
}

// A mesh is swept against alone: where it is the first body, the second is swept.
function sweepConvex(both) {
  const [first, second] = both[0].shape === "triangle" ? [both[1], both[0]] : both;
  const [a, b] = [convex(first), convex(second)];
  const isAsked = a !== undefined && b !== undefined;
  const step = first.step.map((x, k) => x - second.step[k]);
  const toi = !isAsked ? undefined : b === null ? null : sweep(a, b, step);
  if (a) release(a);
  if (b) release(b);
  return toi;
}

function sweep(a, b, step) {
  const { PxGeometryQuery } = PhysX;
  const distance = Math.hypot(...step);
  if (distance === 0) {
    const touches = timed(() => PxGeometryQuery.prototype.overlap(a.geometry, a.pose, b.geometry, b.pose));
    return touches ? 0 : null;
  }
  const direction = new PhysX.PxVec3(...step.map((x) => x / distance));
  const isHit = timed(() =>
    PxGeometryQuery.prototype.sweep(direction, distance, a.geometry, a.pose, b.geometry, b.pose, hit, flags, 0));
  PhysX.destroy(direction);
  return isHit ? Math.max(0, Math.min(1, hit.distance / distance)) : null;
}

serve((query) => {
  const { isFace, steps, radii } = query;
  if (isFace ? radii[0] + radii[1] === 0 : radii[0] === 0 || radii[1] === 0) return undefined;
  const [a, b] = bodies(query);
  if (b === null) {
    release(a);
    return null;
  }
  const step = steps[0].map((x, k) => x - steps[isFace ? 1 : 2][k]);
  const toi = sweep(a, b, step);
  release(a);
  release(b);
  return toi;
}, sweepConvex);
