//! The two tables of figure 8.6 (those of config/flowers.yaml and config/spoon.yaml) and the person who lays them.

use mdp::random::uniform;
use rand_chacha::ChaCha8Rng;
use scene::{Field, Grid, Object, Point, Rbf, Scene, Shape, best_placement};

/// Cells a side on which the person looks for the best place.
const SIDE: usize = 64;

/// A task.
#[derive(Debug, Clone)]
pub struct Task {
    /// Name.
    pub name: &'static str,
    /// The table of the first demonstration.
    pub scene: Scene,
    /// True weights: objects, then the nine fixed centres.
    pub weights: Vec<f64>,
}

/// A vase that belongs in the middle of the table, clear of four dishes.
pub fn flowers() -> Task {
    let disc = |radius_m, height_m| Shape::Cylinder { radius_m, height_m };
    let objects = vec![
        object("left plate", 0.25, 0.75, disc(0.06, 0.02)),
        object("right plate", 0.75, 0.75, disc(0.06, 0.02)),
        object("left cup", 0.25, 0.25, disc(0.05, 0.09)),
        object("right cup", 0.75, 0.25, disc(0.05, 0.09)),
    ];
    let scene = table("flowers", objects, object("vase", 0.0, 0.0, disc(0.04, 0.2)));
    // The fifth fixed centre is the table's.
    let weights = [vec![-0.1; 4], vec![0.0; 4], vec![0.6], vec![0.0; 4]].concat();
    Task { name: "flowers", scene, weights }
}

/// A spoon that belongs on the bowl, wherever it stands among five other things.
pub fn spoon() -> Task {
    let disc = |radius_m, height_m| Shape::Cylinder { radius_m, height_m };
    let block = |width_m, depth_m, height_m| Shape::Box { width_m, depth_m, height_m };
    let mut objects = vec![
        object("bowl", 0.62, 0.58, disc(0.07, 0.06)),
        object("plate", 0.28, 0.70, disc(0.1, 0.02)),
        object("cup", 0.80, 0.80, disc(0.04, 0.09)),
        object("glass", 0.52, 0.86, disc(0.035, 0.14)),
        object("fork rest", 0.20, 0.30, block(0.10, 0.04, 0.02)),
        object("napkin", 0.72, 0.24, block(0.12, 0.12, 0.01)),
    ];
    objects[0].supports = true;
    (objects[4].yaw_rad, objects[5].yaw_rad) = (0.4, 0.2);
    let scene = table("spoon", objects, object("spoon", 0.0, 0.0, disc(0.03, 0.03)));
    let weights = [vec![1.0], vec![0.0; 14]].concat();
    Task { name: "spoon", scene, weights }
}

fn table(id: &str, objects: Vec<Object>, target: Object) -> Scene {
    Scene { id: id.into(), frame: "table".into(), width_m: 1.0, depth_m: 1.0, objects, target }
}

fn object(id: &str, x: f64, y: f64, shape: Shape) -> Object {
    Object { id: id.into(), label: id.into(), shape, position_m: Point::new(x, y), yaw_rad: 0.0, supports: false }
}

impl Task {
    /// Where the person puts the target, metres; `None` where it fits nowhere.
    pub fn best_m(&self, scene: &Scene) -> Option<Point> {
        let rbf = Rbf::new(scene);
        let field = Field::new(&rbf, &Grid::midpoints(SIDE), Some(scene));
        let best = best_placement(scene, &rbf, &field, &self.weights, &mut Vec::new())?;
        Some(scene.metres(best.at))
    }

    /// `n` tables with every object redrawn, whole on the table and clear of each other, on which the target has a place.
    pub fn redrawn(&self, n: usize, rng: &mut ChaCha8Rng) -> Vec<Scene> {
        let mut tables = Vec::with_capacity(n);
        while tables.len() < n {
            let mut scene = Scene { id: format!("test {}", tables.len()), ..self.scene.clone() };
            for object in &mut scene.objects {
                let r = object.shape.bounding_radius_m();
                let mut along = |extent_m: f64| r + (extent_m - 2.0 * r) * uniform(rng);
                object.position_m = Point::new(along(self.scene.width_m), along(self.scene.depth_m));
            }
            let clear = scene.objects.iter().enumerate().all(|(i, a)| {
                let r = a.shape.bounding_radius_m();
                scene.objects.iter().skip(i + 1).all(|b| b.distance_m(a.position_m) > r)
            });
            if clear && self.best_m(&scene).is_some() {
                tables.push(scene);
            }
        }
        tables
    }
}
