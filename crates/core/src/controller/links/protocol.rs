//! The protocol of held links as a pure state machine: who lists whom, who counts on whom, and whose row is active.
//!
//! Robot i *lists* neighbours that it wants to keep. Every message of i says whom it lists and, for each neighbour, the number
//! of the newest message that it has of it. Robot i *counts on* j once j has acknowledged a message s such that every message from s to
//! now lists j. To release j is to stop listing it, and to stop counting on it in that moment.
//!
//! One robot needs its own [`Numbers`] and one [`Hold`] for each other robot. A tick is:
//!
//! ```text
//! list, release            whom i wants to keep from now on
//! numbers.next()           the number of the message that is sent now
//! hold.entry()             what that message says to each neighbour
//! hold.hear(word, last)    what a message of the neighbour says to i
//! hold.counts()            whether i counts on it
//! hold.is_active()         whether i keeps its row for it
//! ```
//!
//! # What is proved of it
//!
//! *If normal robot i counts on normal robot j, then the row of j for i is active.* Messages may be lost, late, doubled and reordered,
//! and either robot may begin anew without memory. What is assumed, and who checks it:
//!
//! | assumption | who checks it |
//! | --- | --- |
//! | the numbers of a robot rise over all its lives | [`Numbers`] within a life; across lives whoever starts the robot, with a clock or a counter that survives ([`Numbers::begin`]) |
//! | nobody can send in another's name | the transport |
//! | every message says what [`Hold::entry`] says at that time | the robot, which builds messages from nothing else |
//!
//! *Proof.* Let i count on j: j has acknowledged a > `after`, the number of the last message of i before it began to list j, so that
//! every message of i with a number above `after` lists j. As `after` is at least the number with which the present life of i
//! began, a is of this life. Suppose that the row of j for i is not active. Then the newest message m′ that j has of i in its
//! present life does not list j, so its number is at most `after`; and m′ or an older message of i acknowledges a message of
//! the present life of j, so m′ was sent after that life began. The message that acknowledges a was sent by j
//!
//! 1. in its present life: then j had received a, which is newer than m′, and m′ would not be the newest;
//! 2. in an earlier life: then a was sent before the present life of j began and m′ after it, so the number of m′ is above a > `after`.
//!
//! Both are contradictions. ∎
//!
//! So no clock is needed to outlive late messages: a message that does not list j lets j drop its row only once i is known to have
//! heard the present life of j. What is forgotten about one neighbour alone begins a new life of that [`Hold`], by the same proof.
//! What was acknowledged once stays acknowledged: a liar cannot take it back.
//!
//! Whatever a malicious j says, it moves the row of i for j and whether i counts on j, nothing else. An acknowledgement of
//! what was never sent counts for nothing. One of what was sent and not received binds the liar: it is assumed to obey the rows of those
//! whose list it has acknowledged, or it is not counted on at all (docs/theory/links.md).

/// The number of a message among those of its sender. 0 stands for no message.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Number(pub u64);

impl Number {
    /// Before all messages.
    pub const NONE: Self = Self(0);
}

/// The numbers of the messages of one robot. They rise, and never begin again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Numbers {
    last: Number,
}

impl Numbers {
    /// The numbers of a life whose messages come after `before`, which must be at least every number of earlier lives.
    #[must_use]
    pub fn begin(before: Number) -> Self {
        Self { last: before }
    }

    /// The number of the newest message, or what the life began with.
    #[must_use]
    pub fn last(&self) -> Number {
        self.last
    }

    /// The number for a message that is sent now: the next one, or `least` if that is more.
    ///
    /// `None` at the end of all numbers. The robot is silent from then on, so that others keep their rows.
    pub fn next(&mut self, least: Number) -> Option<Number> {
        let next = self.last.0.checked_add(1)?.max(least.0);
        self.last = Number(next);
        Some(self.last)
    }
}

/// What a message says to one robot that receives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Word {
    /// The number of the message.
    pub number: Number,
    /// What it says of the receiver.
    pub entry: Entry,
}

/// What a message says of one robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Entry {
    /// Whether the sender lists it.
    pub listed: bool,
    /// The number of the newest message that the sender has of it.
    pub acknowledged: Number,
}

