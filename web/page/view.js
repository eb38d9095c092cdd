"use strict";
// The motion in three dimensions on a plain canvas. Coordinates may be of any size, so what is drawn is the query moved and
// scaled to about 1. Parallel projection: what is drawn under the pointer is where it is dragged to, at the same depth.

const V = {
  add: (a, b) => a.map((x, k) => x + b[k]),
  sub: (a, b) => a.map((x, k) => x - b[k]),
  mul: (a, s) => a.map(x => x * s),
  mix: (a, b, t) => a.map((x, k) => x + (b[k] - x) * t),
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  length: a => Math.hypot(...a),
};

const CSS = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/* Moves and scales coordinates so that these points are about 1 in size, and back. */
function frameOf(points) {
  // Divided first, so that no difference overflows.
  const largest = Math.max(...points.flat().map(Math.abs)) || 1;
  const small = points.map(point => point.map(x => x / largest));
  const ends = [0, 1, 2].map(axis => small.map(point => point[axis])).map(of => [Math.min(...of), Math.max(...of)]);
  const centre = ends.map(([low, high]) => (low + high) / 2);
  const size = Math.max(...ends.map(([low, high]) => high - low)) || 1;
  return {
    to: point => point.map((x, k) => (x / largest - centre[k]) / size),
    from: point => point.map((x, k) => (x * size + centre[k]) * largest),
    // How long 1 is in metres, also as two factors, as it may be beyond f64.
    unit: size * largest,
    factors: [size, largest],
    // A radius of two parts, of which neither the sum nor the ratio need be in f64.
    radius: parts => parts.reduce((sum, part) => sum + part / largest / size, 0),
    bottom: Math.min(...small.map(point => point[2] / size)) - centre[2] / size,
  };
}

class View {
  constructor(canvas, on) {
    this.canvas = canvas;
    this.on = on;
    this.camera = { yaw: 0.6, pitch: 0.42, zoom: 1 };
    this.pan = [0, 0];
    this.selected = null;
    this.pointers = new Map();
    for (const [name, to] of Object.entries({ pointerdown: "down", pointermove: "move", pointerup: "up", pointercancel: "up", wheel: "wheel" })) {
      canvas.addEventListener(name, event => this[to](event), { passive: false });
    }
  }

  show(scene) {
    this.scene = scene;
    this.draw();
  }

  /* Right, up and towards the eye. */
  basis() {
    const { yaw, pitch } = this.camera, [s, c] = [Math.sin(yaw), Math.cos(yaw)], [q, p] = [Math.sin(pitch), Math.cos(pitch)];
    return [[c, s, 0], [s * q, -c * q, p], [s * p, -c * p, q]];
  }

  scale() {
    return Math.min(this.width, this.height * 1.05) * 0.62 * this.camera.zoom;
  }

  /* A point of the frame on the canvas: x, y and how near it is. */
  project(point) {
    const [right, up, back] = this.axes, scale = this.scale();
    return [this.width / 2 + this.pan[0] + scale * V.dot(point, right), this.height / 2 + this.pan[1] - scale * V.dot(point, up), V.dot(point, back)];
  }

  draw() {
    const { canvas, scene } = this, box = canvas.getBoundingClientRect(), ratio = Math.min(devicePixelRatio, 2);
    if (!scene || !box.width) return;
    [this.width, this.height] = [box.width, box.height];
    [canvas.width, canvas.height] = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
    this.pen = canvas.getContext("2d");
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.pen.lineCap = this.pen.lineJoin = "round";
    this.axes = this.basis();
    this.colours = Object.fromEntries(["ink", "pale", "grid", "card", "first", "second", "red", "paper"].map(name => [name, CSS(`--${name}`)]));
    this.points = scene.points.map(scene.frame.to);
    this.parts = [];
    this.floor();
    this.surfaces();
    this.sides();
    this.parts.sort((a, b) => a.depth - b.depth).forEach(part => part.draw());
    this.contact();
    this.handles();
  }

  at(k, t) { return V.mix(this.points[k], this.points[k + 4], t); }

  /* The lines of each side, by their points. */
  lines() {
    return this.scene.kind === "edge-edge" ? [[0, 1, "first"], [2, 3, "second"]] : [[1, 2, "second"], [2, 3, "second"], [3, 1, "second"]];
  }

