//! What the figures of a long run need of it, in a bounded number of ticks.

use closeranks_sim::output::record::Record;
use closeranks_sim::scenario::Scenario;

use super::distance::least_at;

/// A record with a bounded number of ticks, made part by part.
///
/// The first ticks all stay. After them two ticks stay for every stretch that is a fixed share of the time before it, so
/// that beginnings are as fine as in a short run. Positions are those of the two ticks in which the least distance of two
/// robots was least and greatest. Every other number is, for each robot, its least and its greatest of the stretch, in the order
/// in which they came: extremes are exact, and their times are off by less than the stretch. The last tick stays as it is.
#[derive(Debug)]
pub struct Thinned {
    kept: Record,
    stretch: Option<Stretch>,
    /// How many ticks all stay; a later stretch is as long as its beginning divided by this.
    fine: u32,
    last: u32,
}

impl Thinned {
    /// Nothing yet of a run of `scenario`.
    #[must_use]
    pub fn new(scenario: &Scenario) -> Self {
        let fine = (12_000 / u32::from(scenario.team.robots).max(1)).clamp(100, 1_000);
        let kept = Record::new(scenario, scenario.composition().required);
        Self { kept, stretch: None, fine, last: scenario.ticks() }
    }

    /// Adds the next part of the run.
    pub fn add(&mut self, part: &Record) {
        (0..part.ticks.len()).for_each(|place| self.add_tick(part, place));
    }

    fn add_tick(&mut self, part: &Record, place: usize) {
        let tick = part.ticks[place];
        if self.stretch.as_ref().is_some_and(|stretch| tick >= stretch.end || tick == self.last) {
            self.end_stretch();
        }
        match &mut self.stretch {
            Some(stretch) => stretch.add(part, place),
            None => self.stretch = Some(Stretch::new(part, place, tick + (tick / self.fine).max(1))),
        }
    }

    fn end_stretch(&mut self) {
        if let Some(stretch) = self.stretch.take() {
            stretch.end(&mut self.kept);
        }
    }

    /// The ticks that stay.
    #[must_use]
    pub fn finish(mut self) -> Record {
        self.end_stretch();
        self.kept
    }
}

/// Some ticks in a row, of which two stay.
#[derive(Debug)]
struct Stretch {
    /// The first tick after it.
    end: u32,
    /// Where two robots were nearest, where the nearest two were farthest, and the last tick; one tick each.
    near: Record,
    far: Record,
    last: Record,
    distances_m: [f64; 2],
    /// For every number that is no position and no input.
    extremes: Vec<Extremes>,
}

/// The least and the greatest of a number, and which came first.
#[derive(Clone, Copy, Debug)]
struct Extremes {
    least: f64,
    most: f64,
    rises: bool,
}

impl Extremes {
    fn add(&mut self, number: f64) {
        if number < self.least || self.least.is_nan() {
            self.least = number;
            self.rises = false;
        }
        if number > self.most || self.most.is_nan() {
            self.most = number;
            self.rises = true;
        }
    }
}

/// How many columns of numbers are positions and inputs.
fn vectors(record: &Record) -> usize {
    record.positions_m.len() + record.inputs_m_s.len()
}

/// The numbers of a tick that are no positions and no inputs.
fn numbers(record: &Record, place: usize) -> impl Iterator<Item = f64> {
    let rows = record.row(place, 0)..record.row(place + 1, 0);
    record.numbers().into_iter().skip(vectors(record)).flat_map(move |column| column[rows.clone()].to_vec())
}

fn one_tick(part: &Record, place: usize) -> Record {
    let mut one = Record { malicious: part.malicious.clone(), ..empty(part) };
    one.copy(part, place);
    one
}

/// A record like `part` without ticks and without room for any.
fn empty(part: &Record) -> Record {
    Record {
        malicious: Vec::new(),
        ticks: Vec::new(),
        positions_m: vec![Vec::new(); part.dimension],
        inputs_m_s: vec![Vec::new(); part.dimension],
        degree: Vec::new(),
        level: Vec::new(),
        told: Vec::new(),
        h: Vec::new(),
        phi: Vec::new(),
        value: Vec::new(),
        value_told: Vec::new(),
        more_values: vec![Vec::new(); part.more_values.len()],
        more_values_told: vec![Vec::new(); part.more_values_told.len()],
        degree_sensed: Vec::new(),
        level_sensed: Vec::new(),
        outcome: Vec::new(),
        ..*part
    }
}

