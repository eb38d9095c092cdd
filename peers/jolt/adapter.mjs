// The shape cast of Jolt Physics, in WebAssembly and single precision: the first body is cast by the difference of the
// two translations against the second one at rest.
import initJolt from "jolt-physics";
import { aligned, capsule, corners, serve, skin, timed } from "../common/frames.mjs";

const Jolt = await initJolt();

register();

// Jolt knows how to cast its shapes once an interface was made, which needs layers.
function register() {
  const pairs = new Jolt.ObjectLayerPairFilterTable(1);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  const settings = new Jolt.JoltSettings();
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
  new Jolt.JoltInterface(settings);
}

const settings = new Jolt.ShapeCastSettings();
settings.mBackFaceModeTriangles = Jolt.EBackFaceMode_CollideWithBackFaces;
settings.mBackFaceModeConvex = Jolt.EBackFaceMode_CollideWithBackFaces;
const filter = new Jolt.ShapeFilter();
const collector = new Jolt.CastShapeClosestHitCollisionCollector();
const scale = new Jolt.Vec3(1, 1, 1);
const origin = new Jolt.RVec3(0, 0, 0);
const target = new Jolt.TransformedShape();
const place = new Jolt.RVec3(0, 0, 0);
const turn = new Jolt.Quat(0, 0, 0, 1);
const direction = new Jolt.Vec3(0, 0, 0);

function edge(points, radius) {
  const { centre, half, rotation } = capsule(points, 1);
  const shape = half === 0 ? new Jolt.SphereShape(radius) : new Jolt.CapsuleShape(half, radius);
  return { shape: counted(shape), centre, rotation };
}

function face(points) {
  const [b, c, d] = corners(points).map(([x, y, z]) => new Jolt.Vec3(x, y, z));
  const triangle = new Jolt.Triangle(b, c, d);
  const list = new Jolt.TriangleList();
  list.push_back(triangle);
  const mesh = new Jolt.MeshShapeSettings(list);
  const result = mesh.Create();
  const shape = result.IsValid() ? counted(result.Get()) : null;
  result.Clear();
  [b, c, d, triangle, list, mesh].forEach((object) => Jolt.destroy(object));
  return { shape, centre: points[1], rotation: [0, 0, 0, 1] };
}

// Jolt counts who refers to a shape, and the target keeps its last one until it gets another: a shape is released here,
// and never destroyed.
function counted(shape) {
  shape.AddRef();
  return shape;
}

function release({ shape }) {
  shape?.Release();
}

function bodies({ isFace, points, radii }) {
  if (!isFace) return [edge(points.slice(0, 2), radii[0] + skin), edge(points.slice(2), radii[1])];
  const ball = counted(new Jolt.SphereShape(radii[0] + radii[1] + skin));
  return [{ shape: ball, centre: points[0], rotation: [0, 0, 0, 1] }, face(points)];
}

// A body of a cast of a box, or undefined for one that is not asked.
function convex(body) {
  const { shape, points, radius } = body;
  if (shape === "triangle") return face([null, ...points.slice(0, 3)]);
  if (shape !== "box") return radius > 0 ? edge([points[0], points[shape === "edge" ? 1 : 0]], radius) : undefined;
  const box = aligned(body);
  if (box === null) return undefined;
  const half = new Jolt.Vec3(...box.half);
  const made = counted(new Jolt.BoxShape(half, 0));
  Jolt.destroy(half);
  return { shape: made, centre: box.centre, rotation: [0, 0, 0, 1] };
}

// A mesh is cast against alone: where it is the first body, the second is cast.
function castConvex(both) {
  const isMesh = both[0].shape === "triangle";
  const [first, second] = isMesh ? [both[1], both[0]] : both;
  const [a, b] = [convex(first), convex(second)];
  const isAsked = a !== undefined && b !== undefined;
  const step = first.step.map((x, k) => x - second.step[k]);
  const toi = !isAsked ? undefined : b.shape === null ? null : cast(a, b, step);
  if (a !== undefined) release(a);
  if (b !== undefined) release(b);
  return toi;
}

function cast(a, b, step) {
  place.Set(...b.centre);
  turn.Set(...b.rotation);
  target.mShape = b.shape;
  target.SetWorldTransform(place, turn, scale);
  place.Set(...a.centre);
  turn.Set(...a.rotation);
  direction.Set(...step);
  const start = Jolt.RMat44.prototype.sRotationTranslation(turn, place);
  const asked = new Jolt.RShapeCast(a.shape, scale, start, direction);
  collector.Reset();
  collector.ResetEarlyOutFraction();
  timed(() => target.CastShape(asked, settings, origin, collector, filter));
  const toi = collector.HadHit() ? collector.mHit.mFraction : null;
  Jolt.destroy(asked);
  return toi;
}

serve((query) => {
  const { isFace, steps, radii } = query;
  if (isFace ? radii[0] + radii[1] === 0 : radii[0] === 0 || radii[1] === 0) return undefined;
  const [a, b] = bodies(query);
  const step = steps[0].map((x, k) => x - steps[isFace ? 1 : 2][k]);
  // A mesh of a face without area is refused: there is nothing to hit.
  const toi = b.shape === null ? null : cast(a, b, step);
  release(a);
  release(b);
  return toi;
}, castConvex);
