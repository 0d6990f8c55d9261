// A lesson on paper: what was taught, what guarantees it, everything that was said, and what the robot makes of it.

import { fate } from "./answers.js";
import { element, footprint } from "./drawing.js";
import { boundingRadius, cm } from "./geometry.js";
import { drawGrid } from "./grid.js";
import { COMMON, drawReceipt } from "./receipt.js";
import { asARule, number, percent, worstCase } from "./risk.js";
import { ROAD_KEY, drawRoad } from "./road.js";
import { inForce, lessonStart } from "./session.js";
import { drawTrend } from "./trend.js";
import { WORDS, placeWords } from "./words.js";

/** The node shows no more answers than these, the newest; as MAX_ANSWERS in protocol.rs. */
const MAX_ANSWERS = 200;
const MAX_WEIGHTS = 12;
const LESSON = {
  waiting: "No lesson has begun", asking: "Still learning", taught: "Taught: the robot has learned enough", stopped: "Stopped by the person", gave_up: "The robot gave up asking",
  paused: "Paused: the robot asks nothing for now", finished: "Finished: the person said that this is enough", unknown: "Where the lesson stands is not known",
};
const CONFIDENCE = { sure: "sure", fairly: "fairly sure", guess: "a guess" };
const SAID = { skip: "Skipped", cant_tell: "Can't tell", stop: "Stopped the lesson", pause: "Paused the lesson", start: "Started the lesson", finish: "Finished the lesson", new_lesson: "Began a new lesson" };
const COUNTED = { actions: (n) => `Showed a walk of ${n} steps`, preference: (n) => `Compared ${n} walks`, critique: (n) => `Marked ${n} parts of a walk`, history: (n) => `${n} attempts of a learner` };
const ASKED = { actions: "What to do", preference: "Which of two ways is better", critique: "What is good and what is bad in a way" };
const OUTCOMES = {
  planned: "A motion there is planned", no_free_place: "There is no free place", unreachable: "The arm reaches no free place", no_path: "No collision-free motion was found", no_robot: "There is no robot to move",
  start_in_collision: "The arm touches something where it is", goal_in_collision: "The arm would touch something at every free place", joints_unknown: "Where the arm is, is not known", outside_limits: "A joint of the arm is outside its limits", unknown: "What became of the plan is not known",
};
const VERDICTS = { chosen: "chosen", next_best: "next best", unreachable: "out of reach", no_path: "no way there", blocked: "blocked", unknown: "not known" };

// ---- pieces -------------------------------------------------------------------------------------------------------

/** An element with a class and with texts or elements inside; what is null is left out. A number keeps its unit. */
function make(name, className, ...inside) {
  const made = document.createElement(name);
  if (className) made.className = className;
  made.append(...inside.filter((piece) => piece !== null && piece !== undefined).map((piece) => (piece instanceof Node ? piece : String(piece).replace(/(\d) (?=%|cm\b)|(revision) (?=\d)/g, "$1$2\u00a0"))));
  return made;
}

const capital = (words) => `${words.slice(0, 1).toUpperCase()}${words.slice(1)}`;
const sentence = (words) => (words ? `${capital(words)}${/[.!?…]$/.test(words) ? "" : "."}` : "");
const said = (...parts) => parts.filter(Boolean).map(sentence).join(" ");
const paragraph = (words, className = "") => (words ? make("p", className, words) : null);
const section = (title, ...inside) => make("section", "", make("h2", "", title), ...inside);
const place = ({ x_m, y_m }) => `${cm(x_m)} from the left, ${cm(y_m)} from the robot's edge`;
const short = (id) => (id.length > 14 ? `${id.slice(0, 8)}…` : id);

/** A table; `columns` are [title, class], where the class `number` aligns to the right. */
function table(columns, rows) {
  const head = make("tr", "", ...columns.map(([title, className]) => Object.assign(make("th", className, title), { scope: "col" })));
  const body = rows.map(({ className, cells }) => make("tr", className, ...cells.map((cell, i) => make("td", columns[i][1], cell ?? "–"))));
  return make("table", "", make("thead", "", head), make("tbody", "", ...body));
}

/** A drawing that measures its surroundings, made at a size of its own: the same on every screen and on paper. */
function drawnAt(width, height, draw) {
  const frame = make("div", "report-frame"), svg = element("svg", { role: "img" });
  Object.assign(frame.style, { width: `${width}px`, height: `${height}px` });
  Object.assign(svg.style, { width: "100%", height: "100%" });
  frame.append(svg);
  document.body.append(frame);
  try { draw(svg); } finally { frame.remove(); }
  Object.assign(svg.style, { height: "auto", maxWidth: `${width}px` });
  return svg;
}