impl Stretch {
    fn new(part: &Record, place: usize, end: u32) -> Self {
        let one = one_tick(part, place);
        let extremes =
            numbers(part, place).map(|number| Extremes { least: number, most: number, rises: true });
        let extremes = extremes.collect();
        let distances_m = [least_at(part, place); 2];
        Self { end, near: one.clone(), far: one.clone(), last: one, distances_m, extremes }
    }

    fn add(&mut self, part: &Record, place: usize) {
        let distance_m = least_at(part, place);
        let [least_m, most_m] = &mut self.distances_m;
        for (keep, tick) in [
            (distance_m < *least_m, &mut self.near),
            (distance_m > *most_m, &mut self.far),
            (true, &mut self.last),
        ] {
            if keep {
                tick.clear();
                tick.copy(part, place);
            }
        }
        *least_m = least_m.min(distance_m);
        *most_m = most_m.max(distance_m);
        self.extremes
            .iter_mut()
            .zip(numbers(part, place))
            .for_each(|(extremes, number)| extremes.add(number));
    }

    /// Adds the ticks that stay to `kept`.
    fn end(self, kept: &mut Record) {
        let Self { near, far, last, extremes, .. } = self;
        let far = if far.ticks == near.ticks { last } else { far };
        let (first, second) = if near.ticks <= far.ticks { (near, far) } else { (far, near) };
        let is_one = first.ticks == second.ticks;
        for (mut one, later) in [(first, false), (second, true)].into_iter().take(if is_one { 1 } else { 2 })
        {
            let single = vectors(&one);
            let columns = one.numbers_mut().into_iter().skip(single).flatten();
            for (number, Extremes { least, most, rises }) in columns.zip(&extremes) {
                *number = if *rises == later { *most } else { *least };
            }
            kept.copy(&one, 0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use closeranks_sim::world::{Options, run};

    fn long() -> (Scenario, Record) {
        let scenario = Scenario { duration_s: 25.0, ..Scenario::default() };
        let run = run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap();
        (scenario, run.record.unwrap())
    }

    #[test]
    fn ticks_are_fewer_and_extremes_exact() {
        let (scenario, record) = long();
        let mut thinned = Thinned::new(&scenario);
        thinned.add(&record);
        let kept = thinned.finish();
        assert!(kept.ticks.is_sorted_by(|a, b| a < b));
        assert!((4_000..4_500).contains(&kept.ticks.len()), "{}", kept.ticks.len());
        assert_eq!(kept.ticks[..1_000], record.ticks[..1_000]);
        let last = |record: &Record| one_tick(record, record.last_tick());
        assert_eq!(last(&kept), last(&record));
        let least = |column: &[f64]| column.iter().copied().fold(f64::INFINITY, f64::min);
        let most = |column: &[f64]| column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        for (kept, all) in [(&kept.h, &record.h), (&kept.value, &record.value), (&kept.phi, &record.phi)] {
            assert_eq!((least(kept), most(kept)), (least(all), most(all)));
        }
        let nearest = |record: &Record| least(&super::super::distance::least(record));
        assert_eq!(nearest(&kept), nearest(&record));
    }

    #[test]
    fn parts_are_as_good_as_the_whole() {
        let (scenario, record) = long();
        let [mut whole, mut parts] = [Thinned::new(&scenario), Thinned::new(&scenario)];
        whole.add(&record);
        (0..record.ticks.len()).for_each(|place| parts.add(&one_tick(&record, place)));
        let [whole, parts] = [whole.finish(), parts.finish()];
        assert_eq!(whole.digest(), parts.digest());
        assert_eq!(whole.ticks, parts.ticks);
    }

    #[test]
    fn the_number_of_ticks_is_bounded() {
        let mut stretches = 0;
        let mut tick = 0_u32;
        while tick < 1_u32.wrapping_shl(31) {
            tick += (tick / 1_000).max(1);
            stretches += 1;
        }
        assert!(stretches < 16_500, "{stretches}");
    }
}
