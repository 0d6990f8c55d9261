// A question that offers two places on the table: which is better, said with a button, in the picture or by keyboard; or neither.

import { boundingRadius } from "./geometry.js";
import { element, footprint, sideways } from "./drawing.js";
import { LETTERS, TABLE } from "./words.js";

const $ = (id) => document.getElementById(id);
const VALUES = ["first", "second"];

export class Pair {
  /** `on` has changed() and submitted(). */
  constructor(on) {
    Object.assign(this, { on, id: null, better: null, isNeither: false });
    $("pair-better").replaceChildren(...LETTERS.map((letter, i) => button(VALUES[i], `side-${i}`, badge(i), words(TABLE.better(letter)), Object.assign(words(""), { className: "way-moves" }))));
    $("pair-better").lastChild.before(button("equal", "equal", words(TABLE.sayEqual)));
    $("pair").addEventListener("change", (event) => this.choose(event.target.value));
    $("pair").addEventListener("keydown", (event) => { if (event.key === "Enter" && event.target.id !== "neither") { event.preventDefault(); on.submitted(); } });
    $("neither").addEventListener("click", () => { this.isNeither = !this.isNeither; this.better = null; on.changed(); });
    $("table").addEventListener("click", (event) => { const option = event.target.closest("[data-option]"); if (option && !$("pair").disabled) this.choose(VALUES[option.dataset.option]); });
  }

  /** Takes the newest question; another one begins with nothing chosen. */
  settle(question) {
    if ((question?.id ?? null) === this.id) return;
    Object.assign(this, { id: question?.id ?? null, better: null, isNeither: false });
    $("pair-better").querySelectorAll(".way-moves").forEach((at, i) => { at.textContent = question?.options[i] ? TABLE.at(question.options[i]) : ""; });
  }

  choose(better) {
    this.better = better;
    this.on.changed();
  }

  /** Whether the question wants one of two places, and the person does not show a third. */
  wants(question) { return question?.options.length === 2 && !this.isNeither; }

  /** What the picture shows of it. */
  options(question) { return this.wants(question) ? question.options.map((at, i) => ({ ...at, i, isChosen: this.better === VALUES[i] })) : []; }

  render(question, { isShown, isOpen }) {
    const offers = isShown && question?.options.length === 2;
    $("pair").hidden = !offers || this.isNeither;
    $("pair").disabled = !isOpen;
    $("neither").hidden = !offers;
    $("neither").disabled = !isOpen;
    $("neither").textContent = this.isNeither ? TABLE.backToPair : TABLE.neither;
    for (const input of $("pair").querySelectorAll("input")) input.checked = input.value === this.better;
  }
}

/** The target in both places. */
export function drawOptions(layer, table, scene, options) {
  const { k } = table.box, r = boundingRadius(scene.target) * k;
  layer.replaceChildren(...options.map(({ x_m, y_m, i, isChosen }) => {
    const p = table.px({ x: x_m, y: y_m }), letter = LETTERS[i].toLowerCase(), name = TABLE.option(LETTERS[i], scene.target.label);
    const group = element("g", { class: `option option-${letter}${isChosen ? " chosen" : ""}`, "data-option": String(i), "data-testid": `option-${letter}`, transform: `translate(${p.x.toFixed(2)} ${p.y.toFixed(2)})` });
    group.append(
      element("title", {}, name), element("circle", { class: "hit", r: Math.max(r + 6, 24) }), footprint({ ...scene.target, yaw_rad: 0 }, k, "body"),
      ...(isChosen ? [element("circle", { class: "ring", r: r + 6 })] : []),
      element("text", { class: "letter", x: sideways(table, p.x, LETTERS[i]), y: 7, "text-anchor": "middle" }, LETTERS[i]),
    );
    return group;
  }));
}

function button(value, side, ...children) {
  const made = document.createElement("label"), input = document.createElement("input"), face = document.createElement("span");
  made.dataset.side = side;
  Object.assign(input, { type: "radio", name: "pair-choice", value });
  face.className = "face";
  face.append(...children);
  made.append(input, face);
  return made;
}

function words(of) { return Object.assign(document.createElement("span"), { className: "way-title", textContent: of }); }
function badge(i) { return Object.assign(document.createElement("span"), { className: `way-badge way-badge-${LETTERS[i].toLowerCase()}`, textContent: LETTERS[i] }); }
