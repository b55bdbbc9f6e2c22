//! What can be asked of a graph, and who answers it.

use anyhow::{Result, bail};
use closeranks_graph::effort::{Meter, Progress};
use closeranks_graph::formats::Named;
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::hops::HopQuestion;
use closeranks_sim::consensus::Rule;

use super::answer::Answer;
use super::{Check, analysis, hops, mend, question, rule, words};
use crate::progress::Watch;
use crate::threads::Threads;

/// A question about a graph.
pub(super) struct Task<'a> {
    pub(super) named: &'a Named,
    kind: Kind,
    limit: String,
    sets: u64,
    threads: Threads,
}

enum Kind {
    Everything,
    Rule { rule: Rule, faults: usize, leaders: NodeSet },
    Robust { r: usize, s: usize, faults: Option<usize> },
    Leaders { leaders: NodeSet, r: Option<usize> },
    Local { faults: Option<usize> },
    Additions { r: usize, s: usize },
    Hops(HopQuestion),
    MostOverHops(usize),
}

impl<'a> Task<'a> {
    /// What the arguments ask; refuses leaders that are not there and additions for no aim.
    pub(super) fn new(named: &'a Named, arguments: &Check) -> Result<Self> {
        let faults = arguments.faults.map(usize::from);
        let r = arguments.r.map(usize::from);
        let aim = match (faults, r) {
            (Some(faults), _) => Some((faults + 1, faults + 1)),
            (None, Some(r)) => Some((r, arguments.s.map_or(1, usize::from))),
            (None, None) => None,
        };
        let kind = if let Some(rule) = arguments.rule {
            let Some(faults) = faults else { bail!("--rule asks about so many liars: allowed is with --F") };
            Kind::Rule { rule, faults, leaders: leaders(named, &arguments.leaders)? }
        } else if !arguments.leaders.is_empty() {
            let leaders = leaders(named, &arguments.leaders)?;
            Kind::Leaders { leaders, r: r.or(faults.map(|faults| 2 * faults + 1)) }
        } else if arguments.local {
            Kind::Local { faults }
        } else if let Some(hops) = arguments.hops.map(usize::from) {
            // The theorem asks (F + 1, F + 1) of paths that F liars may be on; with --r alone F is r - 1 too.
            let question = |(r, s)| HopQuestion { hops, r, s, liars: r - 1 };
            aim.map_or(Kind::MostOverHops(hops), |aim| Kind::Hops(question(aim)))
        } else {
            match (arguments.additions, aim) {
                (false, None) => Kind::Everything,
                (false, Some((r, s))) => Kind::Robust { r, s, faults },
                (true, Some((r, s))) => Kind::Additions { r, s },
                (true, None) => bail!("--additions to what end? Allowed is with --F, or with --r and --s"),
            }
        };
        Ok(Self {
            named,
            kind,
            limit: arguments.limit(),
            sets: arguments.sets(),
            threads: arguments.threads(),
        })
    }

    /// The answer, or what is known of it when `watch` says that the time is up.
    pub(super) fn answer(&self, watch: &mut Watch) -> Answer {
        let mut look = |progress: &Progress| watch.look(progress);
        let mut meter = Meter::new(self.sets, &mut look).with_workers(&self.threads);
        let answer = self.one(&self.kind, &self.limit, &mut meter);
        let caption =
            if answer.caption.is_empty() { answer.sentence.clone() } else { answer.caption.clone() };
        Answer { graph: analysis::graph(&self.named.graph), caption, ..answer }
    }

    fn one(&self, kind: &Kind, limit: &str, meter: &mut Meter<'_>) -> Answer {
        let named = self.named;
        match kind {
            Kind::Everything => analysis::everything(named, limit, meter),
            Kind::Rule { rule, faults, leaders } => {
                rule::answer(named, (*rule, *faults), *leaders, limit, meter)
            }
            Kind::Robust { r, s, faults } => question::robust(named, (*r, *s), *faults, limit, meter),
            Kind::Leaders { leaders, r } => question::leaders(named, *leaders, *r),
            Kind::Local { faults: Some(faults) } => question::local(named, *faults, limit, meter),
            Kind::Local { faults: None } => question::local_largest(named, limit, meter),
            Kind::Hops(question) => hops::one(named, *question, &hops::asked(*question), limit, meter),
            Kind::MostOverHops(hops) => hops::largest(named, *hops, limit, meter),
            Kind::Additions { r, s } => mend::additions(named, (*r, *s), limit, meter),
        }
    }
}

fn leaders(named: &Named, names: &[String]) -> Result<NodeSet> {
    let mut leaders = NodeSet::EMPTY;
    for name in names {
        match named.names.iter().position(|known| known == name.trim()) {
            Some(node) => leaders.insert(node),
            None => bail!(
                "--leaders names {name:?}, which is no robot of the graph; allowed are {}",
                words::braces(named, named.graph.nodes())
            ),
        }
    }
    Ok(leaders)
}
