//! What a lesson is about: its table and its world, each the first that can be used.

use crate::journal::{Entry, MAX_FRAME};
use crate::node::{Output, RewardPosterior};
use apprentice_msgs::msg::{EvidenceRecord, TableScene, TabularWorld};
use exchange::{MAX_ID, scene_from_message, world_from_message, world_hash};
use scene::Rbf;

impl RewardPosterior {
    pub(crate) fn scene(&mut self, scene: TableScene) -> Vec<Output> {
        if self.evidence.task().is_some() {
            return Vec::new();
        }
        let checked = match scene_from_message(&scene) {
            Ok(checked) => checked,
            Err(error) => return self.tell(format!("the scene is ignored: {error}")),
        };
        if let Err(reason) = self.evidence.weights().fit(Rbf::new(&checked).n()) {
            return self.tell(format!("the scene '{}' is ignored: {reason}", checked.id));
        }
        let entry = if self.evidence.is_blank() {
            Entry::Task(Box::new(scene))
        } else {
            let sequence = self.evidence.revision() + 1;
            let kind = EvidenceRecord::SCENE;
            Entry::Record(Box::new(EvidenceRecord { sequence, kind, scene: vec![scene], ..EvidenceRecord::default() }))
        };
        self.begin(vec![entry])
    }

    pub(crate) fn world(&mut self, message: &TabularWorld) -> Vec<Output> {
        let hash = world_hash(message);
        if let Some(known) = self.evidence.world() {
            let (id, same) = (known.id.clone(), known.hash == hash);
            let shown: String = message.id.chars().take(MAX_ID).collect();
            return if same {
                Vec::new()
            } else if shown == id {
                self.tell(format!("the world '{id}' is ignored: it is not what it was when this lesson began"))
            } else {
                self.tell(format!("the world '{shown}' is ignored: this lesson is about the world '{id}'"))
            };
        }
        let world = match world_from_message(message) {
            Ok(world) => world,
            Err(error) => {
                let id: String = message.id.chars().take(MAX_ID).collect();
                return self.tell(format!("the world '{id}' is ignored: {error}"));
            }
        };
        if let Err(reason) = self.evidence.weights().fit(world.feature_names.len()) {
            return self.tell(format!("the world '{}' is ignored: {reason}", world.id));
        }
        let entry = Entry::World(Box::new(message.clone()));
        let n_bytes = entry.to_bytes().len();
        if n_bytes > MAX_FRAME {
            return self.tell(format!(
                "the world '{}' is ignored: it has {n_bytes} bytes, {MAX_FRAME} are supported",
                world.id
            ));
        }
        let mut entries = vec![entry];
        if !self.evidence.is_blank() {
            let (sequence, kind) = (self.evidence.revision() + 1, EvidenceRecord::WORLD);
            let world = vec![world.reference()];
            entries.push(Entry::Record(Box::new(EvidenceRecord {
                sequence,
                kind,
                world,
                ..EvidenceRecord::default()
            })));
        }
        self.begin(entries)
    }

    /// Takes up what the lesson is about, and looks again at what waited for it.
    fn begin(&mut self, entries: Vec<Entry>) -> Vec<Output> {
        let mut outputs: Vec<Output> = entries.iter().map(|entry| Output::Journal(entry.to_bytes())).collect();
        for entry in entries {
            self.restore_entry(entry).expect("it was checked just now");
        }
        outputs.extend(self.about());
        outputs.extend(self.look_again());
        outputs
    }

    /// Says something once, until there is something else to say.
    fn tell(&mut self, text: String) -> Vec<Output> {
        if self.told.as_ref() == Some(&text) {
            return Vec::new();
        }
        self.told = Some(text.clone());
        vec![Output::Warn(text)]
    }
}
