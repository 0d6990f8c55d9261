// A question about a world and the person's answer: what to do here, what is good and bad on a way, or which of two is better.

import { arrow } from "./grid.js";
import { element } from "./drawing.js";
import { newId } from "./link.js";
import { direction, drawWays, moveTravellers } from "./ways.js";
import { ANSWER, LETTERS, MARKS, WORDS, wayWords } from "./words.js";

const $ = (id) => document.getElementById(id);
const STEP_MS = 620;
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const NEXT = { none: "good", good: "bad", bad: "none" };
const ARROWS = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };

function text(id, words, value) {
  const node = $(id);
  if (node.textContent !== words) node.textContent = words;
  if (value !== undefined) node.dataset.value = value ?? "";
}

const fresh = (question) => ({ id: question?.id ?? null, choice: null, better: null, marks: (question?.ways[0]?.states ?? []).map(() => "none"), focus: null, time: 0, sent: null, problem: "" });

export class Ask {
  /** `link` sends commands; `changed()` asks for the whole lesson to be drawn anew. */
  constructor(link, changed) {
    Object.assign(this, { link, changed, own: fresh(null), state: null, playing: false, built: "", last: null });
    $("ask-submit").addEventListener("click", () => this.submit());
    $("ask-skip").addEventListener("click", () => this.respond("skip"));
    $("ask-cant-tell").addEventListener("click", () => (this.question.kind === "comparison" ? this.send({ type: "compare", better: "cant_tell", confidence: this.confidence() }) : this.respond("cant_tell")));
    $("ask-play").addEventListener("click", () => this.play(!this.playing));
    $("ask-time").addEventListener("input", () => { this.play(false); this.own.time = Number($("ask-time").value); this.renderTime(); });
    for (const id of ["ask-action", "ask-compare"]) $(id).addEventListener("change", (event) => this.choose(event.target));
    $("ask").addEventListener("keydown", (event) => this.key(event));
    $("ask-steps").addEventListener("click", (event) => { const step = event.target.closest("[data-step]"); if (step && !this.locked()) this.mark(Number(step.dataset.step)); });
    $("ask-steps").addEventListener("focusin", (event) => this.focus(Number(event.target.dataset.step)));
    $("ask-steps").addEventListener("pointerover", (event) => { const step = event.target.closest("[data-step]"); if (step) this.focus(Number(step.dataset.step)); });
    for (const [id, mark] of [["ask-all-good", "good"], ["ask-all-none", "none"]]) $(id).addEventListener("click", () => { this.own.marks.fill(mark); this.changed(); });
  }

  get question() { return this.state?.world_question ?? null; }
  /** Whether a question waits for this person's answer. */
  isOpen() { return Boolean(this.question?.open) && this.own.sent === null; }
  locked() { return !this.isOpen(); }
  confidence() { return document.querySelector('input[name="ask-confidence"]:checked').value; }

  /** Takes the newest state; a new question begins with nothing chosen. */
  settle(state) {
    this.state = state;
    const question = this.question;
    if ((question?.id ?? null) !== this.own.id) {
      this.own = fresh(question);
      this.wantsFocus = true;
      document.querySelector('input[name="ask-confidence"][value="sure"]').checked = true;
      this.play(question?.kind === "comparison" && question.open && !calm.matches && !this.isSpectator());
    }
    const sent = state.answers.find((answer) => answer.id === this.own.sent);
    if (sent?.state === "refused") Object.assign(this.own, { sent: null, problem: ANSWER.refused(sent.reason) });
    if (!question?.open) this.play(false);
  }

  /** Whether a simulated person answers: then this page only looks on. */
  isSpectator() { return this.state.nodes.some((node) => node.name === "demonstrator" && node.state === "alive"); }
  /** The robot's own opinion stays hidden while a person forms theirs. */
  hidesPolicy() { return this.isOpen() && !this.isSpectator() && !$("show-policy").checked; }
  isShown() { return Boolean(this.question) && (this.question.open || this.state.lesson?.state === "asking"); }

