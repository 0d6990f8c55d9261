// A lesson about a world: what the robot would do, what it may cost, and how cautious it is to be.

import { drawAnswers } from "./answers.js";
import { Ask } from "./ask.js";
import { drawFrontier, isFlat } from "./frontier.js";
import { cellWords, drawGrid } from "./grid.js";
import { newId } from "./link.js";
import { COMMON, drawReceipt } from "./receipt.js";
import { asARule, number, percent, worstCase } from "./risk.js";
import { drawRoad, roadWords } from "./road.js";
import { lessonStart } from "./session.js";
import { answersLeft, drawTrend } from "./trend.js";
import { drawWeights } from "./weights.js";
import { ANSWER, ANSWERS, BAR, CAUTION, GAUGE, PROGRESS, QUESTION, RECEIPT, WORDS, WORLD, sentence } from "./words.js";

const $ = (id) => document.getElementById(id);

function text(id, words, value) {
  const node = $(id);
  if (node.textContent !== words) node.textContent = words;
  if (value !== undefined) node.dataset.value = value ?? "";
}

export class WorldLesson {
  /** `link` sends commands; `on` has undo(answer), redo(answer) and changed(), which draws everything anew. */
  constructor(link, on) {
    this.link = link;
    this.on = on;
    this.ask = new Ask(link, on.changed);
    /** λ under the slider while the person looks at another balance; null: the robot's own. */
    this.wish = null;
    this.sent = null;
    this.state = null;
    this.looked = null;
    $("lambda").addEventListener("input", () => { this.wish = Number($("lambda").value); this.renderPolicy(); });
    $("caution-apply").addEventListener("click", () => this.apply());
    $("lambda").addEventListener("keydown", (event) => { if (event.key === "Enter" && !$("caution-apply").disabled) this.apply(); });
    $("world").addEventListener("pointermove", (event) => this.look(event.target.closest("[data-state]")));
    $("world").addEventListener("pointerleave", () => this.look(null));
    $("world").addEventListener("click", (event) => this.ask.pick(event.target));
    $("show-policy").addEventListener("change", () => this.draw());
    const again = new ResizeObserver(() => { if (this.state && !$("lesson-world").hidden) this.render(this.state); });
    for (const id of ["world-stage", "frontier-plot", "loss-plot"]) again.observe($(id));
  }

  /** Forgets a wish that the robot follows by now. */
  settle(state) {
    this.ask.settle(state);
    if (state.caution?.taken) this.link.drop(state.caution.id);
    if (state.policy?.preference_id) this.link.drop(state.policy.preference_id);
    const followed = this.sent && (state.policy?.preference_id === this.sent.id || (state.caution?.id === this.sent.id && state.caution.taken));
    if (followed) {
      if (this.wish === this.sent.lambda) this.wish = null;
      this.sent = null;
    }
  }

  /** The bounds of this lesson. */
  trend() {
    const start = lessonStart(this.state.answers);
    return this.state.loss_trend.filter((point) => point.revision >= start);
  }

  apply() {
    if (this.wish === null) return;
    if (this.sent) this.link.drop(this.sent.id);
    this.sent = { type: "caution", id: newId(), lambda: this.wish };
    this.link.send(this.sent);
    this.renderPolicy();
  }

  look(cell) {
    const state = cell ? Number(cell.dataset.state) : null;
    if (state === this.looked) return;
    this.looked = state;
    this.renderReadout();
  }

  /** The point of the frontier under the slider, while the person looks at another balance. */
  preview() {
    const points = this.state.frontier?.points ?? [];
    if (this.wish === null || !points.length) return null;
    const nearest = points.reduce((best, p, i) => (Math.abs(p.lambda - this.wish) < Math.abs(points[best].lambda - this.wish) ? i : best), 0);
    return nearest;
  }

  /** π and visits that are shown now; visits are known of the robot's own policy only. */
  table() {
    const { policy, frontier, world } = this.state, at = this.preview(), cells = world.n_states * world.actions.length;
    if (at !== null && frontier.tables.length === frontier.points.length * cells) return { table: frontier.tables.slice(at * cells, (at + 1) * cells), visits: [] };
    const fits = policy && policy.table.length === cells;
    return { table: fits ? policy.table : [], visits: fits && at === null ? policy.visits : [] };
  }

  render(state) {
    this.state = state;
    const collisions = state.world.features.indexOf("collision");
    if (!state.world.collision) state.world.collision = state.world.picture.kind === "road" ? state.world.cells.map((f, s) => (f === collisions ? s : -1)).filter((s) => s >= 0) : [];
    const asking = this.ask.isShown();
    $("skip-link").href = asking ? "#ask" : "#lambda";
    text("skip-link", asking ? BAR.skipToAnswer : BAR.skipToCaution);
    this.ask.render();
    this.renderLesson();
    this.renderPolicy();
    this.renderProgress();
    drawWeights($("weights"), state.weights);
    drawAnswers($("world-answers"), state.answers, state.lesson?.misfits ?? [], { ...this.on, look: () => {}, title: (answer) => WORDS.answer(state.world, answer) });
    const active = state.answers.filter((a) => a.state === "accepted").length;
    text("world-count", state.answers.length ? ANSWERS.count(active, state.answers.length) : "");
    $("world-no-answers").hidden = state.answers.length > 0;
    $("world-answers").hidden = state.answers.length === 0;
  }

