//! Which place is taken, by each choice, where paper and pencil say which; and what is told of the others.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{TABLE_ARM, flowers, home, object, posterior};
use placement::{Choice, LossBatch, MotionSettings, PlacementPlan, PlanOutcome, Planner, Verdict};
use scene::{Point, Scene};

/// Three supporting things in a row; the draws want one each, in the given numbers.
fn row(wanted: [usize; 3]) -> (Scene, Vec<f32>, Vec<f64>) {
    let mut scene = flowers();
    scene.objects = vec![object("a", 0.2, 0.5), object("b", 0.5, 0.5), object("c", 0.8, 0.5)];
    for object in &mut scene.objects {
        object.supports = true;
    }
    let mut draws = Vec::new();
    for (thing, &n) in wanted.iter().enumerate() {
        for _ in 0..n {
            let mut draw = [0.0_f32; 12];
            draw[thing] = 1.0;
            draws.extend(draw);
        }
    }
    let mut map = vec![0.0; 12];
    map[2] = 1.0;
    (scene, draws, map)
}

fn plan(choice: Choice, alpha: f64, (scene, draws, map): &(Scene, Vec<f32>, Vec<f64>), robot: bool) -> PlacementPlan {
    let mut planner = Planner::new(MotionSettings { choice, ..MotionSettings::default() });
    if robot {
        planner.set_robot(TABLE_ARM).unwrap();
    }
    let batch = LossBatch { draws, n_features: map.len(), map_weights: map, threads: 1 };
    planner.plan(scene, &batch, alpha, &home())
}

fn place(choice: Choice, alpha: f64, case: &(Scene, Vec<f32>, Vec<f64>)) -> Point {
    plan(choice, alpha, case, false).robust_placement_m.unwrap()
}

#[test]
fn each_choice_takes_the_place_that_its_name_says() {
    // 45 want a at 0.2, 10 want b at 0.5, 45 want c at 0.8; the MAP weights want c.
    let case = row([45, 10, 45]);
    let (a, b, c) = (Point::new(0.2, 0.5), Point::new(0.5, 0.5), Point::new(0.8, 0.5));
    assert!(place(Choice::Map, 0.9, &case).distance(c) < 1e-6);
    // The worst tenth is 0.6 m off at a or c, 0.3 m in the middle, and more anywhere else.
    assert!(place(Choice::Cvar, 0.9, &case).distance(b) < 2e-3);
    assert!(place(Choice::Var, 0.9, &case).distance(b) < 2e-3);
    // 45 of 100 lie at c as at a: equals; the MAP placement comes first among equals.
    assert!(place(Choice::MostLikely, 0.9, &case).distance(c) < 0.03);
    // 60 of 100 want a: most likely, and no farther than 0 with probability 0.6.
    let case = row([60, 30, 10]);
    assert!(place(Choice::MostLikely, 0.9, &case).distance(a) < 0.03);
    let var = plan(Choice::Var, 0.6, &case, false);
    assert!(var.robust_placement_m.unwrap().distance(a) < 1e-3, "{:?}", var.robust_placement_m);
    // σ² = 0.3: the hills of a and b, 0.3 m apart, melt into one whose top is between them, nearer to a.
    let mean = place(Choice::Mean, 0.9, &case);
    let reward = |x: f64| {
        let hill = |centre: f64| (-(x - centre) * (x - centre) / 0.3_f64).exp();
        0.6 * hill(0.2) + 0.3 * hill(0.5) + 0.1 * hill(0.8)
    };
    let top = (0..=10_000).map(|i| f64::from(i) / 1e4).max_by(|x, y| reward(*x).total_cmp(&reward(*y))).unwrap();
    assert!(mean.distance(Point::new(top, 0.5)) < 2e-3, "{mean:?} {top}");
}

#[test]
fn candidates_are_told_with_their_figures_apart_and_in_order() {
    let case = row([60, 30, 10]);
    let told = plan(Choice::Cvar, 0.9, &case, false);
    let best = &told.candidates[0];
    assert_eq!(best.at_m, told.robust_placement_m.unwrap());
    assert!((best.cvar_m - told.robust_cvar_m).abs() < 1e-12);
    assert!(told.candidates.len() > 2);
    for pair in told.candidates.windows(2) {
        assert!(pair[0].cvar_m <= pair[1].cvar_m);
    }
    for (i, one) in told.candidates.iter().enumerate() {
        assert!(one.var_m <= one.cvar_m + 1e-12 && (0.0..=1.0).contains(&one.probability_best));
        // The things carry the target; the nearest obstacle is an edge.
        let edge = one.at_m.x.min(1.0 - one.at_m.x).min(one.at_m.y).min(1.0 - one.at_m.y);
        assert!((one.clearance_m - (edge - 0.05)).abs() < 1e-12);
        assert!(told.candidates[..i].iter().all(|other| other.at_m.distance(one.at_m) >= 0.1));
        assert_eq!(one.verdict, Verdict::NextBest, "without a robot nothing is taken or refused");
    }
}

#[test]
fn better_places_out_of_reach_are_told_too() {
    // Only the far right corner counts, where the arm cannot go.
    let (_, mut map) = posterior(1, 0.0, 1);
    map.fill(0.0);
    map[4 + 2] = 1.0;
    let draws: Vec<f32> = map.iter().map(|&w| w as f32).collect();
    let told = plan(Choice::Cvar, 0.9, &(flowers(), draws, map), true);
    assert_eq!(told.outcome, PlanOutcome::Planned, "{}", told.reason);
    let verdicts: Vec<Verdict> = told.candidates.iter().map(|one| one.verdict).collect();
    assert_eq!(verdicts[0], Verdict::Unreachable, "{verdicts:?}");
    assert_eq!(verdicts.iter().filter(|verdict| **verdict == Verdict::Chosen).count(), 1);
    let chosen = told.candidates.iter().find(|one| one.verdict == Verdict::Chosen).unwrap();
    assert_eq!(Some(chosen.at_m), told.robust_placement_m);
    let before = told.candidates.iter().take_while(|one| one.verdict != Verdict::Chosen);
    assert!(before.clone().all(|one| one.reason == "out of the arm's reach" && one.cvar_m <= chosen.cvar_m));
}

#[test]
fn names_of_choices_are_read_and_others_refused() {
    for (name, choice) in Choice::ALL {
        assert_eq!((name.parse(), choice.name()), (Ok(choice), name));
    }
    let error = "best".parse::<Choice>().unwrap_err();
    assert_eq!(error, "choice is 'best'; one of map, mean, var, cvar, most_likely is needed");
}
