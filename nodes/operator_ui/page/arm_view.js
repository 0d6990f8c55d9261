// The arm at its table in three dimensions: drawn with WebGL from what the robot's planner says it looks like.

import { box, cylinder, flat, sphere, tube } from "./solids.js";
import { along, inverse, look, matrix, multiply, perspective, times, turned } from "./poses.js";

const VERTEX = `attribute vec3 at, normal; uniform mat4 pose, view; uniform vec3 size; varying vec3 n;
void main() { n = mat3(pose) * normal; gl_Position = view * (pose * vec4(at * size, 1.0)); }`;
const FRAGMENT = `precision mediump float; uniform vec4 colour; uniform float shine; varying vec3 n;
void main() { vec3 u = normalize(n); float sun = max(0.0, dot(u, normalize(vec3(0.4, -0.55, 0.9)))), sky = 0.5 + 0.5 * u.z;
  gl_FragColor = vec4(mix(colour.rgb, colour.rgb * (0.42 + 0.33 * sky + 0.42 * sun), shine) * colour.a, colour.a); }`;
const FIELD_RAD = 0.6;
const SLAB_M = 0.04;
const HOME = { yaw: -0.62, pitch: 0.62, zoom: 1 };
const STILL = [0, 0, 0, 0, 0, 0, 1];
const clamp = (v, low, high) => Math.min(high, Math.max(low, v));

