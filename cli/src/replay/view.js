"use strict";
// A run in three dimensions. Each of `runs` has the header of its recording and its frames; the comments of the Rust
// type `Frame` say what is in one.
const said = JSON.parse(document.getElementById("runs").textContent), runs = said.runs;
const byId = id => document.getElementById(id);
const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
// Not Math.max(...numbers), which takes no more than some hundred thousand.
const largest = (numbers, least) => numbers.reduce((a, b) => Math.max(a, b), least);
/* The number that this share of the numbers is not above. */
const quantile = (sorted, share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
/* The tension that is red: a spike of a few frames does not make the others blue. */
const most = Math.max(1, quantile(
  runs.flatMap(run => run.frames.map(frame => largest(frame.tensions.flat(), 0))).sort((a, b) => a - b), 0.98) || 0);

// What is drawn in which colour, and what it is called: the legends and the drawing are made from these.
const kinds = { f: ["free node", "#8a949e"], p: ["pinned", "#d62728"], e: ["eye", "#9467bd"], c: ["contact node", "#ff7f0e"] };
const isDark = matchMedia("(prefers-color-scheme: dark)");
const marks = new Map(said.marks.map(kind => [kind.what, { ...kind, colour: isDark.matches ? kind.dark : kind.light }]));
const contactLines = { normal: ["normal of a contact", "#ff7f0e"], force: ["its force", "#2ca02c"] };
const palette = ["#2f7fd0", "#d6592b", "#2ca02c", "#9467bd", "#c79a1b", "#17a8bd", "#b05a7a", "#7f8c3a"];
const wireColour = (run, w) => run.colours.wires[w] ?? palette[w % palette.length];

/* What the controls say. */
const shown = { tone: "tension", names: true, nodes: false, contacts: true, follow: "" };

/* Tension from blue to red; the square root shows small ones too. */
function tint(tension) {
  const share = Math.sqrt(Math.min(1, Math.max(0, tension / most)));
  return new lib.Color().setHSL(0.62 * (1 - share), 0.85, 0.5);
}

/* The shape of a body. Those of three.js are around y, ours around z. */
function shapeOf(shape) {
  if (shape === "Plane") return null;
  const [name, of] = Object.entries(shape)[0];
  const upright = geometry => geometry.rotateX(Math.PI / 2);
  switch (name) {
    case "Box": return new lib.BoxGeometry(...of.half.map(half => 2 * half));
    case "Cylinder": return upright(new lib.CylinderGeometry(of.radius, of.radius, 2 * of.half_height, 40));
    case "Sphere": return new lib.SphereGeometry(of.radius, 32, 20);
    case "Capsule": return upright(new lib.CapsuleGeometry(of.radius, 2 * of.half_height, 12, 32));
    case "Mesh": {
      const geometry = new lib.BufferGeometry();
      geometry.setAttribute("position", new lib.BufferAttribute(new Float32Array(of.vertices.flat()), 3));
      geometry.setIndex(of.triangles.flat());
      geometry.computeVertexNormals();
      return geometry;
    }
  }
}

function bodyOf({ shape, dynamic }, named) {
  const geometry = shapeOf(shape);
  const group = new lib.Group();
  if (!geometry) {
    const grid = new lib.GridHelper(40, 40, 0x808890, 0x8e979f);
    grid.rotateX(Math.PI / 2);
    grid.material.transparent = true;
    grid.material.opacity = 0.45;
    group.add(grid);
    return group;
  }
  const material = new lib.MeshStandardMaterial({ color: named ?? (dynamic ? 0x4c8dbd : 0x9aa3ac), transparent: true, opacity: 0.5, depthWrite: false });
  group.add(new lib.Mesh(geometry, material));
  geometry.computeBoundingSphere();
  group.userData.radius = geometry.boundingSphere.radius;
  const edges = new lib.EdgesGeometry(geometry, 30);
  group.add(new lib.LineSegments(edges, new lib.LineBasicMaterial({ color: 0x6b757f })));
  return group;
}

/* The points that are to be seen: wires, and bodies that move or are small beside the wires, in some sixty frames. What falls away far from where
   all was at the start is left out. */
function pointsOf(run) {
  const { frames } = run, every = Math.ceil(frames.length / 60), points = [];
  const moves = k => frames.some(frame => frame.bodies[k].some((x, axis) => Math.abs(x - frames[0].bodies[k][axis]) > 1e-3));
  const radii = run.header.bodies.map(({ shape }) => {
    const geometry = shapeOf(shape);
    geometry?.computeBoundingSphere();
    return geometry?.boundingSphere.radius ?? 0;
  });
  const nodes = frames[0].wires.flatMap(wire => wire.filter((_, i) => i % 3 === 0).map((x, k) => new lib.Vector3(x, wire[3 * k + 1], wire[3 * k + 2])));
  const isSmall = k => nodes.length > 0 && radii[k] < extent(nodes) / 4;
  const shownWhole = run.header.bodies.map((_, k) => k).filter(k => run.header.bodies[k].shape !== "Plane" && (moves(k) || isSmall(k)));
  frames.forEach((frame, k) => {
    if (k % every && k !== frames.length - 1) return;
    for (const wire of frame.wires) for (let i = 0; i < wire.length; i += 3) points.push(new lib.Vector3(wire[i], wire[i + 1], wire[i + 2]));
    for (const body of shownWhole) for (let corner = 0; corner < 8; corner++) {
      const way = axis => (corner >> axis & 1 ? 1 : -1) * radii[body] * 0.58;
      points.push(new lib.Vector3(...frame.bodies[body].slice(0, 3).map((x, axis) => x + way(axis))));
    }
    if (k === 0) points.start = points.length;
  });
  if (!points.length) return [new lib.Vector3(-1, -1, -1), new lib.Vector3(1, 1, 1)];
  const middle = points.slice(0, points.start).reduce((sum, p) => sum.add(p), new lib.Vector3()).divideScalar(points.start);
  const reach = Math.max(0.1, ...points.slice(0, points.start).map(p => p.distanceTo(middle)));
  return points.filter(p => p.distanceTo(middle) <= 4 * reach);
}

/* What all views fit into the canvas: of two runs the one that takes less room. */
const toSee = runs.map(pointsOf).reduce((a, b) => extent(a) <= extent(b) ? a : b);
function extent(points) {
  return largest(points.map(p => p.distanceTo(points[0])), 1e-3);
}

const back = new lib.Vector3(0.55, -1.05, 0.45).normalize();

/* Moves a camera back along a way until all points are within its picture, and no farther. */
function fitCamera(camera, target, points, height) {
  const right = new lib.Vector3().crossVectors(camera.up, back).normalize(), top = new lib.Vector3().crossVectors(back, right);
  const slope = Math.tan(camera.fov * Math.PI / 360) * (1 - Math.min(24, height / 12) / height);
  // A point is seen if |x - middle| <= slope (distance - depth), so two sums are bounds of the distance.
  const bounds = [[right, slope * camera.aspect], [top, slope]].map(([way, slope]) => {
    const ends = [1, -1].map(sign => points.reduce((most, p) => Math.max(most, sign * p.dot(way) + slope * p.dot(back)), -Infinity));
    return { distance: (ends[0] + ends[1]) / (2 * slope), middle: (ends[0] - ends[1]) / 2 };
  });
  const distance = Math.max(bounds[0].distance, bounds[1].distance);
  const depth = points.reduce((sum, p) => sum + p.dot(back), 0) / points.length;
  const across = right.multiplyScalar(bounds[0].middle).addScaledVector(top, bounds[1].middle);
  target.copy(across).addScaledVector(back, depth);
  camera.position.copy(across).addScaledVector(back, Math.max(distance, depth + 1e-3));
  const away = Math.max(distance - depth, extent(points) * 0.1);
  [camera.near, camera.far] = [away / 1000, away * 50];
}

/* A run in its box: `show` draws a frame, `fit` sees all, `turned` is called when somebody turns it. */
function view(section, run) {
  const box = section.querySelector(".canvas");
  const renderer = new lib.WebGLRenderer({ antialias: true, alpha: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  box.append(renderer.domElement);
  const over = overlay(box);
  const scene = new lib.Scene();
  scene.add(new lib.AmbientLight(0xffffff, 1.6));
  const sun = new lib.DirectionalLight(0xffffff, 2);
  sun.position.set(3, -5, 8);
  scene.add(sun);
  const bodies = run.header.bodies.map((body, k) => bodyOf(body, run.colours.bodies[k]));
  bodies.forEach(body => scene.add(body));
  const room = largest(run.frames.map(frame => frame.wires.reduce((sum, wire) => sum + wire.length / 3, 0)), 1);
  const instances = geometry => {
    const all = new lib.InstancedMesh(geometry, new lib.MeshStandardMaterial({ roughness: 0.75 }), room);
    all.frustumCulled = false;
    scene.add(all);
    return all;
  };
  const tubes = instances(new lib.CylinderGeometry(1, 1, 1, 12, 1, true)), balls = instances(new lib.SphereGeometry(1, 12, 8));
  const contacts = new lib.LineSegments(new lib.BufferGeometry(), new lib.LineBasicMaterial({ vertexColors: true, depthTest: false }));
  contacts.frustumCulled = false;
  scene.add(contacts);
  const camera = new lib.PerspectiveCamera(40, 1, 0.01, 1000);
  camera.up.set(0, 0, 1);
  const controls = new lib.OrbitControls(camera, renderer.domElement);
  const size = extent(toSee);
  let isTurned = false, at = 0, followed = null;

  /* Where that stands which the camera follows. */
  function place(frame) {
    const [what, k] = shown.follow.split(" ");
    if (what === "body") return new lib.Vector3(...frame.bodies[k].slice(0, 3));
    const wire = frame.wires[k], sum = [0, 1, 2].map(axis => wire.reduce((sum, x, i) => i % 3 === axis ? sum + x : sum, 0));
    return new lib.Vector3(...sum).divideScalar(wire.length / 3);
  }

  function follow(frame) {
    if (!shown.follow) return void (followed = null);
    const now = place(frame), way = now.clone().sub(followed?.what === shown.follow ? followed.at : controls.target);
    camera.position.add(way);
    controls.target.add(way);
    followed = { what: shown.follow, at: now };
  }

  /* Tubes between the nodes, no thinner than on 2.2 pixels. */
  const yAxis = new lib.Vector3(0, 1, 0);
  function showWires(frame) {
    const sight = camera.getWorldDirection(new lib.Vector3());
    const pixel = 2 * Math.tan(camera.fov * Math.PI / 360) / box.clientHeight;
    let tube = 0, ball = 0;
    frame.wires.forEach((wire, w) => {
      const radius = run.header.wires[w].material.radius, own = new lib.Color(wireColour(run, w));
      const shade = k => shown.tone === "name" ? own : tint(frame.tensions[w][Math.max(0, k)]);
      let last = null;
      for (let k = 0; 3 * k < wire.length; k++) {
        const node = new lib.Vector3(wire[3 * k], wire[3 * k + 1], wire[3 * k + 2]);
        const least = 1.1 * pixel * Math.max(camera.near, node.clone().sub(camera.position).dot(sight));
        const thick = Math.max(radius, least), kind = frame.kinds[w][k], isMarked = kind !== "f" || shown.nodes;
        const wide = isMarked ? Math.max(1.35 * radius, 3.2 * least) : thick;
        balls.setMatrixAt(ball, new lib.Matrix4().compose(node, new lib.Quaternion(), new lib.Vector3(wide, wide, wide)));
        balls.setColorAt(ball++, isMarked ? new lib.Color(kinds[kind][1]) : shade(k - 1));
        if (last) {
          const along = node.clone().sub(last), length = along.length();
          const turn = new lib.Quaternion().setFromUnitVectors(yAxis, along.divideScalar(length || 1));
          const middle = node.clone().add(last).multiplyScalar(0.5);
          tubes.setMatrixAt(tube, new lib.Matrix4().compose(middle, turn, new lib.Vector3(thick, length, thick)));
          tubes.setColorAt(tube++, shade(k - 1));
        }
        last = node;
      }
    });
    for (const [all, count] of [[tubes, tube], [balls, ball]]) {
      all.count = count;
      all.instanceMatrix.needsUpdate = true;
      if (all.instanceColor) all.instanceColor.needsUpdate = true;
    }
  }

  /* Each contact: its normal, and its force, the longest a tenth of the scene. */
  function showContacts(frame) {
    const list = shown.contacts ? frame.contacts : [];
    const force = contact => Math.hypot(...contact.slice(6));
    const strongest = largest(list.map(force), 1e-9);
    const ends = [], colours = [];
    for (const contact of list) {
      const at = contact.slice(0, 3);
      const draw = (way, scale, shade) => {
        ends.push(...at, ...at.map((x, axis) => x + scale * way[axis]));
        colours.push(...new lib.Color(shade), ...new lib.Color(shade));
      };
      draw(contact.slice(3, 6), 0.05 * size, contactLines.normal[1]);
      draw(contact.slice(6), 0.1 * size / strongest, contactLines.force[1]);
    }
    contacts.geometry.dispose();
    contacts.geometry = new lib.BufferGeometry();
    contacts.geometry.setAttribute("position", new lib.BufferAttribute(new Float32Array(ends), 3));
    contacts.geometry.setAttribute("color", new lib.BufferAttribute(new Float32Array(colours), 3));
  }

  /* On the picture in pixels, or nothing if it is behind the camera or beside the picture. */
  function onPicture(point) {
    const p = point.clone().project(camera);
    if (Math.abs(p.x) > 1 || Math.abs(p.y) > 1 || p.z > 1) return null;
    return [(p.x + 1) / 2 * box.clientWidth, (1 - p.y) / 2 * box.clientHeight];
  }

  function draw() {
    const frame = run.frames[at];
    camera.updateMatrixWorld();
    showWires(frame);
    showContacts(frame);
    over.show(run, at, onPicture);
    renderer.render(scene, camera);
  }

  function show(k) {
    at = Math.min(k, run.frames.length - 1);
    const frame = run.frames[at];
    frame.bodies.forEach((pose, k) => {
      bodies[k].position.set(...pose.slice(0, 3));
      bodies[k].quaternion.set(...pose.slice(3));
    });
    follow(frame);
    camera.lookAt(controls.target);
    draw();
  }

  /* Takes the size of its box; sees all again unless somebody turned it. */
  function fit(again) {
    const { clientWidth: width, clientHeight: height } = box;
    renderer.setSize(width, height);
    camera.aspect = width / height;
    if (again) isTurned = false;
    if (!isTurned && !shown.follow) fitCamera(camera, controls.target, toSee, height);
    followed = null;
    camera.updateProjectionMatrix();
    camera.lookAt(controls.target);
  }

  const result = { show, fit, draw, controls, camera, turned: () => {} };
  controls.addEventListener("start", () => { isTurned = true; });
  controls.addEventListener("change", () => { draw(); if (isTurned) result.turned(); });
  /* The camera of another view. */
  result.copy = other => {
    isTurned = true;
    camera.position.copy(other.camera.position);
    controls.target.copy(other.controls.target);
    camera.lookAt(controls.target);
    draw();
  };
  return result;
}

/* Names of bodies and marks, on top of the picture. */
function overlay(box) {
  const element = name => document.createElementNS("http://www.w3.org/2000/svg", name);
  const svg = element("svg");
  svg.classList.add("over");
  box.append(svg);
  const add = (name, attributes, text) => {
    const one = element(name);
    for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
    if (text) one.textContent = text;
    svg.append(one);
    return one;
  };

  /* A name where none is yet. */
  function label(name, [x, y], taken) {
    const half = name.length * 3.7 + 4;
    if (taken.some(([left, top, width]) => Math.abs(left - x) < half + width && Math.abs(top - y) < 16)) return;
    taken.push([x, y, half]);
    add("text", { x: Math.min(Math.max(x, half), box.clientWidth - half), y, class: "name" }, name);
  }

  /* Marks stay for a quarter of a second of the run, ever paler. */
  function showMarks(run, at, onPicture) {
    const now = run.frames[at].time;
    for (let k = at; k >= 0 && now - run.frames[k].time < 0.25; k--) {
      for (const { what, at: place } of run.frames[k].marks) {
        const spot = place && onPicture(new lib.Vector3(...place));
        if (!spot) continue;
        add("circle", { cx: spot[0], cy: spot[1], r: 9, class: "mark", "data-mark": what, stroke: marks.get(what).colour,
          opacity: 1 - 0.8 * (now - run.frames[k].time) / 0.25 });
      }
    }
  }

  function show(run, at, onPicture) {
    svg.replaceChildren();
    showMarks(run, at, onPicture);
    if (!shown.names) return;
    const taken = [];
    run.frames[at].bodies.forEach((pose, k) => {
      const spot = onPicture(new lib.Vector3(...pose.slice(0, 3)));
      // A plane is everywhere.
      if (spot && run.header.bodies[k].shape !== "Plane") label(run.names.bodies[k], spot, taken);
    });
    run.frames[at].wires.forEach((wire, w) => {
      const middle = 3 * Math.floor(wire.length / 6);
      const spot = onPicture(new lib.Vector3(...wire.slice(middle, middle + 3)));
      if (spot) label(run.names.wires[w], [spot[0], spot[1] - 10], taken);
    });
  }
  return { show };
}
