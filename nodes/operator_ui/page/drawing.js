// SVG pieces of the table view.

import { boundingRadius, shapeWords } from "./geometry.js";
import { TABLE } from "./words.js";

const SVG = "http://www.w3.org/2000/svg";

/** An SVG element with attributes and, optionally, text. */
export function element(name, attributes = {}, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, typeof value === "number" ? value.toFixed(2) : value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** An object's footprint about the origin, k pixels a metre. */
export function footprint(object, k, className) {
  if (object.shape !== "box") return element("circle", { class: className, r: (object.size_x_m / 2) * k });
  const w = object.size_x_m * k, d = object.size_y_m * k;
  return element("rect", { class: className, x: -w / 2, y: -d / 2, width: w, height: d, rx: Math.min(4, w / 6, d / 6), transform: `rotate(${(-object.yaw_rad * 180) / Math.PI})` });
}

/** How far a label about a point has to move sideways to stay inside the drawing, pixels. */
export function sideways(table, x, text) {
  const half = text.length * 3.9 + 4;
  return Math.max(0, half - x) - Math.max(0, x + half - table.box.width);
}

/** The table with its scale bar, the maps on it, and the place beside it where the target waits. */
export function drawBoard(layer, table, { heat, shade, movable }) {
  const { x0, y0, board, k, tray } = table.box, { scene } = table.view, pieces = [];
  const frame = { x: x0, y: y0, width: board.w, height: board.h };
  pieces.push(element("rect", { class: "board-shadow", ...frame, y: y0 + 3, rx: 10 }), element("rect", { class: "board-top", ...frame, rx: 10 }));
  if (heat) pieces.push(element("image", { ...frame, class: "heat", href: heat, preserveAspectRatio: "none", "clip-path": "inset(0 round 10px)" }));
  if (shade) pieces.push(element("image", { ...frame, class: "shade", href: shade, preserveAspectRatio: "none", "clip-path": "inset(0 round 10px)" }));
  let ticks = "";
  for (let v = 0.1; v < scene.width_m - 0.01; v += 0.1) ticks += `M${(x0 + v * k).toFixed(1)} ${(y0 + board.h).toFixed(1)}v-5`;
  for (let v = 0.1; v < scene.depth_m - 0.01; v += 0.1) ticks += `M${x0.toFixed(1)} ${(y0 + board.h - v * k).toFixed(1)}h5`;
  pieces.push(element("path", { class: "ticks", d: ticks }), element("rect", { class: "board-edge", ...frame, rx: 10 }));
  const bar = [1, 0.5, 0.2, 0.1, 0.05].find((m) => m <= scene.width_m / 4) ?? 0.02, y = y0 + board.h + 16;
  pieces.push(element("path", { class: "scale", d: `M${x0 + 2} ${y - 4}v8m0-4h${bar * k}m0-4v8` }));
  pieces.push(element("text", { class: "small-text", x: x0 + bar * k + 10, y: y + 4 }, `${Math.round(bar * 100)} cm`));
  pieces.push(element("text", { class: "small-text", x: x0 + board.w / 2, y: y + 4, "text-anchor": "middle" }, TABLE.side));
  pieces.push(element("text", { class: "small-text", x: x0 + board.w, y: y + 4, "text-anchor": "end" }, `${Math.round(scene.width_m * 100)} × ${Math.round(scene.depth_m * 100)} cm`));
  if (movable && !table.at) {
    pieces.push(element("rect", { class: "tray", x: tray.left, y: tray.top, width: tray.w, height: tray.h, rx: 16 }));
    const r = Math.max(boundingRadius(scene.target) * k, 12), below = table.box.beside;
    const words = below ? TABLE.tray : [TABLE.trayInOne];
    words.forEach((word, i) => pieces.push(element("text", below
      ? { class: "small-text", x: tray.x, y: tray.y + r + 36 + 14 * i, "text-anchor": "middle" }
      : { class: "small-text", x: tray.x + Math.max(r, 30) + 16, y: tray.y + 12 }, word)));
  }
  layer.replaceChildren(...pieces);
}

/** Where each object's label stands, below it or above: where it would cover least of the others and of their labels. */
function labelPlaces(table, scene) {
  const { k, y0, board } = table.box, taken = [];
  const about = scene.objects.map((object, i) => {
    const p = table.px({ x: object.x_m, y: object.y_m }), r = boundingRadius(object) * k, shape = shapeWords(object);
    const words = object.label.length > shape.length ? object.label : shape, x = sideways(table, p.x, words), half = words.length * 3.9;
    const lines = [p.y + r + 34 > y0 + board.h ? null : r + 15, p.y - r - 34 < y0 ? null : -r - 20].filter((line) => line !== null);
    return { i, x, lines: lines.length ? lines : [-r - 20], body: [p.x - r, p.y - r, p.x + r, p.y + r], box: (line) => [p.x + x - half, p.y + line - 12, p.x + x + half, p.y + line + 17] };
  });
  const shared = (a, b) => Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) * Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));
  const covers = (one, line) => [...taken, ...about.filter((other) => other !== one).map((other) => other.body)].reduce((sum, box) => sum + shared(box, one.box(line)), 0);
  const places = [];
  // What can stand in one place only goes first.
  for (const one of about.toSorted((a, b) => a.lines.length - b.lines.length)) {
    const line = one.lines.reduce((best, other) => (covers(one, other) < covers(one, best) ? other : best));
    taken.push(one.box(line));
    places[one.i] = { x: one.x, line };
  }
  return places;
}

