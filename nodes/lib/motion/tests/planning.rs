//! Ways through mazes of spheres: free all along, within limits, shorter than found, and the same for the same seed.

use motion::{Limits, Metric, NoPath, Path, Search, Space, connect, shorten, time};
use proptest::prelude::{ProptestConfig, Strategy, prop_assert, prop_assert_eq, proptest};
use proptest::{collection, prop_oneof};

/// A box of joints with spheres in it.
#[derive(Debug, Clone)]
struct Spheres {
    lower: Vec<f64>,
    upper: Vec<f64>,
    spheres: Vec<(Vec<f64>, f64)>,
}

impl Spheres {
    fn new(n_joints: usize, spheres: Vec<(Vec<f64>, f64)>) -> Self {
        Self { lower: vec![-1.0; n_joints], upper: vec![1.0; n_joints], spheres }
    }

    /// Distance from a segment to a centre: exact, so that what a planner claims can be checked against the truth.
    fn distance(a: &[f64], b: &[f64], centre: &[f64]) -> f64 {
        let d: Vec<f64> = a.iter().zip(b).map(|(a, b)| b - a).collect();
        let length: f64 = d.iter().map(|d| d * d).sum();
        let along: f64 = d.iter().zip(a).zip(centre).map(|((d, a), c)| d * (c - a)).sum();
        let t = if length > 0.0 { (along / length).clamp(0.0, 1.0) } else { 0.0 };
        a.iter().zip(&d).zip(centre).map(|((a, d), c)| (a + t * d - c).powi(2)).sum::<f64>().sqrt()
    }
}

impl Space for Spheres {
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn is_free(&mut self, q: &[f64]) -> bool {
        self.edge_is_free(q, q)
    }
    fn edge_is_free(&mut self, a: &[f64], b: &[f64]) -> bool {
        let inside = |q: &[f64]| q.iter().zip(&self.lower).zip(&self.upper).all(|((q, l), u)| l <= q && q <= u);
        inside(a) && inside(b) && self.spheres.iter().all(|(centre, radius)| Self::distance(a, b, centre) > *radius)
    }
}