const figure = (drawing, caption) => make("figure", "", drawing, make("figcaption", "", caption));

/** A table from above; `spots` are { x_m, y_m, label, isChosen, isTarget }. Without names when it is small. */
function tableFromAbove(scene, spots, width) {
  const k = width / scene.width_m, height = scene.depth_m * k, isSmall = width < 100;
  const svg = element("svg", { class: "report-table", viewBox: `-1 -1 ${width + 2} ${height + 2}`, width: width + 2, height: height + 2, "aria-hidden": "true" });
  const at = ({ x_m, y_m }, ...shapes) => {
    const group = element("g", { transform: `translate(${(x_m * k).toFixed(1)} ${((scene.depth_m - y_m) * k).toFixed(1)})` });
    group.append(...shapes);
    svg.append(group);
  };
  svg.append(element("rect", { class: "report-board", width, height, rx: isSmall ? 3 : 6 }));
  for (const object of scene.objects) {
    at(object, footprint(object, k, "report-object"));
    const low = boundingRadius(object) * k + 13, isLow = (scene.depth_m - object.y_m) * k + low > height - 4;
    if (!isSmall) at(object, element("text", { class: "report-name", y: isLow ? 9 - low : low, "text-anchor": "middle" }, object.label));
  }
  for (const spot of spots) if (spot.isChosen && !isSmall) at(spot, footprint({ ...scene.target, yaw_rad: 0 }, k, "report-place"));
  // The chosen one lies on top of those near it.
  for (const spot of spots.toReversed().sort((a, b) => Boolean(a.isChosen) - Boolean(b.isChosen))) {
    const r = isSmall ? 3 : 8.5;
    at(spot, element(spot.isTarget ? "rect" : "circle", { class: `report-spot${spot.isChosen ? " chosen" : ""}`, ...(spot.isTarget ? { x: -r, y: -r, width: 2 * r, height: 2 * r } : { r }) }), ...(spot.label ? [element("text", { class: `report-mark${spot.isChosen ? " chosen" : ""}`, y: 4, "text-anchor": "middle" }, spot.label)] : []));
  }
  return svg;
}

// ---- what the lesson came to --------------------------------------------------------------------------------------

/** The state in the terms of the report: one lesson about a table or about a world. */
function read(state) {
  const { lesson, policy, robust_bounds: robust, bounds } = state, isAboutWorld = Boolean(state.world) && !state.scene && !state.question;
  const scene = state.scene ?? state.question?.scene ?? null, start = lessonStart(state.answers);
  // A bound belongs to the policy that it judges; one of an older policy says nothing about this one.
  const judged = isAboutWorld ? (robust && policy && robust.set_id.startsWith(`robust-${policy.revision}-`) ? robust : null) : bounds;
  const trend = isAboutWorld ? state.loss_trend.map((p) => ({ revision: p.revision, bound_m: p.bound, epsilon_m: p.goal, reason: p.reason })) : state.trend;
  const points = trend.filter((point) => point.revision >= start), last = points.at(-1) ?? null;
  return {
    ...state, isAboutWorld, scene, judged, points,
    subject: isAboutWorld ? state.world.id : scene?.target.label ?? null,
    asking: Boolean(isAboutWorld ? state.world_question?.open : state.question?.open),
    bound: (isAboutWorld ? lesson?.loss_bound : bounds?.bound_m) ?? null,
    boundRevision: (isAboutWorld ? lesson?.revision : bounds?.revision) ?? null,
    goal: (isAboutWorld ? lesson?.epsilon_loss : lesson?.epsilon_m ?? state.question?.epsilon_m) ?? last?.epsilon_m ?? null,
    missing: (isAboutWorld ? judged?.normalised_loss.reason : bounds?.reason) || last?.reason || lesson?.reason || "",
    amount: (v) => (v === null ? "–" : isAboutWorld ? percent(v) : cm(v)),
  };
}

/** What is guaranteed, in words that a person can be held to. */
function guarantee(of) {
  const { bound, goal, judged, amount } = of, name = of.subject ?? "target";
  const aim = goal === null ? "No goal is known" : `The goal is ${amount(goal)}`;
  if (bound === null) return said(of.missing ? `Nothing guarantees how well the robot does: ${of.missing}` : "Nothing guarantees how well the robot does: no bound has been computed", aim);
  const isSame = Boolean(judged) && judged.revision === of.boundRevision && judged.delta !== null;
  const start = isSame ? `With ${percent(1 - judged.delta)} confidence` : "By a bound whose receipt is not at hand", share = isSame && judged.alpha !== null ? `, for ${percent(judged.alpha)} of what the person may mean` : "";
  const what = of.isAboutWorld ? `the robot loses at worst ${amount(bound)} of what choosing at random loses` : `the robot puts the ${name} at worst ${amount(bound)} from where the person would`;
  return said(`${start}, ${what}${share}`, goal === null ? aim : `${aim}: ${bound < goal ? "reached" : "not reached"}`);
}

