// The shape cast of Rapier, in WebAssembly and single precision.
import RAPIER from "@dimforge/rapier3d-compat";
import { capsule, corners, serve, skin, timed } from "../common/frames.mjs";

await RAPIER.init();

const vector = ([x, y, z]) => ({ x, y, z });
const identity = { x: 0, y: 0, z: 0, w: 1 };

function edge(points, step, radius) {
  if (radius === 0) {
    const end = points[1].map((x, k) => x - points[0][k]);
    const shape = new RAPIER.Segment(vector([0, 0, 0]), vector(end));
    return { shape, at: vector(points[0]), rotation: identity, step: vector(step) };
  }
  const { centre, half, rotation } = capsule(points, 1);
  const [x, y, z, w] = rotation;
  const shape = half === 0 ? new RAPIER.Ball(radius) : new RAPIER.Capsule(half, radius);
  return { shape, at: vector(centre), rotation: { x, y, z, w }, step: vector(step) };
}

function bodies({ isFace, points, steps, radii }) {
  if (!isFace) {
    const first = radii[0] === 0 ? skin : radii[0] + skin;
    return [edge(points.slice(0, 2), steps[0], first), edge(points.slice(2), steps[2], radii[1])];
  }
  const ball = new RAPIER.Ball(radii[0] + radii[1] + skin);
  const [b, c, d] = corners(points).map(vector);
  return [
    { shape: ball, at: vector(points[0]), rotation: identity, step: vector(steps[0]) },
    { shape: new RAPIER.Triangle(b, c, d), at: vector(points[1]), rotation: identity, step: vector(steps[1]) },
  ];
}

serve((query) => {
  if (query.isFace && query.radii[0] + query.radii[1] === 0) return undefined;
  const [a, b] = bodies(query);
  const hit = timed(() =>
    a.shape.castShape(a.at, a.rotation, a.step, b.shape, b.at, b.rotation, b.step, 0, 1, true));
  return hit === null ? null : hit.time_of_impact;
});
