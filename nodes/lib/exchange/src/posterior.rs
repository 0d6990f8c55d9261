//! Posteriors: whether one can be computed with, and which tables it speaks of.

use crate::MAX_WEIGHTS;
use apprentice_msgs::msg::Posterior;
use scene::{FIXED_CENTRES, Rbf, Scene};
use thiserror::Error;

/// Why a posterior cannot be computed with.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PosteriorError {
    /// No weights, or too many.
    #[error("it has {got} features; 1 to {MAX_WEIGHTS} are supported")]
    Features {
        /// Got.
        got: usize,
    },
    /// One MAP weight per feature.
    #[error("it has {expected} features but {got} MAP weights")]
    MapWeights {
        /// Features.
        expected: usize,
        /// Got.
        got: usize,
    },
    /// Equally long chains of one row per draw.
    #[error("{got} numbers are not {draws} draws of {features} weights in {chains} chains")]
    Draws {
        /// Numbers.
        got: usize,
        /// Draws announced.
        draws: usize,
        /// Weights per draw.
        features: usize,
        /// Chains announced.
        chains: usize,
    },
    /// Weights must be numbers.
    #[error("it holds weights that are not finite")]
    NotFinite,
}

/// Whether the parts of a posterior fit together and are finite: what a node must know before it computes with it.
pub fn check_posterior(posterior: &Posterior) -> Result<(), PosteriorError> {
    let k = posterior.feature_names.len();
    if k == 0 || k > MAX_WEIGHTS {
        return Err(PosteriorError::Features { got: k });
    }
    if posterior.map_weights.len() != k {
        return Err(PosteriorError::MapWeights { expected: k, got: posterior.map_weights.len() });
    }
    let (draws, chains) = (posterior.n_draws as usize, posterior.n_chains as usize);
    let even = chains > 0 && draws > 0 && draws.is_multiple_of(chains);
    if !even || Some(posterior.draws.len()) != draws.checked_mul(k) {
        return Err(PosteriorError::Draws { got: posterior.draws.len(), draws, features: k, chains });
    }
    let finite = posterior.draws.iter().all(|w| w.is_finite()) && posterior.map_weights.iter().all(|w| w.is_finite());
    if finite { Ok(()) } else { Err(PosteriorError::NotFinite) }
}

/// Whether the lesson of a posterior is about a table at all.
pub fn is_about_a_table(posterior: &Posterior) -> bool {
    posterior.task.width_m > 0.0
}

/// Whether the weights of a posterior are about the objects of a scene, one after another: those of its task when
/// something else has named the weights.
pub fn is_about_scene(posterior: &Posterior, scene: &Scene) -> bool {
    if Rbf::names(scene) == posterior.feature_names {
        return true;
    }
    let task = posterior.task.objects.iter().map(|object| &object.id);
    let n_weights = scene.objects.len() + FIXED_CENTRES.len();
    is_about_a_table(posterior)
        && n_weights == posterior.feature_names.len()
        && scene.objects.iter().map(|object| &object.id).eq(task)
}

#[cfg(test)]
mod tests {
    use super::{check_posterior, is_about_scene};
    use apprentice_msgs::msg::{Posterior, SceneObject, TableScene};
    use scene::{Object, Point, Rbf, Scene, Shape};

    #[test]
    fn a_posterior_that_does_not_fit_together_is_told() {
        let good = Posterior {
            feature_names: vec!["a".into(), "b".into()],
            map_weights: vec![0.5, 0.5],
            n_chains: 2,
            n_draws: 4,
            draws: vec![0.5; 8],
            ..Posterior::default()
        };
        assert_eq!(check_posterior(&good), Ok(()));
        let told = |change: fn(&mut Posterior)| {
            let mut posterior = good.clone();
            change(&mut posterior);
            check_posterior(&posterior).expect_err("it does not fit").to_string()
        };
        assert_eq!(told(|p| p.feature_names.clear()), "it has 0 features; 1 to 1024 are supported");
        assert_eq!(told(|p| p.map_weights.push(0.0)), "it has 2 features but 3 MAP weights");
        assert_eq!(told(|p| p.n_chains = 3), "8 numbers are not 4 draws of 2 weights in 3 chains");
        assert_eq!(told(|p| p.n_chains = 0), "8 numbers are not 4 draws of 2 weights in 0 chains");
        assert_eq!(told(|p| p.n_draws = 1 << 30), "8 numbers are not 1073741824 draws of 2 weights in 2 chains");
        assert_eq!(told(|p| p.draws[3] = f32::NAN), "it holds weights that are not finite");
    }

    #[test]
    fn a_posterior_speaks_of_the_tables_with_the_objects_of_its_task() {
        let object = |id: &str| Object {
            id: id.into(),
            label: id.into(),
            shape: Shape::Cylinder { radius_m: 0.05, height_m: 0.1 },
            position_m: Point::new(0.5, 0.5),
            yaw_rad: 0.0,
            supports: false,
        };
        let table = |id: &str| Scene {
            id: "t".into(),
            frame: String::new(),
            width_m: 1.0,
            depth_m: 1.0,
            objects: vec![object(id)],
            target: object("vase"),
        };
        let named_by_table = Posterior { feature_names: Rbf::names(&table("cup")), ..Posterior::default() };
        assert!(is_about_scene(&named_by_table, &table("cup")));
        assert!(!is_about_scene(&named_by_table, &table("pan")));
        let cup = SceneObject { id: "cup".into(), ..SceneObject::default() };
        let task = TableScene { width_m: 1.0, objects: vec![cup], ..TableScene::default() };
        let names = |n: usize| (0..n).map(|k| format!("f{k}")).collect::<Vec<_>>();
        let named_by_world = Posterior { feature_names: names(10), task, ..Posterior::default() };
        assert!(is_about_scene(&named_by_world, &table("cup")));
        assert!(!is_about_scene(&named_by_world, &table("pan")));
        assert!(!is_about_scene(&Posterior { feature_names: names(9), ..named_by_world }, &table("cup")));
    }
}
