// The lesson as a whole: begin, pause, go on, finish, begin anew, and take up what was recorded before.

import { newId } from "./link.js";
import { SESSION } from "./words.js";

const $ = (id) => document.getElementById(id);
const ABOUT_LESSON = ["pause", "start", "finish", "new_lesson", "stop"];

/** The answers that count in this lesson: what came before its beginning is past. */
export const inForce = (answers) => answers.filter((answer) => answer.state === "accepted");

/** The revision that the lesson began with: 0 unless a person began it anew. */
export const lessonStart = (answers) => Math.max(0, ...answers.filter((a) => a.kind === "new_lesson" && a.state === "accepted").map((a) => a.revision ?? 0));

export class Session {
  /** `on` has send(command), ask(command), which is not repeated, and undo(answer). */
  constructor(on) {
    this.on = on;
    this.state = null;
    $("lesson-go").addEventListener("click", () => this.go());
    $("go-on").addEventListener("click", () => this.go());
    $("lesson-finish").addEventListener("click", () => { this.close(); this.say("finish"); });
    $("lesson-new").addEventListener("click", () => { this.close(); this.open($("new-dialog")); });
    $("lesson-load").addEventListener("click", () => { this.close(); this.on.ask({ type: "recordings", id: newId() }); this.open($("load-dialog")); });
    $("new-dialog").addEventListener("close", () => { if ($("new-dialog").returnValue === "new") this.say("new_lesson"); });
    $("load-dialog").addEventListener("close", () => { const name = $("load-dialog").returnValue; if (name.startsWith("load:")) this.on.send({ type: "load", id: newId(), name: name.slice(5) }); });
    $("recordings").addEventListener("change", () => this.choose());
    // A menu closes when the person goes elsewhere.
    document.addEventListener("pointerdown", (event) => { if (!$("session").contains(event.target)) this.close(); });
    $("session").addEventListener("keydown", (event) => { if (event.key === "Escape") { this.close(); $("session").querySelector("summary").focus(); } });
  }

  open(dialog) { dialog.returnValue = ""; dialog.showModal(); }
  close() { $("session").open = false; }
  say(kind) { this.on.send({ type: "respond", id: newId(), query_id: "", kind }); }

  /** What one press does now: pause, start, go on after a pause, or take back what ended the lesson. */
  go() {
    this.close();
    const word = this.state.lesson?.state;
    if (word === "asking") this.say("pause");
    else if (word === "paused") this.say("start");
    else for (const answer of inForce(this.state.answers).filter((a) => a.kind === { finished: "finish", stopped: "stop" }[word])) this.on.undo(answer);
  }

  render(state) {
    this.state = state;
    const word = state.lesson?.state ?? "waiting", said = inForce(state.answers);
    const isFresh = word === "paused" && !said.some((answer) => ABOUT_LESSON.includes(answer.kind));
    $("lesson-go").textContent = SESSION.go(word, isFresh);
    $("lesson-go").disabled = !["asking", "paused", "finished", "stopped"].includes(word);
    $("lesson-finish").disabled = !["asking", "paused"].includes(word);
    $("lesson-new").disabled = word === "waiting" || !said.some((answer) => answer.kind !== "new_lesson");
    $("lesson-load").disabled = word === "waiting";
    const isHalted = ["paused", "finished", "stopped"].includes(word);
    $("session-bar").hidden = !isHalted;
    if (isHalted) {
      $("session-words").textContent = SESSION.halted(word, isFresh);
      $("go-on").textContent = SESSION.go(word, isFresh);
    }
    this.list(state.recordings ?? []);
  }

  list(recordings) {
    const key = JSON.stringify(recordings), list = $("recordings");
    if (list.dataset.key === key) return;
    list.dataset.key = key;
    list.replaceChildren(...recordings.map((recording) => {
      const row = document.createElement("label"), pick = document.createElement("input"), name = document.createElement("strong"), detail = document.createElement("span");
      pick.type = "radio";
      pick.name = "recording";
      pick.value = recording.name;
      name.textContent = recording.name;
      detail.textContent = SESSION.recording(recording);
      row.append(pick, name, detail);
      return row;
    }));
    $("no-recordings").hidden = recordings.length > 0;
    this.choose();
  }

  choose() {
    const picked = document.querySelector('input[name="recording"]:checked');
    $("load-confirm").disabled = !picked;
    $("load-confirm").value = picked ? `load:${picked.value}` : "";
  }
}