  path(points, colour, width, dash = []) {
    const { pen } = this;
    pen.beginPath();
    points.forEach((point, k) => pen[k ? "lineTo" : "moveTo"](point[0], point[1]));
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dash);
    pen.stroke();
    pen.setLineDash([]);
  }

  fill(points, colour, alpha) {
    const { pen } = this;
    pen.beginPath();
    points.forEach((point, k) => pen[k ? "lineTo" : "moveTo"](point[0], point[1]));
    pen.closePath();
    pen.globalAlpha = alpha;
    pen.fillStyle = colour;
    pen.fill();
    pen.globalAlpha = 1;
  }

  /* A grid below everything, with the shadows of the sides: they tell what is in front. */
  floor() {
    const z = this.scene.frame.bottom - 0.12, ground = point => [point[0], point[1], z];
    for (let k = -4; k <= 4; k++) {
      const x = k / 5;
      this.path([[x, -0.8, z], [x, 0.8, z]].map(p => this.project(p)), this.colours.grid, 1);
      this.path([[-0.8, x, z], [0.8, x, z]].map(p => this.project(p)), this.colours.grid, 1);
    }
    this.pen.globalAlpha = 0.28;
    for (const [a, b] of this.lines()) {
      this.path([a, b].map(k => this.project(ground(this.at(k, this.scene.time)))), this.colours.ink, 4);
    }
    if (this.scene.kind === "vertex-face") this.path([this.project(ground(this.at(0, this.scene.time)))], this.colours.ink, 8);
    this.pen.globalAlpha = 1;
  }

  /* What the sides sweep, in small pieces so that they hide each other rightly. */
  surfaces() {
    const across = this.scene.kind === "edge-edge" ? 8 : 4, along = 16;
    for (const [a, b, name] of this.lines()) {
      const grid = Array.from({ length: along + 1 }, (_, i) => Array.from({ length: across + 1 }, (_, j) => V.mix(this.at(a, i / along), this.at(b, i / along), j / across)));
      for (let i = 0; i < along; i++) {
        for (let j = 0; j < across; j++) {
          const corners = [grid[i][j], grid[i][j + 1], grid[i + 1][j + 1], grid[i + 1][j]];
          const shape = corners.map(p => this.project(p));
          const normal = V.cross(V.sub(corners[2], corners[0]), V.sub(corners[3], corners[1]));
          const facing = Math.abs(V.dot(normal, this.axes[2])) / (V.length(normal) || 1);
          // What is passed already is stronger.
          const alpha = (0.07 + 0.11 * facing) * ((i + 0.5) / along <= this.scene.time ? 1.7 : 0.75);
          this.parts.push({ depth: shape.reduce((sum, p) => sum + p[2], 0) / 4, draw: () => this.fill(shape, this.colours[name], alpha) });
        }
      }
    }
    this.motions();
  }

  /* The ways of the points, and the sides at the start and at the end. */
  motions() {
    const name = k => this.scene.kind === "edge-edge" ? (k < 2 ? "first" : "second") : (k < 1 ? "first" : "second");
    for (let k = 0; k < 4; k++) this.piece([this.points[k], this.points[k + 4]], this.colours[name(k)], 1, [2, 4], 6);
    for (const [a, b, name] of this.lines()) {
      this.piece([this.points[a], this.points[b]], this.colours[name], 1.6, [], 8);
      this.piece([this.points[a + 4], this.points[b + 4]], this.colours[name], 1.6, [6, 5], 8);
    }
  }

  /* A line in pieces, each at its depth. */
  piece([a, b], colour, width, dash, count) {
    const whole = dash.length > 0;
    const pieces = whole ? 1 : count;
    for (let k = 0; k < pieces; k++) {
      const ends = [V.mix(a, b, k / pieces), V.mix(a, b, (k + 1) / pieces)].map(p => this.project(p));
      this.parts.push({ depth: (ends[0][2] + ends[1][2]) / 2 + 1e-4, draw: () => this.path(ends, colour, width, dash) });
    }
  }

  /* The sides at the time of the clock; with a radius, its half on each side. */
  sides() {
    const { time, radius, kind } = this.scene;
    const width = Math.max(4.5, Math.min(400, radius * this.scale()));
    const now = k => this.at(k, time);
    if (kind === "vertex-face") {
      const corners = [1, 2, 3].map(now).map(p => this.project(p));
      this.parts.push({ depth: corners.reduce((sum, p) => sum + p[2], 0) / 3, draw: () => this.fill(corners, this.colours.second, 0.45) });
      const vertex = this.project(now(0));
      this.parts.push({ depth: vertex[2] + 1e-3, draw: () => this.path([vertex, vertex], this.colours.first, Math.max(11, width)) });
    }
    for (const [a, b, name] of this.lines()) this.piece([now(a), now(b)], this.colours[name], width, [], 24);
  }

  /* Where they touch, if they do: a ring, filled from then on. */
  contact() {
    const { pen } = this, { contacts, time, toi, missed } = this.scene;
    for (const point of contacts) {
      const [x, y] = this.project(point);
      for (const [radius, colour, width] of [[13, this.colours.card, 5], [13, missed ? this.colours.red : this.colours.ink, 2.5]]) {
        pen.beginPath();
        pen.arc(x, y, radius, 0, 2 * Math.PI);
        pen.strokeStyle = colour;
        pen.lineWidth = width;
        pen.stroke();
      }
      if (time >= toi) {
        pen.globalAlpha = 0.3;
        pen.fillStyle = missed ? this.colours.red : this.colours.ink;
        pen.fill();
        pen.globalAlpha = 1;
      }
    }
  }

  handles() {
    const { pen } = this;
    this.spots = this.points.map(point => this.project(point));
    for (const k of [4, 5, 6, 7, 0, 1, 2, 3]) {
      const [x, y] = this.spots[k], first = this.scene.kind === "edge-edge" ? k % 4 < 2 : k % 4 < 1;
      const colour = this.colours[first ? "first" : "second"], isEnd = k > 3, isSelected = k === this.selected;
      pen.beginPath();
      pen.arc(x, y, isSelected ? 9 : 7, 0, 2 * Math.PI);
      pen.fillStyle = isEnd ? this.colours.card : colour;
      pen.fill();
      pen.strokeStyle = isSelected ? this.colours.ink : isEnd ? colour : this.colours.card;
      pen.lineWidth = isSelected ? 3 : 2;
      pen.stroke();
      const still = isEnd && this.points[k].every((x, axis) => x === this.points[k - 4][axis]);
      if (still) continue;
      pen.font = "600 13px system-ui, sans-serif";
      pen.textAlign = "center";
      const label = NAMES[k % 4] + (isEnd ? "′" : "");
      pen.lineWidth = 4;
      pen.strokeStyle = this.colours.card;
      const middle = this.project([0, 0, 0]), away = [x - middle[0], y - middle[1]], far = Math.hypot(...away) || 1;
      const [tx, ty] = [x + 17 * away[0] / far, y + 17 * away[1] / far + 4];
      pen.strokeText(label, tx, ty);
      pen.fillStyle = this.colours.ink;
      pen.fillText(label, tx, ty);
    }
  }

  /* The handle at a place, if any; of those at one spot the selected one, else the start. */
  pick([x, y], reach) {
    const far = k => Math.hypot(this.spots[k][0] - x, this.spots[k][1] - y) - (k === this.selected ? 2 : 0) + (k > 3 ? 0.01 : 0);
    const near = [0, 1, 2, 3, 4, 5, 6, 7].sort((a, b) => far(a) - far(b))[0];
    return far(near) < reach ? near : null;
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  down(event) {
    const at = this.place(event);
    this.canvas.setPointerCapture?.(event.pointerId);
    this.pointers.set(event.pointerId, at);
    this.spread = null;
    if (this.pointers.size > 1) return;
    const handle = this.pick(at, event.pointerType === "mouse" ? 16 : 28);
    this.dragged = handle === null ? null : { handle, depth: this.spots[handle][2], shift: [this.spots[handle][0] - at[0], this.spots[handle][1] - at[1]], alone: event.shiftKey };
    if (handle !== null) {
      this.selected = handle;
      this.on.select(handle);
      this.on.start(handle, event.shiftKey);
    }
    this.draw();
  }

  move(event) {
    const at = this.place(event), before = this.pointers.get(event.pointerId);
    if (!before) {
      if (this.spots) this.canvas.style.cursor = this.pick(at, 16) === null ? "grab" : "pointer";
      return;
    }
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size > 1) return this.pinch();
    if (this.dragged) return this.on.drag(this.dragged.handle, this.unproject(V.add(at, this.dragged.shift), this.dragged.depth));
    this.camera.yaw -= (at[0] - before[0]) * 0.008;
    this.camera.pitch = Math.max(-1.55, Math.min(1.55, this.camera.pitch + (at[1] - before[1]) * 0.008));
    this.on.turn();
  }

  pinch() {
    const [a, b] = [...this.pointers.values()], spread = Math.hypot(a[0] - b[0], a[1] - b[1]) || 1;
    if (this.spread) this.zoom(spread / this.spread);
    this.spread = spread;
  }

  up(event) {
    this.pointers.delete(event.pointerId);
    const { dragged } = this;
    this.dragged = null;
    if (dragged) this.on.stop();
  }

  wheel(event) {
    event.preventDefault();
    this.zoom(Math.exp(-event.deltaY * 0.0012));
  }

  zoom(factor) {
    this.camera.zoom = Math.max(0.2, Math.min(20, this.camera.zoom * factor));
    this.on.turn();
  }

  /* The camera of a link, which may say anything. */
  look(yaw, pitch, zoom) {
    this.camera = { yaw: yaw % (2 * Math.PI), pitch: Math.max(-1.55, Math.min(1.55, pitch)), zoom: Math.max(0.2, Math.min(20, zoom)) };
  }

  /* The point in metres that is at a place of the canvas and so near. */
  unproject([x, y], depth) {
    const [right, up, back] = this.axes, scale = this.scale();
    const [r, u] = [(x - this.width / 2 - this.pan[0]) / scale, -(y - this.height / 2 - this.pan[1]) / scale];
    const point = V.add(V.add(V.mul(right, r), V.mul(up, u)), V.mul(back, depth));
    return this.scene.frame.from(point);
  }
}