/// What robot i holds of robot j: one state for each ordered pair of robots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Hold {
    /// The number of the last message before this state began.
    born: Number,
    /// While i lists j: the number of the last message before it began to.
    listed_after: Option<Number>,
    /// The newest message of j, as far as it is about i.
    heard: Option<Word>,
    /// The highest number that j has acknowledged in messages that were the newest, of those that were sent.
    acknowledged: Number,
}

impl Hold {
    /// Nothing is known of j, and i does not list it. `last` is the number of the newest message of i.
    #[must_use]
    pub fn new(last: Number) -> Self {
        Self { born: last, listed_after: None, heard: None, acknowledged: Number::NONE }
    }

    /// What such a state comes to that is not lived through but known ([`bond`](crate::controller::links::bond)).
    pub(crate) fn of(
        born: Number,
        listed_after: Option<Number>,
        heard: Option<Word>,
        acknowledged: Number,
    ) -> Self {
        Self { born, listed_after, heard, acknowledged }
    }

    /// Lists j from the next message on; `last` is the number of the newest message of i. Nothing changes if j is listed.
    pub fn list(&mut self, last: Number) {
        self.listed_after.get_or_insert(last);
    }

    /// Stops listing j, and counting on it.
    pub fn release(&mut self) {
        self.listed_after = None;
    }

    /// True while i lists j.
    #[must_use]
    pub fn is_listed(&self) -> bool {
        self.listed_after.is_some()
    }

    /// Takes what a message of j says to i. False if it is not newer than the newest one: then it is not used.
    ///
    /// `last` is the number of the newest message of i. To acknowledge a later one is a lie, and counts for nothing.
    pub fn hear(&mut self, word: Word, last: Number) -> bool {
        let newer = self.heard.is_none_or(|heard| word.number > heard.number);
        if newer {
            self.heard = Some(word);
            let acknowledged = word.entry.acknowledged;
            if acknowledged <= last {
                self.acknowledged = self.acknowledged.max(acknowledged);
            }
        }
        newer
    }

    /// The newest message of j, as far as it is about i.
    #[must_use]
    pub fn heard(&self) -> Option<Word> {
        self.heard
    }

    /// What a message that is sent now says to j.
    #[must_use]
    pub fn entry(&self) -> Entry {
        let acknowledged = self.heard.map_or(Number::NONE, |word| word.number);
        Entry { listed: self.is_listed(), acknowledged }
    }

    /// True if i counts on j: it has acknowledged a message since i lists it.
    #[must_use]
    pub fn counts(&self) -> bool {
        self.listed_after.is_some_and(|after| after < self.acknowledged)
    }

