// The risk of a policy in words.

/** A return or a loss, short; a minus sign, not a hyphen. */
export function number(v, least = 0) {
  if (v === null || v === undefined) return "–";
  const digits = Math.max(least, Math.abs(v) >= 100 ? 0 : Math.abs(v) >= 10 ? 1 : 3);
  const text = v.toFixed(digits);
  return (Number(text) === 0 ? (0).toFixed(digits) : text).replace("-", "−");
}

/** A share as a percentage, without decimals that say nothing. */
export const percent = (share) => (share === null || share === undefined ? "–" : `${Number((100 * share).toFixed(1))} %`);

/** What a policy or a point of the frontier may bring in the worst case. */
export function worstCase(of, objective, alpha) {
  const cvar = of.conditional_value_at_risk, share = alpha === null ? "–" : percent(1 - alpha);
  if (cvar === null) return "";
  const start = `In the worst ${share} of what the person may mean`;
  if (objective === "evd") return `${start}, it loses ${number(-cvar)} on average against the best that can be done.`;
  if (objective === "regret") return cvar >= 0 ? `${start}, it returns ${number(cvar)} more on average than what was shown.` : `${start}, it falls ${number(-cvar)} short of what was shown on average.`;
  return `${start}, the return is ${number(cvar)} on average.`;
}

/** What a policy brings as a rule. */
export function asARule(of, objective, alpha) {
  const rest = percent(alpha), least = of.value_at_risk;
  if (least === null || alpha === null) return "";
  if (objective === "evd") return `In the other ${rest} it loses at most ${number(-least)}.`;
  if (objective === "regret") return least >= 0 ? `In the other ${rest} it returns at least ${number(least)} more.` : `In the other ${rest} it falls at most ${number(-least)} short.`;
  return `In the other ${rest} it is at least ${number(least)}.`;
}
