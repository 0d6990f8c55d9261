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
import { ANSWERS, CAUTION, RECEIPT, REPORT, TABLE, WORDS, WORLD } from "./words.js";

/** The node shows no more answers than these, the newest; as MAX_ANSWERS in protocol.rs. */
const MAX_ANSWERS = 200;
const MAX_WEIGHTS = 12;

// ---- pieces -------------------------------------------------------------------------------------------------------

/** An element with a class and with texts or elements inside; what is null is left out. A number keeps its unit. */
function make(name, className, ...inside) {
  const made = document.createElement(name);
  if (className) made.className = className;
  made.append(...inside.filter((piece) => piece !== null && piece !== undefined).map((piece) => (piece instanceof Node ? piece : REPORT.unbroken(String(piece)))));
  return made;
}

const capital = (words) => `${words.slice(0, 1).toUpperCase()}${words.slice(1)}`;
const sentence = (words) => (words ? `${capital(words)}${/[.!?…]$/.test(words) ? "" : "."}` : "");
const said = (...parts) => parts.filter(Boolean).map(sentence).join(" ");
const paragraph = (words, className = "") => (words ? make("p", className, words) : null);
const section = (title, ...inside) => make("section", "", make("h2", "", title), ...inside);
const place = ({ x_m, y_m }) => REPORT.place(cm(x_m), cm(y_m));
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
  const { bound, goal, judged, amount } = of, aim = goal === null ? null : amount(goal);
  if (bound === null) return said(REPORT.nothing(of.missing), REPORT.aim(aim, null));
  const isSame = Boolean(judged) && judged.revision === of.boundRevision && judged.delta !== null;
  const what = of.isAboutWorld ? REPORT.loses(amount(bound)) : REPORT.puts(of.subject, amount(bound));
  return said(REPORT.guarantee(isSame ? percent(1 - judged.delta) : null, what, isSame && judged.alpha !== null ? percent(judged.alpha) : null), REPORT.aim(aim, bound < goal));
}

function heading(of, now) {
  const { lesson, posterior } = of, word = lesson?.state ?? "waiting", revision = posterior?.revision ?? lesson?.revision ?? null;
  const time = Object.assign(make("time", "", now.toLocaleString([], { dateStyle: "long", timeStyle: "long" })), { dateTime: now.toISOString() });
  const about = of.subject === null ? REPORT.none.subject : of.isAboutWorld ? REPORT.world(of.subject) : REPORT.where(of.subject);
  const claim = !of.isAboutWorld && of.bound !== null && of.bounds.reason ? REPORT.claim(sentence(of.bounds.reason)) : "";
  const late = of.bound !== null && revision !== null && of.boundRevision < revision ? REPORT.late(of.boundRevision, revision) : "";
  // While it learns, the lesson's reason is the claim itself.
  const stands = REPORT.lesson[word] ?? REPORT.lesson.unknown, why = lesson && word !== "asking" && lesson.reason ? REPORT.because(stands, lesson.reason) : stands, names = REPORT.facts;
  const facts = [[names.worst, of.bound === null ? REPORT.none.bound : of.amount(of.bound)], [names.goal, of.amount(of.goal)], [names.inForce, inForce(of.answers).length], [names.revision, revision ?? "–"], ...(lesson?.held_out ? [[names.atRandom, REPORT.atRandom(lesson.held_out, lesson.surprises)]] : [])];
  return make("header", "", make("h1", "", REPORT.title), make("p", "report-date", time), make("p", "report-subject", about),
    paragraph(sentence(why), "report-state"), make("dl", "report-facts", ...facts.map(([name, value]) => make("div", "", make("dt", "", name), make("dd", "", value)))),
    paragraph(guarantee(of), of.bound === null ? "report-none" : ""), paragraph(claim, "report-claim"), paragraph(late, "report-none"));
}

function progress(of) {
  if (!of.points.length) return section(REPORT.progress, paragraph(REPORT.none.look));
  const svg = drawnAt(660, 190, (made) => drawTrend(made, of.points, false, of.isAboutWorld ? "%" : "cm"));
  const none = of.points.filter((point) => point.bound_m === null).length;
  return section(REPORT.progress, figure(svg, said(of.isAboutWorld ? REPORT.courseOfLoss : REPORT.courseOfDistance, none ? REPORT.hollow(none, of.points.length) : "")));
}

// ---- what was said ------------------------------------------------------------------------------------------------

function question(of, answer) {
  const id = answer.query_id ? make("span", "report-id", short(answer.query_id)) : null, isOfLesson = ["stop", "pause", "start", "finish", "new_lesson"].includes(answer.kind);
  const words = answer.kind === "preference" && !of.isAboutWorld ? TABLE.whichPlace.replace("?", "")
    : answer.kind === "placement" ? REPORT.where(answer.scene?.target.label)
    : answer.kind === "actions" && answer.step && of.world && answer.step[0] < of.world.n_states ? REPORT.askedThere(of.world, answer.step[0]) : REPORT.asked[answer.kind] ?? "";
  return make("span", "", words || (isOfLesson ? "–" : answer.query_id ? REPORT.unnamed.question : REPORT.unnamed.nothing), answer.query_id ? " " : isOfLesson ? null : ` ${REPORT.unasked}`, id);
}

