// The page: keeps the newest sections of the node's state and what the person is doing, and shows both.

import { GIVEN, canUndo, drawAnswers, fate } from "./answers.js";
import { Carry } from "./carry.js";
import { cm, isUnreachable, obstruction } from "./geometry.js";
import { Link, newId } from "./link.js";
import { colour, range } from "./maps.js";
import { Pair } from "./pair.js";
import { drawReceipt } from "./receipt.js";
import { drawReport } from "./report.js";
import { Session, lessonStart } from "./session.js";
import { TableView } from "./table.js";
import { answersLeft, drawTrend } from "./trend.js";
import { drawWeights } from "./weights.js";
import { ANSWER, ANSWERS, BAR, CARRY, GAUGE, LINK, PROGRESS, QUESTION, STATES, TABLE, fillWords, sentence } from "./words.js";
import { WorldLesson } from "./world.js";

const $ = (id) => document.getElementById(id);
const state = { question: null, world_question: null, guess: null, plan: null, scene: null, lesson: null, bounds: null, posterior: null, trend: [], answers: [], nodes: [], node: null, world: null, policy: null, frontier: null, robust_bounds: null, caution: null, weights: [], loss_trend: [], recordings: [], arm: null, arm_pose: null, arm_motion: null, carrying: null };
fillWords();
const own = { question: undefined, at: null, revealed: false, heat: false, sent: null, sentFor: null, correcting: false, look: null, problem: "" };

const table = new TableView($("table"), { moved, submitted: submit, hovered });
const link = new Link({ status, sections, refused, notice });
const world = new WorldLesson(link, { undo, redo, changed: () => render() });
const pair = new Pair({ changed: () => render(), submitted: submit });
const session = new Session({ send: (command) => send(command), ask: (command) => link.ask(command), undo });
const carry = new Carry(() => render());
const again = new Set();
/** Where the target was put for each of the newest questions. */
const drafts = new Map(), MAX_DRAFTS = 8;
/** Weights that are shown. */
const MAX_WANTS = 8;
const dark = matchMedia("(prefers-color-scheme: dark)");

// ---- what is on the table now -------------------------------------------------------------------------------------

const lessonState = () => state.lesson?.state ?? "waiting";
const isAsking = () => Boolean(state.question?.open) && own.sentFor !== state.question.id;
const isTeaching = () => isAsking() || (own.correcting && !state.question?.open && own.sentFor !== "");
/** Whether one of two places is wanted, and not any. */
const isPair = () => showsQuestion() && pair.wants(state.question);
const showsQuestion = () => Boolean(state.question) && (state.question.open || lessonState() === "asking") && !own.correcting;
const scene = () => (showsQuestion() ? state.question.scene : state.scene ?? state.question?.scene ?? null);

/** The robot's placement for what is on the table now, null while there is none. */
function plan() {
  if (!showsQuestion()) return state.plan;
  return state.guess && state.guess.query_id === state.question.id ? state.guess : null;
}

/** The robot's opinion is shown once the person has formed one, or when nothing is asked. */
const reveal = () => (showsQuestion() || own.correcting ? own.revealed : ["taught", "gave_up", "finished", "misfit"].includes(lessonState()));

// ---- from the node ------------------------------------------------------------------------------------------------

