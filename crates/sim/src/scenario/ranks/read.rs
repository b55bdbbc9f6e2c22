//! How ranks stand in a scenario text.

use closeranks_core::need::Listen;
use toml::de::DeValue;

use crate::parse::common::small;
use crate::parse::reader::{Reader, Section};
use crate::parse::value::whole;
use crate::scenario::ranks::{How, Ranking};

impl Ranking {
    /// Reads the field `ranks` for a team of so many robots: a list, or a table that says how ranks are chosen from the start.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Option<Self> {
        if !section.has_table("ranks") {
            let how = listed(reader, section, "ranks", robots)?;
            return Some(Self { how, listen: Listen::All });
        }
        reader.table(section, "ranks", |reader, section| {
            let listen = [("all", Listen::All), ("counted", Listen::Counted)];
            let listen = reader.word(section, "listen", &listen).unwrap_or_default();
            let how = if section.has("list") {
                listed(reader, section, "list", robots)
            } else {
                chosen(reader, section, robots)
            };
            how.map(|how| Self { how, listen })
        })
    }
}

/// The rank of each robot.
fn listed(reader: &mut Reader, section: &mut Section<'_>, key: &'static str, robots: u16) -> Option<How> {
    let rank = move |value: &DeValue<'_>| whole(value).map(small).filter(|rank| *rank < robots);
    reader.list(section, key, &format!("a rank, 0 to {}", robots - 1), rank).map(How::Listed)
}

/// How ranks are chosen.
fn chosen(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Option<How> {
    let core = small(reader.whole(section, "core", 1..u64::from(robots) + 1)?);
    let [own, layers] = [How::Own { core }, How::Layers { core }];
    let is_own = reader.word(section, "kind", &[("own", true), ("layers", false)]);
    Some(if is_own.unwrap_or(true) { own } else { layers })
}