function heading(of, now) {
  const { lesson, posterior } = of, word = lesson?.state ?? "waiting", revision = posterior?.revision ?? lesson?.revision ?? null;
  const time = Object.assign(make("time", "", now.toLocaleString([], { dateStyle: "long", timeStyle: "long" })), { dateTime: now.toISOString() });
  const about = of.subject === null ? "Nothing is known yet of what is taught." : of.isAboutWorld ? `What to do in the world “${of.subject}”` : `Where the ${of.subject} belongs`;
  const claim = !of.isAboutWorld && of.bound !== null && of.bounds.reason ? `The claim in full: ${sentence(of.bounds.reason)}` : "";
  const late = of.bound !== null && revision !== null && of.boundRevision < revision ? `This bound is of revision ${of.boundRevision}; what was said since, up to revision ${revision}, is not in it.` : "";
  // While it learns, the lesson's reason is the claim itself.
  const why = lesson && word !== "asking" && lesson.reason ? `${LESSON[word] ?? LESSON.unknown}; ${lesson.reason}` : LESSON[word] ?? LESSON.unknown;
  const facts = [["At worst", of.bound === null ? "no bound" : of.amount(of.bound)], ["Goal", of.amount(of.goal)], ["Answers in force", inForce(of.answers).length], ["Revision", revision ?? "–"]];
  return make("header", "", make("h1", "", "Lesson report"), make("p", "report-date", time), make("p", "report-subject", about),
    paragraph(sentence(why), "report-state"), make("dl", "report-facts", ...facts.map(([name, value]) => make("div", "", make("dt", "", name), make("dd", "", value)))),
    paragraph(guarantee(of), of.bound === null ? "report-none" : ""), paragraph(claim, "report-claim"), paragraph(late, "report-none"));
}

function progress(of) {
  if (!of.points.length) return section("The bound against the goal", paragraph("No bound has been looked at in this lesson."));
  const svg = drawnAt(660, 190, (made) => drawTrend(made, of.points, false, of.isAboutWorld ? "%" : "cm"));
  const none = of.points.filter((point) => point.bound_m === null).length;
  const what = of.isAboutWorld ? "What the robot may lose, in % of what choosing at random loses" : "How far off the robot may be at worst, in cm";
  return section("The bound against the goal", figure(svg, said(`${what}, after each revision; dashed: the goal`, none ? `Hollow marks at the top: there was no bound (${none} of ${of.points.length} looks)` : "")));
}

// ---- what was said ------------------------------------------------------------------------------------------------

function question(of, answer) {
  const id = answer.query_id ? make("span", "report-id", short(answer.query_id)) : null, isOfLesson = ["stop", "pause", "start", "finish", "new_lesson"].includes(answer.kind);
  const words = answer.kind === "placement" ? `Where the ${answer.scene?.target.label ?? "target"} belongs`
    : answer.kind === "actions" && answer.step && of.world && answer.step[0] < of.world.n_states ? `What to do ${placeWords(of.world, answer.step[0]).replace(/^(?!in )/, "in ")}` : ASKED[answer.kind] ?? "";
  return make("span", "", words || (isOfLesson ? "–" : answer.query_id ? "A question" : "Nothing"), answer.query_id ? " " : isOfLesson ? null : " (not asked)", id);
}

function told(of, answer) {
  if (answer.kind === "placement") return answer.x_m === null || answer.y_m === null ? "A place" : place(answer);
  return (of.world ? WORDS.answer(of.world, answer) : undefined) ?? (answer.n !== null ? COUNTED[answer.kind]?.(answer.n) : undefined) ?? SAID[answer.kind] ?? answer.kind;
}

