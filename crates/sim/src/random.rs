//! Every random draw: one seed, one stream a purpose, so that a new use never shifts an old one.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

/// What a stream is for. The numbers are part of the format: a run is a function of its seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Start positions.
    Start = 1,
    /// Initial values.
    Values = 2,
    /// Values told by malicious robots.
    Attack = 3,
    /// Levels told by malicious robots.
    Levels = 4,
    /// What the network does.
    Network = 5,
    /// Errors of sensed positions.
    Sensing = 6,
    /// Ticks that robots miss.
    Plant = 7,
    /// The robots' clocks.
    Clocks = 8,
    /// What malicious robots tell each neighbour on its own.
    Faces = 9,
    /// Where disobedient malicious robots go.
    Motion = 10,
    /// What malicious robots tell of held links.
    Lists = 11,
    /// Observations that are missed.
    Dropouts = 12,
    /// Who lies.
    Liars = 13,
    /// Where obstacles stand.
    Obstacles = 14,
    /// Where robots arrive.
    Arrivals = 15,
}

/// A generator for one purpose.
#[derive(Clone, Debug)]
pub struct Random(ChaCha8Rng);

impl Random {
    /// The stream of `seed` for one purpose.
    #[must_use]
    pub fn new(seed: u64, stream: Stream) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream as u64);
        Self(generator)
    }

    /// The stream of one run of a sweep: a key of its own, so that it depends neither on how many runs there are nor on
    /// who else runs, and meets no stream of [`Random::new`].
    #[must_use]
    pub fn of_run(seed: u64, run: u64) -> Self {
        let mut key = *b"................closeranks sweep";
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..16].copy_from_slice(&run.to_le_bytes());
        Self(ChaCha8Rng::from_seed(key))
    }

    /// Even in `0..count`; 0 if `count` is 0. Uneven by less than `count/2⁶⁴`.
    pub fn below(&mut self, count: u64) -> u64 {
        let product = u128::from(self.0.next_u64()) * u128::from(count);
        u64::try_from(product >> 64).unwrap_or(0)
    }

    /// Even in `[min, max)`, in steps of 2⁻⁵³ of the width.
    pub fn uniform(&mut self, min: f64, max: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
        let unit = (self.0.next_u64() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0);
        min + (max - min) * unit
    }

    /// True with `probability`.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.uniform(0.0, 1.0) < probability
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_fixed_and_independent() {
        let mut first = Random::new(1, Stream::Values);
        let draws = [first.uniform(-500.0, 500.0), first.uniform(-500.0, 500.0)];
        let mut again = Random::new(1, Stream::Values);
        assert_eq!(draws, [again.uniform(-500.0, 500.0), again.uniform(-500.0, 500.0)]);
        assert_ne!(draws[0], Random::new(1, Stream::Attack).uniform(-500.0, 500.0));
        assert_ne!(draws[0], Random::new(2, Stream::Values).uniform(-500.0, 500.0));
    }

    #[test]
    fn every_run_of_a_sweep_has_its_own_stream() {
        let first = |seed, run| Random::of_run(seed, run).below(1 << 53);
        assert_eq!(first(1, 7), first(1, 7));
        assert_ne!(first(1, 7), first(1, 8));
        assert_ne!(first(1, 7), first(7, 1));
        let mut random = Random::of_run(1, 0);
        let mut seen = [0; 3];
        (0..300).for_each(|_| seen[usize::try_from(random.below(3)).unwrap()] += 1);
        assert!(seen.iter().all(|count| *count > 60), "{seen:?}");
        assert_eq!(random.below(0), 0);
    }

    #[test]
    fn draws_fill_their_interval() {
        let mut random = Random::new(7, Stream::Start);
        let draws: Vec<f64> = (0..4_000).map(|_| random.uniform(-2.0, 3.0)).collect();
        assert!(draws.iter().all(|draw| (-2.0..3.0).contains(draw)));
        assert!(draws.iter().any(|draw| *draw < -1.99) && draws.iter().any(|draw| *draw > 2.99));
    }
}