function sections(changed) {
  // A node that was started anew knows only the newest bounds; this page may know the older ones.
  const first = changed.trend?.[0]?.revision ?? 0;
  if (first > 0) changed.trend = [...state.trend.filter((point) => point.revision < first), ...changed.trend];
  if (changed.loss_trend?.[0]?.revision > 0) changed.loss_trend = [...state.loss_trend.filter((point) => point.revision < changed.loss_trend[0].revision), ...changed.loss_trend];
  Object.assign(state, changed);
  world.settle(state);
  pair.settle(state.question);
  const sent = state.answers.find((answer) => answer.id === own.sent);
  if (sent?.state === "refused" && own.sentFor !== null) Object.assign(own, { sentFor: null, problem: ANSWER.refused(sent.reason) });
  if (own.correcting && own.sentFor === "" && sent?.state === "accepted") Object.assign(own, { correcting: false, sentFor: null, at: null, revealed: false });
  const key = state.question?.open ? state.question.id : null;
  if (key !== null && own.question !== key) {
    // A node that was started anew may tell of an older question first; what was about to be said to this one is kept.
    drafts.set(own.question, own.at);
    if (drafts.size > MAX_DRAFTS) drafts.delete(drafts.keys().next().value);
    const at = drafts.get(key) ?? null;
    Object.assign(own, { question: key, at, revealed: at !== null, sentFor: null, correcting: false, problem: "", look: null });
    if (at === null) document.querySelector('input[name="confidence"][value="sure"]').checked = true;
    table.place(at);
  }
  render();
}

function status(word) {
  if (word === "expired" && own.status !== word) notice(LINK.old);
  own.status = word;
  renderConnection();
}

function refused(id, reason) {
  if (id !== null && id === own.sent) Object.assign(own, { sentFor: null });
  own.problem = reason;
  world.ask.refused(id, reason);
  notice(reason);
  render();
}

function notice(text) {
  const box = document.createElement("div"), words = document.createElement("span"), close = document.createElement("button");
  box.className = "notice";
  words.textContent = text;
  close.textContent = BAR.dismiss;
  close.addEventListener("click", () => box.remove());
  box.append(words, close);
  while ($("notices").children.length > 2) $("notices").firstChild.remove();
  $("notices").append(box);
}

// ---- from the person ----------------------------------------------------------------------------------------------

function moved(at, settled) {
  own.at = at;
  own.look = null;
  if (settled && at && !own.revealed) {
    own.revealed = true;
    render();
  } else {
    renderAnswer();
  }
}

function hovered(at) {
  own.hover = at;
  renderReadout();
}

const confidence = () => document.querySelector('input[name="confidence"]:checked').value;

function submit() {
  if ($("submit").disabled) return;
  const query = state.question?.open ? state.question.id : "";
  if (isPair()) return compare(pair.better);
  if (!own.at) return;
  send({ type: "place", id: newId(), query_id: query, x_m: own.at.x, y_m: own.at.y, confidence: confidence() }, query);
}

function compare(better) { send({ type: "compare", id: newId(), query_id: state.question.id, better, confidence: confidence() }, state.question.id); }

/** Skipping answers the open question; stopping works whatever is asked. */
function respond(kind, reason = "") {
  const query = isAsking() ? state.question.id : "";
  if (query || kind === "stop") send({ type: "respond", id: newId(), query_id: query, kind, reason }, query || undefined);
}

function send(command, query) {
  Object.assign(own, { sent: command.id, problem: "" });
  world.ask.last = command.id;
  if (query !== undefined) own.sentFor = query;
  link.send(command);
  render();
}

function undo(answer) { send({ type: "retract", id: newId(), evidence_id: answer.id }); }
function redo(answer) {
  const command = { type: "again", id: newId(), evidence_id: answer.id };
  again.add(answer.id).add(command.id);
  send(command);
}
const lastActive = () => state.answers.findLast(canUndo);
const isActive = (answer) => answer.state === "accepted" || answer.state === "pending";
const sameSpot = (a, b) => a.x_m === b.x_m && a.y_m === b.y_m && a.scene?.id === b.scene?.id;
/** The answer taken back last, unless something else was said since: redo walks the undos back, across questions. */
function lastUndone() {
  const isGiven = (a) => (a.kind === "placement" ? state.answers.some((b) => isActive(b) && sameSpot(a, b)) : again.has(a.id));
  if (!isAboutWorld()) return state.answers.findLast((a) => ["placement", "preference"].includes(a.kind) && a.state === "undone" && !isGiven(a));
  const said = Math.max(0, ...state.answers.filter((a) => isActive(a) && !again.has(a.id)).map((a) => a.revision ?? Infinity));
  const undone = state.answers.filter((a) => GIVEN.includes(a.kind) && a.state === "undone" && !again.has(a.id) && (a.undo?.revision ?? 0) > said);
  return undone.sort((a, b) => b.undo.revision - a.undo.revision)[0];
}

