// Where things are and where the target cannot be; the same rules as the crate `scene`. Metres, x right, y away from the robot.

import { TABLE } from "./words.js";

/** Radius of the smallest circle about the centre that holds an object's footprint. */
export function boundingRadius(object) {
  return object.shape === "box" ? Math.hypot(object.size_x_m, object.size_y_m) / 2 : object.size_x_m / 2;
}

/** Distance from a point to an object's footprint; zero inside. */
export function distanceTo(object, at) {
  const dx = at.x - object.x_m, dy = at.y - object.y_m;
  if (object.shape !== "box") return Math.max(0, Math.hypot(dx, dy) - object.size_x_m / 2);
  const c = Math.cos(object.yaw_rad), s = Math.sin(object.yaw_rad);
  return Math.hypot(
    Math.max(0, Math.abs(c * dx + s * dy) - object.size_x_m / 2),
    Math.max(0, Math.abs(c * dy - s * dx) - object.size_y_m / 2),
  );
}

/** Why the target's centre cannot be at a point, in words; null where it can. */
export function obstruction(scene, at) {
  const r = boundingRadius(scene.target);
  const inside = (v, extent) => v >= r && v <= extent - r;
  if (!inside(at.x, scene.width_m) || !inside(at.y, scene.depth_m)) return TABLE.overEdge;
  const met = scene.objects.find((object) => !object.supports && distanceTo(object, at) < r);
  return met ? TABLE.touches(met.label) : null;
}

/** The free spot nearest to a wish, searched on rings around it; null when there is none. */
export function nearestFree(scene, wish) {
  if (!obstruction(scene, wish)) return wish;
  const reach = Math.hypot(scene.width_m, scene.depth_m);
  for (let radius = 0.01; radius < reach; radius += 0.01) {
    const n = Math.max(8, Math.round(radius * 400));
    for (let i = 0; i < n; i++) {
      const at = { x: wish.x + radius * Math.cos((2 * Math.PI * i) / n), y: wish.y + radius * Math.sin((2 * Math.PI * i) / n) };
      if (!obstruction(scene, at)) return at;
    }
  }
  return null;
}

/** Whether the robot's map says that its arm cannot reach a point. */
export function isUnreachable(plan, scene, at) {
  if (!plan || !plan.cell_state.length) return false;
  const n = plan.map_side;
  const cell = (v, extent) => Math.min(n - 1, Math.max(0, Math.floor((v / extent) * n)));
  return plan.cell_state[cell(at.y, scene.depth_m) * n + cell(at.x, scene.width_m)] === 2;
}

/** What an object looks like from above, in words. */
export function shapeWords(object) {
  return TABLE.shape(object, [cm0(object.size_x_m), cm0(object.size_y_m)]);
}

const cm0 = (m) => (m * 100).toFixed(m * 100 < 10 && (m * 1000) % 10 >= 0.5 ? 1 : 0);

/** Centimetres with one decimal, or a dash. */
export function cm(m) {
  return m === null || m === undefined ? "–" : `${(m * 100).toFixed(1)} cm`;
}
