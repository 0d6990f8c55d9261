//! Figure 7.4: policies of Maximum Entropy IRL, LPAL and BROIL after one ambiguous demonstration.

use crate::chapter7::{
    Compared, Corridor, Judged, POLICIES, Posterior, compare, demonstration_grid, grid, lambdas, legend,
};
use crate::harness::plot::{Content, Picture};
use crate::harness::{Claim, Estimate, Options, Outcome, ReproductionError, TextTable, replicates, to_value};
use picture::{GridPicture, policy_grids};

/// Policies whose probabilities differ by less than this everywhere are the same.
const SAME: f64 = 1e-3;

/// Makes the figure.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(100)?;
    let corridor = Corridor::new()?;
    let both = replicates("fig-7.4", n, options.threads, |replicate| {
        let with = |posterior| compare(&corridor, posterior, options.seed, replicate);
        Ok::<_, ReproductionError>([with(Posterior::Published)?, with(Posterior::Ours)?])
    })?;
    let published: Vec<&Compared> = both.iter().map(|pair| &pair[0]).collect();
    let ours: Vec<&Compared> = both.iter().map(|pair| &pair[1]).collect();
    let mut claims = claims(&published, "as published", Claim::matched);
    claims.extend(claims_of_ours(&ours));
    Ok(Outcome {
        name: "fig-7.4",
        title: "policies after one ambiguous demonstration",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "a replicate is a sample of the posterior; the dissertation has one. 3 × 5 cells, γ = .99 as in the author's program, every cell a start".into(),
            "as published: a walk of 2,000 steps on the L2 sphere, σ = .2, β = 10, the first 500 left out, every fifth kept; ours: 2,000 draws in four chains".into(),
            "an arrow has the area of its probability; the picture is of the first replicate as published".into(),
        ],
        tables: vec![red_table(&published, &ours), distinct_table(&published[0].regret)],
        claims,
        picture: picture(&corridor, published[0])?,
        data: to_value(&both),
    })
}

fn red_table(published: &[&Compared], ours: &[&Compared]) -> TextTable {
    let mut table =
        TextTable::new("Share of visits in red cells, mean ± s.e. over samples", &["policy", "as published", "ours"]);
    for (i, name) in POLICIES.iter().enumerate() {
        let red = |all: &[&Compared]| Estimate::of(&all.iter().map(|c| c.policies[i].red).collect::<Vec<f64>>()).text();
        table.row(*name, [red(published), red(ours)]);
    }
    table
}

/// Runs of λ with the same policy: (first λ, last λ, policy).
fn distinct(policies: &[Judged]) -> Vec<(f64, f64, &Judged)> {
    let mut runs: Vec<(f64, f64, &Judged)> = vec![];
    for (lambda, policy) in lambdas().into_iter().zip(policies) {
        let same = |known: &Judged| known.policy.iter().zip(&policy.policy).all(|(p, q)| (p - q).abs() < SAME);
        match runs.last_mut() {
            Some((_, last, known)) if same(known) => *last = lambda,
            _ => runs.push((lambda, lambda, policy)),
        }
    }
    runs
}

fn distinct_table(policies: &[Judged]) -> TextTable {
    let mut table = TextTable::new(
        "Different policies of BROIL regret as published, first replicate",
        &["λ", "red visits", "mean return", "CVaR of the regret", "cells that go down into red"],
    );
    for (first, last, policy) in distinct(policies) {
        let down: Vec<String> = (1..=4).filter(|cell| policy.enters_red(*cell)).map(|cell| cell.to_string()).collect();
        table.row(
            format!("{first} to {last}"),
            [
                format!("{:.3}", policy.red),
                format!("{:.3}", policy.chosen_by[0]),
                format!("{:.3}", policy.chosen_by[2]),
                if down.is_empty() { "none".into() } else { down.join(", ") },
            ],
        );
    }
    table
}

type Make = fn(String, bool, String) -> Claim;

/// What the dissertation sees in its one sample is to be seen in most.
fn claims(all: &[&Compared], whose: &str, make: Make) -> Vec<Claim> {
    let n = all.len();
    let most = |claim: &str, holds: &dyn Fn(&Compared) -> bool| {
        let held = all.iter().filter(|c| holds(c)).count();
        make(format!("{whose}: {claim}"), 2 * held > n, format!("in {held} of {n} samples"))
    };
    let down = |policy: &Judged, cells: &[usize]| cells.iter().all(|cell| policy.enters_red(*cell));
    vec![
        most("Maximum Entropy IRL is stochastic", &|c| c.policies[0].is_stochastic()),
        most("LPAL is stochastic and never goes down into red", &|c| {
            c.policies[1].is_stochastic() && (1..=4).all(|cell| !c.policies[1].enters_red(cell))
        }),
        most("robust, λ = 0: through the far right red cell only, from the cell above it", &|c| {
            let policy = &c.policies[2];
            down(policy, &[4]) && (1..=3).all(|cell| !policy.enters_red(cell))
        }),
        most("regret, λ = 0: avoids red, every cell above goes around", &|c| c.policies[3].goes_around()),
        most("λ = 1: takes a short cut through red", &|c| (1..=4).any(|cell| c.policies[4].enters_red(cell))),
        most("regret has at least three different policies over λ", &|c| distinct(&c.regret).len() >= 3),
    ]
}

fn claims_of_ours(ours: &[&Compared]) -> Vec<Claim> {
    let n = ours.len();
    let mut claims = claims(ours, "ours", Claim::matched);
    let optimal = ours.iter().filter(|c| c.all_optimal).count();
    let gap = ours.iter().map(|c| c.largest_gap).fold(0.0, f64::max);
    claims.push(Claim::beaten(
        "ours: each of the 42 policies of a sample is proved optimal",
        optimal == n,
        format!("in {optimal} of {n} samples, largest gap {gap:.0e} of the returns"),
    ));
    claims
}

fn picture(corridor: &Corridor, compared: &Compared) -> Result<Picture, ReproductionError> {
    let mdp = &corridor.mdp;
    let detail = |policy: &Judged| format!("mean {:.2}, {:.0} % in red", policy.chosen_by[0], 100.0 * policy.red);
    let one = |policy: &Judged, caption: &str| grid(mdp, policy, caption, detail(policy));
    let [entropy, lpal, robust, _, neutral] = &compared.policies[..] else {
        return Err(ReproductionError::UnknownFigure { name: "fig-7.4".into() });
    };
    let mut grids: Vec<GridPicture> = vec![
        demonstration_grid(mdp),
        one(entropy, "Maximum Entropy IRL"),
        one(lpal, "LPAL"),
        one(robust, "BROIL robust, λ = 0"),
    ];
    let runs = distinct(&compared.regret);
    // As many as there is room for, those between spread evenly.
    let last = runs.len() - 1;
    let chosen: Vec<usize> = if last < 3 { (0..last).collect() } else { vec![0, last / 3, 2 * last / 3] };
    for i in chosen {
        let (first, _, policy) = runs[i];
        grids.push(one(policy, &format!("BROIL regret, λ = {first}")));
    }
    grids.push(one(neutral, "BROIL, λ = 1"));
    let drawn = policy_grids("Figure 7.4: policies after one demonstration (as published)", &grids, &legend())?;
    Ok(Picture { title: "Figure 7.4".into(), content: Content::Drawn(drawn) })
}
