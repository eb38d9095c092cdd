"use strict";
// A run, drawn. `run` has the header of its recording and the frames; the comments of the Rust type `Frame` say what
// is in one.
const run = JSON.parse(document.getElementById("run").textContent);
const byId = id => document.getElementById(id);
const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const frames = run.frames, last = frames.length - 1;
// Not Math.max(...numbers), which takes no more than some hundred thousand.
const largest = (numbers, least) => numbers.reduce((a, b) => Math.max(a, b), least);
const most = largest(frames.flatMap(frame => frame.tensions.flat()), 1);
const kinds = { f: ["free", "#8a949e"], p: ["pinned", "#d62728"], e: ["eye", "#9467bd"], c: ["contact", "#ff7f0e"] };

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

function bodyOf({ shape, dynamic }) {
  const geometry = shapeOf(shape);
  const group = new lib.Group();
  if (!geometry) {
    const grid = new lib.GridHelper(40, 40, 0x808890, 0xa0a8b0);
    grid.rotateX(Math.PI / 2);
    group.add(grid);
    return group;
  }
  const material = new lib.MeshStandardMaterial({ color: dynamic ? 0x4c8dbd : 0x9aa3ac, transparent: true, opacity: 0.55 });
  group.add(new lib.Mesh(geometry, material));
  geometry.computeBoundingSphere();
  group.userData.radius = geometry.boundingSphere.radius;
  const edges = new lib.EdgesGeometry(geometry, 30);
  group.add(new lib.LineSegments(edges, new lib.LineBasicMaterial({ color: 0x5a646e })));
  return group;
}