  renderLesson() {
    const { lesson, world, policy } = this.state;
    const question = this.state.world_question, asking = this.ask.isShown();
    const [, asked, why] = asking ? question.reason.match(/^([^?]{1,200}\?)\s+(.+)$/s) ?? [] : [];
    text("world-kicker", asking ? QUESTION.number(lesson?.questions_asked) : WORDS.lesson);
    text("world-name", asking ? question.id : world.id);
    text("world-title", asked ?? WORLD.titles[lesson?.state] ?? QUESTION.moment);
    text("world-why", why ?? (lesson && !["asking", "unknown"].includes(lesson.state) ? sentence(lesson.reason) : ""));
    text("answers-left", lesson?.state === "asking" ? PROGRESS.left(lesson.demonstrations || null, answersLeft(this.trend(), lesson.epsilon_loss)) : "");
    const bound = lesson?.loss_bound ?? null, goal = lesson?.epsilon_loss ?? null;
    text("loss-bound", bound === null ? (lesson ? GAUGE.none : "–") : percent(bound), bound);
    $("loss-bound").dataset.revision = lesson?.revision ?? "";
    text("loss-goal", goal === null ? "–" : percent(goal), goal);
    const full = Math.max(bound ?? 0, (goal ?? 0.1) * 2) * 1.05;
    $("loss-fill").style.width = `${bound === null ? 100 : Math.min(100, (100 * bound) / full)}%`;
    $("loss-gauge").dataset.state = bound === null ? "none" : goal !== null && bound < goal && lesson?.state !== "misfit" ? "below" : "above";
    $("loss-mark").style.left = `${(100 * (goal ?? 0)) / full}%`;
    $("loss-gauge").setAttribute("aria-label", GAUGE.lossLabel(bound === null ? null : percent(bound), percent(goal)));
    const thinking = asking && !question.open && lesson?.state === "asking";
    $("world-veil").hidden = Boolean(policy) && !thinking;
    text("world-veil-text", thinking ? QUESTION.thinking : WORLD.thinking);
  }

  renderPolicy() {
    const { policy, frontier, robust_bounds: bounds, caution } = this.state, at = this.preview();
    const has = policy && policy.expected_return !== null, mine = has ? policy : null;
    text("world-risk", !policy ? WORLD.undecided : has ? `${worstCase(policy, policy.objective, policy.alpha)} ${asARule(policy, policy.objective, policy.alpha)}` : sentence(policy.reason), policy?.conditional_value_at_risk ?? null);
    $("world-risk").dataset.revision = policy?.revision ?? "";
    $("world-risk").hidden = this.ask.isShown();
    this.draw();
    const slider = $("lambda"), n = frontier?.points.length ?? 0;
    slider.disabled = !has;
    slider.step = n > 1 ? String(1 / (n - 1)) : "0.05";
    const lambda = this.wish ?? policy?.lambda ?? 0.5;
    if (Number(slider.value) !== lambda) slider.value = String(lambda);
    slider.style.setProperty("--share", `${100 * lambda}%`);
    drawFrontier($("frontier"), frontier, mine, at ?? -1);
    const point = at === null ? mine : frontier.points[at];
    slider.setAttribute("aria-valuetext", point ? CAUTION.value(number(point.expected_return), worstCase(point, policy?.objective ?? "robust", policy?.alpha ?? null)) : CAUTION.share(percent(lambda)));
    text("caution-words", this.cautionWords(point, at !== null));
    const moving = this.wish !== null && this.wish !== policy?.lambda;
    $("caution-apply").disabled = !moving || (this.sent !== null && this.sent.lambda === this.wish);
    const waiting = this.sent ?? (caution && !caution.taken ? caution : null);
    text("caution-state", waiting ? ANSWER.onItsWay : moving ? CAUTION.preview : policy?.preference_id ? CAUTION.chosen : has ? CAUTION.set : "", waiting ? "sending" : moving ? "preview" : policy?.preference_id ? "chosen" : "");
    const same = bounds && policy && bounds.set_id.startsWith(`robust-${policy.revision}-`);
    text("world-claim", this.claim(same ? bounds : null));
    drawReceipt($("world-receipt"), same ? this.receipt(bounds) : null, this.lines());
  }

  cautionWords(point, preview) {
    const { policy, frontier } = this.state;
    if (!point || point.expected_return === null) return policy ? "" : CAUTION.waits;
    if (isFlat(frontier) && !preview) return CAUTION.flat;
    const before = preview && policy?.expected_return !== null && policy ? policy : null;
    const change = before ? this.change(point.expected_return - before.expected_return, point.conditional_value_at_risk - before.conditional_value_at_risk) : "";
    return CAUTION.point(number(point.expected_return), number(point.conditional_value_at_risk), change);
  }

