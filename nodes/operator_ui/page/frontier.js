// What caution costs: the average return of each balance against its worst case, as a curve.

import { element } from "./drawing.js";
import { number, percent } from "./risk.js";
import { CAUTION } from "./words.js";

const M = { l: 62, r: 16, t: 14, b: 36 };

/** Draws the frontier. `chosen` is the policy the robot follows, `preview` the index of the point under the slider. */
export function drawFrontier(svg, frontier, chosen, preview) {
  const box = svg.parentElement.getBoundingClientRect(), W = Math.max(220, box.width), H = Math.max(120, box.height);
  svg.setAttribute("viewBox", `0 0 ${W} ${H}`);
  const known = (p) => p && p.conditional_value_at_risk !== null && p.expected_return !== null;
  const points = (frontier?.points ?? []).filter(known);
  if (!points.length) {
    svg.replaceChildren(element("text", { class: "axis", x: W / 2, y: H / 2, "text-anchor": "middle" }, frontier?.reason ? CAUTION.frontierNone : CAUTION.frontierWaits));
    svg.setAttribute("aria-label", frontier?.reason ?? CAUTION.noFrontier);
    return;
  }
  const all = known(chosen) ? [...points, chosen] : points;
  const [x0, x1] = span(all.map((p) => p.conditional_value_at_risk)), [y0, y1] = span(all.map((p) => p.expected_return));
  const x = (v) => M.l + ((W - M.l - M.r) * (v - x0)) / (x1 - x0), y = (v) => M.t + (H - M.t - M.b) * (1 - (v - y0) / (y1 - y0));
  const at = (p) => ({ cx: x(p.conditional_value_at_risk), cy: y(p.expected_return) });
  const pieces = [];
  const label = (v, all) => (all.length > 1 ? v.toFixed(Math.max(0, Math.ceil(-Math.log10(all[1] - all[0]) - 1e-9))) : number(v, 3)).replace("-", "−");
  const across = ticks(x0, x1, 4), up = ticks(y0, y1, 3);
  for (const v of up) pieces.push(element("path", { class: "grid", d: `M${M.l} ${y(v).toFixed(1)}H${(W - M.r).toFixed(1)}` }), element("text", { class: "axis", x: M.l - 7, y: y(v) + 4, "text-anchor": "end" }, label(v, up)));
  for (const v of across) pieces.push(element("path", { class: "grid", d: `M${x(v).toFixed(1)} ${M.t}V${(H - M.b).toFixed(1)}` }), element("text", { class: "axis", x: x(v), y: H - M.b + 15, "text-anchor": "middle" }, label(v, across)));
  const tail = CAUTION.tail(frontier.alpha === null ? null : percent(1 - frontier.alpha));
  pieces.push(element("text", { class: "axis", x: (M.l + W - M.r) / 2, y: H - 4, "text-anchor": "middle" }, CAUTION.worstAxis(frontier.objective, tail)));
  pieces.push(element("text", { class: "axis", x: 11, y: M.t + (H - M.t - M.b) / 2, "text-anchor": "middle", transform: `rotate(-90 11 ${M.t + (H - M.t - M.b) / 2})` }, CAUTION.averageAxis));
  pieces.push(element("path", { class: "frontier-line", d: points.map((p, i) => `${i ? "L" : "M"}${x(p.conditional_value_at_risk).toFixed(1)} ${y(p.expected_return).toFixed(1)}`).join("") }));
  for (const p of points) {
    const dot = element("circle", { class: `frontier-dot${p.optimal ? "" : " unsure"}`, ...at(p), r: 3.2 });
    dot.append(element("title", {}, CAUTION.balance(p.lambda.toFixed(2), number(p.expected_return), number(p.conditional_value_at_risk))));
    pieces.push(dot);
  }
  if (known(chosen)) pieces.push(element("circle", { class: "frontier-chosen", ...at(chosen), r: 6.5 }));
  const shown = frontier.points[preview];
  if (known(shown)) pieces.push(element("circle", { class: "frontier-preview", ...at(shown), r: 10 }));
  svg.replaceChildren(...pieces);
  const ends = [points[0], points.at(-1)];
  svg.setAttribute("aria-label", CAUTION.frontier(ends.map((p) => number(p.expected_return)), ends.map((p) => number(p.conditional_value_at_risk))));
}

/** Whether all balances come to the same. */
export function isFlat(frontier) {
  const values = (frontier?.points ?? []).map((p) => p.expected_return).filter((v) => v !== null);
  return values.length > 1 && Math.max(...values) - Math.min(...values) <= 1e-6 * Math.max(1, ...values.map(Math.abs));
}

/** A range with room on both sides, also where all values are one. */
function span(values) {
  const low = Math.min(...values), high = Math.max(...values), room = Math.max((high - low) * 0.12, Math.max(Math.abs(low), Math.abs(high), 1) * 1e-3);
  return [low - room, high + room];
}

function ticks(low, high, n) {
  const raw = (high - low) / n, unit = 10 ** Math.floor(Math.log10(raw)), steps = [1, 2, 5, 10].map((f) => f * unit);
  const at = (step) => Array.from({ length: Math.max(0, Math.floor(high / step) - Math.ceil(low / step) + 1) }, (_, i) => (Math.ceil(low / step) + i) * step);
  const coarse = at(steps.find((step) => step >= raw) ?? raw);
  return coarse.length > 1 ? coarse : at(steps.findLast((step) => step < raw) ?? raw / 2);
}