/* The scene in three dimensions: `show` draws a frame. */
function view(box) {
  const renderer = new lib.WebGLRenderer({ antialias: true, alpha: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  box.prepend(renderer.domElement);
  const scene = new lib.Scene();
  scene.add(new lib.AmbientLight(0xffffff, 1.4));
  const sun = new lib.DirectionalLight(0xffffff, 2);
  sun.position.set(3, -5, 8);
  scene.add(sun);
  const bodies = run.header.bodies.map(bodyOf);
  bodies.forEach(body => scene.add(body));

  // A wire is a line that is seen from afar, and cylinders of its true radius.
  const lines = run.header.wires.map(() => {
    const line = new lib.LineSegments2(new lib.LineSegmentsGeometry(), new lib.LineMaterial({ linewidth: 2.5, vertexColors: true }));
    line.frustumCulled = false;
    scene.add(line);
    return line;
  });
  const room = largest(frames.map(frame => frame.wires.reduce((sum, wire) => sum + wire.length / 3, 0)), 1);
  const tubes = new lib.InstancedMesh(new lib.CylinderGeometry(1, 1, 1, 12), new lib.MeshStandardMaterial(), room);
  tubes.frustumCulled = false;
  scene.add(tubes);
  const points = size => {
    const geometry = new lib.BufferGeometry();
    for (const name of ["position", "color"]) geometry.setAttribute(name, new lib.BufferAttribute(new Float32Array(3 * room), 3));
    const all = new lib.Points(geometry, new lib.PointsMaterial({ size, sizeAttenuation: false, vertexColors: true, depthTest: false }));
    all.frustumCulled = false;
    scene.add(all);
    return all;
  };
  const nodes = points(5);
  const contacts = new lib.LineSegments(new lib.BufferGeometry(), new lib.LineBasicMaterial({ vertexColors: true, depthTest: false }));
  contacts.frustumCulled = false;
  scene.add(contacts);

  const camera = new lib.PerspectiveCamera(40, 1, 0.01, 1000);
  camera.up.set(0, 0, 1);
  const controls = new lib.OrbitControls(camera, renderer.domElement);
  // All wires, and the bodies that move.
  const all = frames[0].wires.flat();
  run.header.bodies.forEach(({ dynamic }, k) => {
    if (dynamic) for (const way of [-1, 1]) all.push(...frames[0].bodies[k].slice(0, 3).map(x => x + way * bodies[k].userData.radius));
  });
  const range = [0, 1, 2].map(axis => {
    const of = all.filter((_, k) => k % 3 === axis);
    return [of.reduce((a, b) => Math.min(a, b), Infinity), of.reduce((a, b) => Math.max(a, b), -Infinity)];
  });
  const middle = new lib.Vector3(...range.map(([low, high]) => (low + high) / 2));
  const size = Math.hypot(...range.map(([low, high]) => high - low)) || 1;
  const back = new lib.Vector3(0.55, -1.05, 0.4).normalize();
  const right = camera.up.clone().cross(back).normalize(), top = back.clone().cross(right);
  // So far back that every corner of what there is at the start is seen, with some room.
  const away = Array.from({ length: 8 }, (_, k) => {
    const corner = new lib.Vector3(...range.map((ends, axis) => ends[k >> axis & 1])).sub(middle);
    return Math.max(...[right, top].map(way => Math.abs(corner.dot(way)))) / Math.tan(Math.PI / 9) + corner.dot(back);
  });
  controls.target.copy(middle);
  camera.position.copy(middle).addScaledVector(back, 1.15 * Math.max(...away, size / 2));
  controls.update();

  const up = new lib.Vector3(0, 1, 0);
  function show(frame) {
    frame.bodies.forEach((pose, k) => {
      bodies[k].position.set(...pose.slice(0, 3));
      bodies[k].quaternion.set(...pose.slice(3));
    });
    const position = nodes.geometry.attributes.position, tone = nodes.geometry.attributes.color;
    let count = 0, tube = 0;
    frame.wires.forEach((wire, w) => {
      const at = k => new lib.Vector3(...wire.slice(3 * k, 3 * k + 3));
      const ends = [], colours = [];
      for (let k = 0; 3 * k < wire.length; k++) {
        position.setXYZ(count, ...at(k));
        tone.setXYZ(count++, ...new lib.Color(kinds[frame.kinds[w][k]][1]));
        if (k === 0) continue;
        const [a, b] = [at(k - 1), at(k)], along = b.clone().sub(a), length = along.length();
        const shade = tint(frame.tensions[w][k - 1]), radius = run.header.wires[w].material.radius;
        ends.push(...a, ...b);
        colours.push(...shade, ...shade);
        const turn = new lib.Quaternion().setFromUnitVectors(up, along.normalize());
        const matrix = new lib.Matrix4().compose(a.add(b).multiplyScalar(0.5), turn, new lib.Vector3(radius, length, radius));
        tubes.setMatrixAt(tube, matrix);
        tubes.setColorAt(tube++, shade);
      }
      lines[w].geometry.dispose();
      lines[w].geometry = new lib.LineSegmentsGeometry();
      lines[w].geometry.setPositions(ends);
      lines[w].geometry.setColors(colours);
    });
    nodes.geometry.setDrawRange(0, count);
    position.needsUpdate = tone.needsUpdate = true;
    tubes.count = tube;
    tubes.instanceMatrix.needsUpdate = true;
    if (tubes.instanceColor) tubes.instanceColor.needsUpdate = true;
    showContacts(frame);
    renderer.render(scene, camera);
  }

  /* Each contact: its normal in orange, its force in green, the longest a tenth of the scene. */
  function showContacts(frame) {
    const force = contact => Math.hypot(...contact.slice(6));
    const strongest = largest(frame.contacts.map(force), 1e-9);
    const ends = [], colours = [];
    for (const contact of frame.contacts) {
      const at = contact.slice(0, 3);
      const draw = (way, scale, shade) => {
        ends.push(...at, ...at.map((x, axis) => x + scale * way[axis]));
        colours.push(...shade, ...shade);
      };
      draw(contact.slice(3, 6), 0.05 * size, [1, 0.5, 0.05]);
      draw(contact.slice(6), 0.1 * size / strongest, [0.17, 0.63, 0.17]);
    }
    contacts.geometry.dispose();
    contacts.geometry = new lib.BufferGeometry();
    contacts.geometry.setAttribute("position", new lib.BufferAttribute(new Float32Array(ends), 3));
    contacts.geometry.setAttribute("color", new lib.BufferAttribute(new Float32Array(colours), 3));
  }

  function fit() {
    const { clientWidth: width, clientHeight: height } = box;
    renderer.setSize(width, height);
    camera.aspect = width / height;
    // A tall window sees as much to the sides as a wide one up and down.
    camera.fov = camera.aspect < 1 ? 2 * Math.atan(Math.tan(Math.PI / 9) / camera.aspect) * 180 / Math.PI : 40;
    camera.updateProjectionMatrix();
  }
  return { show, fit, controls };
}

/* The charts, all on the clock of the view. */
function charts(seek) {
  const times = frames.map(frame => frame.time);
  const spins = run.header.bodies.map((body, k) => body.dynamic ? k : -1).filter(k => k >= 0);
  const palette = ["#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf", "#8c564b", "#e377c2"];
  const all = [
    ["Largest tension of each wire, N", run.header.wires.map((_, w) => [run.names.wires[w], frames.map(frame => frame.tensions[w].reduce((a, b) => Math.max(a, b), 0))])],
    ["Energy, J", ["kinetic", "potential", "elastic"].map((name, k) => [name, frames.map(frame => frame.energy[k])])],
    ["Contacts", [["contacts", frames.map(frame => frame.contacts.length)], ["met on the way", frames.map(frame => frame.met)]]],
    ["Angular velocity, rad/s", spins.map(k => [run.names.bodies[k], frames.map(frame => frame.spin[k])])],
  ];
  return all.filter(([, series]) => series.length).map(([title, series]) => {
    const box = document.createElement("div");
    box.className = "chart";
    box.append(Object.assign(document.createElement("h2"), { textContent: title }));
    byId("charts").append(box);
    const axis = { stroke: colour("--pale"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false }, font: "11px system-ui", size: 34 };
    const brief = (_, values) => values.map(value => Math.abs(value) >= 1e4 ? value.toExponential(0) : value);
    const chart = new lib.uPlot({
      width: 300, height: 150,
      cursor: { sync: { key: "clock" }, drag: { x: false, y: false } },
      scales: { x: { time: false } },
      axes: [axis, { ...axis, size: 48, values: brief }],
      series: [{ label: "s" }, ...series.map(([label], k) => ({ label, stroke: palette[k % palette.length], width: 1.5, points: { show: false } }))],
    }, [times, ...series.map(([, values]) => values)], box);
    const now = document.createElement("div");
    now.className = "now";
    chart.over.append(now);
    chart.over.addEventListener("click", event => seek(chart.posToVal(event.offsetX, "x")));
    return {
      fit: () => chart.setSize({ width: Math.max(240, box.clientWidth - 12), height: 150 }),
      mark: time => { now.style.left = `${chart.valToPos(time, "x")}px`; },
    };
  });
}

/* What happened, on the time line: tunnels red, what was prevented amber. */
function marks() {
  const names = { missed: "--red", tunnelled: "--red", returned: "--accent", prevented: "--amber" };
  const ticks = frames.flatMap((frame, k) => Object.keys(names).filter(name => frame.events[name])
    .map(name => `<rect data-event="${name}" x="${1000 * k / Math.max(1, last)}" y="0" width="3" height="10" fill="${colour(names[name])}"><title>${frame.time.toFixed(3)} s: ${name} ${frame.events[name]}</title></rect>`));
  byId("marks").innerHTML = ticks.join("");
}

function legend() {
  const scale = [0, 0.25, 0.5, 0.75, 1].map(share => `#${tint(share * share * most).getHexString()}`);
  const used = new Set(frames.flatMap(frame => frame.kinds).join(""));
  const dots = [...used].map(kind => `<span class="dot" style="background:${kinds[kind][1]}"></span>${kinds[kind][0]}`);
  byId("legend").innerHTML = `0<span class="scale" style="background:linear-gradient(90deg,${scale})"></span>${Math.round(most).toLocaleString("en")} N ${dots.join("")}`;
}

let time = frames[0].time, playing = false, before = 0;
const end = frames[last].time;
const frameAt = t => {
  let [low, high] = [0, last];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (frames[middle].time <= t + 1e-9) low = middle; else high = middle - 1;
  }
  return low;
};
let scene = null;
try {
  scene = view(byId("view"));
} catch (error) {
  byId("view").append(`This browser draws no 3D: ${error.message}`);
}
const plots = charts(t => { pause(); seek(t); });

function seek(t) {
  time = Math.min(end, Math.max(frames[0].time, t));
  const k = frameAt(time), frame = frames[k];
  byId("time").value = k;
  byId("clock").textContent = `${frame.time.toFixed(3)} s`;
  const events = Object.entries(frame.events).filter(([, count]) => count).map(([name, count]) => `${name} ${count}`);
  byId("events").textContent = events.join(", ") || "nothing met";
  byId("events").className = frame.events.missed || frame.events.tunnelled ? "red" : "";
  plots.forEach(plot => plot.mark(frame.time));
  scene?.show(frame);
}

function pause() {
  playing = false;
  byId("play").textContent = "Play";
}

function play() {
  playing = true;
  if (time >= end) time = frames[0].time;
  before = performance.now();
  byId("play").textContent = "Pause";
  requestAnimationFrame(tick);
}

function tick(now) {
  if (!playing) return;
  seek(time + (now - before) / 1000 * Number(byId("speed").value));
  before = now;
  if (time >= end) pause(); else requestAnimationFrame(tick);
}

function fit() {
  scene?.fit();
  plots.forEach(plot => plot.fit());
  seek(time);
}

byId("time").max = last;
byId("time").addEventListener("input", event => { pause(); seek(frames[Number(event.target.value)].time); });
byId("play").addEventListener("click", () => playing ? pause() : play());
addEventListener("keydown", event => {
  if (event.target.matches("input, select, button")) return;
  const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (event.key === " ") { event.preventDefault(); playing ? pause() : play(); }
  if (step) { pause(); seek(frames[Math.min(last, Math.max(0, frameAt(time) + step))].time); }
});
scene?.controls.addEventListener("change", () => { if (!playing) scene.show(frames[frameAt(time)]); });
addEventListener("resize", fit);
legend();
marks();
fit();
