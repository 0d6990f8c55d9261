// The table from above, to scale: objects, the robot's maps and guess, and the target that the person drags.

import { boundingRadius, isUnreachable, nearestFree, obstruction, shapeWords } from "./geometry.js";
import { rewardPicture, shadePicture } from "./maps.js";
import { drawBoard, drawGuess, drawObjects, drawSpots, element, footprint, sideways } from "./drawing.js";
import { drawOptions } from "./pair.js";
import { TABLE } from "./words.js";

const STEP_M = 0.005;
const BIG_STEP_M = 0.02;
const TOUCH_RADIUS_PX = 24;
const MARGIN = { left: 14, top: 14, right: 14, bottom: 34 };

export class TableView {
  /** `on` has moved(at, settled), submitted() and the words the target is described with. */
  constructor(svg, on) {
    this.svg = svg;
    this.on = on;
    this.at = null;
    this.view = { scene: null, plan: null, heat: false, reveal: false, movable: false, locked: false, marks: [], spots: [], options: [] };
    this.layers = Object.fromEntries(["board", "objects", "guess", "spots", "options"].map((name) => [name, svg.appendChild(element("g", { class: name }))]));
    this.target = svg.appendChild(element("g", { id: "target", "data-testid": "target", class: "target", tabindex: "0", role: "application" }));
    this.target.addEventListener("pointerdown", (event) => this.grab(event));
    this.target.addEventListener("pointermove", (event) => this.drag(event));
    this.target.addEventListener("pointerup", (event) => this.release(event));
    this.target.addEventListener("pointercancel", (event) => this.release(event));
    // A page that may scroll takes the drag away, and `touch-action` does not hold on parts of an SVG everywhere.
    this.target.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
    this.target.addEventListener("keydown", (event) => this.key(event));
    svg.addEventListener("click", (event) => this.tap(event));
    svg.addEventListener("pointermove", (event) => this.hover(event));
    svg.addEventListener("pointerleave", () => this.on.hovered(null));
    new ResizeObserver(() => this.draw()).observe(svg.parentElement);
  }

  /** Shows another state; only what differs is drawn again. */
  show(view) {
    this.view = { ...this.view, ...view };
    this.draw();
  }

  /** Puts the target at a place, or back beside the table. */
  place(at) {
    this.at = at;
    this.grip = null;
    this.target.classList.remove("held");
    this.drawTarget();
  }

  layout() {
    const { scene } = this.view, box = this.svg.parentElement.getBoundingClientRect();
    const width = Math.max(200, box.width), height = Math.max(200, box.height);
    const tray = 92, beside = width / height > scene.width_m / scene.depth_m + 0.06;
    const inner = { w: width - MARGIN.left - MARGIN.right - (beside ? tray : 0), h: height - MARGIN.top - MARGIN.bottom - (beside ? 0 : tray) };
    const k = Math.max(20, Math.min(inner.w / scene.width_m, inner.h / scene.depth_m));
    const board = { w: k * scene.width_m, h: k * scene.depth_m };
    const x0 = MARGIN.left + Math.max(0, (inner.w - board.w) / 2), y0 = MARGIN.top + Math.max(0, (inner.h - board.h) / 2);
    const room = beside
      ? { left: x0 + board.w + 12, top: y0 + board.h / 2 - 118, w: tray - 12, h: 236 }
      : { left: x0 + board.w / 2 - 130, top: y0 + board.h + MARGIN.bottom, w: 260, h: tray - 12 };
    const waiting = beside ? { x: room.left + room.w / 2, y: y0 + board.h / 2 } : { x: room.left + 58, y: room.top + room.h / 2 - 8 };
    return { width, height, k, x0, y0, board, tray: { ...room, ...waiting }, beside };
  }

  px(at) { return { x: this.box.x0 + at.x * this.box.k, y: this.box.y0 + this.box.board.h - at.y * this.box.k }; }
  metres(p) { return { x: (p.x - this.box.x0) / this.box.k, y: (this.box.y0 + this.box.board.h - p.y) / this.box.k }; }
  pointer(event) { const r = this.svg.getBoundingClientRect(); return { x: event.clientX - r.left, y: event.clientY - r.top }; }

  draw() {
    const { scene, plan, heat, reveal, movable, marks, dark } = this.view;
    if (!scene) return;
    this.box = this.layout();
    this.svg.setAttribute("viewBox", `0 0 ${this.box.width} ${this.box.height}`);
    const key = [scene, plan, heat, dark].map(identity).join();
    if (key !== this.pictureKey) {
      this.pictureKey = key;
      this.heatUrl = heat && plan ? rewardPicture(plan) : null;
      this.shadeUrl = shade(scene, plan, dark);
    }
    drawBoard(this.layers.board, this, { heat: this.heatUrl, shade: this.shadeUrl, movable });
    drawObjects(this.layers.objects, this, scene, Boolean(this.heatUrl));
    drawGuess(this.layers.guess, this, scene, reveal ? plan : null, marks, movable ? this.at : null);
    drawSpots(this.layers.spots, this, this.view.spots);
    drawOptions(this.layers.options, this, scene, this.view.options);
    this.drawTarget(true);
  }

