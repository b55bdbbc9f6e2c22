//! The protocol of held links, checked in every interleaving of a small world (docs/theory/links.md, lem:counted).
//!
//! Robots list and release each other, send, and may lose all memory and begin anew. A message that was ever sent may arrive at any
//! time: so it may be late or overtake others, and one that never arrives is lost. What a robot has already is not used again, so a
//! doubled message changes nothing; that is checked as well. One robot may be a liar, which says anything to anybody.
//!
//! The invariant: if normal robot i counts on normal robot j, the row of j for i is active. The same checker finds what is wrong with
//! rules that differ a little from ours.

use closeranks_core::controller::links::protocol::{Entry, Hold, Number, Numbers, Word};
use stateright::{Checker, Model, Property};

/// The robots of a small world.
const ROBOTS: usize = 3;
/// The numbers that a liar uses for its messages and in its acknowledgements.
const LIES: u64 = 2;

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Robot {
    numbers: Numbers,
    holds: [Hold; ROBOTS],
    /// How often it began anew.
    restarts: u8,
    /// How often it began or ceased to list each of the others.
    changes: [u8; ROBOTS],
}

/// A message, as it says something to each robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Message {
    number: Number,
    entries: [Entry; ROBOTS],
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct World {
    robots: [Robot; ROBOTS],
    /// All messages that each robot ever sent.
    sent: [Vec<Message>; ROBOTS],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Action {
    List { robot: usize, other: usize },
    Release { robot: usize, other: usize },
    Send { robot: usize },
    Restart { robot: usize },
    Arrive { sender: usize, receiver: usize, message: usize },
    Lie { liar: usize, receiver: usize, word: Word },
}

/// A world with its bounds and its rules.
#[derive(Clone, Copy)]
struct Held {
    /// How many of the robots there are.
    robots: usize,
    /// The last one lies.
    has_liar: bool,
    /// How many messages each may send.
    messages: usize,
    /// How often each may begin anew.
    restarts: u8,
    /// Everybody lists everybody at the start. A liar is always listed.
    listed: bool,
    /// How often each may begin or cease to list each normal robot.
    changes: u8,
    /// The number with which a life begins, given the last one of the life before.
    begin: fn(Number) -> Numbers,
    counts: fn(&Hold) -> bool,
    is_active: fn(&Hold) -> bool,
}

impl Held {
    const OURS: Self = Self {
        robots: 2,
        has_liar: false,
        messages: 3,
        restarts: 1,
        listed: false,
        changes: 3,
        begin: Numbers::begin,
        counts: Hold::counts,
        is_active: Hold::is_active,
    };

    fn normal(&self) -> usize {
        self.robots - usize::from(self.has_liar)
    }

    /// What a robot may do of its own accord.
    fn push_own(&self, world: &World, robot: usize, actions: &mut Vec<Action>) {
        let may_change = |other: &usize| world.robots[robot].changes[*other] < self.changes;
        for other in (0..self.normal()).filter(|other| *other != robot).filter(may_change) {
            let is_listed = world.robots[robot].holds[other].is_listed();
            let (list, release) = (Action::List { robot, other }, Action::Release { robot, other });
            actions.push(if is_listed { release } else { list });
        }
        if world.sent[robot].len() < self.messages {
            actions.push(Action::Send { robot });
        }
        if world.robots[robot].restarts < self.restarts {
            actions.push(Action::Restart { robot });
        }
    }

    /// What may arrive: every message that was ever sent. Those that are not newer change nothing, which `next_state` checks.
    fn push_arrivals(&self, world: &World, receiver: usize, actions: &mut Vec<Action>) {
        for sender in (0..self.normal()).filter(|sender| *sender != receiver) {
            let messages = 0..world.sent[sender].len();
            actions.extend(messages.map(|message| Action::Arrive { sender, receiver, message }));
        }
        let liar = self.normal();
        for number in (1..=LIES).filter(|_| self.has_liar).map(Number) {
            for acknowledged in (0..=LIES).map(Number) {
                for listed in [false, true] {
                    let word = Word { number, entry: Entry { listed, acknowledged } };
                    actions.push(Action::Lie { liar, receiver, word });
                }
            }
        }
    }

    /// Whether everybody whom a normal robot counts on keeps its row.
    fn is_held(&self, world: &World) -> bool {
        let normal = || 0..self.normal();
        let mut pairs = normal().flat_map(|i| normal().filter(move |j| *j != i).map(move |j| (i, j)));
        pairs.all(|(i, j)| {
            let [own, other] = [&world.robots[i], &world.robots[j]];
            !(self.counts)(&own.holds[j]) || (self.is_active)(&other.holds[i])
        })
    }

    /// Searches every interleaving; true if the invariant held in all of them.
    fn holds(self) -> bool {
        let checker = self.checker().threads(1).spawn_bfs().join();
        checker.assert_any_discovery_of_each();
        checker.discovery("who is counted on keeps its row").is_none()
    }
}

/// Something that must be found, so that a search that finds nothing wrong has looked at it.
trait Found {
    fn assert_any_discovery_of_each(&self);
}

impl<C: Checker<Held>> Found for C {
    fn assert_any_discovery_of_each(&self) {
        self.assert_any_discovery("somebody counts on somebody");
        self.assert_any_discovery("somebody drops a row");
    }
}

impl Model for Held {
    type State = World;
    type Action = Action;

    fn init_states(&self) -> Vec<World> {
        let numbers = Numbers::begin(Number::NONE);
        let hold = Hold::new(numbers.last());
        let mut robot = Robot { numbers, holds: [hold; ROBOTS], restarts: 0, changes: [0; ROBOTS] };
        let from = if self.listed { 0 } else { self.normal() };
        robot.holds[from..].iter_mut().for_each(|hold| hold.list(numbers.last()));
        vec![World { robots: core::array::from_fn(|_| robot.clone()), sent: Default::default() }]
    }

    fn actions(&self, world: &World, actions: &mut Vec<Action>) {
        for robot in 0..self.normal() {
            self.push_own(world, robot, actions);
            self.push_arrivals(world, robot, actions);
        }
    }

    fn next_state(&self, world: &World, action: Action) -> Option<World> {
        let mut next = world.clone();
        match action {
            Action::List { robot, other } => {
                let last = next.robots[robot].numbers.last();
                next.robots[robot].holds[other].list(last);
                next.robots[robot].changes[other] += 1;
            }
            Action::Release { robot, other } => {
                next.robots[robot].holds[other].release();
                next.robots[robot].changes[other] += 1;
            }
            Action::Send { robot } => {
                let number = next.robots[robot].numbers.next(Number::NONE)?;
                let entries = next.robots[robot].holds.map(|hold| hold.entry());
                next.sent[robot].push(Message { number, entries });
            }
            Action::Restart { robot } => {
                let own = &mut next.robots[robot];
                own.numbers = (self.begin)(own.numbers.last());
                own.holds = [Hold::new(own.numbers.last()); ROBOTS];
                own.restarts += 1;
            }
            Action::Arrive { sender, receiver, message } => {
                let Message { number, entries } = next.sent[sender][message];
                let word = Word { number, entry: entries[receiver] };
                hear(&mut next.robots[receiver], sender, word)?;
            }
            Action::Lie { liar, receiver, word } => hear(&mut next.robots[receiver], liar, word)?,
        }
        Some(next)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        let counts = |held: &Held, world: &World| {
            let [one, other] = [&world.robots[0], &world.robots[1]];
            (held.counts)(&one.holds[1]) || (held.counts)(&other.holds[0])
        };
        let drops = |held: &Held, world: &World| !(held.is_active)(&world.robots[0].holds[1]);
        vec![
            Property::always("who is counted on keeps its row", Held::is_held),
            Property::sometimes("somebody counts on somebody", counts),
            Property::sometimes("somebody drops a row", drops),
        ]
    }
}

/// Hands a word to a robot; `None` if nothing changed, as it must be if the word is not newer.
fn hear(robot: &mut Robot, sender: usize, word: Word) -> Option<()> {
    let (hold, last) = (&mut robot.holds[sender], robot.numbers.last());
    let before = *hold;
    let newer = hold.hear(word, last);
    assert_eq!(newer, *hold != before, "{word:?} changed {before:?}");
    newer.then_some(())
}

//= theory lem:counted type=test
#[test]
fn two_robots() {
    assert!(Held { restarts: 0, ..Held::OURS }.holds());
}

//= theory lem:counted type=test
#[test]
fn two_robots_that_begin_anew() {
    assert!(Held { messages: 2, changes: 3, ..Held::OURS }.holds());
}

//= theory lem:counted type=test
#[test]
fn three_robots() {
    assert!(Held { robots: 3, messages: 1, restarts: 0, listed: true, changes: 1, ..Held::OURS }.holds());
}

//= theory lem:counted type=test
#[test]
fn two_robots_and_a_liar() {
    assert!(
        Held { robots: 3, has_liar: true, messages: 1, restarts: 0, listed: true, changes: 2, ..Held::OURS }
            .holds()
    );
}

#[test]
fn a_row_dropped_on_release_sent_is_found() {
    assert!(!Held { is_active: Hold::is_listed, restarts: 0, ..Held::OURS }.holds());
}

#[test]
fn an_acknowledgement_of_an_older_message_that_counts_is_found() {
    let counts = |hold: &Hold| {
        let told = hold.heard().is_some_and(|word| word.entry.acknowledged > Number::NONE);
        hold.is_listed() && told
    };
    assert!(!Held { counts, restarts: 0, ..Held::OURS }.holds());
}

#[test]
fn a_count_kept_after_release_is_found() {
    let counts = |hold: &Hold| hold.heard().is_some_and(|word| word.entry.acknowledged > Number::NONE);
    assert!(!Held { counts, restarts: 0, ..Held::OURS }.holds());
}

#[test]
fn a_row_dropped_by_a_message_to_an_earlier_life_is_found() {
    let is_active = |hold: &Hold| hold.is_listed() || hold.heard().is_none_or(|word| word.entry.listed);
    assert!(!Held { is_active, ..Held::OURS }.holds());
}

/// The assumption that somebody outside of the robot checks: without it the invariant is false.
#[test]
fn numbers_that_begin_again_are_found() {
    let begin = |_: Number| Numbers::begin(Number::NONE);
    assert!(!Held { begin, ..Held::OURS }.holds());
}
