//! Networks of more robots than exact search takes: proofs by ranks, bounds by degrees, and an honest interval between.

use anyhow::{Result, bail};
use closeranks_graph::network::Network;
use closeranks_graph::ranks::{self, Found};
use closeranks_report::content::Table;
use serde_json::{Value, json};

use super::answer::Answer;
use super::certificate::{self, Proof};
use super::input::NetworkInput;
use super::{Check, words};

/// What can be said of a network.
struct Known<'a> {
    input: &'a NetworkInput,
    found: Option<Found>,
    /// It survives no more than this; −1 if it does not agree even if nobody lies.
    most: i64,
    /// For numbers of liars that it is not proved to survive, the largest part that was found.
    parts: Vec<Found>,
}

/// For so many numbers of liars parts are looked for.
const PARTS: usize = 8;

/// Answers; false when the answer is no or was not found.
pub(super) fn check(arguments: &Check, input: &NetworkInput) -> Result<bool> {
    refuse_exact(arguments, input)?;
    let network = &input.reading.network;
    let most = most(network);
    let asked = arguments.faults.map(usize::from);
    let found = match asked {
        _ if most < 0 => None,
        Some(f) => ranks::order(network, f).and_then(|order| {
            let layers = order.check(network).ok()?;
            Some(Found { order, layers })
        }),
        None => ranks::largest(network, usize::try_from(most).unwrap_or(0)),
    };
    let parts = match (asked, &found) {
        (None, found) => ranks::parts(network, found.as_ref().map_or(0, |found| found.order.f + 1), PARTS),
        (Some(f), None) => ranks::part(network, f).into_iter().collect(),
        (Some(_), Some(_)) => Vec::new(),
    };
    let known = Known { input, found, most, parts };
    let answer = match asked {
        Some(f) => known.question(f),
        None => known.everything(),
    };
    let proof = known.found.as_ref().map_or(Proof::Nothing, |found| Proof::Order(found.order.clone()));
    let read = words::reading(&(&input.reading).into());
    let answer = Answer { proof, graph: known.degrees(), read, table: known.table(), ..answer };
    super::tell(arguments, &answer, "");
    if let Some(target) = &arguments.certificate {
        let name = |node: usize| input.reading.names.get(node).cloned().unwrap_or_default();
        certificate::save(arguments, target, network.clone(), answer.proof.clone(), &name)?;
    }
    Ok(answer.holds)
}

/// What only exact search answers.
fn refuse_exact(arguments: &Check, input: &NetworkInput) -> Result<()> {
    let given = [
        ("--r", arguments.r.is_some()),
        ("--leaders", !arguments.leaders.is_empty()),
        ("--additions", arguments.additions),
        ("--output", arguments.output.is_some()),
        ("--hops", arguments.hops.is_some()),
        ("--window", arguments.window.is_some()),
        ("--every", arguments.every.is_some()),
        ("--radius", arguments.radius.is_some()),
    ];
    if let Some((option, _)) = given.into_iter().find(|(_, given)| *given) {
        bail!(
            "{option} is for graphs of up to 128 robots, and `{}` has {}; allowed are --F, --local and --json",
            input.name,
            input.reading.network.node_count()
        );
    }
    Ok(())
}

/// No network survives more liars in all than this: every robot must hear 2F others or more, and somebody must be heard by all.
fn most(network: &Network) -> i64 {
    if !has_root(network) {
        return -1;
    }
    let least = network.degrees().min().unwrap_or(0);
    i64::try_from((least / 2).min(network.node_count().div_ceil(2) - 1)).unwrap_or(0)
}

/// True if what some robot tells can reach all others.
fn has_root(network: &Network) -> bool {
    let hearers = network.transposed();
    let mut reached = vec![false; network.node_count()];
    let mut last = 0;
    for root in 0..reached.len() {
        if !reached[root] {
            last = root;
            reach(&hearers, root, &mut reached);
        }
    }
    // If anybody reaches all, the last who had to be begun with does.
    let mut again = vec![false; reached.len()];
    reach(&hearers, last, &mut again);
    again.iter().all(|reached| *reached)
}

fn reach(hearers: &Network, root: usize, reached: &mut [bool]) {
    let mut open = vec![root];
    reached[root] = true;
    while let Some(node) = open.pop() {
        for hearer in hearers.heard(node).iter().map(|hearer| *hearer as usize) {
            if !reached[hearer] {
                reached[hearer] = true;
                open.push(hearer);
            }
        }
    }
}

