//! W-MSR over two hops (Yuan and Ishii 2021, "Resilient consensus with multi-hop communication", arXiv 2201.03214; built from its
//! abstract and descriptions).
//!
//! A robot is told values by its neighbours, each with the robot it comes from: their own, and those that they were told in this round.
//! A lie can now come over many paths, so what is counted is not values but robots: a *cover* of some messages is a set of robots
//! of which every message has passed at least one.
//!
//! ```text
//! above: the messages with values above y_i, largest first. Discard the longest run of them that F robots cover. Likewise below.
//! y_i ← mean of y_i and what is left
//! ```
//!
//! With one hop this is W-MSR. It assumes synchronous rounds, at most F liars, and that a message tells truly over whom it came; liars may
//! change what they pass on, and here they pass on their own lie. Normal robots agree if and only if the graph is (F + 1, F + 1)-robust
//! with two hops ([`closeranks_graph::hops`]), which is weaker than with one.

use closeranks_core::wmsr;

use super::{Told, Update};

/// A value and the robots that it passed: the sender, and from whom the sender has it if it is not its own.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Passed {
    value: f64,
    sender: u16,
    source: Option<u16>,
}

impl Passed {
    fn robots(&self) -> impl Iterator<Item = u16> {
        core::iter::once(self.sender).chain(self.source)
    }
}

/// Memory for the messages of a robot.
#[derive(Clone, Debug, Default)]
pub struct TwoHop {
    passed: Vec<Passed>,
    cover: Vec<u16>,
}

impl TwoHop {
    fn collect(&mut self, told: &Told<'_>, robot: usize) {
        self.passed.clear();
        for &(sender, value) in &told.heard[robot] {
            let liar = told.malicious[usize::from(sender)];
            self.passed.push(Passed { value, sender, source: None });
            for &(source, passed_on) in &told.heard[usize::from(sender)] {
                if usize::from(source) != robot {
                    let value = if liar { value } else { passed_on };
                    self.passed.push(Passed { value, sender, source: Some(source) });
                }
            }
        }
        self.passed.retain(|passed| passed.value.is_finite());
        self.passed.sort_by(|one, other| one.value.total_cmp(&other.value));
    }
}

impl Update for TwoHop {
    fn update(&mut self, told: &Told<'_>, next: &mut [f64]) {
        for (robot, own) in told.own.iter().enumerate() {
            self.collect(told, robot);
            let passed = &self.passed[..];
            let smaller = passed.partition_point(|passed| passed.value < *own);
            let not_larger = passed.partition_point(|passed| passed.value <= *own);
            let faults = usize::from(told.faults);
            let below = covered(&passed[..smaller].iter(), faults, &mut self.cover);
            let above = covered(&passed[not_larger..].iter().rev(), faults, &mut self.cover);
            let kept = &passed[below..passed.len() - above];
            let low = kept.first().map_or(*own, |first| first.value.min(*own));
            let high = kept.last().map_or(*own, |last| last.value.max(*own));
            next[robot] = wmsr::mean(*own, kept.iter().map(|kept| kept.value), kept.len(), low, high);
        }
    }
}

/// How many of `messages`, from the first on, some `faults` robots cover.
fn covered<'a>(
    messages: &(impl Iterator<Item = &'a Passed> + Clone),
    faults: usize,
    cover: &mut Vec<u16>,
) -> usize {
    let mut most = 0;
    cover.clear();
    extend(messages, faults, cover, &mut most);
    most
}

/// Tries every way to cover the first message that `cover` leaves open, which takes one of the two robots that it passed: at most
/// 2^F tries.
fn extend<'a>(
    messages: &(impl Iterator<Item = &'a Passed> + Clone),
    left: usize,
    cover: &mut Vec<u16>,
    most: &mut usize,
) {
    let hit = |passed: &&Passed| passed.robots().any(|robot| cover.contains(&robot));
    let reach = messages.clone().take_while(hit).count();
    *most = (*most).max(reach);
    let Some(open) = messages.clone().nth(reach).filter(|_| left > 0) else { return };
    for robot in open.robots() {
        cover.push(robot);
        extend(messages, left - 1, cover, most);
        cover.pop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_as_long_as_few_robots_cover() {
        let passed = |value, sender, source| Passed { value, sender, source };
        let messages =
            [passed(9.0, 1, Some(2)), passed(8.0, 3, Some(1)), passed(7.0, 2, None), passed(6.0, 4, None)];
        let run = |faults| covered(&messages.iter(), faults, &mut Vec::new());
        // Robot 1 covers the first two; robots 1 and 2 the first three.
        assert_eq!((0..4).map(run).collect::<Vec<_>>(), [0, 2, 3, 4]);
    }

    /// Where nobody passes anything on it is W-MSR.
    #[test]
    fn with_one_hop_it_is_w_msr() {
        let told: Vec<Passed> = [5.0, 1.0, 2.0]
            .iter()
            .zip(1..)
            .map(|(value, sender)| Passed { value: *value, sender, source: None })
            .collect();
        assert_eq!(covered(&told.iter(), 2, &mut Vec::new()), 2);
    }
}