function answers(of) {
  const counted = inForce(of.answers).length;
  if (!of.answers.length) return section("What was said", paragraph("Nothing has been answered."));
  const withTables = of.answers.some((answer) => answer.scene);
  const columns = [["No.", "number"], ...(withTables ? [["Table", "report-thumbnail"]] : []), ["Asked", "report-asked"], ["Answered", "report-said"], ["How sure", ""], ["What became of it", "report-fate"], ["By", "report-by"]];
  const rows = of.answers.map((answer, i) => ({
    className: `is-${answer.state}`,
    cells: [i + 1, ...(withTables ? [answer.scene ? tableFromAbove(answer.scene, answer.x_m === null || answer.y_m === null ? [] : [{ ...answer, isChosen: true }], 46) : ""] : []),
      question(of, answer), capital(told(of, answer)), CONFIDENCE[answer.confidence] ?? "–", `${answer.state === "accepted" ? "in force, " : ""}${fate(answer)}`, answer.source || "–"],
  }));
  const newest = of.answers.length >= MAX_ANSWERS ? `These are the newest ${of.answers.length}; earlier ones are not shown.` : "";
  return section("What was said", paragraph(said(`${counted} of ${of.answers.length} in force`, newest)), table(columns, rows));
}

// ---- what the robot makes of it -----------------------------------------------------------------------------------

function robot(of) {
  const title = "What the robot would do now";
  // On the page, too, the robot's opinion comes after the person's.
  if (of.asking) return section(title, paragraph("A question is open. What the robot would do is left out, so that it does not sway the answer."));
  return section(title, ...(of.isAboutWorld ? policy(of) : plan(of)));
}

function plan({ plan: made, scene, subject, posterior }) {
  if (!made) return [paragraph("The robot has no plan for the table as it is.")];
  const isHere = made.scene_id === scene?.id, { map_placement: map, robust_placement: robust } = made;
  const worst = made.alpha === null ? "the worst case" : `the worst ${percent(1 - made.alpha)}`, risk = (v) => (v === null ? "" : `${cm(v)} off on average in ${worst} of what the person may mean`);
  const old = posterior && made.revision < posterior.revision ? `This plan is of revision ${made.revision}; the answers are at revision ${posterior.revision}.` : "";
  const facts = [
    ["The place it takes", robust ? `${sentence(place(robust))} ${sentence(risk(made.robust_cvar_m))}` : "none"],
    ["The most likely place", map ? `${sentence(place(map))} ${sentence(risk(made.map_cvar_m))}` : "none"],
    ["Outcome", said(`${OUTCOMES[made.outcome] ?? OUTCOMES.unknown}${made.outcome === "planned" ? `, in ${made.motion_s.toFixed(1)} s` : ""}`, made.reason)],
    ["May it move", made.inside_bound ? "Yes: for this table the bound is below the goal." : "No: for this table the bound is not known to be below the goal."],
  ];
  const list = make("dl", "report-list", ...facts.flatMap(([name, value]) => [make("dt", "", name), make("dd", "", value)]));
  const considered = made.candidates ?? [], spots = considered.map((one, i) => ({ ...one, label: String(i + 1), isChosen: one.verdict === "chosen" }));
  if (robust && !spots.some((spot) => spot.isChosen)) spots.unshift({ ...robust, label: "", isChosen: true });
  if (map) spots.push({ ...map, label: "", isTarget: true });
  const picture = isHere && spots.length ? figure(tableFromAbove(scene, spots, 460), `The table from above, the robot's side below. Black: where the robot would put the ${subject}.${considered.length ? " Numbers: the places below." : ""}${map ? " Square: the most likely place." : ""}`) : null;
  const columns = [["No.", "number"], ["From the left", "number"], ["From the robot's edge", "number"], ["Verdict", ""], ["Why", "report-said"], ["Free space around", "number"], ["Off in the worst case", "number"], ["Best for", "number"]];
  const rows = considered.map((one, i) => ({ className: one.verdict === "chosen" ? "is-chosen" : "", cells: [i + 1, cm(one.x_m), cm(one.y_m), VERDICTS[one.verdict] ?? one.verdict, sentence(one.reason), cm(one.clearance_m), cm(one.cvar_m), percent(one.probability_best)] }));
  return [paragraph(old, "report-none"), isHere ? null : paragraph("This plan is for a table that has changed since.", "report-none"), list, picture,
    rows.length ? make("h3", "", "Places that were considered, best first") : null, rows.length ? table(columns, rows) : null,
    rows.length ? paragraph(`Off in the worst case: the mean distance to the person's place in ${worst} of what the person may mean. Best for: the share of these whose best place is near.`, "report-note") : null];
}

