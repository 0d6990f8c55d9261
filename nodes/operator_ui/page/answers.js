// The list of answers: what was said, what became of it, and the way to take it back or give it again.

import { element, footprint } from "./drawing.js";

const CONFIDENCE = { sure: "sure", fairly: "fairly sure", guess: "a guess" };
const KINDS = { skip: "Skipped", cant_tell: "Can't tell", stop: "Stopped the lesson", pause: "Paused", start: "Started", finish: "Finished the lesson", new_lesson: "Began a new lesson" };
const COUNTED = { actions: (n) => `Showed a walk of ${n} steps`, preference: (n) => `Compared ${n} walks`, critique: (n) => `Marked ${n} parts of a walk`, history: (n) => `${n} attempts of a learner` };
const MARKS = { skip: "↷", cant_tell: "?", stop: "■", pause: "‖", start: "▸", finish: "✓", new_lesson: "✦", placement: "•", actions: "↝", preference: "≷", critique: "✎", history: "↗" };

/** Kinds of answer that can be given once more. */
export const GIVEN = ["placement", "actions", "preference", "critique", "history", "stop"];

/** Whether an answer counts at the moment and may be taken back. */
export function canUndo(answer) {
  return (answer.state === "accepted" || answer.state === "pending") && !(answer.undo && answer.undo.state !== "refused");
}

/** What became of an answer, in words. */
export function fate(answer) {
  if (answer.state === "pending") return "on its way…";
  if (answer.state === "past") return `revision ${answer.revision}, of an earlier lesson`;
  if (answer.state === "held") return "waits for the new lesson…";
  if (answer.state === "refused") return `refused: ${answer.reason}`;
  if (answer.state === "undone") return answer.undo && answer.undo.revision !== null ? `taken back in revision ${answer.undo.revision}` : "taken back";
  if (answer.undo && answer.undo.state === "refused") return `revision ${answer.revision}; could not be taken back: ${answer.undo.reason}`;
  if (answer.undo) return "being taken back…";
  return `revision ${answer.revision}`;
}

/** Draws the list, newest first; `on` has undo(answer), redo(answer) and look(answer or null). */
export function drawAnswers(list, answers, on) {
  const focused = list.contains(document.activeElement) ? document.activeElement.closest("[data-id]")?.dataset.id : undefined;
  const known = new Map([...list.children].map((item) => [item.dataset.id, item]));
  const items = answers.toReversed().map((answer) => {
    const key = JSON.stringify([answer.state, answer.revision, answer.reason, answer.undo]);
    const old = known.get(answer.id);
    if (old && old.dataset.key === key) return old;
    const item = build(answer, on);
    item.dataset.id = answer.id;
    item.dataset.key = key;
    return item;
  });
  const isLonger = items.length > known.size;
  list.replaceChildren(...items);
  if (isLonger) list.scrollTop = 0;
  if (focused) list.querySelector(`[data-id="${CSS.escape(focused)}"] button`)?.focus({ preventScroll: true });
}

function build(answer, on) {
  const item = document.createElement("li");
  item.className = `entry ${answer.state}`;
  item.dataset.state = answer.state;
  item.dataset.kind = answer.kind;
  if (answer.revision !== null) item.dataset.revision = answer.revision;
  const words = document.createElement("div");
  words.className = "entry-words";
  const title = document.createElement("strong");
  title.textContent = on.title?.(answer) ?? (answer.kind === "placement" ? `${answer.scene?.target.label ?? "Target"} at ${(answer.x_m * 100).toFixed(1)} × ${(answer.y_m * 100).toFixed(1)} cm` : COUNTED[answer.kind]?.(answer.n) ?? KINDS[answer.kind]);
  const detail = document.createElement("span");
  detail.textContent = [answer.confidence ? CONFIDENCE[answer.confidence] : null, answer.mine ? "you" : answer.source, fate(answer)].filter(Boolean).join(" · ");
  words.append(title, detail);
  item.append(answer.scene ? thumbnail(answer) : mark(answer.kind), words);
  if (canUndo(answer)) item.append(button("Take back", `Take back: ${title.textContent}`, () => on.undo(answer)));
  else if (GIVEN.includes(answer.kind) && answer.state === "undone") item.append(button("Give again", `Give again: ${title.textContent}`, () => on.redo(answer)));
  if (answer.scene) {
    item.addEventListener("pointerenter", () => on.look(answer));
    item.addEventListener("pointerleave", () => on.look(null));
  }
  return item;
}

function button(text, label, action) {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  made.setAttribute("aria-label", label);
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
