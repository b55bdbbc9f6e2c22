//! What every answer has.

use closeranks_graph::agreement::Split;
use closeranks_graph::definition::Witness;
use closeranks_graph::formats::{Named, Reading};
use closeranks_graph::graph::set::NodeSet;
use closeranks_report::content::Table;
use closeranks_report::table;
use serde_json::{Map, Value, json};

use super::certificate::{self, Proof};
use super::words;
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
    /// What proves the answer, where that can be written down.
    pub(super) proof: Proof,
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
        self.read = words::reading(&reading.into());
        if let Value::Object(numbers) = &mut self.numbers {
            numbers.insert("read".to_owned(), words::reading_value(&reading.into()));
        }
        self
    }

    /// With the sets of a witness.
    pub(super) fn with_witness(mut self, named: &Named, witness: &Witness) -> Self {
        self.why.push(words::witness(named, witness));
        let split = Split::of(&named.graph, witness);
        self.why.push(words::split(named, &split));
        if let Value::Object(numbers) = &mut self.numbers {
            numbers.insert("agreement".to_owned(), words::split_value(named, &split));
        }
        self.proof = Proof::Claim(certificate::refuted(witness));
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
