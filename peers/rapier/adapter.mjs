// The shape cast of Rapier, in WebAssembly and single precision.
import RAPIER from "@dimforge/rapier3d-compat";
import { aligned, capsule, corners, hull, serve, skin, timed } from "../common/frames.mjs";

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

// A body of a cast of a box: a box along the axes is a cuboid, another the hull of its corners.
function convex(body) {
  const { shape, points, step, radius } = body;
  const at = (place, made) => ({ shape: made, at: vector(place), rotation: identity, step: vector(step) });
  switch (shape) {
    case "edge": return edge(points, step, radius);
    case "sphere": return at(points[0], new RAPIER.Ball(radius));
    case "triangle": return at(points[0], new RAPIER.Triangle(...corners([null, ...points.slice(0, 3)]).map(vector)));
  }
  const box = aligned(body);
  if (box !== null) return at(box.centre, new RAPIER.Cuboid(...box.half));
  const { corners: turned, faces } = hull(body);
  return at(points[0], new RAPIER.ConvexPolyhedron(new Float32Array(turned.flat()), new Uint32Array(faces.flat())));
}

function cast([a, b]) {
  const hit = timed(() =>
    a.shape.castShape(a.at, a.rotation, a.step, b.shape, b.at, b.rotation, b.step, 0, 1, true));
  return hit === null ? null : hit.time_of_impact;
}

serve((query) => {
  if (query.isFace && query.radii[0] + query.radii[1] === 0) return undefined;
  return cast(bodies(query));
}, (both) => cast(both.map(convex)));
