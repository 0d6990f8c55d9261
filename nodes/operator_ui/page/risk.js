// The risk of a policy in words.

import { RISK } from "./words.js";

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
  if (objective === "evd") return RISK.worst.evd(share, number(-cvar));
  if (objective === "regret") return cvar >= 0 ? RISK.worst.above(share, number(cvar)) : RISK.worst.below(share, number(-cvar));
  return RISK.worst.robust(share, number(cvar));
}

/** What a policy brings as a rule. */
export function asARule(of, objective, alpha) {
  const rest = percent(alpha), least = of.value_at_risk;
  if (least === null || alpha === null) return "";
  if (objective === "evd") return RISK.rule.evd(rest, number(-least));
  if (objective === "regret") return least >= 0 ? RISK.rule.above(rest, number(least)) : RISK.rule.below(rest, number(-least));
  return RISK.rule.robust(rest, number(least));
}
