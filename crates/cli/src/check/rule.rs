//! What a rule of consensus needs of a graph, asked of the graph: `--rule NAME`.

use anyhow::{Result, bail};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use closeranks_graph::decide::Robustness;
use closeranks_graph::definition::Witness;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::formats::Named;
use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::hops::HopQuestion;
use closeranks_graph::makers::random::geometric;
use closeranks_graph::verdict::Verdict;
use closeranks_report::recording::Recording;
use closeranks_sim::consensus::{Needs, Rule};
use serde_json::{Value, json};

use super::answer::{Answer, numbers};
use super::{question, words};
use crate::progress::Watch;

/// Reads the name of a rule.
pub(super) fn named() -> impl TypedValueParser<Value = Rule> {
    PossibleValuesParser::new(Rule::ALL.map(|(name, _)| name)).map(|name| {
        let known = Rule::ALL.into_iter().find(|(known, _)| *known == name);
        known.map_or(Rule::default(), |(_, rule)| rule)
    })
}

/// Does `rule` survive F liars on this graph?
pub(super) fn answer(
    named: &Named,
    (rule, faults): (Rule, usize),
    leaders: NodeSet,
    limit: &str,
    meter: &mut Meter<'_>,
) -> Answer {
    let answer = match rule.row().needs {
        Needs::Robust => question::robust(named, (faults + 1, faults + 1), Some(faults), limit, meter),
        Needs::JointlyRobust => jointly(named, faults, limit, meter),
        Needs::FromLeaders if !leaders.is_empty() => question::leaders(named, leaders, Some(2 * faults + 1)),
        Needs::NoLiars if faults == 0 => question::robust(named, (1, 1), Some(0), limit, meter),
        Needs::NoLiars => said(named, rule, "no", "No: one liar leads all.".to_owned(), &json!({})),
        Needs::RobustInTwoHops => {
            let asked = json!({ "rule": rule.name() });
            super::hops::one(named, HopQuestion::survives(2, faults), &asked, limit, meter)
        }
        Needs::Degrees => degrees(named, rule, faults),
        Needs::FromLeaders => unknown(named, rule, "it needs --leaders"),
        Needs::Trusted => {
            unknown(named, rule, "it depends on whom robots trust, which the graph does not say")
        }
        Needs::Unknown => unknown(named, rule, "nobody knows a condition"),
    };
    let needs = format!("`{}` with F = {faults} needs {}.", rule.name(), rule.row().needs.words());
    let why = core::iter::once(needs).chain(answer.why).collect();
    Answer { why, ..answer }
}

fn said(named: &Named, rule: Rule, answer: &str, sentence: String, more: &Value) -> Answer {
    let question = json!({ "rule": rule.name() });
    let numbers = numbers(named, &question, answer, more);
    Answer { holds: answer == "yes", sentence, numbers, ..Answer::default() }
}

fn unknown(named: &Named, rule: Rule, why: &str) -> Answer {
    said(named, rule, "undecided", format!("Not known: {why}."), &json!({}))
}

/// A graph that is the same in every round. That (2F+1)-robustness is enough is proved, and that it is necessary is not.
fn jointly(named: &Named, faults: usize, limit: &str, meter: &mut Meter<'_>) -> Answer {
    let mut answer = question::robust(named, (2 * faults + 1, 1), None, limit, meter);
    if answer.numbers["answer"] == "no" {
        answer.why.push(format!(
            "This speaks of the condition that is known to be sufficient, and of robots that discard {} values at each end; `{}` with F = \
             {faults} discards {faults}, and may agree here although the condition does not hold.",
            2 * faults,
            Rule::SwMsr.name()
        ));
    }
    answer
}

/// Enough neighbours are enough; with fewer nobody knows.
fn degrees(named: &Named, rule: Rule, faults: usize) -> Answer {
    let (least, enough) = (named.graph.degree_min(), faults + named.graph.node_count() / 2);
    let more = json!({ "degree_min": least, "enough": enough });
    if least >= enough {
        let sentence = format!("Yes: every robot hears at least {least} others, and {enough} are enough.");
        return said(named, rule, "yes", sentence, &more);
    }
    let sentence = format!("Not known: {enough} neighbours are enough, and a robot hears {least}.");
    said(named, rule, "undecided", sentence, &more)
}

/// Does a rule survive F liars in a recorded run? Windows of so many rounds are asked for `sw-msr`.
pub(super) fn recorded(
    recording: &Recording,
    (rule, faults): (Rule, usize),
    (radius_m, every, window): (f64, usize, usize),
    sets: u64,
    watch: &mut Watch,
) -> Result<Answer> {
    if rule != Rule::SwMsr {
        bail!(
            "--rule {} is for graphs; of recorded runs allowed is --rule sw-msr with --window",
            rule.name()
        );
    }
    let ticks: Vec<usize> = (0..recording.ticks()).step_by(every).collect();
    if ticks.len() < window {
        bail!("--window {window} is longer than the run, which has {} rounds", ticks.len());
    }
    let graphs = ticks.iter().map(|tick| Ok(geometric(recording.at(*tick), radius_m)?));
    let graphs: Vec<Graph> = graphs.collect::<Result<_>>()?;
    let windows = Windows::of(&graphs, &ticks, (window, 2 * faults + 1), sets, watch)?;
    let needs = format!("`{}` with F = {faults} needs {}.", rule.name(), rule.row().needs.words());
    Ok(windows.answer(needs, (rule, faults), window))
}