export class ArmView {
  constructor(canvas) {
    this.canvas = canvas;
    this.view = { scene: null, arm: null, pose: null, replayed: false, way: null, tray: null, target: null, spots: [], dark: false };
    this.camera = { ...HOME };
    this.pointers = new Map();
    this.labels = document.createElement("div");
    this.labels.className = "arm-labels";
    this.labels.setAttribute("aria-hidden", "true");
    canvas.after(this.labels);
    this.start();
    canvas.addEventListener("webglcontextlost", (event) => { event.preventDefault(); this.gl = null; });
    canvas.addEventListener("webglcontextrestored", () => { this.start(); this.changed(); });
    canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); this.pointers.set(event.pointerId, [event.clientX, event.clientY]); });
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, (event) => this.pointers.delete(event.pointerId));
    // The page scrolls over the picture; who wants to come nearer has put the focus on it, or holds the control key.
    canvas.addEventListener("wheel", (event) => { if (event.ctrlKey || document.activeElement === canvas) { event.preventDefault(); this.turn(0, 0, Math.exp(-0.0015 * event.deltaY)); } }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("dblclick", () => this.home());
    new ResizeObserver(() => this.changed()).observe(canvas);
  }

  /** Whether this browser can draw it. */
  get works() { return Boolean(this.gl); }

  start() {
    const gl = this.canvas.getContext("webgl", { antialias: true, premultipliedAlpha: true });
    this.gl = gl;
    this.meshes = null;
    if (!gl) return;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    this.at = gl.getAttribLocation(program, "at");
    this.normal = gl.getAttribLocation(program, "normal");
    this.uniform = Object.fromEntries(["pose", "view", "size", "colour", "shine"].map((name) => [name, gl.getUniformLocation(program, name)]));
    this.unit = { box: this.upload(box()), cylinder: this.upload(cylinder()), sphere: this.upload(sphere()) };
    this.key3d = null;
    this.wayKey = null;
  }

  upload(numbers) {
    const gl = this.gl, buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
    return { buffer, count: numbers.length / 6 };
  }

  /** Shows another state; drawn at the next frame, if anything differs. */
  show(view) {
    const differs = Object.keys(view).some((name) => view[name] !== this.view[name]);
    Object.assign(this.view, view);
    if (differs) this.changed();
  }

  home() { this.camera = { ...HOME }; this.changed(); }

  turn(yaw, pitch, zoom) {
    const { camera } = this;
    camera.yaw += yaw;
    camera.pitch = clamp(camera.pitch + pitch, -0.1, 1.5);
    camera.zoom = clamp(camera.zoom * zoom, 0.4, 6);
    this.changed();
  }

  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY], others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    if (others.length) {
      const apart = (at) => Math.hypot(at[0] - others[0][0], at[1] - others[0][1]);
      this.turn(0, 0, apart(now) / Math.max(1, apart(before)));
    } else this.turn(-0.008 * (now[0] - before[0]), 0.008 * (now[1] - before[1]), 1);
    this.pointers.set(event.pointerId, now);
  }

  key(event) {
    const step = { ArrowLeft: [0.15, 0, 1], ArrowRight: [-0.15, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1], "+": [0, 0, 1.2], "=": [0, 0, 1.2], "-": [0, 0, 1 / 1.2] }[event.key];
    if (!step && event.key !== "Home") return;
    event.preventDefault();
    if (step) this.turn(...step);
    else this.home();
  }

  changed() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => { this.frame = 0; this.draw(); });
  }

  /** Middle and radius of what is to be seen: the table and the arm. */
  extent() {
    const { scene, pose } = this.view, low = [0, 0, 0], high = [scene.width_m, scene.depth_m, 0.25];
    const poses = (pose ?? []).map(Number);
    for (let i = 0; i + 2 < poses.length; i += 7) for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k], Math.max(poses[i + k], -3));
      high[k] = Math.max(high[k], Math.min(poses[i + k], 3));
    }
    const middle = low.map((v, k) => (v + high[k]) / 2);
    // What is near looks large: a little less height than there is brings the table up.
    middle[2] *= 0.65;
    return { middle, radius: Math.max(0.2, Math.hypot(...high.map((v, k) => v - middle[k]))) };
  }

  colours() {
    const style = getComputedStyle(this.canvas), context = (this.paint ??= document.createElement("canvas").getContext("2d"));
    const of = (name, spare) => {
      context.fillStyle = spare;
      context.fillStyle = style.getPropertyValue(name).trim() || spare;
      return [1, 3, 5].map((i) => parseInt(context.fillStyle.slice(i, i + 2), 16) / 255);
    };
    const names = { wood: "--wood", edge: "--wood-edge", object: "--object", target: "--target", guess: "--guess", good: "--good", bad: "--bad", accent: "--accent", muted: "--muted", surface: "--surface" };
    return { ...Object.fromEntries(Object.entries(names).map(([key, name]) => [key, of(name, "#888888")])), hues: [0, 1, 2, 3, 4, 5].map((i) => of(`--h${i}`, "#888888")) };
  }

  draw() {
    const { gl, canvas, view } = this, ratio = Math.min(2, devicePixelRatio || 1), width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (!gl || !view.scene || !width || !height) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    this.prepare();
    const { middle, radius } = this.extent(), { yaw, pitch, zoom } = this.camera, aspect = width / height;
    const distance = radius / Math.sin(FIELD_RAD / 2) / zoom * 0.82;
    const eye = [Math.sin(yaw + Math.PI) * Math.cos(pitch), Math.cos(yaw + Math.PI) * Math.cos(pitch), Math.sin(pitch)].map((v, k) => middle[k] + distance * v);
    this.camera.matrix = times(perspective(FIELD_RAD, aspect, distance / 20, distance + 4 * radius), look(eye, middle));
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.uniformMatrix4fv(this.uniform.view, false, this.camera.matrix);
    const c = this.colours(), { scene } = view;
    this.put(this.unit.box, [scene.width_m / 2, scene.depth_m / 2, -SLAB_M / 2, 0, 0, 0, 1], [scene.width_m, scene.depth_m, SLAB_M], c.wood, 1);
    if (view.tray) this.tray(view.tray, c.wood);
    scene.objects.forEach((object, i) => this.object(object, 0, c.hues[i % 6].map((v, k) => 0.55 * v + 0.45 * c.object[k]), 1));
    for (const spot of view.spots) this.put(this.unit.cylinder, [spot.x_m, spot.y_m, 0.002, 0, 0, 0, 1], [0.016, 0.016, 0.004], { chosen: c.good, spare: c.accent }[spot.kind] ?? c.bad, 1, 0.3);
    if (this.way) this.put(this.way, STILL, [1, 1, 1], c.accent, 1, 0.4);
    const metal = c.muted.map((v, k) => 0.5 * v + 0.5 * (view.dark ? 0.75 : c.surface[k]));
    this.arm(view.pose, view.replayed ? metal.map((v, k) => 0.6 * v + 0.4 * c.guess[k]) : metal);
    // What is translucent comes last and hides nothing behind it.
    gl.depthMask(false);
    gl.enable(gl.CULL_FACE);
    if (view.target) this.object(view.target, view.target.z_m, c.target, view.target.alpha ?? 0.45);
    gl.disable(gl.CULL_FACE);
    gl.depthMask(true);
    this.write(width / ratio, height / ratio);
  }

  /** What the target waits on, when that is not the table. */
  tray({ pick: [x, y, z], target }, colour) {
    const { width_m, depth_m } = this.view.scene;
    if (!target || (x >= 0 && x <= width_m && y >= 0 && y <= depth_m)) return;
    const radius = 0.8 * Math.hypot(target.size_x_m, target.size_y_m);
    this.put(this.unit.cylinder, [x, y, z - SLAB_M / 4, 0, 0, 0, 1], [radius, radius, SLAB_M / 2], colour, 1);
  }

  /** Meshes of this arm, and the tube of this way. */
  prepare() {
    const { arm, way } = this.view, gl = this.gl;
    if (this.key3d !== arm) {
      this.key3d = arm;
      for (const mesh of this.meshes?.values() ?? []) gl.deleteBuffer(mesh.buffer);
      this.meshes = new Map();
      for (const part of arm?.links.flat() ?? []) if (part.mesh) this.meshes.set(part, this.upload(flat(part.mesh.points, part.mesh.triangles)));
    }
    if (this.wayKey !== way) {
      this.wayKey = way;
      if (this.way) gl.deleteBuffer(this.way.buffer);
      this.way = way && way.length >= 6 ? this.upload(tube(way, 0.004)) : null;
    }
  }

  arm(poses, tone) {
    const { arm } = this.view;
    if (!arm || !poses || poses.length !== 7 * arm.links.length) return;
    arm.links.forEach((parts, link) => {
      const at = poses.slice(7 * link, 7 * link + 7), shade = link % 2 ? 0.86 : 1.08;
      for (const part of parts) {
        const here = multiply(at, part.at), colour = tone.map((v) => Math.min(1, v * shade));
        if (part.box) this.put(this.unit.box, here, part.box, colour, 1);
        else if (part.cylinder) this.put(this.unit.cylinder, here, [part.cylinder[0], part.cylinder[0], part.cylinder[1]], colour, 1);
        else if (part.sphere) this.put(this.unit.sphere, here, [part.sphere, part.sphere, part.sphere], colour, 1);
        else if (part.capsule) this.capsule(here, part.capsule, colour);
        else if (part.mesh) this.put(this.meshes.get(part), here, [1, 1, 1], colour, 1);
      }
    });
  }

  capsule(at, [radius, length], colour) {
    this.put(this.unit.cylinder, at, [radius, radius, length], colour, 1);
    for (const end of [-0.5, 0.5]) this.put(this.unit.sphere, multiply(at, [0, 0, end * length, 0, 0, 0, 1]), [radius, radius, radius], colour, 1);
  }

  /** A thing that stands at a height; turned by a pose of its own while it is carried. */
  object(object, z_m, colour, alpha) {
    const size = object.shape === "box" ? [object.size_x_m, object.size_y_m, object.size_z_m] : [object.size_x_m / 2, object.size_x_m / 2, object.size_z_m];
    const at = object.pose ?? [object.x_m, object.y_m, z_m, ...turned(object.yaw_rad)];
    this.put(object.shape === "box" ? this.unit.box : this.unit.cylinder, multiply(at, [0, 0, object.size_z_m / 2, 0, 0, 0, 1]), size, colour, alpha);
  }

  put(mesh, pose, size, colour, alpha, shine = 1) {
    const { gl, uniform } = this;
    if (!mesh || ![...pose, ...size].every(Number.isFinite)) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
    gl.enableVertexAttribArray(this.at);
    gl.enableVertexAttribArray(this.normal);
    gl.vertexAttribPointer(this.at, 3, gl.FLOAT, false, 24, 0);
    gl.vertexAttribPointer(this.normal, 3, gl.FLOAT, false, 24, 12);
    gl.uniformMatrix4fv(uniform.pose, false, matrix(pose));
    gl.uniform3fv(uniform.size, size);
    gl.uniform4f(uniform.colour, ...colour, alpha);
    gl.uniform1f(uniform.shine, shine);
    gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
  }

  /** Names of things and numbers of places, over the picture. */
  write(width, height) {
    const { scene, spots, target } = this.view;
    const texts = [
      ...scene.objects.map((object) => ({ text: object.label, at: [object.x_m, object.y_m, object.size_z_m + 0.03], kind: "" })),
      ...spots.map((spot) => ({ text: spot.label, at: [spot.x_m, spot.y_m, 0.02], kind: spot.kind, isPlace: true })),
      ...(target ? [{ text: target.label, at: target.pose ? along(target.pose, [0, 0, target.size_z_m + 0.03]) : [target.x_m, target.y_m, target.z_m + target.size_z_m + 0.03], kind: "target" }] : []),
    ];
    while (this.labels.children.length > texts.length) this.labels.lastChild.remove();
    const shown = texts.map(({ text, at, kind, isPlace = false }, i) => {
      const label = this.labels.children[i] ?? this.labels.appendChild(document.createElement("span")), m = this.camera.matrix;
      const p = [0, 1, 2, 3].map((row) => m[row] * at[0] + m[4 + row] * at[1] + m[8 + row] * at[2] + m[12 + row]);
      if (label.textContent !== text) label.textContent = text;
      label.className = `arm-label ${kind}`;
      label.hidden = !(p[3] > 0);
      return { label, x: (0.5 + p[0] / p[3] / 2) * width, y: (0.5 - p[1] / p[3] / 2) * height, far: p[3], isPlace };
    }).filter(({ label }) => !label.hidden);
    // Measured when all are written, so that the browser lays them out once.
    for (const one of shown) Object.assign(one, { w: one.label.offsetWidth, h: one.label.offsetHeight });
    for (const { label, x, y } of stepAside(shown, height)) label.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
  }
}

