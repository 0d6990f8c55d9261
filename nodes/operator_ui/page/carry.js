// How the robot would carry out its plan: the arm in three dimensions, its motion, and every place that it considered.

import { ArmView, carried, posesAt } from "./arm_view.js";
import { CARRY } from "./words.js";

const $ = (id) => document.getElementById(id);

export class Carry {
  /** `changed` draws the page anew. */
  constructor(changed) {
    this.changed = changed;
    this.solid = false;
    this.view = null;
    /** Moment of the motion that is looked at, seconds; null: the arm as it is. */
    this.seconds = null;
    this.playing = false;
    $("show-arm").addEventListener("change", () => this.toggle($("show-arm").checked));
    $("motion-play").addEventListener("click", () => this.play());
    $("motion-time").addEventListener("input", () => { this.playing = false; this.seconds = Number($("motion-time").value); this.render(this.state); });
    $("arm-home").addEventListener("click", () => this.view?.home());
    $("candidates").addEventListener("toggle", changed);
  }

  toggle(on) {
    this.solid = on;
    if (on) this.view ??= new ArmView($("arm"));
    this.changed();
  }

  /** Whether the arm is shown, instead of the table from above. */
  isSolid() { return this.solid && Boolean(this.view?.works && this.state?.arm && this.state.scene); }

  /** The places to mark on the table, when the person looks at them. */
  spots() {
    if ($("candidates").hidden || !$("candidates").open) return [];
    return this.state.plan.candidates.map((c, i) => ({ x_m: c.x_m, y_m: c.y_m, label: String(i + 1), kind: { chosen: "chosen", next_best: "spare" }[c.verdict] ?? "bad" }));
  }

  play() {
    const { motion } = this.state, last = motion?.times_s.at(-1) ?? 0;
    this.playing = !this.playing;
    if (!this.playing) return this.render(this.state);
    let before = null;
    if (this.seconds === null || this.seconds >= last) this.seconds = 0;
    const step = (now) => {
      if (!this.playing) return;
      if (before !== null) this.seconds = Math.min(last, this.seconds + (now - before) / 1000);
      before = now;
      if (this.seconds >= last) this.playing = false;
      this.render(this.state);
      if (this.playing) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  /** `state` has scene, plan (null while it is hidden), arm, pose, motion (of that plan) and dark. */
  render(state) {
    if (this.state && this.state.motion !== state.motion) { this.seconds = null; this.playing = false; }
    this.state = state;
    const { scene, plan, arm, pose, motion, dark } = state, moves = Boolean(motion?.times_s.length && plan);
    $("show-arm-switch").hidden = !arm;
    $("candidates").hidden = !plan?.candidates.length;
    if (plan?.candidates.length) this.list(plan);
    const solid = this.solid && Boolean(arm && scene);
    $("arm").hidden = !solid;
    if (this.view) this.view.labels.hidden = !solid;
    $("arm-home").hidden = !solid;
    $("table").style.visibility = solid ? "hidden" : "";
    $("motion").hidden = !(solid && moves);
    if (!solid) return;
    if (!this.view.works) {
      $("arm").hidden = true;
      $("table").style.visibility = "";
      $("show-arm-switch").title = CARRY.noPicture;
      return;
    }
    // While the person looks at the plan, the arm as it is would only be in the way.
    const replay = moves && this.seconds !== null ? posesAt(motion, this.seconds) : null;
    const target = motion?.target && plan ? { ...motion.target, z_m: motion.target_z_m } : null;
    this.view.show({ scene, arm, dark, pose: replay ?? pose, replayed: Boolean(replay), way: moves ? motion.way : null, tray: plan && motion?.pick ? motion : null, target: target && { ...target, ...this.at(replay) } });
    const spots = this.spots(), key = JSON.stringify(spots);
    if (key !== this.spotsKey) { this.spotsKey = key; this.view.show({ spots }); }
    $("arm").setAttribute("aria-label", CARRY.picture(scene, plan));
    if (!moves) return;
    const last = motion.times_s.at(-1);
    $("motion-time").max = last;
    $("motion-time").value = this.seconds ?? 0;
    $("motion-time").style.setProperty("--share", `${(100 * (this.seconds ?? 0)) / Math.max(1e-3, last)}%`);
    $("motion-time").setAttribute("aria-valuetext", CARRY.time(this.seconds, last));
    $("motion-words").textContent = CARRY.time(this.seconds, last);
    $("motion-play").textContent = this.playing ? CARRY.pause : CARRY.play;
  }

  /** Where the target is at the moment that is looked at: it waits to be picked up, is in the hand, or stands in its place. */
  at(replay) {
    const { motion } = this.state, [from, until] = motion.held_s;
    if (!replay || this.seconds > until) return {};
    if (this.seconds < from && motion.pick) return { pose: motion.pick, alpha: 0.75 };
    const held = carried(motion, replay);
    return held ? { pose: held, alpha: 0.75 } : {};
  }

  /** What the arm is doing, in words. */
  doing(carrying) {
    const node = $("carrying");
    node.hidden = !carrying;
    if (!carrying) return;
    node.dataset.state = carrying.over ? (carrying.done ? "done" : "failed") : "moving";
    const words = CARRY.doing(carrying);
    if (node.textContent !== words) node.textContent = words;
  }

  list(plan) {
    const key = JSON.stringify(plan.candidates), list = $("candidate-list");
    if (list.dataset.key === key) return;
    list.dataset.key = key;
    $("candidates-title").textContent = CARRY.considered(plan.candidates.length);
    list.replaceChildren(...plan.candidates.map((candidate) => {
      const item = document.createElement("li"), title = document.createElement("strong"), detail = document.createElement("span");
      item.dataset.verdict = candidate.verdict;
      title.textContent = CARRY.verdict(candidate);
      detail.textContent = CARRY.numbers(candidate);
      item.append(title, detail);
      return item;
    }));
  }
}
