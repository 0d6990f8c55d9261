//! What a lesson is about: its table and its world, each the first that can be used; and its table anew, when things on it were
//! moved.

use crate::journal::{Entry, MAX_FRAME};
use crate::node::{Output, RewardPosterior};
use crate::receive::{Verdict, has_room, same_features};
use apprentice_msgs::msg::{EvidenceRecord, TableScene, TabularWorld};
use exchange::{MAX_ID, scene_from_message, world_from_message, world_hash};
use scene::{Rbf, Scene};

/// Things that were moved have to stand still for so many seconds before they count.
const STILL_TICKS: u32 = 2;

/// A table that is not as the lesson has it.
pub(crate) struct Elsewhere {
    message: TableScene,
    /// The same, checked.
    scene: Scene,
    /// For how long nothing on it was moved.
    ticks: u32,
}

impl RewardPosterior {
    pub(crate) fn scene(&mut self, scene: TableScene) -> Vec<Output> {
        let checked = match scene_from_message(&scene) {
            Ok(checked) => checked,
            Err(error) => return self.tell(format!("the scene is ignored: {error}")),
        };
        if self.evidence.task().is_some() {
            return self.moved(scene, checked);
        }
        if let Err(reason) = self.evidence.weights().fit(Rbf::new(&checked).n()) {
            return self.tell(format!("the scene '{}' is ignored: {reason}", checked.id));
        }
        let entry = if self.evidence.is_blank() {
            Entry::Task(Box::new(scene))
        } else {
            Entry::Record(Box::new(self.table_record(scene)))
        };
        self.begin(vec![entry])
    }

    /// A table as an event of the lesson.
    fn table_record(&self, scene: TableScene) -> EvidenceRecord {
        let (sequence, kind) = (self.evidence.revision() + 1, EvidenceRecord::SCENE);
        EvidenceRecord { sequence, kind, scene: vec![scene], ..EvidenceRecord::default() }
    }

    /// The table is seen again. What stands elsewhere than it did is noted, and counts once it stands still.
    fn moved(&mut self, message: TableScene, scene: Scene) -> Vec<Output> {
        let Some((_, task)) = self.evidence.task() else { return Vec::new() };
        if task.stands_as(&scene) {
            self.elsewhere = None;
            return Vec::new();
        }
        if let Err(Verdict::Refuse(reason) | Verdict::Unknown(reason)) = same_features(&self.evidence, &scene) {
            self.elsewhere = None;
            return self.tell(format!("the table is not what the lesson is about, which goes on about that: {reason}"));
        }
        let ticks =
            self.elsewhere.take().filter(|before| before.scene.stands_as(&scene)).map_or(0, |before| before.ticks);
        self.elsewhere = Some(Elsewhere { message, scene, ticks });
        Vec::new()
    }

    /// A second has passed. Draws do not depend on where things stand; the bound on the table does, and so does what to ask.
    pub(crate) fn stood_still(&mut self) -> Vec<Output> {
        let Some(seen) = self.elsewhere.take() else { return Vec::new() };
        if seen.ticks + 1 < STILL_TICKS {
            self.elsewhere = Some(Elsewhere { ticks: seen.ticks + 1, ..seen });
            return Vec::new();
        }
        let record = self.table_record(seen.message);
        if let Err(Verdict::Refuse(reason) | Verdict::Unknown(reason)) = has_room(&self.evidence, &record) {
            return self.tell(format!("that things on the table were moved cannot be kept: {reason}"));
        }
        self.close_questions();
        self.begin(vec![Entry::Record(Box::new(record))])
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
