//! Consensus rounds of a whole team in a perfect network.

use closeranks_core::consensus::Rule;

use closeranks_core::need::Listen;

use crate::attack::liars::Liars;
use crate::frame::Frame;
use crate::geometry::near::small;
use crate::scenario::Scenario;

/// Values of a team and scratch for its rounds.
#[derive(Clone, Debug)]
pub(crate) struct Consensus {
    rule: Rule,
    faults: u16,
    /// True if a robot takes the values of those alone that count for it.
    listens_to_counted: bool,
    ticks_per_round: u32,
    malicious: Vec<bool>,
    next_values: Vec<f64>,
    speakers: Vec<usize>,
    heard: Vec<f64>,
}

impl Consensus {
    /// For the robots of `scenario` with initial `values`.
    pub(crate) fn new(scenario: &Scenario, values: &[f64]) -> Self {
        Self {
            rule: scenario.consensus.rule.of_robots().unwrap_or_default(),
            faults: scenario.team.faults,
            listens_to_counted: scenario.ranking().is_some_and(|ranks| ranks.listen == Listen::Counted),
            ticks_per_round: scenario.ticks_per_round(),
            malicious: scenario.malicious_mask(),
            next_values: values.to_vec(),
            speakers: (0..values.len()).collect(),
            heard: Vec::new(),
        }
    }

    /// True in a tick with which a round begins.
    pub(crate) fn is_due(&self, tick: u32) -> bool {
        tick.is_multiple_of(self.ticks_per_round)
    }

    /// A round: values are told, then every robot updates its own from those of the robots it is `linked` to.
    ///
    /// Speakers are sorted once for all, so that each robot hears values in order and has nothing left to sort.
    pub(crate) fn hold<const D: usize>(
        &mut self,
        frame: &mut Frame<D>,
        liars: &mut Liars,
        linked: impl Fn(usize, usize) -> bool,
    ) {
        self.tell(frame, liars);
        self.speakers.sort_unstable_by(|a, b| frame.values[*a].total_cmp(&frame.values[*b]).then(a.cmp(b)));
        for (index, own) in self.next_values.iter_mut().enumerate() {
            let speakers = self.speakers.iter().filter(|speaker| linked(index, **speaker));
            self.heard.clear();
            let mut normal = 0;
            for speaker in speakers {
                self.heard.push(frame.values[*speaker]);
                normal += u16::from(!self.malicious[*speaker]);
            }
            frame.heard[index] = [frame.degrees[index], normal];
            *own = self.rule.update(*own, &mut self.heard, self.faults).value;
        }
    }
    /// The same in a team in which few are linked: each robot looks at those `around` it, of whom it is told who counts for it.
    pub(crate) fn hold_around<const D: usize, Others: Iterator<Item = (usize, bool)>>(
        &mut self,
        frame: &mut Frame<D>,
        liars: &mut Liars,
        around: impl Fn(usize) -> Others,
    ) {
        self.tell(frame, liars);
        for (index, own) in self.next_values.iter_mut().enumerate() {
            self.heard.clear();
            let [mut counted, mut normal, mut lying] = [0; 3];
            for (speaker, counts) in around(index) {
                let lies = self.malicious[speaker];
                if counts || !self.listens_to_counted {
                    self.heard.push(frame.values[speaker]);
                    counted += u16::from(counts);
                    normal += u16::from(counts && !lies);
                    lying += u16::from(lies);
                }
            }
            frame.heard[index] = [counted, normal];
            frame.listened[index] = [small(self.heard.len()), lying];
            *own = self.rule.update(*own, &mut self.heard, self.faults).value;
        }
    }

    /// What everybody tells in a round.
    fn tell<const D: usize>(&self, frame: &mut Frame<D>, liars: &mut Liars) {
        liars.begin_round(self.next_values.iter().copied());
        for (index, value) in frame.values.iter_mut().enumerate() {
            *value = liars.value(index, self.next_values[index]);
            frame.held[index] = self.next_values[index];
        }
    }
}
