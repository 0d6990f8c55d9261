//! What a lesson is about: its table and its world, each the first that can be used; and its table anew, when things on it were
//! moved.

use crate::journal::{Entry, MAX_FRAME};
use crate::node::{Output, RewardPosterior};
use crate::receive::{MAX_BYTES, Verdict, same_features};
use apprentice_msgs::msg::{EvidenceRecord, TableScene, TabularWorld};
use exchange::{MAX_ID, scene_from_message, stands_as, world_from_message, world_hash};
use scene::{Rbf, Scene};

/// Things that were moved have to stand still for so many seconds before they count.
const STILL_TICKS: u32 = 2;

impl RewardPosterior {
    pub(crate) fn scene(&mut self, scene: TableScene) -> Vec<Output> {
        let checked = match scene_from_message(&scene) {
            Ok(checked) => checked,
            Err(error) => return self.tell(format!("the scene is ignored: {error}")),
        };
        if self.evidence.task().is_some() {
            return self.moved(scene, &checked);
        }
        if let Err(reason) = self.evidence.weights().fit(Rbf::new(&checked).n()) {
            return self.tell(format!("the scene '{}' is ignored: {reason}", checked.id));
        }
        let entry = if self.evidence.is_blank() { Entry::Task(Box::new(scene)) } else { self.table_record(scene) };
        self.begin(vec![entry])
    }

    /// A table as an accepted event.
    fn table_record(&self, scene: TableScene) -> Entry {
        let (sequence, kind) = (self.evidence.revision() + 1, EvidenceRecord::SCENE);
        Entry::Record(Box::new(EvidenceRecord { sequence, kind, scene: vec![scene], ..EvidenceRecord::default() }))
    }

    /// The table is seen again. What stands elsewhere than it did is noted, and counts once it stands still.
    fn moved(&mut self, scene: TableScene, checked: &Scene) -> Vec<Output> {
        let Some((_, task)) = self.evidence.task() else { return Vec::new() };
        if task.stands_as(checked) {
            self.elsewhere = None;
            return Vec::new();
        }
        if let Err(Verdict::Refuse(reason) | Verdict::Unknown(reason)) = same_features(&self.evidence, checked) {
            self.elsewhere = None;
            return self.tell(format!("the table is not what the lesson is about, which goes on about that: {reason}"));
        }
        let stood = match &self.elsewhere {
            Some((seen, ticks)) if stands_as(seen, &scene) => *ticks,
            _ => 0,
        };
        self.elsewhere = Some((scene, stood));
        Vec::new()
    }

    /// A second has passed. Draws do not depend on where things stand; the bound on the table does, and so does what to ask.
    pub(crate) fn stood_still(&mut self) -> Vec<Output> {
        let Some((scene, ticks)) = self.elsewhere.take() else { return Vec::new() };
        if ticks + 1 < STILL_TICKS {
            self.elsewhere = Some((scene, ticks + 1));
            return Vec::new();
        }
        if self.evidence.n_bytes() > MAX_BYTES {
            return self.tell("things on the table were moved, but the session holds all that it takes".into());
        }
        let entry = self.table_record(scene);
        self.close_questions();
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