/** The things on the table, each with its name and shape. */
export function drawObjects(layer, table, scene, onHeat) {
  const { k } = table.box, lines = labelPlaces(table, scene);
  layer.classList.toggle("on-heat", onHeat);
  layer.replaceChildren(...scene.objects.map((object, i) => {
    const p = table.px({ x: object.x_m, y: object.y_m }), r = boundingRadius(object) * k;
    const group = element("g", { class: `object hue-${i % 6}`, transform: `translate(${p.x.toFixed(2)} ${p.y.toFixed(2)})`, "data-id": object.id });
    group.append(element("title", {}, TABLE.object(object, shapeWords(object))), footprint(object, k, "body"));
    if (object.shape !== "box") group.append(element("circle", { class: "rim", r: Math.max(0, (object.size_x_m / 2) * k * 0.72) }));
    if (object.supports) group.append(element("circle", { class: "supports", r: r + 4 }));
    const { x, line } = lines[i];
    group.append(
      element("text", { class: "label", x, y: line, "text-anchor": "middle" }, object.label),
      element("text", { class: "sub-label", x, y: line + 13, "text-anchor": "middle" }, shapeWords(object)),
    );
    return group;
  }));
}

/** Places that the robot considered, by number. */
export function drawSpots(layer, table, spots) {
  layer.replaceChildren(...spots.map((spot) => {
    const p = table.px({ x: spot.x_m, y: spot.y_m }), group = element("g", { transform: `translate(${p.x.toFixed(2)} ${p.y.toFixed(2)})` });
    group.append(element("circle", { class: `spot ${spot.kind}`, r: 9 }), element("text", { class: "spot-number", y: 3.8, "text-anchor": "middle" }, spot.label));
    return group;
  }));
}

/** Where the robot would put the target, how far that is from the person's spot, and earlier answers to look at. */
export function drawGuess(layer, table, scene, plan, marks, own) {
  const pieces = [], k = table.box.k;
  const ghost = (at, className, label, below) => {
    const p = table.px(at), group = element("g", { class: className, transform: `translate(${p.x.toFixed(2)} ${p.y.toFixed(2)})` });
    const r = boundingRadius(scene.target) * k;
    group.append(footprint({ ...scene.target, yaw_rad: 0 }, k, "body"), element("path", { class: "cross", d: "M0-6 6 0 0 6-6 0Z" }));
    if (label) group.append(element("text", { class: "label", x: sideways(table, p.x, label), y: below ? r + 16 : -r - 8, "text-anchor": "middle" }, label));
    return group;
  };
  if (plan && plan.map_placement) {
    const map = plan.map_placement, robust = plan.robust_placement;
    const apart = robust ? Math.hypot(robust.x_m - map.x_m, robust.y_m - map.y_m) : 0;
    if (own) {
      const a = table.px(own), b = table.px({ x: map.x_m, y: map.y_m });
      pieces.push(element("line", { class: "apart", x1: a.x, y1: a.y, x2: b.x, y2: b.y }));
    }
    const below = robust && apart > 0.004 ? robust.y_m > map.y_m : own ? own.y > map.y_m : false;
    pieces.push(ghost({ x: map.x_m, y: map.y_m }, "ghost", table.view.guessLabel ?? TABLE.guess, below));
    if (robust && apart > 0.004) pieces.push(ghost({ x: robust.x_m, y: robust.y_m }, "ghost robust", apart > 0.03 ? TABLE.cautious : "", robust.y_m <= map.y_m));
  }
  for (const mark of marks) pieces.push(ghost({ x: mark.x, y: mark.y }, "ghost mark", mark.label, true));
  layer.replaceChildren(...pieces);
}