$("submit").addEventListener("click", () => (isTeaching() ? submit() : startCorrecting()));
$("skip").addEventListener("click", () => respond("skip"));
$("cant-tell").addEventListener("click", () => (isPair() ? compare("cant_tell") : respond("cant_tell")));
for (const id of ["undo", "ask-undo"]) $(id).addEventListener("click", () => { const answer = lastActive(); if (answer) undo(answer); });
for (const id of ["redo", "ask-redo"]) $(id).addEventListener("click", () => { const answer = lastUndone(); if (answer) redo(answer); });
for (const id of ["stop", "ask-stop"]) $(id).addEventListener("click", () => { $("stop-dialog").returnValue = ""; $("stop-dialog").showModal(); });
$("stop-dialog").addEventListener("close", () => { if ($("stop-dialog").returnValue === "stop") respond("stop", $("stop-reason").value); $("stop-reason").value = ""; });
$("report-open").addEventListener("click", () => { session.close(); drawReport($("report"), state, new Date()); $("report-dialog").showModal(); $("report-dialog").scrollTop = 0; reachable($("report").querySelectorAll("section")); });
$("report-print").addEventListener("click", () => print());
$("report-close").addEventListener("click", () => $("report-dialog").close());
$("report-dialog").addEventListener("close", () => $("report").replaceChildren());
$("heat").addEventListener("change", () => { own.heat = $("heat").checked; render(); });
$("log-scale").addEventListener("change", renderProgress);
$("wants").addEventListener("toggle", renderWants);
$("answers").addEventListener("pointerleave", () => look(null));
$("theme").addEventListener("click", () => setTheme(isDark() ? "light" : "dark"));
dark.addEventListener("change", render);
for (const kind of ["keydown", "pointerdown"]) addEventListener(kind, () => { document.documentElement.dataset.input = kind; }, true);
new ResizeObserver(renderProgress).observe($("plot"));

/** What scrolls sideways can be scrolled by keyboard too. */
function reachable(parts) { for (const part of parts) if (part.scrollWidth > part.clientWidth) part.tabIndex = 0; }

function startCorrecting() {
  Object.assign(own, { correcting: true, at: null, revealed: false, sentFor: null });
  table.place(null);
  render();
}

// ---- showing it ---------------------------------------------------------------------------------------------------

function text(id, words, value) {
  const node = $(id);
  if (node.textContent !== words) node.textContent = words;
  if (value !== undefined) node.dataset.value = value ?? "";
}

/** A lesson about a world has a page of its own; what has a table is shown as a table. */
const isAboutWorld = () => Boolean(state.world) && !state.scene && !state.question;

function render() {
  const aboutWorld = isAboutWorld();
  $("lesson-table").hidden = aboutWorld;
  $("lesson-world").hidden = !aboutWorld;
  renderLesson();
  session.render(state);
  if (aboutWorld) world.render(state);
  for (const [id, is] of [["ask-undo", lastActive()], ["ask-redo", lastUndone()], ["ask-stop", !["waiting", "stopped"].includes(lessonState())]]) $(id).disabled = !is;
  renderTable();
  renderAnswer();
  renderProgress();
  drawAnswers($("answers"), state.answers, state.lesson?.misfits ?? [], { undo, redo, look, title: (answer) => TABLE.compared[answer.kind === "preference" && answer.said] });
  const active = state.answers.filter((a) => a.state === "accepted").length;
  text("history-count", state.answers.length ? ANSWERS.count(active, state.answers.length) : "");
  $("no-answers").hidden = state.answers.length > 0;
  $("answers").hidden = state.answers.length === 0;
  renderConnection();
}


