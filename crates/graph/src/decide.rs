//! Questions about one graph, each answered once.

use crate::definition::Witness;
use crate::effort::{Effort, Meter, Stopped};
use crate::graph::Graph;
use crate::search::ledger::{Ledger, number};
use crate::search::{self, ALIKE, PLAIN};
use crate::spectrum::{Sizes, Spectrum};
use crate::table;
use crate::verdict::{Certificate, Interval, Verdict};

/// Nodes that the search may visit before the table is thought of, however small the table.
const LEAST_PATIENCE: u64 = 1 << 10;

/// Nodes of a question that is asked for the sake of a bound.
const SHORT: u64 = 1 << 13;

/// The robustness of one graph: answers are remembered, and each serves the next question.
///
/// A question goes to the bounds, then to branch and bound, to the eigenvalues when that is long, and to the table of subsets once the
/// search has cost as much as the table would, if the memory for it is granted.
#[derive(Debug)]
pub struct Robustness<'g> {
    ledger: Ledger<'g>,
    table_bytes: u64,
    spectrum: Asked,
}

/// What is known of the eigenvalues. They are asked for when a search is long.
#[derive(Clone, Copy, Debug)]
enum Asked {
    NotYet,
    Found(Option<Spectrum>),
}

impl<'g> Robustness<'g> {
    /// Nothing is computed here but the bounds of [`crate::bounds`]. Of `effort` only the memory is used here.
    #[must_use]
    pub fn new(graph: &'g Graph, effort: &Effort) -> Self {
        Self { ledger: Ledger::new(graph), table_bytes: effort.table_bytes, spectrum: Asked::NotYet }
    }

    /// Is the graph (r,s)-robust? An s above n asks the same as n.
    ///
    /// A graph of one node is (r,s)-robust for every r and s.
    //= paper def:robustness
    pub fn decide(&mut self, r: usize, s: usize, meter: &mut Meter<'_>) -> Verdict {
        let single = self.ledger.graph.node_count() == 1;
        if r == 0 || s == 0 || single {
            return Verdict::Robust(Certificate::Nothing);
        }
        let row = r.min(self.ledger.r_count());
        let wanted = s.min(self.ledger.graph.node_count());
        if self.settle(row, wanted, meter).is_err() {
            return Verdict::Unknown;
        }
        match self.ledger.witness(row, wanted) {
            Some(found) => {
                Verdict::NotRobust(Witness::new(self.ledger.graph, r, s, found.first, found.second))
            }
            None => Verdict::Robust(self.ledger.certificate(row)),
        }
    }

    /// Largest r such that the graph is r-robust, `0 ..= ceil(n/2)`; 1 for a single node.
    //= paper def:robustness
    pub fn r_max(&mut self, meter: &mut Meter<'_>) -> Interval {
        self.narrow(Self::r_known, |_| 1, meter)
    }

    /// Largest F such that the graph is (F+1,F+1)-robust, `−1 ..= ceil(n/2) − 1`; −1 if it is not even (1,1)-robust.
    //= paper def:robustness
    pub fn f_max(&mut self, meter: &mut Meter<'_>) -> Interval {
        let known = |robustness: &Self| {
            let f = robustness.f_known();
            Interval { least: f.least + 1, most: f.most + 1 }
        };
        let both = self.narrow(known, |r| r, meter);
        Interval { least: both.least - 1, most: both.most - 1 }
    }

    /// Largest s in `0 ..= n` such that the graph is (r,s)-robust; 0 if it is not r-robust. Of r = 0 it is n.
    //= paper def:robustness
    pub fn s_max(&mut self, r: usize, meter: &mut Meter<'_>) -> Interval {
        let count = self.ledger.graph.node_count();
        if r == 0 || count == 1 {
            return Interval { least: number(count), most: number(count) };
        }
        let row = r.min(self.ledger.r_count());
        // From below: a small effort of exempt nodes is a small tree.
        while self.ledger.least(row) < self.ledger.most(row) {
            if self.settle(row, self.ledger.least(row) + 1, meter).is_err() {
                break;
            }
        }
        self.ledger.interval(row)
    }

    /// A witness against (r,s), if one was found so far.
    #[must_use]
    pub fn witness(&self, r: usize, s: usize) -> Option<Witness> {
        (1..=self.ledger.r_count()).contains(&r).then(|| self.ledger.witness(r, s))?
    }

    /// How it is known that the graph is (r, s)-robust for all s up to the least one known.
    #[must_use]
    pub fn certificate(&self, r: usize) -> Certificate {
        if r == 0 { Certificate::Nothing } else { self.ledger.certificate(r) }
    }