/** Moves labels that would cover others up or down, no further than it takes. A number keeps its place before a name, because it says where; then what is near before what is far. */
function stepAside(labels, height) {
  const placed = [];
  for (const label of labels.toSorted((a, b) => b.isPlace - a.isPlace || a.far - b.far)) {
    const beside = placed.filter((other) => 2 * Math.abs(other.x - label.x) < other.w + label.w);
    const isFree = (y) => beside.every((other) => 2 * Math.abs(other.y - y) > other.h + label.h - 0.1);
    const rows = [label.y, ...beside.flatMap((other) => [-0.5, 0.5].map((side) => other.y + side * (other.h + label.h)))].filter(isFree).sort((a, b) => Math.abs(a - label.y) - Math.abs(b - label.y));
    // Above the topmost there is always room, but perhaps not in the picture.
    placed.push({ ...label, y: rows.find((y) => 2 * y > label.h && 2 * (height - y) > label.h) ?? rows[0] });
  }
  return placed;
}

/** The poses of all links at a time between those of a motion: the nearest two, mixed. */
export function posesAt(motion, seconds) {
  const { times_s: t, poses } = motion;
  if (!t.length) return null;
  let i = t.findIndex((at) => at >= seconds);
  if (i < 0) i = t.length - 1;
  if (i === 0) return poses[0];
  const share = clamp((seconds - t[i - 1]) / Math.max(1e-9, t[i] - t[i - 1]), 0, 1), [from, to] = [poses[i - 1], poses[i]], mixed = new Array(from.length);
  for (let k = 0; k < from.length; k += 7) {
    for (let j = 0; j < 3; j++) mixed[k + j] = from[k + j] + share * (to[k + j] - from[k + j]);
    // The shorter way round: a quaternion and its negative turn alike.
    const sign = from[k + 3] * to[k + 3] + from[k + 4] * to[k + 4] + from[k + 5] * to[k + 5] + from[k + 6] * to[k + 6] < 0 ? -1 : 1;
    const q = [3, 4, 5, 6].map((j) => from[k + j] + share * (sign * to[k + j] - from[k + j])), norm = Math.hypot(...q) || 1;
    q.forEach((v, j) => { mixed[k + 3 + j] = v / norm; });
  }
  return mixed;
}

/** Where the target is while the hand carries it: fixed to the link that is nearest to the end of the way when it lets go. */
export function carried(motion, poses) {
  const { target, way, target_z_m } = motion, last = posesAt(motion, motion.held_s[1]);
  if (!target || !last || !poses) return null;
  const end = way.slice(-3), far = (k) => Math.hypot(...[0, 1, 2].map((j) => last[k + j] - end[j]));
  let hand = 0;
  // Of links in one place the last is the tool.
  for (let k = 0; k < last.length; k += 7) if (far(k) <= far(hand) + 1e-6) hand = k;
  const held = multiply(inverse(last.slice(hand, hand + 7)), [target.x_m, target.y_m, target_z_m, ...turned(target.yaw_rad)]);
  return multiply(poses.slice(hand, hand + 7), held);
}