function renderLesson() {
  const { question, lesson, bounds, posterior } = state, name = scene()?.target.label ?? QUESTION.it, word = lessonState();
  text("state-text", STATES[word]);
  $("state").dataset.value = word;
  text("revision", posterior ? String(posterior.revision) : "–", posterior?.revision ?? null);
  const asking = showsQuestion();
  text("question-number", own.correcting ? QUESTION.correction : asking ? QUESTION.number(lesson?.questions_asked) : QUESTION.lesson);
  text("question-id", asking ? question.id : "", asking ? question.id : "");
  const [, asked, why] = asking ? question.reason.match(/^([^?]{1,200}\?)\s+(.+)$/s) ?? [] : [];
  text("question-title", own.correcting || asking ? asked ?? QUESTION.where(name) : QUESTION.titles[word] ?? QUESTION.moment);
  text("question-reason", own.correcting ? QUESTION.correct(name) : asking ? why ?? question.reason : sentence(lesson?.reason) || QUESTION.waiting);
  const epsilon = lesson?.epsilon_m ?? question?.epsilon_m ?? null, bound = bounds?.bound_m ?? null;
  text("bound", bound === null ? (bounds ? GAUGE.none : "–") : cm(bound), bound);
  $("bound").dataset.revision = bounds?.revision ?? "";
  text("epsilon", cm(epsilon), epsilon);
  const here = asking ? question.bound_m : null;
  text("question-bound", cm(here), here);
  $("here").hidden = here === null;
  document.title = BAR.tab(asking || state.world_question?.open ? BAR.question : STATES[word]);
  const full = Math.max(bound ?? 0, (epsilon ?? 0.1) * 2) * 1.05;
  $("gauge-fill").style.width = `${bound === null ? 100 : Math.min(100, (100 * bound) / full)}%`;
  $("gauge").dataset.state = bound === null ? "none" : epsilon !== null && bound < epsilon ? "below" : "above";
  $("gauge-goal").style.left = `${(100 * (epsilon ?? 0)) / full}%`;
  $("gauge").setAttribute("aria-label", GAUGE.label(cm(bound), cm(epsilon)));
  text("claim", bounds?.reason ?? "");
  text("placements-left", word === "asking" ? PROGRESS.left(lesson.demonstrations || null, answersLeft(thisLesson().map((point) => ({ revision: point.revision, bound: point.bound_m })), epsilon)) : "");
}

function renderTable() {
  const shown = own.look?.scene ?? scene();
  const guessed = own.look ? null : plan(), isTask = guessed !== null && guessed === state.plan;
  const motion = isTask && state.arm_motion?.revision === guessed.revision ? state.arm_motion : null;
  carry.render({ scene: shown, plan: isTask && reveal() ? guessed : null, arm: state.arm, pose: state.arm_pose, motion, dark: isDark() });
  carry.doing(isTask && reveal() && state.carrying?.revision === guessed.revision ? state.carrying : null);
  table.show({
    scene: shown,
    spots: carry.spots(),
    options: own.look || !showsQuestion() ? [] : pair.options(state.question),
    plan: guessed,
    heat: own.heat && reveal(),
    reveal: reveal(),
    movable: !own.look && !isPair() && (isTeaching() || (showsQuestion() && own.at !== null && !isAsking())),
    locked: !isTeaching(),
    marks: own.look ? [{ x: own.look.x_m, y: own.look.y_m, label: TABLE.mark(own.look.revision) }] : [],
    guessLabel: showsQuestion() || own.correcting ? TABLE.guess : TABLE.place,
    dark: isDark(),
  });
  $("heat").disabled = !reveal() || !plan()?.reward_map.length;
  renderLegend();
  const thinking = !own.look && lessonState() === "asking" && !isAsking();
  $("veil").hidden = !(thinking || !shown);
  text("veil-text", !shown ? TABLE.waiting : QUESTION.thinking);
}