fn mazes() -> impl Strategy<Value = (Spheres, Vec<f64>, Vec<f64>, u64)> {
    prop_oneof![proptest::strategy::Just(2_usize), proptest::strategy::Just(6)].prop_flat_map(|n| {
        let point = || collection::vec(-0.95..0.95_f64, n);
        (collection::vec((point(), 0.1..0.4_f64), 0..12), point(), point(), 0..1000_u64)
            .prop_map(move |(spheres, a, b, seed)| (Spheres::new(n, spheres), a, b, seed))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]
    #[test]
    fn what_is_found_is_free_within_limits_and_repeatable((mut space, start, goal, seed) in mazes()) {
        let n = start.len();
        let limits = Limits::new(vec![1.0; n], vec![4.0; n], vec![40.0; n]).expect("good");
        let metric = Metric::of_limits(&limits);
        let search = Search { samples: 2000, seed, ..Search::default() };
        let found = connect(&mut space, &metric, &start, std::slice::from_ref(&goal), &search);
        prop_assert_eq!(&found, &connect(&mut space, &metric, &start, std::slice::from_ref(&goal), &search));
        let path = match found {
            Ok(path) => path,
            Err(NoPath::StartBlocked) => { prop_assert!(!space.is_free(&start)); return Ok(()); }
            Err(NoPath::GoalsBlocked { .. }) => { prop_assert!(!space.is_free(&goal)); return Ok(()); }
            Err(NoPath::NotFound { .. }) => return Ok(()),
        };
        prop_assert!(path.start() == start && path.end() == goal);
        let is_free = |space: &mut Spheres, path: &Path| path.corners().windows(2).all(|e| space.edge_is_free(&e[0], &e[1]));
        prop_assert!(is_free(&mut space, &path));
        let short = shorten(&mut space, &metric, &path, 100, seed);
        prop_assert!(is_free(&mut space, &short));
        prop_assert!(short.length(&metric) <= path.length(&metric) + 1e-12);
        prop_assert!(short.start() == start && short.end() == goal);

        let trajectory = time(&mut space, &short, &limits, 0.005).expect("it can be timed");
        let points = &trajectory.points;
        let last = &points[points.len() - 1];
        prop_assert!(points[0].positions == start && last.positions == goal);
        prop_assert!(points[0].velocities.iter().chain(&last.velocities).all(|v| *v == 0.0));
        for pair in points.windows(2) {
            let dt = pair[1].time_from_start_s - pair[0].time_from_start_s;
            prop_assert!(dt > 0.0 && dt <= 0.005 + 1e-12);
            for i in 0..n {
                prop_assert!(pair[1].velocities[i].abs() <= 1.0 + 1e-6);
                prop_assert!(pair[1].accelerations[i].abs() <= 4.0 + 1e-6);
                // The means of jerk and of acceleration over the step are what the points say.
                let jerk = (pair[1].accelerations[i] - pair[0].accelerations[i]) / dt;
                prop_assert!(jerk.abs() <= 40.0 + 1e-4, "jerk {jerk}");
                let mean = 0.5 * (pair[0].velocities[i] + pair[1].velocities[i]);
                let moved = pair[1].positions[i] - pair[0].positions[i];
                // The trapezoid's error is jerk dt³ / 12.
                prop_assert!((moved - mean * dt).abs() <= 40.0 * dt.powi(3) / 12.0 + 1e-9);
            }
            // Chords of a blend that was checked along coarser chords: they differ by far less than a sphere.
            let clear = space.spheres.iter().all(|(c, r)| Spheres::distance(&pair[0].positions, &pair[1].positions, c) > r - 0.01);
            prop_assert!(clear);
        }
    }
}

/// A wall with one door: straight edges are blocked, the way exists.
fn wall() -> Spheres {
    let spheres =
        (-20..=20).map(|i| f64::from(i) * 0.05).filter(|y| (y - 0.8).abs() > 0.14).map(|y| (vec![0.0, y], 0.06));
    Spheres::new(2, spheres.collect())
}

#[test]
fn a_door_in_a_wall_is_found_and_a_wall_without_one_is_not_crossed() {
    let metric = Metric::even(2);
    let (start, goal) = (vec![-0.8, -0.8], vec![0.8, -0.8]);
    let path = connect(&mut wall(), &metric, &start, std::slice::from_ref(&goal), &Search::default()).expect("a door");
    let short = shorten(&mut wall(), &metric, &path, 200, 1);
    // Through (0, 0.72): 2 · hypot(0.8, 1.52) = 3.43.
    assert!(short.length(&metric) < 3.6, "{}", short.length(&metric));
    let mut closed = Spheres::new(2, (-21..=21).map(|i| (vec![0.0, f64::from(i) * 0.05], 0.06)).collect());
    let search = Search { samples: 500, ..Search::default() };
    assert_eq!(connect(&mut closed, &metric, &start, &[goal], &search), Err(NoPath::NotFound { samples: 500 }));
}

#[test]
fn the_nearest_free_goal_is_taken() {
    let mut space = Spheres::new(2, vec![(vec![0.5, 0.0], 0.2)]);
    let goals = [vec![0.5, 0.0], vec![-0.9, 0.9], vec![0.1, 0.1]];
    let path = connect(&mut space, &Metric::even(2), &[0.0, 0.0], &goals, &Search::default()).expect("free");
    assert_eq!(path.end(), goals[2]);
    let blocked = connect(&mut space, &Metric::even(2), &[0.0, 0.0], &goals[..1], &Search::default());
    assert_eq!(blocked, Err(NoPath::GoalsBlocked { goals: 1 }));
    let from_inside = connect(&mut space, &Metric::even(2), &goals[0], &goals, &Search::default());
    assert_eq!(from_inside, Err(NoPath::StartBlocked));
}

#[test]
fn rounding_corners_is_quicker_than_stopping_at_them() {
    let corners: Vec<Vec<f64>> =
        (0..8).map(|i| vec![f64::from(i) * 0.2 - 0.8, if i % 2 == 0 { 0.0 } else { 0.05 }]).collect();
    let path = Path::new(corners.clone()).expect("corners");
    let limits = Limits::new(vec![1.0; 2], vec![4.0; 2], vec![40.0; 2]).expect("good");
    let seconds = |space: &mut Spheres, path: &Path| time(space, path, &limits, 0.01).expect("timed").seconds();
    let mut free = Spheres::new(2, Vec::new());
    let rounded = seconds(&mut free, &path);
    let stopping: f64 =
        corners.windows(2).map(|edge| seconds(&mut free, &Path::new(edge.to_vec()).expect("an edge"))).sum();
    assert!(rounded < 0.6 * stopping, "{rounded} against {stopping}");
}

#[test]
fn standing_still_and_going_back_are_motions_too() {
    let limits = Limits::new(vec![1.0; 2], vec![4.0; 2], vec![40.0; 2]).expect("good");
    let mut free = Spheres::new(2, Vec::new());
    let still = Path::new(vec![vec![0.1, 0.2]; 3]).expect("corners");
    let trajectory = time(&mut free, &still, &limits, 0.01).expect("timed");
    assert_eq!((trajectory.points.len(), trajectory.seconds()), (1, 0.0));
    // There and back: a corner of 180 degrees.
    let back = Path::new(vec![vec![0.0, 0.0], vec![0.5, 0.0], vec![0.0, 0.0]]).expect("corners");
    let trajectory = time(&mut free, &back, &limits, 0.01).expect("timed");
    assert!(
        trajectory.points.iter().all(|p| p.velocities[0].abs() <= 1.0 + 1e-9 && p.accelerations[0].abs() <= 4.0 + 1e-6)
    );
    assert!(time(&mut free, &back, &limits, 0.0).is_err());
    assert!(time(&mut free, &back, &Limits::new(vec![1.0], vec![1.0], vec![1.0]).expect("good"), 0.01).is_err());
}