    /// The graph that is asked about.
    #[must_use]
    pub fn graph(&self) -> &'g Graph {
        self.ledger.graph
    }

    /// The largest r, as far as it is known without another search.
    #[must_use]
    pub fn r_known(&self) -> Interval {
        let rows = || 1..self.ledger.r_count();
        let least = rows().take_while(|&r| self.ledger.least(r) > 0).count();
        let most = rows().take_while(|&r| self.ledger.most(r) > 0).count();
        Interval { least: number(least), most: number(most) }
    }

    /// The largest F, as far as it is known without another search.
    #[must_use]
    pub fn f_known(&self) -> Interval {
        let rows = || 1..self.ledger.r_count();
        let least = rows().take_while(|&r| self.ledger.least(r) >= r).count();
        let most = rows().take_while(|&r| self.ledger.most(r) >= r).count();
        Interval { least: number(least) - 1, most: number(most) - 1 }
    }

    /// Asks about (r, s(r)) until `known`, the largest r for which it holds, is exact or the effort is spent.
    ///
    /// From above, since a witness settles several r at once. If that is long, everything short from below first, so that
    /// whoever stops has a lower end too.
    fn narrow(
        &mut self,
        known: impl Fn(&Self) -> Interval,
        s: impl Fn(usize) -> usize,
        meter: &mut Meter<'_>,
    ) -> Interval {
        let mut short = true;
        loop {
            let now = known(self);
            let ends = usize::try_from(now.least).and_then(|least| Ok((least, usize::try_from(now.most)?)));
            let (Ok((least, most)), None) = (ends, now.exactly()) else {
                return now;
            };
            let limit = if short { SHORT } else { u64::MAX };
            match meter.within(limit, |meter| self.settle(most, s(most), meter)) {
                Err(Stopped) => return known(self),
                Ok(Some(())) => {}
                Ok(None) => {
                    short = false;
                    for r in least + 1..most {
                        let asked = meter.within(SHORT, |meter| self.settle(r, s(r), meter));
                        if asked != Ok(Some(())) || self.ledger.least(r) < s(r) {
                            break;
                        }
                    }
                }
            }
        }
    }

    /// Makes sure that the ledger knows whether the graph is (r,s)-robust.
    fn settle(&mut self, r: usize, s: usize, meter: &mut Meter<'_>) -> Result<(), Stopped> {
        if s <= self.ledger.least(r) || s > self.ledger.most(r) {
            return Ok(());
        }
        let graph = self.ledger.graph;
        let before = meter.nodes();
        let affordable = table::bytes(graph.node_count()) <= self.table_bytes;
        let patience = if affordable { LEAST_PATIENCE + table::cost(graph.node_count()) } else { u64::MAX };
        let short = meter.within(patience.min(PLAIN), |meter| search::plain(graph, r, s, meter))?;
        let found = if short.is_some() {
            short
        } else {
            let spectrum = self.ask_spectrum();
            if s <= self.ledger.least(r) {
                return Ok(());
            }
            let left = patience.saturating_sub(PLAIN);
            meter.within(left, |meter| search::long(graph, r, s, spectrum, ALIKE, meter))?
        };
        match found {
            Some(Some(witness)) => self.ledger.note_witness(r, witness.first, witness.second),
            Some(None) => {
                let nodes = meter.nodes() - before;
                self.ledger.note_robust(r, s, Certificate::Search { nodes });
            }
            None => return self.settle_by_table(r, s, meter),
        }
        Ok(())
    }

    /// Finds the eigenvalues, and notes what they say of every r, once.
    fn ask_spectrum(&mut self) -> Option<Spectrum> {
        if let Asked::Found(spectrum) = self.spectrum {
            return spectrum;
        }
        let spectrum = Spectrum::new(self.ledger.graph);
        self.spectrum = Asked::Found(spectrum);
        for r in (1..=self.ledger.r_count()).rev() {
            let s = spectrum.map_or(0, |spectrum| Sizes::new(self.ledger.graph, spectrum, r).s_least());
            self.ledger.note_robust(r, s, Certificate::Eigenvalues);
        }
        spectrum
    }

    fn settle_by_table(&mut self, r: usize, s: usize, meter: &mut Meter<'_>) -> Result<(), Stopped> {
        let graph = self.ledger.graph;
        match table::s_max(graph, r, self.table_bytes, meter) {
            Ok((s, witness)) => {
                let subsets = table::bytes(graph.node_count());
                self.ledger.note_robust(r, s, Certificate::Table { subsets });
                if let Some(witness) = witness {
                    self.ledger.note_witness(r, witness.first, witness.second);
                }
                Ok(())
            }
            Err(table::TableError::Stopped) => Err(Stopped),
            Err(table::TableError::Memory { .. }) => {
                // The machine has less memory than was granted: without the table, then.
                self.table_bytes = 0;
                self.settle(r, s, meter)
            }
        }
    }
}