function renderLegend() {
  const map = plan(), span = own.heat && reveal() && map ? range(map.reward_map) : null;
  $("legend").hidden = !span;
  if (!span) return;
  text("legend-low", span[0].toFixed(2));
  text("legend-high", span[1].toFixed(2));
  const context = $("legend-ramp").getContext("2d");
  for (let i = 0; i < 96; i++) { context.fillStyle = `rgb(${colour(i / 95)})`; context.fillRect(i, 0, 1, 8); }
}

function renderReadout() {
  const shown = scene(), at = (isTeaching() || showsQuestion() ? own.at : null) ?? own.hover, map = plan();

  if (carry.isSolid()) return text("readout", CARRY.hint);
  if (!shown || !at || own.look) return text("readout", own.look ? ANSWERS.earlier(fate(own.look)) : TABLE.key);
  const blocked = obstruction(shown, at), far = isUnreachable(map, shown, at);
  text("readout", TABLE.readout(at, blocked, far));
}

function renderAnswer() {
  renderReadout();
  const shown = scene(), map = plan(), name = shown?.target.label ?? QUESTION.it, teaching = isTeaching(), asking = isAsking();
  const blocked = teaching && own.at && shown ? obstruction(shown, own.at) : null;
  const wantsOne = isPair(), submittable = teaching && (wantsOne ? pair.better !== null : own.at && !blocked), idle = !teaching && !showsQuestion() && Boolean(state.scene) && lessonState() !== "waiting" && lessonState() !== "asking";
  $("submit").disabled = !(submittable || idle);
  text("submit-text", idle ? TABLE.another : wantsOne ? TABLE.choose : TABLE.submit(name));
  pair.render(state.question, { isShown: showsQuestion(), isOpen: asking });
  if (!isAboutWorld()) { text("skip-link", wantsOne ? BAR.skipToAnswer : BAR.skip); $("skip-link").href = wantsOne ? "#pair" : "#target"; }
  keepFocus(wantsOne, asking);
  $("submit").querySelector("kbd").hidden = idle;
  const far = submittable && !wantsOne && isUnreachable(map, shown, own.at);
  text("hint", own.problem ? own.problem
    : blocked ? TABLE.notThere(blocked)
    : far ? TABLE.far
    : wantsOne ? (asking && !submittable ? TABLE.todoPair : "")
    : teaching && !own.at ? TABLE.drag
    : submittable ? TABLE.keys : "");
  $("hint").dataset.tone = own.problem || blocked ? "bad" : far ? "warn" : "";
  for (const id of ["skip", "cant-tell"]) $(id).disabled = !asking;
  $("stop").disabled = lessonState() === "waiting" || lessonState() === "stopped";
  document.querySelector(".confidence").disabled = !teaching;
  const undoable = lastActive(), redoable = lastUndone();
  $("undo").disabled = !undoable;
  $("redo").disabled = !redoable;
  renderGuess(map, shown, name);
  const sent = state.answers.find((a) => a.id === own.sent || a.undo?.id === own.sent);
  const isUndo = sent && sent.id !== own.sent;
  const words = !own.sent ? "" : !sent ? (link.outbox.has(own.sent) ? ANSWER.sending : "")
    : isUndo ? { accepted: ANSWER.takenBack(sent.undo.revision), refused: ANSWER.notTakenBack(sent.undo.reason) }[sent.undo.state] ?? ANSWER.takingBack
    : { accepted: ANSWER.takenIn(sent.revision), refused: ANSWER.refused(sent.reason), undone: "" }[sent.state] ?? ANSWER.onItsWay;
  text("acknowledgement", own.problem ? "" : words, sent ? (isUndo ? sent.undo.revision : sent.revision) : null);
  $("acknowledgement").dataset.state = sent ? (isUndo ? sent.undo.state : sent.state) : own.sent ? "sending" : "";
}