  refused(id, reason) {
    if (id !== this.own.sent) return;
    Object.assign(this.own, { sent: null, problem: reason });
  }

  send(command) {
    if (!this.isOpen()) return;
    const sent = { ...command, id: newId(), query_id: this.question.id };
    Object.assign(this.own, { sent: sent.id, problem: "" });
    this.last = sent.id;
    this.play(false);
    this.link.send(sent);
    this.changed();
  }

  respond(kind) { this.send({ type: "respond", kind, reason: "" }); }

  submit() {
    if ($("ask-submit").disabled) return;
    const { own } = this, confidence = this.confidence();
    if (this.question.kind === "action") this.send({ type: "act", action: own.choice, confidence });
    else if (this.question.kind === "comparison") this.send({ type: "compare", better: own.better, confidence });
    else this.send({ type: "mark", segments: segments(own.marks), confidence });
  }

  isReady() {
    const { own } = this;
    return { action: own.choice !== null, comparison: own.better !== null, critique: own.marks.some((mark) => mark !== "none") }[this.question?.kind] ?? false;
  }

  choose(input) {
    if (input.name === "ask-choice") this.own.choice = Number(input.value);
    if (input.name === "ask-better") this.own.better = input.value;
    this.own.problem = "";
    this.changed();
  }

  /** A place in the picture was chosen: the next cell for an action, a step of the way for a critique. */
  pick(target) {
    if (this.locked()) return;
    const step = target.closest("[data-step]"), cell = target.closest("[data-state]");
    if (this.question.kind === "critique" && step) return this.mark(Number(step.dataset.step));
    if (this.question.kind !== "action" || !cell || this.state.world.picture.kind !== "cells") return;
    const { columns } = this.state.world.picture, to = Number(cell.dataset.state), from = this.question.state;
    this.toward([Math.sign((to % columns) - (from % columns)), Math.sign(Math.floor(to / columns) - Math.floor(from / columns))]);
  }

  /** Chooses the action that leads most nearly there. */
  toward([dx, dy]) {
    const { world } = this.state, fit = (a) => { const [x, y] = direction(world, a); return x * dx + y * dy; };
    const best = world.actions.map((_, a) => a).reduce((b, a) => (fit(a) > fit(b) + 1e-9 ? a : b), 0);
    if (fit(best) < 0.5) return;
    this.own.choice = best;
    this.own.problem = "";
    this.changed();
    document.querySelector(`#ask-action input[value="${best}"]`)?.focus();
  }

  mark(i, mark = NEXT[this.own.marks[i]]) {
    this.own.marks[i] = mark;
    this.own.problem = "";
    this.changed();
    $("ask-steps").children[i]?.querySelector("button").focus({ preventScroll: true });
  }

