//! How much more room than it needs a robot has for what it has agreed on.

/// So many deals more at least, and at most.
const LEAST: usize = 2;
const MOST: usize = 8;
/// Room that is too small so many ticks after it was made was too small from the beginning.
const SOON_TICKS: u32 = 16;
/// Room that has been large enough for so many ticks may be smaller.
const LONG_TICKS: u32 = 64;

/// How many deals more than it has a robot has room for when room is made.
///
/// Deals are read in every tick, and gaps between those of one robot and the next cost time. So there is little to spare, and more only where neighbours
/// come so often that room would have to be made again and again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Spare {
    deals: usize,
    /// The tick in which room was too small last.
    short: Option<u32>,
}

impl Spare {
    /// Nothing was too small yet.
    pub(super) const NEW: Self = Self { deals: LEAST, short: None };

    /// How many deals.
    pub(super) fn deals(&self) -> usize {
        self.deals
    }

    /// Takes in that room is too small in this tick.
    pub(super) fn falls_short(&mut self, tick: u32) {
        if self.short.is_some_and(|before| tick.saturating_sub(before) <= SOON_TICKS) {
            self.deals = (2 * self.deals).min(MOST);
        }
        self.short = Some(tick);
    }

    /// Takes in that room was large enough in this tick. True if `room` for deals, of which there are so many, is more than the robots of a team
    /// are to have.
    pub(super) fn suffices(&mut self, tick: u32, room: usize, deals: usize, robots: usize) -> bool {
        if self.short.is_none_or(|before| tick.saturating_sub(before) >= LONG_TICKS) {
            self.deals = LEAST;
        }
        room > deals + (self.deals + LEAST) * robots
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_runs_short_again_soon_gets_more_and_who_does_not_for_long_gets_less() {
        let mut spare = Spare::NEW;
        let mut after = |tick| {
            spare.falls_short(tick);
            spare.deals()
        };
        assert_eq!([0, 1, 17, 18, 40].map(&mut after), [2, 4, 8, 8, 8]);
        assert!(!spare.suffices(41, 100, 20, 8) && spare.suffices(41, 101, 20, 8));
        assert!(!spare.suffices(104, 52, 20, 8) && spare.suffices(104, 53, 20, 8));
        assert_eq!(spare.deals(), LEAST);
    }
}
