// The receipt of a bound: everything the claim rests on.

import { RECEIPT } from "./words.js";

const LINES = [
  ["claim", RECEIPT.names.claim, (b) => b.reason],
  ["bound_m", RECEIPT.names.bound_m, (b) => (b.bound_m === null ? RECEIPT.none : `${(b.bound_m * 100).toFixed(2)} cm`)],
  ["alpha", RECEIPT.names.alpha, (b) => b.alpha],
  ["delta", RECEIPT.names.delta, (b) => b.delta],
  ["look", RECEIPT.names.look, (b) => b.look],
  ["delta_spent", RECEIPT.names.delta_spent, (b) => short(b.delta_spent)],
  ["n", RECEIPT.names.n, (b) => RECEIPT.draws(b.n, b.n_chains)],
  ["ess_min", RECEIPT.names.ess_min, (b) => fixed(b.ess_min, 0)],
  ["rhat_max", RECEIPT.names.rhat_max, (b) => fixed(b.rhat_max, 4)],
  ["acceptance", RECEIPT.names.acceptance, (b) => fixed(b.acceptance, 3)],
  ["beta", RECEIPT.names.beta, (b) => b.beta],
  ["prior", RECEIPT.names.prior, (b) => b.prior],
  ["evidence_hash", RECEIPT.names.evidence_hash, (b) => b.evidence_hash],
  ["seed", RECEIPT.names.seed, (b) => b.seed],
  ["version", RECEIPT.names.version, (b) => b.version],
];

const fixed = (v, digits) => (v === null ? "–" : v.toFixed(digits));
const short = (v) => (v === null ? "–" : v.toPrecision(3));

/** The lines of a receipt that every bound shares, from its confidence on. */
export const COMMON = () => LINES.slice(2).filter(([key]) => key !== "beta" && key !== "delta_spent");

/** Fills the definition list; each number is also there in full in `data-value`. */
export function drawReceipt(list, bounds, lines = LINES) {
  list.replaceChildren(...(bounds ? lines : []).flatMap(([key, name, value]) => {
    const term = document.createElement("dt"), text = document.createElement("dd");
    term.textContent = name;
    text.textContent = value(bounds) ?? "–";
    text.dataset.field = key;
    if (bounds[key] !== undefined) text.dataset.value = bounds[key] ?? "";
    return [term, text];
  }));
}
