//! Figure 7.5: sorted return distributions over the posterior, and the frontier of BROIL regret.

use crate::chapter7::{Compared, Corridor, Judged, POLICIES, Posterior, compare, quantiles};
use crate::harness::plot::{Content, Picture};
use crate::harness::{Claim, Estimate, Options, Outcome, ReproductionError, TextTable, replicates, to_value};
use picture::{Chart, Line, Mark, Stroke, charts};
use robust::OutOfSample;

/// Makes the figure.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(100)?;
    let corridor = Corridor::new()?;
    let both = replicates("fig-7.5", n, options.threads, |replicate| {
        let with = |posterior| compare(&corridor, posterior, options.seed, replicate);
        Ok::<_, ReproductionError>([with(Posterior::Published)?, with(Posterior::Ours)?])
    })?;
    let published: Vec<&Compared> = both.iter().map(|pair| &pair[0]).collect();
    let ours: Vec<&Compared> = both.iter().map(|pair| &pair[1]).collect();
    let mut claims = claims(&published, "as published");
    claims.extend(claims_of_ours(&published, &ours, options.seed));
    Ok(Outcome {
        name: "fig-7.5",
        title: "return distributions over the posterior, and the frontier of BROIL regret",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "samples and policies as in figure 7.4; α = .95".into(),
            "fresh: 20,000 other draws of the same posterior, in four chains; intervals by a bootstrap over blocks"
                .into(),
            "ours: in some samples a chain's first draws after the warm-up are still where it began, 700 nats below the mode; such draws, not the posterior, are what lowers the CVaRs that ours is chosen by below the fresh ones".into(),
            "the demonstration's return is that of its one trajectory, policies start everywhere".into(),
        ],
        tables: vec![
            table("as published (300 draws of the walk)", &published),
            table("ours (2,000 draws)", &ours),
            intervals(&corridor, ours[0], options.seed)?,
        ],
        claims,
        picture: picture(&corridor, published[0])?,
        data: to_value(&both),
    })
}

fn table(whose: &str, all: &[&Compared]) -> TextTable {
    let head = ["policy", "mean return", "CVaR of the return", "fresh", "CVaR of the regret", "fresh"];
    let mut table = TextTable::new(format!("{whose}: mean ± s.e. over samples"), &head);
    for (i, name) in POLICIES.iter().enumerate() {
        let of = |f: &dyn Fn(&Judged) -> f64| {
            Estimate::of(&all.iter().map(|c| f(&c.policies[i])).collect::<Vec<f64>>()).text()
        };
        table.row(
            *name,
            [
                of(&|p| p.chosen_by[0]),
                of(&|p| p.chosen_by[1]),
                of(&|p| p.fresh[1]),
                of(&|p| p.chosen_by[2]),
                of(&|p| p.fresh[2]),
            ],
        );
    }
    table
}

/// Fresh CVaR with its interval, of the first replicate.
fn intervals(corridor: &Corridor, compared: &Compared, seed: u64) -> Result<TextTable, ReproductionError> {
    let head = ["policy", "CVaR of the return", "CVaR of the regret", "effective draws"];
    let mut table = TextTable::new("ours, first replicate: CVaR by 20,000 fresh draws with its 95 % interval", &head);
    let text = |tail: &OutOfSample| {
        format!("{:.3} [{:.3}, {:.3}]", tail.conditional_value_at_risk, tail.interval[0], tail.interval[1])
    };
    for (name, policy) in POLICIES.iter().zip(&compared.policies) {
        let tail = |regret| corridor.fresh_tail(policy, regret, seed, 0);
        let (returns, regrets) = (tail(false)?, tail(true)?);
        table.row(*name, [text(&returns), text(&regrets), format!("{:.0}", returns.effective_size)]);
    }
    Ok(table)
}

/// Whether some point of a frontier is at least as good in both.
fn dominates(frontier: &[Judged], other: &Judged, of: fn(&Judged) -> [f64; 2]) -> bool {
    let [mean, cvar] = of(other);
    frontier.iter().map(of).any(|[m, c]| m >= mean - 1e-9 && c >= cvar - 1e-9 && (m > mean + 1e-9 || c > cvar + 1e-9))
}