function told(of, answer) {
  if (answer.kind === "placement") return answer.x_m === null || answer.y_m === null ? REPORT.unnamed.place : place(answer);
  const ofPlaces = answer.kind === "preference" && !of.isAboutWorld ? TABLE.compared[answer.said] : undefined;
  return ofPlaces ?? (of.world ? WORDS.answer(of.world, answer) : undefined) ?? (answer.n !== null ? ANSWERS.counted[answer.kind]?.(answer.n) : undefined) ?? REPORT.kinds[answer.kind] ?? answer.kind;
}

function answers(of) {
  const counted = inForce(of.answers).length;
  if (!of.answers.length) return section(REPORT.answers, paragraph(REPORT.none.answers));
  const withTables = of.answers.some((answer) => answer.scene), names = REPORT.columns;
  const columns = [[REPORT.number, "number"], ...(withTables ? [[names.table, "report-thumbnail"]] : []), [names.asked, "report-asked"], [names.answered, "report-said"], [names.sure, ""], [names.became, "report-fate"], [names.by, "report-by"]];
  const rows = of.answers.map((answer, i) => ({
    className: `is-${answer.state}`,
    cells: [i + 1, ...(withTables ? [answer.scene ? tableFromAbove(answer.scene, answer.x_m === null || answer.y_m === null ? [] : [{ ...answer, isChosen: true }], 46) : ""] : []),
      question(of, answer), capital(told(of, answer)), ANSWERS.confidence[answer.confidence] ?? "–", REPORT.fate(answer.state === "accepted", fate(answer)), answer.source || "–"],
  }));
  const newest = of.answers.length >= MAX_ANSWERS ? REPORT.newest(of.answers.length) : "";
  return section(REPORT.answers, paragraph(said(REPORT.count(counted, of.answers.length), newest)), table(columns, rows));
}

// ---- what the robot makes of it -----------------------------------------------------------------------------------

function robot(of) {
  // On the page, too, the robot's opinion comes after the person's.
  if (of.asking) return section(REPORT.robot, paragraph(REPORT.isOpen));
  return section(REPORT.robot, ...(of.isAboutWorld ? policy(of) : plan(of)));
}

function plan({ plan: made, scene, subject, posterior }) {
  if (!made) return [paragraph(REPORT.none.plan)];
  const isHere = made.scene_id === scene?.id, { map_placement: map, robust_placement: robust } = made;
  const worst = CAUTION.tail(made.alpha === null ? null : percent(1 - made.alpha)), risk = (v) => (v === null ? "" : REPORT.risk(cm(v), worst));
  const old = posterior && made.revision < posterior.revision ? REPORT.oldPlan(made.revision, posterior.revision) : "";
  const names = REPORT.plan, outcome = REPORT.outcome(REPORT.outcomes[made.outcome] ?? REPORT.outcomes.unknown, made.outcome === "planned" ? made.motion_s : null);
  const facts = [
    [names.takes, robust ? `${sentence(place(robust))} ${sentence(risk(made.robust_cvar_m))}` : names.none],
    [names.likely, map ? `${sentence(place(map))} ${sentence(risk(made.map_cvar_m))}` : names.none],
    [names.outcome, said(outcome, made.reason)],
    [names.may, made.inside_bound ? REPORT.mayMove.yes : REPORT.mayMove.no],
  ];
  const list = make("dl", "report-list", ...facts.flatMap(([name, value]) => [make("dt", "", name), make("dd", "", value)]));
  const considered = made.candidates ?? [], spots = considered.map((one, i) => ({ ...one, label: String(i + 1), isChosen: one.verdict === "chosen" }));
  if (robust && !spots.some((spot) => spot.isChosen)) spots.unshift({ ...robust, label: "", isChosen: true });
  if (map) spots.push({ ...map, label: "", isTarget: true });
  const picture = isHere && spots.length ? figure(tableFromAbove(scene, spots, 460), REPORT.picture(subject, considered.length > 0, Boolean(map))) : null;
  const titles = REPORT.candidate, columns = [[REPORT.number, "number"], [titles.left, "number"], [titles.edge, "number"], [titles.verdict, ""], [titles.why, "report-said"], [titles.free, "number"], [titles.off, "number"], [titles.best, "number"]];
  const rows = considered.map((one, i) => ({ className: one.verdict === "chosen" ? "is-chosen" : "", cells: [i + 1, cm(one.x_m), cm(one.y_m), REPORT.verdicts[one.verdict] ?? one.verdict, sentence(one.reason), cm(one.clearance_m), cm(one.cvar_m), percent(one.probability_best)] }));
  return [paragraph(old, "report-none"), isHere ? null : paragraph(REPORT.otherTable, "report-none"), list, picture,
    rows.length ? make("h3", "", REPORT.considered) : null, rows.length ? table(columns, rows) : null,
    rows.length ? paragraph(REPORT.note(worst), "report-note") : null];
}

