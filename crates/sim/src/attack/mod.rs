//! What malicious robots do: tell wrong levels, values and lists, go where they like. One file for each of the four holds
//! the data, its table in scenario files and its player; [`liars`] plays all of them in a run.

pub mod level;
pub mod liars;
pub mod lists;
pub mod motion;
mod swing;
pub mod value;

pub use level::LevelAttack;
pub use lists::ListsAttack;
pub use motion::MotionAttack;
pub use value::ValueAttack;

use crate::parse::reader::{Reader, Section};
use crate::scenario::route::Whose;

/// What all malicious robots of a run do. By default they do what the paper's nominal scenario says: true levels, random
/// values, obedient motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attack {
    /// What they tell of their level.
    pub level: LevelAttack,
    /// What they tell of held links.
    pub lists: ListsAttack,
    /// What they tell of their value.
    pub value: ValueAttack,
    /// Where they go.
    pub motion: MotionAttack,
}

impl Attack {
    /// Reads the table `attack` of a scenario text. Lists of motions are those of `malicious`.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, malicious: &Whose<'_>) -> Self {
        Self {
            level: reader.table(section, "level", LevelAttack::read),
            lists: reader.table(section, "lists", ListsAttack::read),
            value: reader.table(section, "value", ValueAttack::read),
            motion: MotionAttack::read(reader, section, malicious),
        }
    }

    /// True when every neighbour of a liar gets one and the same well-formed message, and all liars obey their controller:
    /// then a whole team can be computed at once.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.level.is_alike_for_all()
            && self.value.is_alike_for_all()
            && self.motion == MotionAttack::Obedient
    }

    /// True when every neighbour of a liar gets one and the same well-formed message, also about `lists` if robots tell them.
    #[must_use]
    pub(crate) fn is_alike_for_all(&self, lists: bool) -> bool {
        let alike = self.level.is_alike_for_all() && self.value.is_alike_for_all();
        alike && (!lists || self.lists == ListsAttack::None)
    }

    /// True when no two neighbours of a liar are told different values, as the paper's definition wants it (misbeh). Bits that are
    /// changed at random may be those of a value.
    #[must_use]
    pub fn has_one_voice(&self) -> bool {
        let whole = self.level != LevelAttack::Garbage && self.lists != ListsAttack::Garbage;
        self.value.has_one_voice() && whole
    }
}

/// The default attack, but with this lie about levels.
impl From<LevelAttack> for Attack {
    fn from(level: LevelAttack) -> Self {
        Self { level, ..Self::default() }
    }
}

/// The default attack, but with this lie about held links.
impl From<ListsAttack> for Attack {
    fn from(lists: ListsAttack) -> Self {
        Self { lists, ..Self::default() }
    }
}

/// The default attack, but with this lie about values.
impl From<ValueAttack> for Attack {
    fn from(value: ValueAttack) -> Self {
        Self { value, ..Self::default() }
    }
}

/// The default attack, but with this motion.
impl From<MotionAttack> for Attack {
    fn from(motion: MotionAttack) -> Self {
        Self { motion, ..Self::default() }
    }
}
