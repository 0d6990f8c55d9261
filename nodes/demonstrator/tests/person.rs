//! Claims about the simulated person's choices.

use demonstrator::{Answer, GRID_SIDE, Noise, Person, Settings, true_error_m};
use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
use scene::{Field, Grid, Object, Point, Rbf, Scene, Shape, best_placement};

fn object(id: &str, x: f64, y: f64, radius_m: f64) -> Object {
    Object {
        id: id.to_owned(),
        label: id.to_owned(),
        shape: Shape::Cylinder { radius_m, height_m: 0.1 },
        position_m: Point::new(x, y),
        yaw_rad: 0.0,
        supports: false,
    }
}

fn flowers() -> Scene {
    Scene {
        id: "flowers".to_owned(),
        frame: "table".to_owned(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![
            object("plate_1", 0.25, 0.75, 0.06),
            object("plate_2", 0.75, 0.75, 0.06),
            object("cup_1", 0.25, 0.25, 0.05),
            object("cup_2", 0.75, 0.25, 0.05),
        ],
        target: object("vase", 0.0, 0.0, 0.04),
    }
}

fn taste() -> Settings {
    Settings {
        reward_names: ["plate_1", "plate_2", "cup_1", "cup_2", "table centre"].map(String::from).to_vec(),
        reward_weights: vec![-0.1, -0.1, -0.1, -0.1, 0.6],
        ..Settings::default()
    }
}

fn best_m(settings: &Settings, scene: &Scene) -> Point {
    let rbf = Rbf::new(scene);
    let field = Field::new(&rbf, &Grid::midpoints(GRID_SIDE), Some(scene));
    let w = Person::new(settings).weights(scene);
    let best = best_placement(scene, &rbf, &field, &w, &mut Vec::new()).expect("a free place");
    scene.metres(best.at)
}

fn placed(answer: Answer) -> Point {
    match answer {
        Answer::Place(at_m) => at_m,
        other => panic!("expected a placement, got {other:?}"),
    }
}

#[test]
fn without_noise_the_vase_goes_to_the_centre_of_the_symmetric_table() {
    let person = Person::new(&taste());
    let at_m = placed(person.answer("q", &flowers()).expect("a sound scene"));
    assert!(at_m.distance(Point::new(0.5, 0.5)) < 1e-6, "{at_m:?}");
    assert!(true_error_m(&person, &flowers(), Point::new(0.5, 0.6)).is_some_and(|m| (m - 0.1).abs() < 1e-6));
}

proptest! {
    #[test]
    fn without_noise_the_answer_is_the_best_placement(x in 0.1..0.9_f64, y in 0.1..0.9_f64, which in 0..4_usize) {
        let mut scene = flowers();
        scene.objects[which].position_m = Point::new(x, y);
        let answer = Person::new(&taste()).answer("q", &scene).expect("a sound scene");
        prop_assert_eq!(placed(answer), best_m(&taste(), &scene));
    }

    #[test]
    fn the_same_seed_and_question_give_the_same_answer_and_the_place_is_free(seed in 0..1000_i64, question in "[a-z]{1,8}") {
        let settings = Settings {
            seed, noise: Noise::Boltzmann, beta: 5.0, mistake_rate: 0.2, skip_rate: 0.1, cant_tell_rate: 0.1, ..taste()
        };
        let scene = flowers();
        let answer = Person::new(&settings).answer(&question, &scene).expect("a sound scene");
        prop_assert_eq!(&answer, &Person::new(&settings).answer(&question, &scene).expect("a sound scene"));
        if let Answer::Place(at_m) = answer {
            prop_assert!(scene.occupied().is_free(at_m));
        }
    }
}

/// The table is almost filled by one box, so only some cells along its edges are free; over many questions each of
/// them must come up as often as exp(β·R) says (χ² over the cells that are expected at least five times).
#[test]
fn boltzmann_choices_come_up_as_often_as_their_rewards_say() {
    let mut scene = flowers();
    scene.objects.truncate(1);
    scene.objects[0].shape = Shape::Box { width_m: 0.86, depth_m: 1.0, height_m: 0.1 };
    scene.objects[0].position_m = Point::new(0.43, 0.5);
    let settings = Settings {
        noise: Noise::Boltzmann,
        beta: 6.0,
        reward_names: vec!["table centre".to_owned()],
        reward_weights: vec![1.0],
        ..Settings::default()
    };
    let person = Person::new(&settings);
    let rbf = Rbf::new(&scene);
    let field = Field::new(&rbf, &Grid::midpoints(GRID_SIDE), Some(&scene));
    assert!((20..400).contains(&field.n_free()), "{}", field.n_free());
    let mut expected = vec![0.0; field.grid().n()];
    field.rewards(&person.weights(&scene), &mut expected);
    for (mass, free) in expected.iter_mut().zip(field.free()) {
        *mass = if *free { (6.0 * *mass).exp() } else { 0.0 };
    }
    let total: f64 = expected.iter().sum();
    let n = 4000;
    let mut seen = vec![0.0; field.grid().n()];
    for question in 0..n {
        let at = scene.normalised(placed(person.answer(&format!("q{question}"), &scene).expect("a sound scene")));
        let side = GRID_SIDE as f64;
        seen[(at.y * side) as usize * GRID_SIDE + (at.x * side) as usize] += 1.0;
    }
    let (mut chi_squared, mut cells) = (0.0, 0.0);
    for (seen, mass) in seen.iter().zip(&expected) {
        let expected = mass / total * f64::from(n);
        assert!(expected > 0.0 || *seen == 0.0, "an occupied cell was chosen");
        if expected >= 5.0 {
            chi_squared += (seen - expected).powi(2) / expected;
            cells += 1.0;
        }
    }
    // Mean `cells`, variance 2·`cells`: five standard deviations.
    assert!(chi_squared < cells + 5.0 * (2.0_f64 * cells).sqrt(), "χ² = {chi_squared} over {cells} cells");
}

#[test]
fn moods_come_up_as_often_as_their_rates() {
    let settings = Settings { skip_rate: 0.3, cant_tell_rate: 0.2, mistake_rate: 0.25, ..taste() };
    let (person, scene) = (Person::new(&settings), flowers());
    let best = best_m(&settings, &scene);
    let n = 1000;
    let mut count = [0.0; 4];
    for question in 0..n {
        let mood = match person.answer(&format!("q{question}"), &scene).expect("a sound scene") {
            Answer::Skip => 0,
            Answer::CantTell { .. } => 1,
            Answer::Place(at_m) if at_m == best => 3,
            Answer::Place(_) => 2,
        };
        count[mood] += 1.0 / f64::from(n);
    }
    for (share, wanted) in count.iter().zip([0.3, 0.2, 0.25, 0.25]) {
        // Three standard deviations of a share at n = 1000 are at most 0.048.
        assert!((share - wanted).abs() < 0.05, "{count:?}");
    }
}

#[test]
fn a_full_table_and_a_broken_scene_get_their_own_answers() {
    let mut scene = flowers();
    scene.objects[0].shape = Shape::Box { width_m: 2.0, depth_m: 2.0, height_m: 0.1 };
    scene.objects[0].position_m = Point::new(0.5, 0.5);
    let answer = Person::new(&taste()).answer("q", &scene).expect("a sound scene");
    assert_eq!(answer, Answer::CantTell { reason: "there is no free place on this table" });
    scene.objects[0].position_m = Point::new(f64::NAN, 0.5);
    assert!(Person::new(&taste()).answer("q", &scene).is_err());
}
