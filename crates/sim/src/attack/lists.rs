//! Lies about held links: what is told of lists, acknowledgements, promises and wishes.
//!
//! A liar runs the controller and keeps its rows; what it sends is changed on its way. A new lie is a variant of
//! [`ListsAttack`], its row in `KINDS`, and its arms, for which the compiler asks, in `ListsLiar::lists` and
//! `ListsLiar::lie`. One that acknowledges what it did not receive stands in `lies_about_receipts` too.

use closeranks_core::controller::links::protocol::{Entry, Number};
use closeranks_core::controller::links::wire::{Head, Item, LinkMessage, bytes_max};
use closeranks_core::num::Vector;
use closeranks_core::robot::neighbor::RobotId;

use crate::parse::common::{Kind, NOT_NEGATIVE, PERIOD, one_kind};
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};
use crate::transport::Bytes;

/// A lie about held links.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ListsAttack {
    /// The truth.
    #[default]
    None,
    /// Lists, acknowledgements, promises, prices and wishes drawn for every neighbour on its own in every tick.
    Faces,
    /// Everybody is listed and promised a release for nothing, and nobody is ever released.
    Never,
    /// Nobody is listed, and everybody is promised a release for nothing.
    Always,
    /// Everybody is listed for a while, and then nobody is listed and nothing acknowledged, in turns.
    Flap {
        /// How long one turn of both takes, s.
        period_s: f64,
    },
    /// The lists and acknowledgements of some time ago under the number of now.
    Replay {
        /// How long ago, s.
        age_s: f64,
    },
    /// As `never`, with a wish opposite to that of each reader.
    Siren,
    /// As `always`, with a wish opposite to that of each reader.
    Deserter,
    /// Bytes of which some are wrong.
    Garbage,
}

/// Every kind by its name in scenario files, with its fields; the first is the default.
const KINDS: [Kind<ListsAttack>; 9] = [
    ("none", |_, _| ListsAttack::None),
    ("faces", |_, _| ListsAttack::Faces),
    ("never", |_, _| ListsAttack::Never),
    ("always", |_, _| ListsAttack::Always),
    ("flap", |reader, section| ListsAttack::Flap {
        period_s: reader.number_or(section, "period_s", PERIOD, 1.0),
    }),
    ("replay", |reader, section| ListsAttack::Replay {
        age_s: reader.number_or(section, "age_s", NOT_NEGATIVE, 1.0),
    }),
    ("siren", |_, _| ListsAttack::Siren),
    ("deserter", |_, _| ListsAttack::Deserter),
    ("garbage", |_, _| ListsAttack::Garbage),
];

impl ListsAttack {
    /// Reads the table `attack.lists` of a scenario text.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>) -> Self {
        one_kind(reader, section, &KINDS)
    }

    /// True if it tells of acknowledgements what is not so. By the assumption that liars obey, such a liar keeps its row
    /// for everybody.
    #[must_use]
    pub fn lies_about_receipts(self) -> bool {
        matches!(self, Self::Faces | Self::Garbage)
    }
}

/// Tells the lies of a run.
#[derive(Clone, Debug)]
pub(crate) struct ListsLiar {
    attack: ListsAttack,
    tick_s: f64,
    random: Random,
    /// The true messages of each liar, one a tick, with the tick. Only those that replay keep them.
    past: Vec<Vec<(u32, Bytes)>>,
    buffer: Vec<u8>,
}

impl ListsLiar {
    /// The liars of a team of so many robots.
    pub(crate) fn new(attack: ListsAttack, seed: u64, robots: u16, tick_s: f64) -> Self {
        Self {
            attack,
            tick_s,
            random: Random::new(seed, Stream::Lists),
            past: vec![Vec::new(); usize::from(robots)],
            buffer: vec![0; bytes_max(robots, 3)],
        }
    }

    /// True if liars acknowledge what they did not receive.
    pub(crate) fn binds(&self) -> bool {
        self.attack.lies_about_receipts()
    }