/** Who answers by keyboard goes on by keyboard: what a new question is answered with has the focus. */
function keepFocus(wantsOne, asking) {
  const key = asking ? `${state.question.id} ${wantsOne}` : null, at = document.activeElement;
  if (key === null || key === own.focused) return;
  const isFree = at === document.body || at === null || (at.closest(".answer, #table") && !at.closest("#ask"));
  own.focused = key;
  if (document.documentElement.dataset.input !== "keydown" || !isFree || isAboutWorld()) return;
  (wantsOne ? $("pair").querySelector("input") : table.target).focus({ preventScroll: true });
}

function renderGuess(map, shown, name) {
  const guess = map?.map_placement;
  let words = "", distance = null;
  if (showsQuestion() || own.correcting) {
    if (isPair()) words = "";
    else if (!own.revealed) words = TABLE.hidden(name);
    else if (guess && own.at) {
      distance = Math.hypot(guess.x_m - own.at.x, guess.y_m - own.at.y);
      words = TABLE.apart(cm(distance));
    } else if (map && !guess) words = TABLE.noGuess(map.reason);
    else if (!map) words = TABLE.notArrived;
  } else if (map && reveal()) {
    words = guess ? TABLE.wouldPut(name, guess, map.outcome === "planned" ? map.motion_s : null) : map.reason;
    if (guess && map.outcome !== "planned") words += ` ${map.reason}`;
  }
  text("guess-distance", words, distance);
}

const thisLesson = () => state.trend.filter((point) => point.revision >= lessonStart(state.answers));

function renderProgress() {
  drawTrend($("trend"), thisLesson(), $("log-scale").checked);
  drawReceipt($("receipt-list"), state.bounds);
  $("receipt").hidden = !state.bounds;
  renderWants();
}

/** The weights that are largest; hidden as long as the robot's opinion is. */
function renderWants() {
  $("wants").hidden = isAboutWorld() || !state.weights.length || !reveal();
  if (!$("wants").hidden && $("wants").open) drawWeights($("wants-picture"), state.weights.toSorted((a, b) => Math.abs(b.mean) - Math.abs(a.mean)).slice(0, MAX_WANTS));
}

function look(answer) {
  own.look = answer;
  renderTable();
  renderReadout();
}

function renderConnection() {
  const gone = state.nodes.filter((n) => n.state !== "alive"), open = own.status === "open";
  const value = !open ? own.status ?? "connecting" : gone.some((n) => n.state === "gone") ? "gone" : gone.length ? "late" : "open";
  $("connection").dataset.value = value;
  text("connection-text", !open ? LINK[own.status] ?? LINK.connecting : gone.length ? LINK.node(gone[0].name, gone[0].state) : LINK.open);
  document.body.classList.toggle("offline", !open && own.status !== undefined);
  const list = $("node-list"), key = JSON.stringify([open, state.nodes]);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  list.replaceChildren(...[{ name: LINK.page, state: open ? "alive" : "gone" }, ...state.nodes].map((n) => {
    const item = document.createElement("li"), name = document.createElement("span"), word = document.createElement("b");
    item.dataset.node = n.name;
    item.dataset.value = n.state;
    name.textContent = n.name;
    word.textContent = LINK.state(n.state, n.restarts);
    item.append(document.createElement("i"), name, word);
    return item;
  }));
  text("node-hint", state.nodes.length ? LINK.hint : LINK.silent);
}

function isDark() {
  return (document.documentElement.dataset.theme ?? (dark.matches ? "dark" : "light")) === "dark";
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  try { localStorage.setItem("apprentice.theme", theme); } catch { /* not kept */ }
  render();
}

try { const kept = localStorage.getItem("apprentice.theme"); if (kept) document.documentElement.dataset.theme = kept; } catch { /* the system's */ }
if (location.search) history.replaceState(null, "", location.pathname);
render();