  focus(i) {
    if (!Number.isInteger(i) || this.own.focus === i) return;
    this.own.focus = i;
    this.draw();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || this.locked()) return;
    const typing = event.target.tagName === "BUTTON" && event.target.id !== "ask-submit";
    if (event.key === "Enter" && !(typing && !event.target.dataset.step)) { event.preventDefault(); return this.submit(); }
    const kind = this.question.kind, step = event.target.closest?.("[data-step]");
    if (kind === "action" && ARROWS[event.key] && event.target.name === "ask-choice") { event.preventDefault(); return this.toward(ARROWS[event.key]); }
    if (kind !== "critique" || !step) return;
    const i = Number(step.dataset.step), move = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (move) { event.preventDefault(); $("ask-steps").children[i + move]?.querySelector("button").focus(); }
    const mark = { g: "good", b: "bad", u: "none" }[event.key.toLowerCase()];
    if (mark) { event.preventDefault(); this.mark(i, mark); $("ask-steps").children[i + 1]?.querySelector("button").focus(); }
  }

  /** The two walk in step; where motion is not wanted each press is one step. */
  play(on) {
    if (on && calm.matches) {
      const last = this.length();
      this.own.time = this.own.time >= last ? 0 : Math.floor(this.own.time) + 1;
      return this.renderTime();
    }
    if (this.playing === on) return;
    this.playing = on;
    text("ask-play-text", WORDS.play(on));
    if (!on) return;
    if (this.own.time >= this.length()) this.own.time = 0;
    let before = null;
    const frame = (now) => {
      if (!this.playing || this.question?.kind !== "comparison") return;
      this.own.time += before === null ? 0 : (now - before) / STEP_MS;
      before = now;
      // A moment's rest at the end, then from the start again.
      if (this.own.time > this.length() + 1.2) this.own.time = 0;
      this.renderTime();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  length() { return Math.max(0, ...(this.question?.ways ?? []).map((way) => way.states.length - 1)); }

  renderTime() {
    const { world, world_question: question } = this.state, t = Math.min(this.own.time, this.length());
    moveTravellers($("world"), world, question, t);
    const slider = $("ask-time");
    slider.value = String(t);
    slider.style.setProperty("--share", `${(100 * t) / Math.max(1, this.length())}%`);
    slider.setAttribute("aria-valuetext", WORDS.time(world, question.ways, Math.round(t)));
  }

  draw() { if (this.state?.world) drawWays($("world"), this.state.world, this.question?.open ? this.question : null, this.own); }

  render() {
    const { state, question, own } = this, shown = this.isShown(), open = this.isOpen(), kind = question?.kind;
    $("ask").hidden = !shown;
    $("lesson-world").classList.toggle("asking", shown);
    $("show-policy-switch").hidden = !open || this.isSpectator();
    if (!shown) return;
    $("ask").dataset.kind = kind;
    $("ask").dataset.query = question.open ? question.id : "";
    $("ask").dataset.state = question.state;
    for (const [id, of] of [["ask-action", "action"], ["ask-compare", "comparison"], ["ask-critique", "critique"]]) $(id).hidden = kind !== of;
    this.build();
    for (const input of $("ask").querySelectorAll("fieldset")) input.disabled = !open;
    for (const input of document.querySelectorAll('input[name="ask-choice"]')) input.checked = Number(input.value) === own.choice;
    for (const input of document.querySelectorAll('input[name="ask-better"]')) input.checked = input.value === own.better;
    if (kind === "critique") this.renderSteps();
    $("ask-submit").disabled = !open || !this.isReady();
    text("ask-submit-text", WORDS.submit[kind]);
    for (const id of ["ask-skip", "ask-cant-tell"]) $(id).disabled = !open;
    text("ask-hint", own.problem || (open ? (this.isReady() ? "" : WORDS.todo[kind]) : ""));
    $("ask-hint").dataset.tone = own.problem ? "bad" : "";
    this.renderAcknowledgement();
    if (open && this.wantsFocus) this.takeFocus();
  }

  /** Who answers by keyboard goes on by keyboard: the next question's first control has the focus. */
  takeFocus() {
    this.wantsFocus = false;
    const at = document.activeElement, byKeyboard = document.documentElement.dataset.input === "keydown";
    if (!byKeyboard || !(at === document.body || at === null || $("ask").contains(at))) return;
    const first = { action: "#ask-action input", comparison: "#ask-better input", critique: "#ask-steps button" }[this.question.kind];
    document.querySelector(first)?.focus({ preventScroll: true });
  }

  renderAcknowledgement() {
    const { answers } = this.state, sent = answers.find((a) => a.id === this.last || a.undo?.id === this.last), undo = sent && sent.id !== this.last;
    const words = !this.last ? "" : !sent ? (this.link.outbox.has(this.last) ? ANSWER.sending : "")
      : undo ? { accepted: ANSWER.takenBack(sent.undo.revision), refused: ANSWER.refused(sent.undo.reason) }[sent.undo.state] ?? ANSWER.takingBack
      : { accepted: ANSWER.takenIn(sent.revision), refused: ANSWER.refused(sent.reason), undone: "" }[sent.state] ?? ANSWER.onItsWay;
    text("ask-acknowledgement", this.own.problem ? "" : words, sent ? (undo ? sent.undo.revision : sent.revision) : null);
    $("ask-acknowledgement").dataset.state = sent ? (undo ? sent.undo.state : sent.state) : "";
  }

  /** Buttons of a new question. */
  build() {
    const { world, world_question: question } = this.state;
    if (this.built === question.id) return;
    this.built = question.id;
    if (question.kind === "action") $("ask-action-buttons").replaceChildren(...world.actions.map((name, a) => this.actionButton(name, a)));
    else if (question.kind === "comparison") {
      $("ask-better").replaceChildren(...question.ways.map((way, i) => this.wayButton(way, i, i ? "second" : "first")));
      $("ask-better").lastChild.before(radio("ask-better", "equal", [label("equal-text", WORDS.sayEqual)], "equal"));
      $("ask-time").max = String(this.length());
      text("ask-play-text", WORDS.play(this.playing));
    } else $("ask-steps").replaceChildren(...question.ways[0].states.map((_, i) => { const item = document.createElement("li"), button = document.createElement("button"); button.type = "button"; button.dataset.step = i; button.append(label("step-glyph", ""), label("step-number", "")); item.append(button); return item; }));
  }

  actionButton(name, a) {
    const { world } = this.state, [dx, dy] = direction(world, a), svg = element("svg", { viewBox: "0 0 32 32", width: 26, height: 26, "aria-hidden": "true" });
    svg.append(dx || dy ? arrow("button-move", 16 - 3.4 * dx, 16 - 3.4 * dy, [dx, dy], 22, 3) : element("circle", { class: "button-stay", cx: 16, cy: 16, r: 6 }));
    const side = Math.abs(dx) > Math.abs(dy) ? (dx > 0 ? "right" : "left") : dy < 0 ? "up" : dy > 0 ? "down" : "middle";
    return radio("ask-choice", String(a), [svg, label("", name)], side);
  }

  wayButton(way, i, value) {
    const { moves, over } = wayWords(this.state.world, way), badge = label(`way-badge way-badge-${LETTERS[i].toLowerCase()}`, LETTERS[i]);
    return radio("ask-better", value, [badge, label("way-title", WORDS.way(i)), label("way-moves", over ? `${moves} · ${over}` : moves)], `side-${i}`);
  }

  renderSteps() {
    const { world, world_question: question } = this.state, way = question.ways[0], glyphs = { good: "✓", bad: "✕", none: "" };
    [...$("ask-steps").children].forEach((item, i) => {
      const button = item.firstChild, mark = this.own.marks[i];
      button.className = `step ${mark}`;
      button.disabled = !this.isOpen();
      button.setAttribute("aria-label", WORDS.step(world, way, i, mark));
      button.firstChild.dataset.glyph = glyphs[mark] || `${i + 1}`;
      button.lastChild.textContent = world.actions[way.actions[i]];
      button.title = MARKS[mark];
    });
  }
}

/** Runs of equal marks as segments; what is not marked says nothing. */
function segments(marks) {
  const found = [];
  marks.forEach((mark, i) => {
    const last = found[found.length - 1];
    if (mark === "none") return;
    if (last && last.end === i && last.good === (mark === "good")) last.end = i + 1;
    else found.push({ start: i, end: i + 1, good: mark === "good" });
  });
  return found;
}

function label(className, words) {
  const made = document.createElement("span");
  made.className = className;
  made.textContent = words;
  return made;
}

function radio(name, value, children, side) {
  const made = document.createElement("label"), input = document.createElement("input"), face = document.createElement("span");
  made.dataset.side = side;
  Object.assign(input, { type: "radio", name, value });
  face.className = "face";
  face.append(...children);
  made.append(input, face);
  return made;
}
