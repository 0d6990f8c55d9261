// A road from above, one panel for each lane that other traffic may be in: what the robot does in every lane, by how far
// ahead the traffic is.

import { element } from "./drawing.js";
import { actionWords, arrow } from "./grid.js";
import { WORLD, laneNames } from "./words.js";

const LEAST = 0.02;
/** How to read the picture. */
export const ROAD_KEY = WORLD.roadKey;

const stateOf = ({ lanes, places }, lane, traffic, place) => (lane * (lanes - 2) + traffic) * places + place;

/** Where the cells of a road lie in a box: one panel a lane of the traffic, side by side where there is room. */
export function roadFrame(world, box) {
  const { lanes, places } = world.picture, panels = lanes - 2, W = Math.max(200, box.width), H = Math.max(200, box.height), wide = W > 560;
  const across = wide ? panels : 1, down = wide ? 1 : panels, top = 30, gap = 20, side = 14;
  const k = Math.max(9, Math.min((W - 2 * side - gap * (across - 1)) / (across * lanes), 62));
  const kh = Math.max(9, Math.min((H - 16 - down * (top + gap)) / (down * places), 1.8 * k)), w = k * lanes, h = kh * places;
  const left = (W - across * w - gap * (across - 1)) / 2, upper = Math.max(2, (H - down * (h + top) - gap * (down - 1)) / 2);
  const corner = (t) => [left + (wide ? t * (w + gap) : 0), upper + top + (wide ? 0 : t * (h + top + gap))];
  const middle = (s) => { const [x, y] = corner(Math.floor(s / places) % panels); return [x + (Math.floor(s / (places * panels)) + 0.5) * k, y + ((s % places) + 0.5) * kh]; };
  return { W, H, k, kh, w, h, corner, middle, panel: (s) => Math.floor(s / places) % panels };
}

/** Draws the road into an SVG. `table` holds π(a|s); `touching` the feature whose cells are collisions. */
export function drawRoad(svg, world, table, visits, looked) {
  const { lanes, places, moves } = world.picture, panels = lanes - 2, n = world.actions.length;
  const { W, H, k, kh, w, h, corner } = roadFrame(world, svg.parentElement.getBoundingClientRect()), panel = { w, h };
  svg.setAttribute("viewBox", `0 0 ${W} ${H}`);
  const most = Math.max(1e-12, ...visits), names = laneNames(lanes), pieces = [];
  for (let t = 0; t < panels; t++) {
    const [x0, y0] = corner(t);
    pieces.push(element("text", { class: "road-title", x: x0 + panel.w / 2, y: y0 - 11, "text-anchor": "middle" }, WORLD.traffic(names[t + 1])));
    for (let lane = 0; lane < lanes; lane++) pieces.push(element("rect", { class: lane === 0 || lane === lanes - 1 ? "verge" : "asphalt", x: x0 + lane * k, y: y0, width: k, height: panel.h }));
    for (let lane = 2; lane < lanes - 1; lane++) pieces.push(element("path", { class: "lane-mark", d: `M${(x0 + lane * k).toFixed(1)} ${y0.toFixed(1)}v${panel.h.toFixed(1)}` }));
    for (let lane = 0; lane < lanes; lane++) for (let place = 0; place < places; place++) {
      const s = stateOf(world.picture, lane, t, place), x = x0 + lane * k, y = y0 + place * kh, cx = x + k / 2, cy = y + kh / 2, reach = Math.min(k, kh);
      const share = visits.length ? visits[s] / most : 0, hit = world.collision?.includes(s);
      const cell = element("g", { class: `cell road-cell${looked === s ? " looked" : ""}`, "data-state": s });
      cell.append(element("rect", { class: "road-ground", x, y, width: k, height: kh }));
      if (hit) cell.append(element("rect", { class: "road-hit", x: x + 2, y: y + 2, width: k - 4, height: kh - 4, rx: 5 }));
      if (share > 0.005) cell.append(element("rect", { class: "cell-visited", x: x + 2, y: y + 2, width: k - 4, height: kh - 4, rx: 5, "fill-opacity": 0.1 + 0.4 * Math.sqrt(share) }));
      for (let a = 0; table.length && a < n; a++) {
        const p = table[s * n + a], right = moves[a] ?? 0;
        if (p < LEAST) continue;
        const className = `move${visits.length && share <= 1e-9 ? " never" : ""}`;
        cell.append(right === 0 ? arrow(className, cx, cy, [0, -1], reach * (0.1 + 0.36 * p)) : arrow(className, cx, cy, [right, 0], reach * (0.1 + 0.36 * p)));
      }
      pieces.push(cell);
    }
  }
  svg.replaceChildren(...pieces);
  svg.setAttribute("aria-label", WORLD.road(panels, table.length ? world.starts.map((s) => roadWords(world, table, s)) : null));
}

/** What is known of a state, in words. */
export function roadWords(world, table, s) {
  return WORLD.state(world, s, table.length ? actionWords(world, table, s, world.actions.length) : null);
}