    /// True if i keeps its row for j: unless i does not list j, and the newest message of j does not list i although j has
    /// acknowledged a message of i since this state began.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.is_listed() || !self.is_released()
    }

    /// True if the newest message of j releases i, as [`is_active`](Self::is_active) says.
    #[must_use]
    pub fn is_released(&self) -> bool {
        self.acknowledged > self.born && self.heard.is_some_and(|word| !word.entry.listed)
    }

    /// True if the newest message of j lists i.
    #[must_use]
    pub fn lists(&self) -> bool {
        self.heard.is_some_and(|word| word.entry.listed)
    }

    /// True if j may count on i, as far as i can know: the row is active and j was heard in this life of the state.
    #[must_use]
    pub fn is_bound(&self) -> bool {
        self.is_active() && self.heard.is_some()
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;

    fn number(of: u64) -> Number {
        Number(of)
    }

    fn word(of: u64, listed: bool, acknowledged: u64) -> Word {
        Word { number: number(of), entry: Entry { listed, acknowledged: number(acknowledged) } }
    }

    #[test]
    fn who_is_listed_and_has_said_so_is_counted_on() {
        let mut numbers = Numbers::begin(number(7));
        let mut hold = Hold::new(numbers.last());
        assert!(hold.is_active() && !hold.counts());
        hold.list(numbers.last());
        assert_eq!(numbers.next(Number::NONE), Some(number(8)));
        assert!(hold.hear(word(1, true, 7), numbers.last()) && !hold.counts(), "of an earlier life");
        assert!(hold.hear(word(2, true, 9), numbers.last()) && !hold.counts(), "never sent");
        assert!(hold.hear(word(3, false, 8), numbers.last()) && hold.counts());
        assert!(
            !hold.hear(word(3, false, 0), numbers.last()) && !hold.hear(word(2, false, 0), numbers.last()),
            "not newer"
        );
        assert!(hold.hear(word(4, false, 0), numbers.last()) && hold.counts(), "nothing is taken back");
        hold.release();
        assert!(!hold.counts() && !hold.is_active());
        hold.list(numbers.last());
        assert!(!hold.counts(), "what is acknowledged is older than the new list");
    }

    #[test]
    fn a_row_is_dropped_when_both_have_let_go_and_know_each_other() {
        let numbers = Numbers::begin(number(6));
        let mut hold = Hold::new(number(5));
        assert!(
            hold.hear(word(1, false, 0), numbers.last()) && hold.is_active(),
            "it does not know this life"
        );
        assert!(hold.hear(word(2, false, 5), numbers.last()) && hold.is_active(), "nor does it now");
        assert!(hold.hear(word(3, true, 6), numbers.last()) && hold.is_active());
        assert!(hold.hear(word(4, false, 6), numbers.last()) && !hold.is_active());
        hold.list(number(6));
        assert!(hold.is_active());
    }

    #[test]
    fn the_last_number_is_used_once() {
        let mut numbers = Numbers::begin(number(3));
        assert_eq!(numbers.next(number(u64::MAX)), Some(number(u64::MAX)));
        assert_eq!(numbers.next(Number::NONE), None);
        assert_eq!(numbers.last(), number(u64::MAX));
        let mut hold = Hold::new(numbers.last());
        hold.list(numbers.last());
        hold.hear(word(1, true, u64::MAX), numbers.last());
        assert!(!hold.counts(), "no message since has a number");
    }

    /// One robot of a pair, and all messages that it ever sent in any life.
    struct Robot {
        numbers: Numbers,
        hold: Hold,
        sent: Vec<Word>,
    }

    impl Robot {
        fn new() -> Self {
            let numbers = Numbers::begin(Number::NONE);
            Self { numbers, hold: Hold::new(numbers.last()), sent: Vec::new() }
        }

        fn act(&mut self, draw: u64) {
            match draw % 8 {
                0 | 1 => self.hold.list(self.numbers.last()),
                2 | 3 => self.hold.release(),
                4 if draw & 0x300 == 0 => {
                    // The life ends: a clock that goes on is all that is left.
                    self.numbers = Numbers::begin(self.numbers.last());
                    self.hold = Hold::new(self.numbers.last());
                }
                5 if draw & 0x300 == 0 => self.hold = Hold::new(self.numbers.last()),
                _ => {
                    if let Some(number) = self.numbers.next(Number::NONE) {
                        self.sent.push(Word { number, entry: self.hold.entry() });
                    }
                }
            }
        }
    }

    /// Any message that was ever sent may arrive at any time, as often as it likes.
    //= theory lem:counted type=test
    #[test]
    fn who_is_counted_on_has_an_active_row_whatever_arrives_when() {
        let mut state = 1_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state >> 33
        };
        let (mut counted, mut dropped) = (0, 0);
        for _ in 0..20_000 {
            let mut robots = [Robot::new(), Robot::new()];
            for _ in 0..40 {
                let (me, other) = if draw() & 1 == 0 { (0, 1) } else { (1, 0) };
                if draw() & 1 == 0 {
                    robots[me].act(draw());
                } else if let Some(last) = robots[other].sent.len().checked_sub(1) {
                    let back = usize::try_from(draw() % 4).unwrap().min(last);
                    let at = if draw() % 4 == 0 {
                        usize::try_from(draw()).unwrap() % (last + 1)
                    } else {
                        last - back
                    };
                    let word = robots[other].sent[at];
                    let last = robots[me].numbers.last();
                    robots[me].hold.hear(word, last);
                }
                for (i, j) in [(0, 1), (1, 0)] {
                    let counts = robots[i].hold.counts();
                    assert!(!counts || robots[j].hold.is_active());
                    counted += u32::from(counts);
                    dropped += u32::from(!robots[j].hold.is_active());
                }
            }
        }
        assert!(counted > 20_000 && dropped > 50_000, "{counted} {dropped}");
    }
}
