//! The scenarios built in are the tasks of the dissertation's section 8.2.4.

use bringup::{BUILT_IN, Scenario, Subject};
use scene::{Field, Grid, Object, Point, Rbf, Scene, Shape, best_placement};
use serde_json::Value;

struct Task {
    scene: Scene,
    weights: Vec<f64>,
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().map(|list| list.iter().map(|v| v.as_f64().expect("a number")).collect()).unwrap_or_default()
}

fn strings(value: &Value) -> Vec<String> {
    value.as_array().expect("a list").iter().map(|v| v.as_str().expect("a string").to_owned()).collect()
}

fn shape(name: &str, size_m: &[f64]) -> Shape {
    match name {
        "cylinder" => Shape::Cylinder { radius_m: 0.5 * size_m[0], height_m: size_m[2] },
        _ => Shape::Box { width_m: size_m[0], depth_m: size_m[1], height_m: size_m[2] },
    }
}

fn task(name: &str) -> Task {
    let scenario = Scenario::find(name).expect("built in");
    let file: Value = serde_saphyr::from_str(&scenario.text).expect("YAML");
    let of = |node: &str| file[format!("/**/{node}")]["ros__parameters"].clone();
    let (table, person) = (of("simulated_table"), of("demonstrator"));
    let (ids, shapes, labels) =
        (strings(&table["object_ids"]), strings(&table["object_shapes"]), strings(&table["object_labels"]));
    let (sizes, at, yaws) =
        (numbers(&table["object_sizes_m"]), numbers(&table["object_positions_m"]), numbers(&table["object_yaws_rad"]));
    let objects = ids.iter().enumerate().map(|(i, id)| Object {
        id: id.clone(),
        label: labels[i].clone(),
        shape: shape(&shapes[i], &sizes[3 * i..]),
        position_m: Point::new(at[2 * i], at[2 * i + 1]),
        yaw_rad: yaws.get(i).copied().unwrap_or(0.0),
        supports: table["object_supports"][i].as_bool().unwrap_or(false),
    });
    let scene = Scene {
        id: name.to_owned(),
        frame: "table".to_owned(),
        width_m: table["table_width_m"].as_f64().expect("a number"),
        depth_m: table["table_depth_m"].as_f64().expect("a number"),
        objects: objects.collect(),
        target: Object {
            id: "target".to_owned(),
            label: "target".to_owned(),
            shape: shape(table["target_shape"].as_str().expect("a shape"), &numbers(&table["target_size_m"])),
            position_m: Point::default(),
            yaw_rad: 0.0,
            supports: false,
        },
    };
    scene.check().expect("a sound scene");
    let (rewarded, values) = (strings(&person["reward_names"]), numbers(&person["reward_weights"]));
    let names = Rbf::names(&scene);
    assert!(rewarded.iter().all(|name| names.contains(name)), "{rewarded:?} against {names:?}");
    let weight = |name: &String| rewarded.iter().position(|known| known == name).map_or(0.0, |i| values[i]);
    Task { weights: names.iter().map(weight).collect(), scene }
}

fn best(task: &Task) -> Point {
    let rbf = Rbf::new(&task.scene);
    let field = Field::new(&rbf, &Grid::midpoints(64), Some(&task.scene));
    let best = best_placement(&task.scene, &rbf, &field, &task.weights, &mut Vec::new()).expect("a free place");
    task.scene.metres(best.at)
}

/// Values of the author's program (method notes, section 5).
#[test]
fn the_reward_of_flowers_is_the_authors() {
    let task = task("flowers");
    let rbf = Rbf::new(&task.scene);
    assert_eq!((task.scene.objects.len(), task.scene.width_m, task.scene.depth_m), (4, 1.0, 1.0));
    assert!((rbf.reward(&task.weights, Point::new(0.5, 0.5)) - 0.336_303_75).abs() < 1e-8);
    assert!((rbf.reward(&task.weights, Point::new(0.2, 0.3)) - 0.185_411_08).abs() < 1e-8);
    assert!(best(&task).distance(Point::new(0.5, 0.5)) < 1e-6);
}

#[test]
fn the_spoon_belongs_on_the_bowl() {
    let task = task("spoon");
    assert_eq!(task.scene.objects.len(), 6);
    let bowl = task.scene.objects.iter().find(|object| object.id == "bowl").expect("a bowl");
    assert!(bowl.supports);
    assert!(best(&task).distance(bowl.position_m) < 1e-6);
}

#[test]
fn nothing_on_a_table_overlaps_or_sticks_out() {
    for (name, _) in BUILT_IN.iter().filter(|(_, text)| Subject::of(text) == Subject::Table) {
        let scene = task(name).scene;
        for (i, object) in scene.objects.iter().enumerate() {
            let radius_m = object.shape.bounding_radius_m();
            let at = object.position_m;
            let inside = |v: f64, extent: f64| v >= radius_m && v <= extent - radius_m;
            assert!(inside(at.x, scene.width_m) && inside(at.y, scene.depth_m), "{name}: {} sticks out", object.id);
            for other in &scene.objects[..i] {
                let gap = other.position_m.distance(at) - radius_m - other.shape.bounding_radius_m();
                assert!(gap > 0.01, "{name}: {} and {} are {gap} m apart", object.id, other.id);
            }
        }
    }
}
