// SVG pieces of the table view.

import { boundingRadius, shapeWords } from "./geometry.js";

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
  pieces.push(element("text", { class: "small-text", x: x0 + board.w / 2, y: y + 4, "text-anchor": "middle" }, "robot's side"));
  pieces.push(element("text", { class: "small-text", x: x0 + board.w, y: y + 4, "text-anchor": "end" }, `${Math.round(scene.width_m * 100)} × ${Math.round(scene.depth_m * 100)} cm`));
  if (movable && !table.at) {
    pieces.push(element("rect", { class: "tray", x: tray.left, y: tray.top, width: tray.w, height: tray.h, rx: 16 }));
    const r = Math.max(boundingRadius(scene.target) * k, 12), below = table.box.beside;
    const words = below ? ["drag it", "onto the", "table"] : ["drag it onto the table"];
    words.forEach((word, i) => pieces.push(element("text", below
      ? { class: "small-text", x: tray.x, y: tray.y + r + 36 + 14 * i, "text-anchor": "middle" }
      : { class: "small-text", x: tray.x + Math.max(r, 30) + 16, y: tray.y + 12 }, word)));
  }
  layer.replaceChildren(...pieces);
}

/** The things on the table, each with its name and shape. */
export function drawObjects(layer, table, scene, onHeat) {
  const { k, y0, board } = table.box;
  layer.classList.toggle("on-heat", onHeat);
  layer.replaceChildren(...scene.objects.map((object, i) => {
    const p = table.px({ x: object.x_m, y: object.y_m }), r = boundingRadius(object) * k;
    const group = element("g", { class: `object hue-${i % 6}`, transform: `translate(${p.x.toFixed(2)} ${p.y.toFixed(2)})`, "data-id": object.id });
    group.append(element("title", {}, `${object.label}: ${shapeWords(object)}${object.supports ? ", things may stand on it" : ""}`), footprint(object, k, "body"));
    if (object.shape !== "box") group.append(element("circle", { class: "rim", r: Math.max(0, (object.size_x_m / 2) * k * 0.72) }));
    if (object.supports) group.append(element("circle", { class: "supports", r: r + 4 }));
    const above = p.y + r + 34 > y0 + board.h;
    const line = above ? -r - 20 : r + 15;
    const x = sideways(table, p.x, object.label.length > shapeWords(object).length ? object.label : shapeWords(object));
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
    pieces.push(ghost({ x: map.x_m, y: map.y_m }, "ghost", table.view.guessLabel ?? "robot's guess", below));
    if (robust && apart > 0.004) pieces.push(ghost({ x: robust.x_m, y: robust.y_m }, "ghost robust", apart > 0.03 ? "cautious guess" : "", robust.y_m <= map.y_m));
  }
  for (const mark of marks) pieces.push(ghost({ x: mark.x, y: mark.y }, "ghost mark", mark.label, true));
  layer.replaceChildren(...pieces);
}