/// What became of all windows of a run.
#[derive(Default)]
struct Windows {
    all: usize,
    held: usize,
    open: usize,
    /// Windows that fail, those one after another with the same links as one.
    failures: Vec<Failure>,
}

/// Windows one after another with the same links, which are not jointly robust.
struct Failure {
    /// Where the first of them begins.
    from_tick: usize,
    /// Where the last of them ends.
    to_tick: usize,
    windows: usize,
    /// All links of a window.
    named: Named,
    witness: Witness,
}

impl Windows {
    /// Asks each `window` of `graphs` for r-robustness.
    fn of(
        graphs: &[Graph],
        ticks: &[usize],
        (window, r): (usize, usize),
        sets: u64,
        watch: &mut Watch,
    ) -> Result<Self> {
        let mut found = Self { all: graphs.len() - window + 1, ..Self::default() };
        let mut before: Option<(Graph, Verdict)> = None;
        for (place, graphs) in graphs.windows(window).enumerate() {
            let union = union(graphs)?;
            let same = before.take().filter(|(last, _)| *last == union);
            let is_new = same.is_none();
            let verdict = same.map_or_else(|| verdict(&union, r, sets, watch), |(_, verdict)| verdict);
            let span = (ticks[place], ticks[place + window - 1]);
            found.note(&union, verdict, span, is_new);
            before = Some((union, verdict));
        }
        Ok(found)
    }

    fn note(&mut self, union: &Graph, verdict: Verdict, (from_tick, to_tick): (usize, usize), is_new: bool) {
        match verdict {
            Verdict::Robust(_) => self.held += 1,
            Verdict::Unknown => self.open += 1,
            Verdict::NotRobust(witness) => {
                let last = self.failures.last_mut().filter(|_| !is_new);
                if let Some(failure) = last {
                    failure.to_tick = to_tick;
                    failure.windows += 1;
                } else {
                    // Robots of recordings have numbers from 1 on.
                    let names = (1..=union.node_count()).map(|robot| robot.to_string()).collect();
                    let named = Named { graph: union.clone(), names };
                    self.failures.push(Failure { from_tick, to_tick, windows: 1, named, witness });
                }
            }
        }
    }

    fn answer(self, needs: String, (rule, faults): (Rule, usize), window: usize) -> Answer {
        let (held, all, open, r) = (self.held, self.all, self.open, 2 * faults + 1);
        let what = format!("windows of {window} rounds");
        let first = self.failures.first();
        let sentence = match first {
            Some(Failure { from_tick, .. }) => {
                format!(
                    "No: jointly {r}-robust in {held} of {all} {what}, first not from tick {from_tick} on."
                )
            }
            None if open > 0 => {
                format!("Undecided: jointly {r}-robust in {held} of {all} {what}, {open} were not settled.")
            }
            None => format!("Yes: jointly {r}-robust in all {all} {what}."),
        };
        let failures: Vec<Value> = self.failures.iter().map(Failure::value).collect();
        let numbers = json!({ "rule": rule.name(), "F": faults, "window": window, "windows": all, "robust": held,
            "open": open, "first_not_robust_tick": first.map(|failure| failure.from_tick), "failures": failures });
        let union = format!(
            "A window counts every link of {window} rounds one after another. That is enough for a rule that remembers for so long (Saldaña \
             et al. 2017), and says nothing of W-MSR, which forgets after each round."
        );
        let sets = first.map(|failure| failure.words(r));
        let why = [needs, union].into_iter().chain(sets).collect();
        Answer { holds: held == all, sentence, why, numbers, ..Answer::default() }
    }
}

impl Failure {
    /// The sets that fail, for a terminal.
    fn words(&self, r: usize) -> String {
        let sides = [self.witness.first, self.witness.second];
        let [one, other] = sides.map(|side| words::hears(&self.named, side, side));
        let (from, to) = (self.from_tick, self.to_tick);
        format!(
            "All links of a window between tick {from} and tick {to} together: {one}, and {other}; one of them would have to hear {r} or more."
        )
    }

    fn value(&self) -> Value {
        json!({ "from_tick": self.from_tick, "to_tick": self.to_tick, "windows": self.windows,
            "witness": words::witness_value(&self.named, &self.witness) })
    }
}

fn verdict(graph: &Graph, r: usize, sets: u64, watch: &mut Watch) -> Verdict {
    let mut look = |progress: &Progress| watch.look(progress);
    let mut meter = Meter::new(sets, &mut look);
    Robustness::new(graph, &Effort::UNLIMITED).decide(r, 1, &mut meter)
}

/// Who hears whom in some round.
fn union(graphs: &[Graph]) -> Result<Graph> {
    let robots = graphs.first().map_or(1, Graph::node_count);
    let hears =
        |node: usize| graphs.iter().fold(NodeSet::EMPTY, |all, graph| all.union(graph.in_neighbors(node)));
    let mut union = Graph::empty(robots, false)?;
    for to in 0..robots {
        for from in hears(to).iter().filter(|from| *from < to) {
            union.add_edge(from, to)?;
        }
    }
    Ok(union)
}