function policy({ policy: made, world, posterior }) {
  if (!made) return [paragraph(WORLD.undecided)];
  const has = made.expected_return !== null;
  const old = posterior && made.revision < posterior.revision ? REPORT.oldPolicy(made.revision, posterior.revision) : "";
  const balance = has && made.lambda !== null ? REPORT.balance(percent(made.lambda), percent(1 - made.lambda), Boolean(made.preference_id)) : "";
  const fits = has && made.table.length === world.n_states * world.actions.length, { kind, rows, columns } = world.picture;
  const picture = !fits || kind === "none" ? null
    : kind === "cells" ? figure(drawnAt(660, Math.min(420, Math.max(160, 36 + (624 * rows) / columns)), (svg) => drawGrid(svg, world, made.table, made.visits, null)), REPORT.gridKey)
    : figure(drawnAt(660, 400, (svg) => drawRoad(svg, world, made.table, made.visits, null)), ROAD_KEY);
  return [paragraph(old, "report-none"), paragraph(sentence(made.reason)), has ? paragraph(`${worstCase(made, made.objective, made.alpha)} ${asARule(made, made.objective, made.alpha)}`) : null, paragraph(balance), picture];
}

function wants(of) {
  // While a table is asked about they would sway the answer, as the plan would.
  if (!of.weights.length || (of.asking && !of.isAboutWorld)) return null;
  const shown = of.weights.toSorted((a, b) => Math.abs(b.mean) - Math.abs(a.mean)).slice(0, MAX_WEIGHTS);
  const reach = 1.05 * Math.max(1e-9, ...shown.flatMap((w) => [Math.abs(w.low), Math.abs(w.high)])), x = (v) => 80 + (80 * v) / reach;
  const bar = ({ mean, low, high }) => {
    const svg = element("svg", { class: "report-bar", viewBox: "0 0 160 14", width: 160, height: 14, "aria-hidden": "true" });
    svg.append(element("path", { class: "report-zero", d: "M80 0V14" }), element("path", { class: "report-range", d: `M${x(low).toFixed(1)} 7H${x(high).toFixed(1)}` }), element("circle", { cx: x(mean), cy: 7, r: 3.6 }));
    return svg;
  };
  const rows = shown.map((w) => ({ cells: [w.name, number(w.mean), REPORT.range(number(w.low), number(w.high)), bar(w)] })), names = REPORT.weights;
  const rest = of.weights.length > shown.length ? REPORT.most(shown.length, of.weights.length) : "";
  return section(REPORT.wants, paragraph(said(REPORT.worth, rest)), table([[names.feature, ""], [names.mean, "number"], [names.range, "number"], [names.bar, ""]], rows));
}

function receipt(of) {
  const { judged, policy: made } = of, { names } = RECEIPT, list = make("dl", "report-list report-receipt");
  const add = (name, value) => list.append(make("dt", "", name), make("dd", "", value));
  if (judged && of.isAboutWorld) {
    const lines = [
      ["least", names.least, (b) => number(b.least_return.bound)], ["mean", names.mean, (b) => number(b.least_return_of_mean.bound)], ["loss_bound", names.loss_bound, (b) => number(b.loss.bound)],
      ["share", names.share, (b) => percent(b.normalised_loss.bound)], ["chosen_by", names.chosen_by, () => RECEIPT.chosenBy(made.n_draws)], ["gap", names.gap, () => (made.gap === null ? "–" : made.gap.toExponential(1))],
    ];
    drawReceipt(list, judged, [...lines, ...COMMON()]);
  } else if (judged) drawReceipt(list, judged);
  add(REPORT.receiptNames.bound, judged?.revision ?? REPORT.none.bound);
  add(REPORT.receiptNames.answers, of.posterior?.revision ?? "–");
  if (!judged && of.posterior) add(names.evidence_hash, of.posterior.evidence_hash);
  if (of.isAboutWorld) add(REPORT.receiptNames.world, of.world.hash);
  return section(REPORT.receipt, judged ? null : paragraph(of.isAboutWorld && of.policy ? REPORT.none.judgement : REPORT.none.claim), list);
}

/** Fills `root` (an empty <article id="report">) with the report of `state` as it is now; `now` is a Date. */
export function drawReport(root, state, now) {
  const of = read(state);
  const parts = [heading(of, now), progress(of), answers(of), robot(of), wants(of), receipt(of)];
  root.replaceChildren(...parts.filter(Boolean), make("footer", "", REPORT.made));
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
