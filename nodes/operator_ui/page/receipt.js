// The receipt of a bound: everything the claim rests on.

const WORDS = [
  ["claim", "Claim", (b) => b.reason],
  ["bound_m", "Bound", (b) => (b.bound_m === null ? "none" : `${(b.bound_m * 100).toFixed(2)} cm`)],
  ["alpha", "α, share of rewards covered", (b) => b.alpha],
  ["delta", "δ, chance that the bound is wrong", (b) => b.delta],
  ["look", "Looks at the bound so far", (b) => b.look],
  ["delta_spent", "δ spent on each table of this look", (b) => short(b.delta_spent)],
  ["n", "Draws", (b) => `${b.n} in ${b.n_chains} chains`],
  ["ess_min", "Effective draws, least", (b) => fixed(b.ess_min, 0)],
  ["rhat_max", "R̂, worst", (b) => fixed(b.rhat_max, 4)],
  ["acceptance", "Acceptance", (b) => fixed(b.acceptance, 3)],
  ["beta", "β, rationality assumed", (b) => b.beta],
  ["prior", "Prior", (b) => b.prior],
  ["evidence_hash", "Evidence, SHA-256", (b) => b.evidence_hash],
  ["seed", "Seed", (b) => b.seed],
  ["version", "Version", (b) => b.version],
];

const fixed = (v, digits) => (v === null ? "–" : v.toFixed(digits));
const short = (v) => (v === null ? "–" : v.toPrecision(3));

/** The lines of a receipt that every bound shares, from its confidence on. */
export const COMMON = () => WORDS.slice(2).filter(([key]) => key !== "beta" && key !== "delta_spent");

/** Fills the definition list; each number is also there in full in `data-value`. */
export function drawReceipt(list, bounds, lines = WORDS) {
  list.replaceChildren(...(bounds ? lines : []).flatMap(([key, name, value]) => {
    const term = document.createElement("dt"), text = document.createElement("dd");
    term.textContent = name;
    text.textContent = value(bounds) ?? "–";
    text.dataset.field = key;
    if (bounds[key] !== undefined) text.dataset.value = bounds[key] ?? "";
    return [term, text];
  }));
}
