//! Robot descriptions with their meshes and the pairs of links that may touch; plans name all of it by one hash.

use crate::{PlacementPlanner, Settings};
use arm::{Exclusions, MAX_BYTES, MeshDetail, MissingMesh, ReadOptions, Robot, SrdfError, UrdfError};
use placement::ManipulatorError;
use robot_files::{Folders, FoldersError, TextError, read_text};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Problems of one description that are told one by one; more are counted.
const MOST_TOLD: usize = 8;

/// What a description may draw on: files of this machine, as the parameters name them.
#[derive(Debug, Clone, Default)]
pub struct RobotFiles {
    folders: Option<Folders>,
    srdf: Option<String>,
    missing: MissingMesh,
}

/// Why the files that the parameters name cannot be used.
#[derive(Debug, Error)]
pub enum RobotFilesError {
    /// A package path.
    #[error("parameter package_paths: {0}")]
    Folders(#[from] FoldersError),
    /// The file of the SRDF.
    #[error("parameter srdf: {0}")]
    Srdf(#[from] TextError),
}

/// Why a robot cannot be used.
#[derive(Debug, Error)]
pub enum RobotRefused {
    /// Its description.
    #[error(transparent)]
    Urdf(#[from] UrdfError),
    /// As an arm at a table.
    #[error(transparent)]
    Arm(#[from] ManipulatorError),
}

impl RobotFiles {
    /// Looks up the folders and reads the SRDF that the parameters name. Meshes are read with each description.
    ///
    /// # Errors
    /// A folder or file that is not there, or no text.
    pub fn open(settings: &Settings) -> Result<Self, RobotFilesError> {
        let roots: Vec<PathBuf> = settings.package_paths.iter().map(PathBuf::from).collect();
        let folders = if roots.is_empty() { None } else { Some(Folders::new(&roots, None)?) };
        let srdf = match settings.srdf.as_str() {
            "" => None,
            path => Some(read_text(Path::new(path), MAX_BYTES)?),
        };
        Ok(Self { folders, srdf, missing: missing(settings) })
    }

    /// Without any files.
    pub(crate) fn none(settings: &Settings) -> Self {
        Self { folders: None, srdf: None, missing: missing(settings) }
    }

    /// Whether the SRDF is a file, so that the topic does not count.
    pub(crate) fn has_srdf(&self) -> bool {
        self.srdf.is_some()
    }

    fn find(&self, name: &str) -> Result<Vec<u8>, String> {
        match &self.folders {
            Some(folders) => {
                // The advice of the command line is not that of a node.
                folders
                    .find(name)
                    .map_err(|why| why.replace("use --package-path DIR", "set the parameter package_paths"))
            }
            None => Err("no folder was given that may hold meshes; set the parameter package_paths".into()),
        }
    }
}

fn missing(settings: &Settings) -> MissingMesh {
    if settings.missing_meshes == "bound" { MissingMesh::Bound } else { MissingMesh::Refuse }
}

impl PlacementPlanner {
    /// Takes a robot description, in place of an earlier one, with the SRDF of the topic, if there is one. The robot's meshes
    /// are read from the folders of the parameters. Plans name the robot by a hash of all of it: of the description's text alone
    /// when it has neither meshes nor SRDF. Returns what a person should know.
    ///
    /// # Errors
    /// A robot that cannot be used; the earlier one stays.
    pub fn set_robot(&mut self, urdf: &str, semantics: Option<&str>) -> Result<Vec<String>, RobotRefused> {
        let mut of_all = Sha256::new().chain_update(b"robot\0").chain_update(Sha256::digest(urdf.as_bytes()));
        let mut is_text_alone = true;
        let files = &self.files;
        let mut find = |name: &str| {
            let found = files.find(name);
            let content = found.as_ref().map_or([0; 32], |bytes| Sha256::digest(bytes).into());
            of_all.update(b"mesh\0");
            of_all.update(Sha256::digest(name.as_bytes()));
            of_all.update(content);
            is_text_alone = false;
            found
        };
        let options = ReadOptions { missing: files.missing, detail: MeshDetail::Hull };
        let robot = Robot::read(urdf, &mut find, &options)?;
        let mut told: Vec<String> = robot
            .problems
            .iter()
            .filter(|problem| problem.what.contains("stands in for it"))
            .map(ToString::to_string)
            .collect();
        let mut exclusions = None;
        if let Some(text) = files.srdf.as_deref().or(semantics) {
            match Exclusions::from_srdf(&robot, text) {
                Ok((found, problems)) => {
                    told.extend(problems.iter().map(ToString::to_string));
                    of_all.update(b"srdf\0");
                    of_all.update(Sha256::digest(text.as_bytes()));
                    is_text_alone = false;
                    exclusions = Some(found);
                }
                Err(error) => told.push(without_srdf(&error)),
            }
        }
        self.planner.set_arm(robot, exclusions.as_ref())?;
        let hash = if is_text_alone { Sha256::digest(urdf.as_bytes()) } else { of_all.finalize() };
        self.robot_hash = hash.iter().map(|byte| format!("{byte:02x}")).collect();
        let more = told.len().saturating_sub(MOST_TOLD);
        if more > 0 {
            told.truncate(MOST_TOLD);
            told.push(format!("{more} more problems of this kind; `apprentice robot` lists them"));
        }
        Ok(told)
    }

    /// The hash that plans name the robot by; empty without one.
    pub fn robot_hash(&self) -> &str {
        &self.robot_hash
    }
}

fn without_srdf(error: &SrdfError) -> String {
    format!("{error}; pairs of links that always touch are left out instead")
}
