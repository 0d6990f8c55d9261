// What the page says about questions about a world, in English: every sentence of it stands here.

import { cellPlace } from "./grid.js";
import { roadPlace } from "./road.js";

/** Which state, in words. */
export function placeWords(world, s) {
  if (world.picture.kind === "cells") return cellPlace(world, s);
  return world.picture.kind === "road" ? roadPlace(world, s) : `state ${s}`;
}

/** "right, right, up" with what lies on the way: "path 3 times, mud once". */
export function wayWords(world, way) {
  const counts = new Map();
  for (const s of way.states) { const f = world.cells[s] ?? null; if (f !== null) counts.set(f, (counts.get(f) ?? 0) + 1); }
  const over = [...counts].sort((a, b) => b[1] - a[1]).map(([f, n]) => `${world.features[f]}${n > 1 ? ` ×${n}` : ""}`);
  return { moves: way.actions.filter((_, i) => !world.terminals.includes(way.states[i])).map((a) => world.actions[a]).join(", "), over: over.join(", ") };
}

export const LETTERS = ["A", "B"];
export const MARKS = { good: "good", bad: "bad", none: "not marked" };
export const WORDS = {
  number: (n) => `Question ${n || ""}`,
  lesson: "What the robot would do",
  thinking: "Thinking about the next question…",
  submit: { action: "Do this here", critique: "That is my judgement", comparison: "That is my choice" },
  todo: { action: "Choose what to do there, with a button or the arrow keys.", critique: "Mark at least one step; what you leave unmarked says nothing.", comparison: "Watch both, then choose." },
  sayEqual: "About equal",
  way: (i) => `${LETTERS[i]} is better`,
  step: (world, way, i, mark) => `Step ${i + 1} of ${way.states.length}, ${world.actions[way.actions[i]]}, ${placeWords(world, way.states[i])}: ${MARKS[mark]}`,
  time: (world, ways, t) => ways.map((way, i) => { const at = Math.min(t, way.states.length - 1); return `${LETTERS[i]}: ${placeWords(world, way.states[at])}`; }).join("; "),
  play: (playing) => (playing ? "Pause" : "Play both"),
  picture: {
    action: (world, q) => `The robot is ${placeWords(world, q.state)}.`,
    critique: (world, q) => `The way in question: ${q.ways[0].states.map((s, i) => `${i + 1}: ${placeWords(world, s)}, ${world.actions[q.ways[0].actions[i]]}`).join("; ")}.`,
    comparison: (world, q) => q.ways.map((way, i) => `Way ${LETTERS[i]}: ${wayWords(world, way).moves}, over ${wayWords(world, way).over || "nothing named"}.`).join(" "),
  },
  hidden: "What I would do is hidden until you have answered.",
  sending: "Sending…",
  onItsWay: "On its way to the robot…",
  takenIn: (revision) => `Taken in as revision ${revision}`,
  refused: (reason) => `Refused: ${reason}`,
  takingBack: "Taking it back…",
  takenBack: (revision) => `Taken back in revision ${revision}`,
  range: (answered, most) => (answered === null ? "" : most === null ? `${answered} given so far.` : most > 200 ? `${answered} given so far; it may take very many more.` : `${answered} given so far; at this pace about ${most <= 1 ? "one more" : `${Math.max(1, Math.round(most / 2))} to ${Math.round(most * 1.5)} more`}.`),
  answer: (world, answer) => {
    if (answer.kind === "actions" && answer.step && answer.step[1] < world.actions.length && answer.step[0] < world.n_states) return `${world.actions[answer.step[1]]} in ${placeWords(world, answer.step[0]).replace(/^in /, "")}`;
    if (answer.kind === "preference" && answer.said) return { ranked: "Chose the better of two ways", equal: "Two ways are about equal", cant_tell: "Can't tell which of two ways is better" }[answer.said];
    if (answer.kind === "critique" && answer.marked) return `Marked ${answer.marked[0]} good and ${answer.marked[1]} bad steps`;
    return undefined;
  },
};

/** The lesson as a whole. */
export const SESSION = {
  go: (word, isFresh) => (word === "paused" ? (isFresh ? "Start the lesson" : "Go on") : word === "finished" ? "Go on teaching" : word === "stopped" ? "Take the stop back" : "Pause"),
  halted: (word, isFresh) => ({
    paused: isFresh ? "The lesson has not been started yet." : "The lesson is paused. The robot asks nothing; you may still correct it.",
    finished: "You finished the lesson. The robot keeps what it learned.",
    stopped: "You stopped the lesson because nothing was acceptable.",
  })[word],
  recording: ({ began_s, duration_s, bytes }) => [began_s === null ? null : new Date(1000 * began_s).toLocaleString(), `${Math.round(duration_s / 60)} min`, `${(bytes / 1e6).toFixed(1)} MB`].filter(Boolean).join(" · "),
};

/** How the robot would carry out its plan. */
export const CARRY = {
  play: "Play the motion",
  pause: "Pause",
  noPicture: "This browser cannot draw in three dimensions.",
  time: (seconds, last) => (seconds === null ? `The arm as it is; the motion takes ${last.toFixed(1)} s` : `${seconds.toFixed(1)} of ${last.toFixed(1)} s`),
  picture: (scene, plan) => `The arm at the table with ${scene.objects.map((object) => object.label).join(", ") || "nothing on it"}.${plan ? ` ${plan.reason}` : ""} Arrow keys turn the picture, plus and minus bring it nearer.`,
  hint: "Drag to turn the picture; with the focus on it, scroll or pinch to come nearer.",
  considered: (n) => (n === 1 ? "The one place it considered" : `${n} places it considered`),
  verdict: ({ x_m, y_m, verdict, reason }) => `${(100 * x_m).toFixed(1)} × ${(100 * y_m).toFixed(1)} cm: ${{ chosen: "chosen", next_best: "would do too" }[verdict] ?? reason}`,
  numbers: ({ probability_best, cvar_m, clearance_m }) => [
    probability_best === null ? null : `best for ${Math.round(100 * probability_best)} % of the rewards that fit`,
    cvar_m === null ? null : `in the worst cases ${(100 * cvar_m).toFixed(1)} cm off`,
    clearance_m === null ? null : `${(100 * clearance_m).toFixed(1)} cm free around it`,
  ].filter(Boolean).join(" · "),
};
