// The history of the bound against the goal, one point a look.

import { element } from "./drawing.js";
import { cm } from "./geometry.js";
import { PROGRESS } from "./words.js";

/** Draws the bounds, in centimetres or per cent, over revisions; looks without a bound sit at the top as hollow marks. */
export function drawTrend(svg, trend, logarithmic, unit = "cm") {
  const shown = unit === "cm" ? cm : (v) => (v === null ? "–" : `${(v * 100).toFixed(1)} ${unit}`);
  const box = svg.parentElement.getBoundingClientRect(), W = Math.max(220, box.width), H = Math.max(90, box.height);
  const m = { l: 40, r: 34, t: 12, b: 22 }, w = W - m.l - m.r, h = H - m.t - m.b;
  svg.setAttribute("viewBox", `0 0 ${W} ${H}`);
  const known = trend.filter((p) => p.bound_m !== null), epsilon = trend.length ? trend[trend.length - 1].epsilon_m : null;
  const values = known.map((p) => p.bound_m * 100).concat(epsilon !== null ? [epsilon * 100] : []).filter((v) => v > 0);
  const top = Math.max(5, ...values) * 1.12, bottom = logarithmic ? Math.min(...(values.length ? values : [1])) / 1.6 : 0;
  const lastRevision = Math.max(4, ...trend.map((p) => p.revision));
  const x = (revision) => m.l + (w * revision) / lastRevision;
  const y = (v) => m.t + h * (logarithmic ? 1 - Math.log(Math.max(v, bottom) / bottom) / Math.log(top / bottom) : 1 - v / top);
  const pieces = [];
  for (const v of gridValues(top, bottom, logarithmic)) {
    pieces.push(element("path", { class: "grid", d: `M${m.l} ${y(v).toFixed(1)}H${(W - m.r).toFixed(1)}` }));
    pieces.push(element("text", { class: "axis", x: m.l - 6, y: y(v) + 4, "text-anchor": "end" }, `${v}`));
  }
  pieces.push(element("text", { class: "axis", x: m.l - 12, y: H - 6, "text-anchor": "end" }, unit));
  const stride = Math.max(1, Math.ceil(lastRevision / Math.max(3, w / 44)));
  for (let r = 0; r <= lastRevision; r += stride) pieces.push(element("text", { class: "axis", x: x(r), y: H - 6, "text-anchor": "middle" }, `${r}`));
  if (epsilon !== null) {
    pieces.push(element("path", { class: "goal", d: `M${m.l} ${y(epsilon * 100).toFixed(1)}H${(W - m.r).toFixed(1)}` }));
    pieces.push(element("text", { class: "axis goal-text", x: W - m.r + 4, y: y(epsilon * 100) + 4 }, PROGRESS.goal));
  }
  let path = "", pen = "M";
  for (const p of trend) {
    if (p.bound_m === null) { pen = "M"; continue; }
    path += `${pen}${x(p.revision).toFixed(1)} ${y(p.bound_m * 100).toFixed(1)}`;
    pen = "L";
  }
  pieces.push(element("path", { class: "line", d: path }));
  trend.forEach((p, i) => {
    const none = p.bound_m === null, last = i === trend.length - 1;
    const dot = element("circle", { class: `dot${none ? " none" : ""}${last ? " last" : ""}`, cx: x(p.revision), cy: none ? m.t + 2 : y(p.bound_m * 100), r: last ? 4.5 : 3.2 });
    dot.append(element("title", {}, none ? PROGRESS.noBound(p.revision, p.reason) : PROGRESS.bound(p.revision, shown(p.bound_m))));
    pieces.push(dot);
  });
  svg.replaceChildren(...pieces);
  svg.setAttribute("aria-label", trend.length ? PROGRESS.course(shown(epsilon), trend.slice(-12).map((p) => [p.revision, p.bound_m === null ? null : shown(p.bound_m)])) : PROGRESS.none);
}

function gridValues(top, bottom, logarithmic) {
  if (logarithmic) return [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500].filter((v) => v >= bottom && v <= top);
  const step = [1, 2, 5, 10, 20, 25, 50, 100, 200, 500, 1000].find((s) => top / s <= 4.5) ?? 5000;
  return Array.from({ length: Math.floor(top / step) + 1 }, (_, i) => i * step);
}

/**
 * How many more answers it may take: the fall of the bound so far, as a straight line of its logarithm, drawn on to the goal. `points` are
 * { revision, bound }; null while too little is known, Infinity where the bound does not fall.
 */
export function answersLeft(points, goal) {
  const known = points.filter((point) => point.bound > 0);
  if (known.length < 4 || !goal) return null;
  const recent = known.slice(-16), x = recent.map((point) => point.revision), y = recent.map((point) => Math.log(point.bound));
  const mean = (v) => v.reduce((a, b) => a + b, 0) / v.length, mx = mean(x), my = mean(y);
  const slope = x.reduce((sum, v, i) => sum + (v - mx) * (y[i] - my), 0) / Math.max(1e-9, x.reduce((sum, v) => sum + (v - mx) ** 2, 0));
  const now = my + slope * (x[x.length - 1] - mx);
  return slope < -1e-4 ? Math.max(1, (now - Math.log(goal)) / -slope) : Infinity;
}