  drawTarget(rebuild = false) {
    const { scene, movable } = this.view;
    if (!scene || !this.box) return;
    const target = scene.target, r = boundingRadius(target) * this.box.k;
    this.target.toggleAttribute("hidden", !movable);
    this.target.setAttribute("tabindex", movable ? "0" : "-1");
    if (rebuild || this.drawn !== target.id) {
      this.drawn = target.id;
      this.target.replaceChildren(
        element("circle", { class: "hit", r: Math.max(r, TOUCH_RADIUS_PX) }),
        element("circle", { class: "focus-ring", r: r + 6 }),
        footprint({ ...target, yaw_rad: 0 }, this.box.k, "body"),
        element("path", { class: "cross", d: "M-5 0H5M0-5V5" }),
        element("text", { class: "label", y: r + 17, "text-anchor": "middle" }, target.label),
      );
    }
    const p = this.at ? this.px(this.at) : this.box.tray;
    const blocked = this.at && obstruction(scene, this.at);
    this.target.setAttribute("transform", `translate(${p.x.toFixed(2)} ${p.y.toFixed(2)})`);
    this.target.classList.toggle("blocked", Boolean(blocked));
    this.target.classList.toggle("locked", this.view.locked);
    this.target.classList.toggle("waiting", !this.at);
    const guess = this.view.reveal && this.view.plan?.map_placement;
    this.target.lastChild.setAttribute("y", this.at && guess && guess.y_m < this.at.y ? -r - 9 : r + 17);
    this.target.lastChild.setAttribute("x", sideways(this, p.x, target.label));
    const robust = guess && (this.view.plan.robust_placement ?? guess);
    const isNear = (spot) => Math.hypot(spot.x_m - this.at.x, spot.y_m - this.at.y) * this.box.k < 2 * r + 24;
    this.target.classList.toggle("close", Boolean(this.at && guess && (isNear(guess) || isNear(robust))));
    this.target.setAttribute("aria-label", this.at
      ? TABLE.stands(target.label, shapeWords(target), this.at, blocked)
      : TABLE.waits(target.label, shapeWords(target)));
    this.target.dataset.x = this.at ? this.at.x : "";
    this.target.dataset.y = this.at ? this.at.y : "";
    drawGuess(this.layers.guess, this, scene, this.view.reveal ? this.view.plan : null, this.view.marks, movable ? this.at : null);
  }

  /** Whether the target may be moved now. */
  isFree() { return this.view.movable && !this.view.locked; }

  grab(event) {
    if (!this.isFree() || event.button > 0) return;
    event.preventDefault();
    this.target.focus({ preventScroll: true });
    const p = this.pointer(event), now = this.at ? this.px(this.at) : this.box.tray;
    this.grip = { x: now.x - p.x, y: now.y - p.y, from: this.at, moved: false };
    this.target.setPointerCapture(event.pointerId);
    this.target.classList.add("held");
  }

  drag(event) {
    if (!this.grip) return;
    const p = this.pointer(event);
    this.grip.moved = true;
    this.at = this.metres({ x: p.x + this.grip.x, y: p.y + this.grip.y });
    this.drawTarget();
    this.on.moved(this.at, false);
  }

  release(event) {
    if (!this.grip) return;
    const { moved, from } = this.grip, { scene } = this.view;
    this.grip = null;
    this.target.classList.remove("held");
    if (!moved) return;
    if (event.type === "pointercancel") this.at = from;
    const off = this.at && (this.at.x < 0 || this.at.y < 0 || this.at.x > scene.width_m || this.at.y > scene.depth_m);
    if (off) this.at = null;
    this.settledAt = event.timeStamp;
    this.drawTarget();
    this.on.moved(this.at, true);
  }

  tap(event) {
    if (!this.isFree() || this.target.contains(event.target) || event.timeStamp - (this.settledAt ?? -1e9) < 250) return;
    const at = this.metres(this.pointer(event)), { scene } = this.view;
    if (at.x < 0 || at.y < 0 || at.x > scene.width_m || at.y > scene.depth_m) return;
    this.settle(at);
    this.target.focus({ preventScroll: true });
  }

  hover(event) {
    if (this.grip || !this.view.scene || !this.box) return;
    const at = this.metres(this.pointer(event)), { scene } = this.view;
    const on = at.x >= 0 && at.y >= 0 && at.x <= scene.width_m && at.y <= scene.depth_m;
    this.on.hovered(on ? at : null);
  }

  key(event) {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!this.isFree()) return;
    if (event.key === "Enter") {
      event.preventDefault();
      this.on.submitted();
    } else if (move) {
      event.preventDefault();
      const { scene } = this.view, step = event.shiftKey ? BIG_STEP_M : STEP_M;
      if (!this.at) return this.settle(nearestFree(scene, { x: scene.width_m / 2, y: scene.depth_m / 2 }));
      const clamp = (v, extent) => Math.min(extent, Math.max(0, v));
      this.settle({ x: clamp(this.at.x + move[0] * step, scene.width_m), y: clamp(this.at.y + move[1] * step, scene.depth_m) });
    }
  }

  settle(at) {
    this.at = at;
    this.drawTarget();
    this.on.moved(at, true);
  }
}

/** Hatching where the objects or the edge are in the way, and where the robot's map says that the arm does not reach. */
function shade(scene, plan, dark) {
  return shadePicture((u, v) => {
    const at = { x: u * scene.width_m, y: v * scene.depth_m };
    return obstruction(scene, at) ? 1 : isUnreachable(plan, scene, at) ? 2 : 0;
  }, dark);
}

const seen = new WeakMap();
let count = 0;
function identity(value) {
  if (value === null || typeof value !== "object") return String(value);
  if (!seen.has(value)) seen.set(value, ++count);
  return `#${seen.get(value)}`;
}
