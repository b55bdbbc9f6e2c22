//! What can be asked, and what every answer has.

use anyhow::{Result, bail};
use closeranks_graph::definition::Witness;
use closeranks_graph::effort::{Meter, Progress};
use closeranks_graph::formats::{Named, Reading};
use closeranks_graph::graph::set::NodeSet;
use closeranks_report::content::Table;
use closeranks_report::table;
use serde_json::{Map, Value, json};

use super::{Check, analysis, mend, question, words};
use crate::progress::Watch;
use crate::wrap::wrapped;

/// The answer to a task.
#[derive(Debug, Default)]
pub(super) struct Answer {
    /// Exit code 0.
    pub(super) holds: bool,
    /// The answer in one sentence.
    pub(super) sentence: String,
    /// What the file was read as, in one line, and a line for each remark on it.
    pub(super) read: Vec<String>,
    /// What the graph is, in one line.
    pub(super) graph: String,
    /// A table.
    pub(super) table: Option<Table>,
    /// A paragraph or more on why.
    pub(super) why: Vec<String>,
    /// For machines.
    pub(super) numbers: Value,
    /// S₁, S₂ and the exempt nodes, as far as there are any.
    pub(super) sets: [NodeSet; 3],
    /// What the picture calls them.
    pub(super) labels: [&'static str; 3],
    /// What the picture shows.
    pub(super) caption: String,
}

impl Answer {
    /// For a terminal.
    pub(super) fn text(&self) -> String {
        let table = self.table.as_ref().map(table::text);
        let why = (!self.why.is_empty()).then(|| wrap(&self.why.join("\n")));
        let read: String = self.read.iter().map(|line| wrap(line)).collect();
        let head = format!("{}{read}{}", wrap(&self.sentence), wrap(&self.graph));
        [Some(head), table, why].into_iter().flatten().collect::<Vec<String>>().join("\n")
    }

    /// With what the file was read as, for persons and for machines.
    pub(super) fn with_reading(mut self, reading: &Reading) -> Self {
        self.read = words::reading(reading);
        if let Value::Object(numbers) = &mut self.numbers {
            numbers.insert("read".to_owned(), words::reading_value(reading));
        }
        self
    }

    /// With the sets of a witness.
    pub(super) fn with_witness(mut self, named: &Named, witness: &Witness) -> Self {
        self.why.push(words::witness(named, witness));
        self.sets = [witness.first, witness.second, witness.exempt];
        self.labels = ["one side", "the other side", "may lie"];
        self.caption =
            format!("Why it is not ({},{})-robust: two sides that never agree", witness.r, witness.s);
        self
    }
}

/// Widest line of prose.
const WIDTH: usize = 110;

fn wrap(text: &str) -> String {
    wrapped(text, WIDTH)
}

/// A question about a graph.
pub(super) struct Task<'a> {
    pub(super) named: &'a Named,
    kind: Kind,
}

enum Kind {
    Everything,
    Robust { r: usize, s: usize, faults: Option<usize> },
    Leaders { leaders: NodeSet, r: Option<usize> },
    Local { faults: Option<usize> },
    Additions { r: usize, s: usize },
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
        let kind = if !arguments.leaders.is_empty() {
            let leaders = leaders(named, &arguments.leaders)?;
            Kind::Leaders { leaders, r: r.or(faults.map(|faults| 2 * faults + 1)) }
        } else if arguments.local {
            Kind::Local { faults }
        } else {
            match (arguments.additions, aim) {
                (false, None) => Kind::Everything,
                (false, Some((r, s))) => Kind::Robust { r, s, faults },
                (true, Some((r, s))) => Kind::Additions { r, s },
                (true, None) => bail!("--additions to what end? Allowed is with --F, or with --r and --s"),
            }
        };
        Ok(Self { named, kind })
    }

    /// The answer, or what is known of it when `watch` says that the time is up.
    pub(super) fn answer(&self, watch: &mut Watch) -> Answer {
        let limit = format!("{} s", watch.limit_s());
        let mut look = |progress: &Progress| watch.look(progress);
        let answer = match &self.kind {
            Kind::Everything => analysis::everything(self.named, &limit, &mut look),
            kind => {
                let mut meter = Meter::new(u64::MAX, &mut look);
                self.one(kind, &limit, &mut meter)
            }
        };
        let caption =
            if answer.caption.is_empty() { answer.sentence.clone() } else { answer.caption.clone() };
        Answer { graph: analysis::graph(&self.named.graph), caption, ..answer }
    }

    fn one(&self, kind: &Kind, limit: &str, meter: &mut Meter<'_>) -> Answer {
        let named = self.named;
        match kind {
            Kind::Everything => Answer::default(),
            Kind::Robust { r, s, faults } => question::robust(named, (*r, *s), *faults, limit, meter),
            Kind::Leaders { leaders, r } => question::leaders(named, *leaders, *r),
            Kind::Local { faults: Some(faults) } => question::local(named, *faults, limit, meter),
            Kind::Local { faults: None } => question::local_largest(named, limit, meter),
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

/// The head of the JSON of a question, and what else it says.
pub(super) fn numbers(named: &Named, question: &Value, answer: &str, more: &Value) -> Value {
    let mut object = Map::new();
    object.insert("n".to_owned(), json!(named.graph.node_count()));
    object.insert("directed".to_owned(), json!(named.graph.is_directed()));
    object.insert("question".to_owned(), question.clone());
    object.insert("answer".to_owned(), json!(answer));
    object.extend(more.as_object().cloned().unwrap_or_default());
    Value::Object(object)
}
