// Ways over the picture of a world: where the robot is, what it did, and two travellers who walk in step.

import { element } from "./drawing.js";
import { arrow, gridFrame } from "./grid.js";
import { roadFrame } from "./road.js";
import { LETTERS } from "./words.js";

/** Where states lie in the picture, and how large one is; null for a world without a picture. */
export function frameOf(svg, world) {
  const box = svg.parentElement.getBoundingClientRect();
  if (world.picture.kind === "cells") { const f = gridFrame(world, box); return { ...f, size: f.k, panel: () => 0 }; }
  if (world.picture.kind === "road") { const f = roadFrame(world, box); return { ...f, size: Math.min(f.k, f.kh) }; }
  return null;
}

/** Where an action leads in the picture: right and down. */
export function direction(world, action) {
  const move = world.picture.moves?.[action];
  if (world.picture.kind === "cells") return move ? [move[1], move[0]] : [0, 0];
  return move ? [move, 0] : [0, -1];
}

/** The open question over the picture. `own` has choice, marks, focus and time. */
export function drawWays(svg, world, question, own) {
  svg.querySelector(".ways")?.remove();
  const frame = frameOf(svg, world);
  if (!frame || !question) return;
  const layer = element("g", { class: `ways ways-${question.kind}` });
  if (question.kind !== "action") { const [x, y] = frame.middle(question.state); layer.append(element("circle", { class: "here-ring", cx: x, cy: y, r: frame.size * 0.42 })); }
  if (question.kind === "action") drawHere(layer, world, frame, question.state, own.choice);
  else question.ways.forEach((way, i) => drawWay(layer, world, frame, way, question.kind === "comparison" ? i : null, own));
  if (question.kind === "comparison") question.ways.forEach((way, i) => layer.append(traveller(frame, way, i, own.time)));
  svg.append(layer);
}

function drawHere(layer, world, { middle, size }, state, choice) {
  const [x, y] = middle(state), r = size * 0.4;
  layer.append(element("circle", { class: "here-ring", cx: x, cy: y, r }), element("circle", { class: "here", cx: x, cy: y, r: Math.max(4, size * 0.13) }));
  if (choice === null) return;
  const [dx, dy] = direction(world, choice);
  if (dx || dy) layer.append(arrow("here-move", x + dx * size * 0.22, y + dy * size * 0.22, [dx, dy], size * 0.62, 5));
  else layer.append(element("circle", { class: "here-stay", cx: x, cy: y, r: r * 0.7 }));
}

const CORNERS = [[0, 0], [-0.27, -0.27], [0.27, -0.27], [0.27, 0.27], [-0.27, 0.27]];

/** Places of a way: beside the middle where two ways may share a cell, and beside each other where one comes again. */
function points({ middle, size }, way, which) {
  const shift = which === null ? 0 : (which === 0 ? -1 : 1) * size * 0.13, visits = new Map();
  return way.states.map((s) => {
    const [x, y] = middle(s), n = visits.get(s) ?? 0, [dx, dy] = which === null ? CORNERS[n % CORNERS.length] : [0, 0];
    visits.set(s, n + 1);
    return [x + shift + dx * size, y + shift + dy * size];
  });
}

function drawWay(layer, world, frame, way, which, own) {
  const at = points(frame, way, which), name = which === null ? "single" : `way-${LETTERS[which].toLowerCase()}`;
  const group = element("g", { class: `way ${name}` });
  for (let i = 1; i < at.length; i++) {
    const [x0, y0] = at[i - 1], [x1, y1] = at[i], apart = frame.panel(way.states[i - 1]) !== frame.panel(way.states[i]);
    const mark = which === null ? own.marks[i - 1] : "";
    if (x0 !== x1 || y0 !== y1) group.append(element("path", { class: `leg ${mark}${apart ? " apart-leg" : ""}`, d: `M${x0.toFixed(1)} ${y0.toFixed(1)}L${x1.toFixed(1)} ${y1.toFixed(1)}` }));
  }
  at.forEach(([x, y], i) => group.append(...stop(world, frame, way, i, which, x, y, own)));
  if (which !== null) {
    const [x, y] = at[at.length - 1], side = which === 0 ? -1 : 1;
    group.append(element("circle", { class: "way-end", cx: x, cy: y, r: Math.max(9, frame.size * 0.17) }), element("text", { class: "way-letter", x, y: y + 5, "text-anchor": "middle", "data-side": side }, LETTERS[which]));
  }
  layer.append(group);
}

/** One step: a dot, numbered where it can be marked, with a short arrow for what was done. */
function stop(world, frame, way, i, which, x, y, own) {
  const pieces = [], r = which === null ? Math.max(9, frame.size * 0.14) : Math.max(3, frame.size * 0.05), [dx, dy] = direction(world, way.actions[i]);
  const ended = world.terminals.includes(way.states[i]);
  if (which === null && !ended && (dx || dy)) pieces.push(arrow(`stop-move ${own.marks[i]}`, x + dx * r * 1.1, y + dy * r * 1.1, [dx, dy], frame.size * 0.28, 3));
  // A step that comes to the same place again is drawn over the earlier one, and marked in the list.
  pieces.push(element("circle", { class: `stop ${which === null ? own.marks[i] : ""}${own.focus === i && which === null ? " focused" : ""}`, cx: x, cy: y, r, "data-step": i }));
  if (which === null) pieces.push(element("text", { class: "stop-number", x, y: y + 4.5, "text-anchor": "middle" }, own.marks[i] === "good" ? "✓" : own.marks[i] === "bad" ? "✕" : `${i + 1}`));
  return pieces;
}

/** Somebody who walks a way, at a time in steps. */
function traveller(frame, way, which, time) {
  const at = points(frame, way, which), last = at.length - 1, t = Math.min(Math.max(time, 0), last), i = Math.min(Math.floor(t), Math.max(0, last - 1));
  const [x0, y0] = at[i], [x1, y1] = at[Math.min(i + 1, last)], share = last ? t - i : 0;
  const jump = last > 0 && frame.panel(way.states[i]) !== frame.panel(way.states[Math.min(i + 1, last)]);
  const f = jump ? Math.round(share) : share, x = x0 + (x1 - x0) * f, y = y0 + (y1 - y0) * f, r = Math.max(7, frame.size * 0.13);
  return element("circle", { class: `traveller traveller-${LETTERS[which].toLowerCase()}`, cx: x.toFixed(1), cy: y.toFixed(1), r });
}

/** Moves the travellers without drawing anything else anew. */
export function moveTravellers(svg, world, question, time) {
  const layer = svg.querySelector(".ways"), frame = frameOf(svg, world);
  if (!layer || !frame) return;
  layer.querySelectorAll(".traveller").forEach((old) => old.remove());
  question.ways.forEach((way, i) => layer.append(traveller(frame, way, i, time)));
}
