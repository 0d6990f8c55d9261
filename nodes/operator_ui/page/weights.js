// What each feature may be worth to the person: the mean of the draws, and where nine of ten of them lie.

import { element } from "./drawing.js";
import { number } from "./risk.js";
import { WEIGHTS } from "./words.js";

const ROW = 22;

/** Draws one line a feature; worth more is further right. */
export function drawWeights(svg, weights) {
  const W = Math.max(220, svg.getBoundingClientRect().width || 300), H = ROW * weights.length + 6;
  svg.style.height = `${H}px`;
  svg.setAttribute("viewBox", `0 0 ${W} ${H}`);
  const names = Math.min(0.42 * W, 8 + 7 * Math.max(0, ...weights.map((w) => w.name.length)));
  const reach = Math.max(1e-9, ...weights.flatMap((w) => [Math.abs(w.low), Math.abs(w.high)])) * 1.08;
  const left = names + 8, x = (v) => left + ((W - left - 8) * (v + reach)) / (2 * reach);
  const pieces = [element("path", { class: "weight-zero", d: `M${x(0).toFixed(1)} 2V${H - 4}` })];
  weights.forEach((w, i) => {
    const y = ROW * i + ROW / 2 + 2;
    const row = element("g", { class: `hue-${i % 6}` });
    row.append(
      element("title", {}, WEIGHTS.row(w.name, number(w.mean), number(w.low), number(w.high))),
      element("text", { class: "weight-name", x: names, y: y + 4, "text-anchor": "end" }, w.name),
      element("path", { class: "weight-range", d: `M${x(w.low).toFixed(1)} ${y}H${x(w.high).toFixed(1)}` }),
      element("circle", { class: "weight-mean", cx: x(w.mean), cy: y, r: 4.2 }),
    );
    pieces.push(row);
  });
  svg.replaceChildren(...pieces);
  svg.setAttribute("aria-label", weights.length ? WEIGHTS.label(weights.map((w) => [w.name, number(w.mean), number(w.low), number(w.high)])) : WEIGHTS.none);
}