function policy({ policy: made, world, posterior }) {
  if (!made) return [paragraph("The robot has not decided what to do.")];
  const has = made.expected_return !== null;
  const old = posterior && made.revision < posterior.revision ? `This policy is of revision ${made.revision}; the answers are at revision ${posterior.revision}.` : "";
  const balance = has && made.lambda !== null ? `The average counts ${percent(made.lambda)}, the worst case ${percent(1 - made.lambda)}, ${made.preference_id ? "as the person chose" : "as it was set"}.` : "";
  const fits = has && made.table.length === world.n_states * world.actions.length, { kind, rows, columns } = world.picture;
  const picture = !fits || kind === "none" ? null
    : kind === "cells" ? figure(drawnAt(660, Math.min(420, Math.max(160, 36 + (624 * rows) / columns)), (svg) => drawGrid(svg, world, made.table, made.visits, null)), "Arrows: what the robot does; thick where it often comes. Dashed rings: where it starts. Green: where it ends.")
    : figure(drawnAt(660, 400, (svg) => drawRoad(svg, world, made.table, made.visits, null)), ROAD_KEY);
  return [paragraph(old, "report-none"), paragraph(sentence(made.reason)), has ? paragraph(`${worstCase(made, made.objective, made.alpha)} ${asARule(made, made.objective, made.alpha)}`) : null, paragraph(balance), picture];
}

function wants(of) {
  if (!of.weights.length) return null;
  const shown = of.weights.toSorted((a, b) => Math.abs(b.mean) - Math.abs(a.mean)).slice(0, MAX_WEIGHTS);
  const reach = 1.05 * Math.max(1e-9, ...shown.flatMap((w) => [Math.abs(w.low), Math.abs(w.high)])), x = (v) => 80 + (80 * v) / reach;
  const bar = ({ mean, low, high }) => {
    const svg = element("svg", { class: "report-bar", viewBox: "0 0 160 14", width: 160, height: 14, "aria-hidden": "true" });
    svg.append(element("path", { class: "report-zero", d: "M80 0V14" }), element("path", { class: "report-range", d: `M${x(low).toFixed(1)} 7H${x(high).toFixed(1)}` }), element("circle", { cx: x(mean), cy: 7, r: 3.6 }));
    return svg;
  };
  const rows = shown.map((w) => ({ cells: [w.name, number(w.mean), `${number(w.low)} to ${number(w.high)}`, bar(w)] }));
  const rest = of.weights.length > shown.length ? `These ${shown.length} of ${of.weights.length} features weigh most` : "";
  return section("What it takes the person to want", paragraph(said("What each feature is worth: the mean of the draws, and where nine in ten of them lie", rest)), table([["Feature", ""], ["Mean", "number"], ["Nine in ten between", "number"], ["Left: worth less; right: worth more", ""]], rows));
}

function receipt(of) {
  const { judged, policy: made } = of, list = make("dl", "report-list report-receipt");
  const add = (name, value) => list.append(make("dt", "", name), make("dd", "", value));
  if (judged && of.isAboutWorld) {
    const lines = [
      ["least", "Least return", (b) => number(b.least_return.bound)], ["mean", "The same for the best on average", (b) => number(b.least_return_of_mean.bound)], ["loss_bound", "Largest loss", (b) => number(b.loss.bound)],
      ["share", "Of what choosing at random loses", (b) => percent(b.normalised_loss.bound)], ["chosen_by", "Draws that chose the policy", () => `${made.n_draws}; others judge it`], ["gap", "Another policy may be better by", () => (made.gap === null ? "–" : made.gap.toExponential(1))],
    ];
    drawReceipt(list, judged, [...lines, ...COMMON()]);
  } else if (judged) drawReceipt(list, judged);
  add("Revision of the bound", judged?.revision ?? "no bound");
  add("Revision of the answers", of.posterior?.revision ?? "–");
  if (!judged && of.posterior) add("Evidence, SHA-256", of.posterior.evidence_hash);
  if (of.isAboutWorld) add("World, SHA-256", of.world.hash);
  return section("What the claim rests on", judged ? null : paragraph(of.isAboutWorld && of.policy ? "The bound on the robot's policy is not there yet." : "There is no bound, so there is no claim."), list);
}

/** Fills `root` (an empty <article id="report">) with the report of `state` as it is now; `now` is a Date. */
export function drawReport(root, state, now) {
  const of = read(state);
  const parts = [heading(of, now), progress(of), answers(of), robot(of), wants(of), receipt(of)];
  root.replaceChildren(...parts.filter(Boolean), make("footer", "", "Made by the operator page from what it knew at that time."));
}

// Some browsers print only one sheet of what lies on top of a page: on paper the report stands in the page itself.
let dialog = null;
addEventListener("beforeprint", () => {
  const root = document.getElementById("report");
  if (!root?.closest("dialog")?.open) return;
  dialog = root.parentElement;
  document.body.append(root);
});
addEventListener("afterprint", () => {
  if (!dialog) return;
  dialog.append(document.getElementById("report"));
  dialog = null;
});