    /// What `sender` tells one `reader`, who wants to go with `wish_m_s`, in place of the message in `bytes`. What cannot be
    /// told any more is not sent.
    pub(crate) fn lists<const D: usize>(
        &mut self,
        tick: u32,
        sender: usize,
        reader: RobotId,
        wish_m_s: &Vector<D>,
        bytes: Bytes,
    ) -> Option<Bytes> {
        match self.attack {
            ListsAttack::None => return Some(bytes),
            ListsAttack::Garbage => return Some(self.garbage(&bytes)),
            ListsAttack::Faces
            | ListsAttack::Never
            | ListsAttack::Always
            | ListsAttack::Flap { .. }
            | ListsAttack::Replay { .. }
            | ListsAttack::Siren
            | ListsAttack::Deserter => {}
        }
        let Ok(message) = LinkMessage::<D>::parse(&bytes) else { return Some(bytes) };
        let mut head = *message.head();
        let item = message.items().find(|item| item.id == reader);
        let nothing = Item { id: reader, entry: Entry::default(), promised: false };
        let mut item = item.unwrap_or(nothing);
        self.lie(tick, sender, &bytes, wish_m_s, &mut head, &mut item);
        let length = head.encode(core::iter::once(item), &mut self.buffer)?;
        Some(Bytes::from(&self.buffer[..length]))
    }

    fn lie<const D: usize>(
        &mut self,
        tick: u32,
        sender: usize,
        bytes: &Bytes,
        wish_m_s: &Vector<D>,
        head: &mut Head<D>,
        item: &mut Item,
    ) {
        match self.attack {
            ListsAttack::Never | ListsAttack::Siren => item.entry.listed = true,
            ListsAttack::Always | ListsAttack::Deserter => item.entry.listed = false,
            ListsAttack::Flap { period_s } => {
                item.entry.listed = (f64::from(tick) * self.tick_s / period_s).fract() < 0.5;
                if !item.entry.listed {
                    item.entry.acknowledged = Number::NONE;
                }
            }
            ListsAttack::Replay { age_s } => {
                if let Some(then) = self.replayed::<D>(tick, sender, bytes, age_s, item.id) {
                    *item = then;
                }
                return;
            }
            ListsAttack::Faces => return self.draw(head, item),
            ListsAttack::None | ListsAttack::Garbage => return,
        }
        (item.promised, head.price_m) = (true, 0.0);
        if matches!(self.attack, ListsAttack::Siren | ListsAttack::Deserter) {
            head.wish_m_s = wish_m_s.map(|component| -10.0 * component);
        }
    }

    /// Draws everything that is told to one neighbour.
    fn draw<const D: usize>(&mut self, head: &mut Head<D>, item: &mut Item) {
        let true_number = item.entry.acknowledged.0;
        let mut below = |most: f64| self.random.uniform(0.0, most);
        item.entry.listed = below(1.0) < 0.5;
        item.promised = below(1.0) < 0.5;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some number of ns")]
        let drawn = below(2e9) as u64;
        item.entry.acknowledged = Number(match below(5.0) {
            kind if kind < 1.0 => 0,
            kind if kind < 2.0 => u64::MAX,
            kind if kind < 3.0 => true_number.saturating_sub(drawn),
            kind if kind < 4.0 => true_number.saturating_add(drawn),
            _ => true_number,
        });
        head.price_m = if below(1.0) < 0.3 { f64::INFINITY } else { below(20.0) };
        head.wish_m_s = core::array::from_fn(|_| below(20.0) - 10.0);
    }

    /// What the message of some time ago said to `reader`.
    fn replayed<const D: usize>(
        &mut self,
        tick: u32,
        sender: usize,
        bytes: &Bytes,
        age_s: f64,
        reader: RobotId,
    ) -> Option<Item> {
        let past = &mut self.past[sender];
        if past.last().is_none_or(|(then, _)| *then != tick) {
            past.push((tick, bytes.clone()));
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let ticks = (age_s / self.tick_s).round() as usize;
        let (_, then) = &past[past.len().saturating_sub(ticks.saturating_add(1))];
        LinkMessage::<D>::parse(then).ok()?.items().find(|item| item.id == reader)
    }

    /// A message in which up to four bits are wrong.
    fn garbage(&mut self, bytes: &Bytes) -> Bytes {
        let mut wrong = bytes.to_vec();
        let mut below = |most: usize| usize::try_from(self.random.below(most as u64)).unwrap_or(0);
        for _ in 0..=below(4) {
            let at = below(wrong.len().max(1));
            if let Some(byte) = wrong.get_mut(at) {
                *byte ^= 1 << below(8);
            }
        }
        Bytes::from(&wrong[..])
    }
}