fn claims(all: &[&Compared], whose: &str) -> Vec<Claim> {
    let n = all.len();
    let every = |claim: String, holds: &dyn Fn(&Compared) -> bool| {
        let held = all.iter().filter(|c| holds(c)).count();
        Claim::matched(format!("{whose}: {claim}"), held == n, format!("in {held} of {n} samples"))
    };
    let mut claims = vec![];
    for (place, name) in [(1, "LPAL"), (0, "Maximum Entropy IRL")] {
        for (how, of) in [
            ("", (|p| [p.chosen_by[0], p.chosen_by[2]]) as fn(&Judged) -> [f64; 2]),
            (", by fresh draws", (|p| [p.fresh[0], p.fresh[2]]) as fn(&Judged) -> [f64; 2]),
        ] {
            claims.push(every(format!("BROIL regret dominates {name} in mean and CVaR{how}"), &move |c| {
                dominates(&c.regret, &c.policies[place], of)
            }));
        }
    }
    let best = |c: &Compared, place: usize, tail: usize| {
        c.policies.iter().all(|p| p.chosen_by[tail] <= c.policies[place].chosen_by[tail] + 1e-9)
    };
    claims.push(every("robust has the largest CVaR of the return".into(), &|c| best(c, 2, 1)));
    claims.push(every("regret has the largest CVaR of the regret".into(), &|c| best(c, 3, 2)));
    claims
}

fn claims_of_ours(published: &[&Compared], ours: &[&Compared], seed: u64) -> Vec<Claim> {
    let mut all = claims(ours, "ours");
    // Both are judged by the same fresh draws.
    for (place, tail, what) in
        [(2, 1, "robust, λ = 0: fresh CVaR of the return"), (3, 2, "regret, λ = 0: fresh CVaR of the regret")]
    {
        let differences: Vec<f64> = published
            .iter()
            .zip(ours)
            .map(|(theirs, ours)| theirs.policies[place].fresh[tail] - ours.policies[place].fresh[tail])
            .collect();
        all.push(Claim::smaller(format!("{what}: the published one's is below ours"), &differences, seed));
    }
    all
}

fn picture(corridor: &Corridor, compared: &Compared) -> Result<Picture, ReproductionError> {
    let names = [(0, 1), (1, 2), (2, 0), (3, 3)];
    let mut panels = vec![vec![], vec![]];
    for (i, colour) in names {
        let values = corridor.returns(&compared.policies[i].feature_counts, &compared.draws)?;
        for (lines, values) in panels.iter_mut().zip(values) {
            let (label, points) = (POLICIES[i].to_owned(), quantiles(&values));
            lines.push(Line { label, colour, stroke: Stroke::Solid, points });
        }
    }
    let shown = corridor.returns(&corridor.expert, &compared.draws)?;
    for (lines, values) in panels.iter_mut().zip(shown) {
        let points = quantiles(&values);
        lines.push(Line { label: "demonstration".into(), colour: 6, stroke: Stroke::Dashed, points });
    }
    let at = |p: &Judged| (p.chosen_by[2], p.chosen_by[0]);
    let frontier: Vec<(f64, f64)> = compared.regret.iter().map(at).collect();
    let marks = vec![
        Mark { text: "λ = 0".into(), at: frontier[0] },
        Mark { text: "λ = 1".into(), at: frontier[frontier.len() - 1] },
    ];
    let mut lines =
        vec![Line { label: "BROIL regret over λ".into(), colour: 3, stroke: Stroke::Dotted, points: frontier }];
    for (i, colour) in [(0, 1), (1, 2)] {
        let points = vec![at(&compared.policies[i])];
        lines.push(Line { label: format!("{} (point)", POLICIES[i]), colour, stroke: Stroke::Crosses, points });
    }
    let mut panels = panels.into_iter();
    let mut sorted = |y: &str| Chart {
        x: "share of the posterior".into(),
        y: y.to_owned(),
        lines: panels.next().unwrap_or_default(),
        marks: vec![],
    };
    let drawn = charts(
        "Figure 7.5: returns over the posterior, first replicate as published (α = .95)",
        &[
            sorted("return, sorted"),
            sorted("return above the demonstration's, sorted"),
            Chart { x: "CVaR of the regret".into(), y: "mean return".into(), lines, marks },
        ],
    )?;
    Ok(Picture { title: "Figure 7.5".into(), content: Content::Drawn(drawn) })
}