impl Known<'_> {
    fn network(&self) -> &Network {
        &self.input.reading.network
    }

    /// Degrees, in one line.
    fn degrees(&self) -> String {
        let degrees = self.network().degrees();
        let (least, most) = (degrees.clone().min().unwrap_or(0), degrees.max().unwrap_or(0));
        let heard = if self.network().is_directed() { "in-degrees" } else { "degrees" };
        format!("{heard} {least} to {most}")
    }

    /// `proved by ranks, a core of 7 in 5 layers`.
    fn proof(&self) -> String {
        self.found.as_ref().map_or(String::new(), |Found { order, layers }| {
            format!(
                "proved by ranks, a core of {} in {}",
                order.core.len(),
                words::count(*layers as u64, "layer")
            )
        })
    }

    /// Why it survives no more.
    fn limit(&self) -> String {
        match self.most {
            -1 => "some robots hear nobody of the others, even through others".to_owned(),
            most => format!(
                "not any {}: a robot would have to hear {} others",
                words::liars(small(most + 1)),
                2 * (most + 1)
            ),
        }
    }

    fn everything(&self) -> Answer {
        let least = self.found.as_ref().map_or(-1, |found| i64::try_from(found.order.f).unwrap_or(0));
        let is_exact = least == self.most;
        let survives = match least {
            -1 if self.most == -1 => return self.no_agreement(),
            -1 => "No ranks were found, not even for no liars".to_owned(),
            0 => format!("Agrees if nobody lies, {}", self.proof()),
            f => format!("Survives any {} around each robot, {}", words::liars(small(f)), self.proof()),
        };
        let open = if is_exact { "" } else { "; what lies between is open" };
        let f_max = if is_exact { json!(least) } else { json!([least, self.most]) };
        let proved = if is_exact { "exactly" } else { "bounds" };
        Answer {
            holds: is_exact,
            sentence: format!("{survives}; {}{open}.", self.limit()),
            why: self.why(),
            numbers: self.numbers(&json!({ "f_max": f_max, "proved": proved })),
            ..Answer::default()
        }
    }

    fn no_agreement(&self) -> Answer {
        Answer {
            holds: true,
            sentence: format!("Does not agree even if nobody lies: {}.", self.limit()),
            why: self.why(),
            numbers: self.numbers(&json!({ "f_max": -1, "proved": "exactly" })),
            ..Answer::default()
        }
    }

    fn question(&self, f: usize) -> Answer {
        let liars = words::liars(f);
        let (answer, sentence) = if self.found.is_some() {
            ("yes", format!("Yes: survives any {liars} around each robot, {}.", self.proof()))
        } else if i64::try_from(f).unwrap_or(i64::MAX) > self.most {
            ("no", format!("No: does not survive any {liars}: {}.", self.limit()))
        } else {
            ("undecided", format!("Undecided: no ranks were found that show that it survives any {liars}."))
        };
        let more = json!({ "question": { "F": f, "local": true }, "answer": answer });
        Answer {
            holds: answer == "yes",
            sentence,
            why: self.why(),
            numbers: self.numbers(&more),
            ..Answer::default()
        }
    }

    /// What the proof is.
    fn why(&self) -> Vec<String> {
        let parts = (!self.parts.is_empty()).then(|| {
            "Each line of the table is a part of the network that survives so many liars around each of its robots if these \
             listen to each other only."
                .to_owned()
        });
        let proof = self.found.as_ref().map(|Found { order, .. }| {
            let before = ranks::need_before(order.f);
            let core = if order.counts(self.network()).is_ok() {
                let in_core = ranks::need_in_core(order.f, order.core.len());
                format!("Each robot of the core hears {in_core} others of it or more")
            } else {
                "That the core survives by itself was found by exact search".to_owned()
            };
            format!(
                "{core}, and each other robot {before} of the core or of those before it (--json has the order). At most {} of those \
                 that a robot hears may lie, however many in all (docs/ranks.md).",
                order.f
            )
        });
        proof.into_iter().chain(parts).collect()
    }

    /// A line for each part.
    fn table(&self) -> Option<Table> {
        let heads = ["F", "robots", "core", "layers"].map(str::to_owned).to_vec();
        let row = |found: &Found| {
            let Found { order, layers } = found;
            [order.f, found.node_count(), order.core.len(), *layers].map(|number| number.to_string()).to_vec()
        };
        let rows: Vec<Vec<String>> = self.parts.iter().map(row).collect();
        (!rows.is_empty()).then_some(Table { heads, rows })
    }

    fn numbers(&self, more: &Value) -> Value {
        let network = self.network();
        let names = |nodes: &[u32]| -> Value {
            let name = |node: &u32| self.input.value(*node as usize);
            nodes.iter().map(name).collect()
        };
        let mut numbers = serde_json::Map::new();
        numbers.insert("n".to_owned(), json!(network.node_count()));
        numbers.insert("directed".to_owned(), json!(network.is_directed()));
        numbers.extend(more.as_object().cloned().unwrap_or_default());
        let ranks = self.found.as_ref().map(|Found { order, layers }| {
            json!({ "F": order.f, "layers": layers, "core": names(&order.core), "order": names(&order.rest) })
        });
        let part = |found: &Found| {
            let Found { order, layers } = found;
            json!({ "F": order.f, "robots": found.node_count(), "core": names(&order.core), "layers": layers })
        };
        numbers.insert("ranks".to_owned(), json!(ranks));
        numbers.insert("parts".to_owned(), self.parts.iter().map(part).collect());
        numbers.insert("read".to_owned(), words::reading_value(&(&self.input.reading).into()));
        Value::Object(numbers)
    }
}

fn small(number: i64) -> usize {
    usize::try_from(number).unwrap_or(0)
}
