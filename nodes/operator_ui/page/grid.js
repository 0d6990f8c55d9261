// A grid of cells from above, and what a policy does in each: arrows as long as the action is likely.

import { element } from "./drawing.js";
import { percent } from "./risk.js";
import { WORLD } from "./words.js";

const LEAST = 0.02;

/** An arrow from a little behind a point along a direction, `length` pixels and `width` thick. */
export function arrow(className, px, py, [dx, dy], length, width = 2.2) {
  const x = px - 0.35 * length * dx, y = py - 0.35 * length * dy;
  const tip = { x: x + dx * length, y: y + dy * length }, head = Math.min(6 + width, length * 0.42);
  const wing = (side) => `M${tip.x.toFixed(1)} ${tip.y.toFixed(1)}L${(tip.x - head * (dx + side * dy * 0.75)).toFixed(1)} ${(tip.y - head * (dy - side * dx * 0.75)).toFixed(1)}`;
  return element("path", { class: className, "stroke-width": width, d: `M${x.toFixed(1)} ${y.toFixed(1)}L${tip.x.toFixed(1)} ${tip.y.toFixed(1)}${wing(1)}${wing(-1)}` });
}

/** Where the cells of a grid lie in a box: the size of one, and the middle of each state. */
export function gridFrame(world, box) {
  const { rows, columns } = world.picture, W = Math.max(200, box.width), H = Math.max(200, box.height), margin = 18;
  const k = Math.max(8, Math.min((W - 2 * margin) / columns, (H - 2 * margin) / rows)), x0 = (W - k * columns) / 2, y0 = (H - k * rows) / 2;
  return { W, H, k, x0, y0, middle: (s) => [x0 + ((s % columns) + 0.5) * k, y0 + (Math.floor(s / columns) + 0.5) * k] };
}

/** Draws the grid into an SVG. `table` holds π(a|s), `visits` how often a state is come to; both may be empty. */
export function drawGrid(svg, world, table, visits, looked) {
  const { rows, columns, moves } = world.picture, { W, H, k, x0, y0 } = gridFrame(world, svg.parentElement.getBoundingClientRect());
  const n = world.actions.length;
  svg.setAttribute("viewBox", `0 0 ${W} ${H}`);
  const most = Math.max(1e-12, ...visits), pieces = [];
  for (let s = 0; s < rows * columns; s++) {
    const x = x0 + (s % columns) * k, y = y0 + Math.floor(s / columns) * k, feature = world.cells[s], cx = x + k / 2, cy = y + k / 2;
    const share = visits.length ? visits[s] / most : 0, ended = world.terminals.includes(s);
    const cell = element("g", { class: `cell${feature === null ? "" : ` hue-${feature % 6}`}${looked === s ? " looked" : ""}`, "data-state": s });
    cell.append(element("rect", { class: "cell-ground", x: x + 1, y: y + 1, width: k - 2, height: k - 2, rx: Math.min(8, k / 8) }));
    if (k > 58 && feature !== null) cell.append(element("text", { class: "cell-name", x: x + 8, y: y + k - 9 }, world.features[feature]));
    if (world.starts.includes(s) && world.starts.length <= 12) cell.append(element("circle", { class: "cell-start", cx, cy, r: k * 0.34 }));
    if (ended) cell.append(element("circle", { class: "cell-end", cx, cy, r: k * 0.2 }), element("circle", { class: "cell-end-core", cx, cy, r: k * 0.09 }));
    for (let a = 0; table.length && !ended && a < n; a++) {
      const p = table[s * n + a], [down, right] = moves[a] ?? [0, 0];
      if (p < LEAST) continue;
      const className = `move${visits.length && share < 0.002 ? " never" : ""}`, width = visits.length ? 1.5 + 3 * Math.sqrt(share) : 2.2;
      if (down === 0 && right === 0) cell.append(element("circle", { class: `${className} stay`, cx, cy, r: Math.max(2, k * 0.07 * p) }));
      else cell.append(arrow(className, cx, cy, [right, down], k * (0.1 + 0.28 * p), width));
    }
    pieces.push(cell);
  }
  svg.replaceChildren(...pieces);
  svg.setAttribute("aria-label", WORLD.grid(rows, columns, way(world, table)));
}

/** The likeliest way from each of the first starts, in words. */
function way(world, table) {
  if (!table.length) return WORLD.noPolicy;
  const { columns, moves } = world.picture, n = world.actions.length, rows = world.picture.rows;
  const from = (start) => {
    const words = [];
    let s = start;
    for (let step = 0; step < 24 && !world.terminals.includes(s); step++) {
      const row = table.slice(s * n, (s + 1) * n), a = row.indexOf(Math.max(...row)), [down, right] = moves[a] ?? [0, 0];
      words.push(world.actions[a]);
      const r = Math.floor(s / columns) + Math.round(down), c = (s % columns) + Math.round(right);
      if (r < 0 || c < 0 || r >= rows || c >= columns || (down === 0 && right === 0)) break;
      s = r * columns + c;
    }
    return WORLD.from(Math.floor(start / columns) + 1, (start % columns) + 1, words);
  };
  return world.starts.slice(0, 4).map(from).join(" ");
}

/** What is known of a cell, in words. */
export function cellWords(world, table, s) {
  const n = world.actions.length;
  const does = world.terminals.includes(s) ? WORLD.ends : table.length ? actionWords(world, table, s, n) : null;
  return WORLD.state(world, s, does);
}

/** "right 80 %, up 20 %". */
export function actionWords(world, table, s, n) {
  const does = world.actions.map((name, a) => [name, table[s * n + a]]).filter(([, p]) => p >= LEAST).sort((a, b) => b[1] - a[1]);
  return does.map(([name, p]) => (p > 1 - LEAST ? name : `${name} ${percent(Math.round(p * 100) / 100)}`)).join(", ");
}