  /** What another balance would change, in words. */
  change(mean, worst) {
    const part = (v) => (Math.abs(v) < 5e-4 ? null : v > 0 ? CAUTION.better(number(v)) : CAUTION.worse(number(-v)));
    return CAUTION.change(part(mean), part(worst));
  }

  claim(bounds) {
    const { policy } = this.state;
    if (!bounds) return policy ? WORLD.claimWaits : "";
    const least = bounds.least_return;
    if (least.bound === null) return sentence(least.reason);
    return WORLD.claim(percent(1 - bounds.delta), number(least.bound), percent(bounds.alpha));
  }

  receipt(bounds) {
    return { ...bounds, reason: this.claim(bounds), least: bounds.least_return.bound, loss_bound: bounds.loss.bound, share: bounds.normalised_loss.bound, mean: bounds.least_return_of_mean.bound, policy: this.state.policy };
  }

  lines() {
    return [
      ["reason", RECEIPT.names.reason, (b) => b.reason],
      ["least", RECEIPT.names.least, (b) => number(b.least)],
      ["mean", RECEIPT.names.mean, (b) => number(b.mean)],
      ["loss_bound", RECEIPT.names.loss_bound, (b) => number(b.loss_bound)],
      ["share", RECEIPT.names.share, (b) => percent(b.share)],
      ["chosen_by", RECEIPT.names.chosen_by, (b) => RECEIPT.chosenBy(b.policy.n_draws)],
      ["held_out", RECEIPT.names.held_out, (b) => (b.policy.held_out_cvar === null ? "–" : b.policy.held_out_interval ? RECEIPT.heldOut(number(b.policy.held_out_cvar), percent(b.policy.confidence), b.policy.held_out_interval.map((v) => number(v))) : number(b.policy.held_out_cvar))],
      ["gap", RECEIPT.names.gap, (b) => (b.policy.gap === null ? "–" : b.policy.gap.toExponential(1))],
      ...COMMON(),
    ];
  }

  renderProgress() {
    const trend = this.trend();
    drawTrend($("loss-trend"), trend.map((p) => ({ revision: p.revision, bound_m: p.bound, epsilon_m: p.goal, reason: p.reason })), false, "%");
  }

  draw() {
    const { world } = this.state, quiet = this.ask.hidesPolicy(), { table, visits } = quiet ? { table: [], visits: [] } : this.table(), svg = $("world");
    svg.classList.toggle("preview", this.preview() !== null);
    $("lesson-world").dataset.picture = world.picture.kind;
    svg.parentElement.style.setProperty("--stage", `${Math.round(this.height(svg.parentElement.clientWidth))}px`);
    if (world.picture.kind === "cells") drawGrid(svg, world, table, visits, this.looked);
    else if (world.picture.kind === "road") drawRoad(svg, world, table, visits, this.looked);
    else svg.replaceChildren();
    this.ask.draw();
    const question = this.ask.isShown() && this.state.world_question.open ? this.state.world_question : null;
    if (question) svg.setAttribute("aria-label", `${WORDS.picture[question.kind](world, question)} ${quiet ? "" : svg.getAttribute("aria-label") ?? ""}`);
    this.renderLegend();
    this.renderReadout();
  }

  /** How tall the picture wants to be on a narrow page, where the page scrolls. */
  height(width) {
    const { kind, rows, columns, lanes, places } = this.state.world.picture;
    if (kind === "cells") return Math.min(900, Math.max(160, (width - 36) * (rows / columns) + 36));
    return kind === "road" ? (lanes - 2) * (places * 40 + 56) : 90;
  }

  renderLegend() {
    const { world } = this.state, list = $("world-legend"), key = `${world.hash} ${world.picture.kind}`;
    if (list.dataset.key === key) return;
    list.dataset.key = key;
    const names = world.picture.kind === "cells" ? world.features.map((name, i) => [name, `hue-${i % 6}`]) : world.picture.kind === "road" ? [[WORLD.collision, "is-hit"], [WORLD.roadside, "is-verge"]] : [];
    list.replaceChildren(...names.slice(0, 12).map(([name, className]) => {
      const item = document.createElement("li"), swatch = document.createElement("i");
      swatch.className = className;
      item.append(swatch, name);
      return item;
    }));
  }

  renderReadout() {
    if (!this.state) return;
    const { world } = this.state, quiet = this.ask.hidesPolicy(), { table } = quiet ? { table: [] } : this.table(), s = this.looked;
    if (world.picture.kind === "none") return text("world-readout", WORLD.noPicture(world.n_states, world.actions.length));
    if (s === null || s >= world.n_states) return text("world-readout", quiet ? WORDS.hidden : this.preview() !== null ? WORLD.preview : world.picture.kind === "road" ? WORLD.roadKey : WORLD.gridKey);
    if (quiet) return text("world-readout", WORLD.place(world, s));
    text("world-readout", world.picture.kind === "cells" ? cellWords(world, table, s) : roadWords(world, table, s));
  }
}
