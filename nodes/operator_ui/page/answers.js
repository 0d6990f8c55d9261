// The list of answers: what was said, what became of it, and the way to take it back or give it again.

import { element, footprint } from "./drawing.js";
import { ANSWERS } from "./words.js";

const MARKS = { skip: "↷", cant_tell: "?", stop: "■", pause: "‖", start: "▸", finish: "✓", new_lesson: "✦", placement: "•", actions: "↝", preference: "≷", critique: "✎", history: "↗" };

/** Kinds of answer that can be given once more. */
export const GIVEN = ["placement", "actions", "preference", "critique", "history", "stop"];

/** Whether an answer counts at the moment and may be taken back. */
export function canUndo(answer) {
  return (answer.state === "accepted" || answer.state === "pending") && !(answer.undo && answer.undo.state !== "refused");
}

/** What became of an answer, in words. */
export function fate(answer) {
  if (answer.state === "pending") return ANSWERS.pending;
  if (answer.state === "past") return ANSWERS.past(answer.revision);
  if (answer.state === "held") return ANSWERS.held;
  if (answer.state === "refused") return ANSWERS.refused(answer.reason);
  if (answer.state === "undone") return ANSWERS.undone(answer.undo?.revision ?? null);
  if (answer.undo && answer.undo.state === "refused") return ANSWERS.notUndone(answer.revision, answer.undo.reason);
  if (answer.undo) return ANSWERS.undoing;
  return ANSWERS.revision(answer.revision);
}

/** Draws the list, newest first; `misfits` are the ids of those that fit worst; `on` has undo(answer), redo(answer) and look(answer or null). */
export function drawAnswers(list, answers, misfits, on) {
  const focused = list.contains(document.activeElement) ? document.activeElement.closest("[data-id]")?.dataset.id : undefined;
  const known = new Map([...list.children].map((item) => [item.dataset.id, item]));
  const items = answers.toReversed().map((answer) => {
    const isOdd = misfits.includes(answer.id), key = JSON.stringify([answer.state, answer.revision, answer.reason, answer.undo, isOdd]);
    const old = known.get(answer.id);
    if (old && old.dataset.key === key) return old;
    const item = build(answer, isOdd, on);
    item.dataset.id = answer.id;
    item.dataset.key = key;
    return item;
  });
  const isLonger = items.length > known.size;
  list.replaceChildren(...items);
  if (isLonger) list.scrollTop = 0;
  if (focused) list.querySelector(`[data-id="${CSS.escape(focused)}"] button`)?.focus({ preventScroll: true });
}

function build(answer, isOdd, on) {
  const item = document.createElement("li");
  item.className = `entry ${answer.state}${isOdd ? " misfit" : ""}`;
  item.dataset.state = answer.state;
  item.dataset.kind = answer.kind;
  if (answer.revision !== null) item.dataset.revision = answer.revision;
  const words = document.createElement("div");
  words.className = "entry-words";
  const title = document.createElement("strong");
  title.textContent = on.title?.(answer) ?? (answer.kind === "placement" ? ANSWERS.placement(answer.scene?.target.label, answer.x_m, answer.y_m) : ANSWERS.counted[answer.kind]?.(answer.n) ?? ANSWERS.kinds[answer.kind]);
  const detail = document.createElement("span");
  detail.textContent = [isOdd ? ANSWERS.misfit : null, answer.confidence ? ANSWERS.confidence[answer.confidence] : null, answer.mine ? ANSWERS.you : answer.source, fate(answer)].filter(Boolean).join(" · ");
  words.append(title, detail);
  item.append(answer.scene ? thumbnail(answer) : mark(answer.kind), words);
  if (canUndo(answer)) item.append(button(ANSWERS.takeBack, title.textContent, () => on.undo(answer)));
  else if (GIVEN.includes(answer.kind) && answer.state === "undone") item.append(button(ANSWERS.giveAgain, title.textContent, () => on.redo(answer)));
  if (answer.scene) {
    item.addEventListener("pointerenter", () => on.look(answer));
    item.addEventListener("pointerleave", () => on.look(null));
  }
  return item;
}

function button(text, what, action) {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  made.setAttribute("aria-label", ANSWERS.button(text, what));
  made.addEventListener("click", action);
  return made;
}

function thumbnail({ scene, x_m, y_m }) {
  const size = 40, k = size / Math.max(scene.width_m, scene.depth_m);
  const svg = element("svg", { class: "thumbnail", viewBox: `0 0 ${scene.width_m * k} ${scene.depth_m * k}`, width: size, height: size, "aria-hidden": "true" });
  const at = (x, y, shape) => {
    const group = element("g", { transform: `translate(${(x * k).toFixed(2)} ${((scene.depth_m - y) * k).toFixed(2)})` });
    group.append(shape);
    return group;
  };
  svg.append(element("rect", { class: "board-top", width: scene.width_m * k, height: scene.depth_m * k, rx: 4 }));
  for (const object of scene.objects) svg.append(at(object.x_m, object.y_m, footprint(object, k, "thumbnail-object")));
  svg.append(at(x_m, y_m, element("circle", { class: "thumbnail-target", r: 3.4 })));
  return svg;
}

function mark(kind) {
  const made = document.createElement("span");
  made.className = "entry-mark";
  made.setAttribute("aria-hidden", "true");
  made.textContent = MARKS[kind];
  return made;
}
