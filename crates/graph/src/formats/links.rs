//! The links of a text in its order, and which of them are told again.

use alloc::vec::Vec;

/// A link as a text tells it.
#[derive(Clone, Copy)]
struct Link {
    from: u32,
    to: u32,
    line: u32,
    /// Each end hears the other.
    both: bool,
    /// Told again it is no news.
    expected: bool,
}

/// Links in the order of a text.
#[derive(Default)]
pub(super) struct Links {
    all: Vec<Link>,
    /// Either end may name the other: u - v after v - u is not told again.
    pub(super) each_end: bool,
    /// Links from now on are no news when they are told again.
    pub(super) expected: bool,
}

/// What links come to.
#[derive(Default)]
pub(super) struct Told {
    /// Of the links that are there, those that hold both ways, each time that they are told with something new.
    pub(super) both_ways: usize,
    /// How many are told again.
    pub(super) parallel: usize,
    /// The first of these: its ends and its line.
    pub(super) first: Option<(usize, usize, usize)>,
}

impl Links {
    /// One link more.
    pub(super) fn push(&mut self, (from, to): (usize, usize), line: usize, both: bool) {
        let small = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        let (from, to, line, expected) = (small(from), small(to), small(line), self.expected);
        self.all.push(Link { from, to, line, both, expected });
    }

    /// All pairs `(from, to)`, in both directions where both hear, some of them more than once.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let back = |link: &Link| link.both.then_some((link.to, link.from));
        self.all.iter().flat_map(move |link| [Some((link.from, link.to)), back(link)]).flatten()
    }

    /// Which are told again.
    pub(super) fn told(&self) -> Told {
        let mut order: Vec<(u32, u32, u32)> =
            (0_u32..).zip(&self.all).map(|(place, link)| link.key(place)).collect();
        order.sort_unstable();
        let (mut told, mut first) = (Told::default(), None);
        for pair in order.chunk_by(|one, next| (one.0, one.1) == (next.0, next.1)) {
            let mut seen = Seen::default();
            for &(.., place) in pair {
                let link = &self.all[place as usize];
                if seen.is_new(link, self.each_end) {
                    told.both_ways += usize::from(link.both);
                } else if !link.expected {
                    told.parallel += 1;
                    first = Some(first.map_or(place, |first: u32| first.min(place)));
                }
            }
        }
        told.first = first.map(|place| self.all[place as usize].told());
        told
    }
}

impl Link {
    /// The two ends, the lesser first, and the place in the text.
    fn key(&self, place: u32) -> (u32, u32, u32) {
        (self.from.min(self.to), self.from.max(self.to), place)
    }

    fn told(&self) -> (usize, usize, usize) {
        (self.from as usize, self.to as usize, self.line as usize)
    }
}

/// What was told of two nodes so far.
#[derive(Default)]
struct Seen {
    /// Whether the greater hears the lesser, and the lesser the greater.
    heard: [bool; 2],
    /// How often the link was told from the lesser end, and from the greater.
    times: [usize; 2],
}

impl Seen {
    /// Whether the link says something new.
    fn is_new(&mut self, link: &Link, each_end: bool) -> bool {
        let way = usize::from(link.from > link.to);
        let mut is_new = !core::mem::replace(&mut self.heard[way], true);
        if link.both {
            is_new |= !core::mem::replace(&mut self.heard[1 - way], true);
        }
        self.times[way] += 1;
        let fresh = self.times[way] == 1 || self.times[way] <= self.times[1 - way];
        if each_end { fresh } else { is_new }
    }
}
