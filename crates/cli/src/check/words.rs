//! Sets, witnesses and proofs in words, with the names of the file.

use closeranks_graph::agreement::Split;
use closeranks_graph::definition::Witness;
use closeranks_graph::formats::{Format, Named, NetworkReading, Note, Reading, ToldBy};
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::verdict::Certificate;
use serde_json::{Value, json};

use super::input;

/// Characters of a name that are shown.
const NAME_SHOWN: usize = 32;

/// The name of a node, safe for a terminal.
pub(super) fn name(named: &Named, node: usize) -> String {
    let safe = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    let text = named.names.get(node).map_or("", String::as_str);
    let mut shown: String = text.chars().take(NAME_SHOWN).map(safe).collect();
    if text.chars().nth(NAME_SHOWN).is_some() {
        shown.push('…');
    }
    shown
}

/// `10 robots, 15 links, undirected`.
fn size(read: &Read<'_>) -> String {
    let [kind, links] = if read.directed { ["directed", "edge"] } else { ["undirected", "link"] };
    let (robots, links) = (count(read.robots as u64, "robot"), count(read.links as u64, links));
    format!("{robots}, {links}, {kind}")
}

/// What a file was read as.
pub(super) struct Read<'a> {
    format: Format,
    told_by: ToldBy,
    notes: &'a [Note],
    robots: usize,
    links: usize,
    directed: bool,
}

impl<'a> From<&'a Reading> for Read<'a> {
    fn from(reading: &'a Reading) -> Self {
        let Reading { named: Named { graph, .. }, format, told_by, notes } = reading;
        let (robots, links, directed) = (graph.node_count(), graph.edge_count(), graph.is_directed());
        Self { format: *format, told_by: *told_by, notes, robots, links, directed }
    }
}

impl<'a> From<&'a NetworkReading> for Read<'a> {
    fn from(reading: &'a NetworkReading) -> Self {
        let NetworkReading { network, format, told_by, notes, .. } = reading;
        let (robots, links, directed) = (network.node_count(), network.edge_count(), network.is_directed());
        Self { format: *format, told_by: *told_by, notes, robots, links, directed }
    }
}

/// What a file was read as, in one line, and a line for each remark on it.
pub(super) fn reading(reading: &Read<'_>) -> Vec<String> {
    let told = input::told(reading.told_by);
    let head = format!("read as {} ({told}): {}", reading.format.title(), size(reading));
    let notes = reading.notes.iter().map(|note| format!("note: {}", safe(&note.to_string())));
    core::iter::once(head).chain(notes).collect()
}

/// Says in JSON what was read, as the lines above do in words.
pub(super) fn reading_value(reading: &Read<'_>) -> Value {
    let told_by = match reading.told_by {
        ToldBy::Content => "content",
        ToldBy::Ending => "ending",
        ToldBy::Request => "request",
    };
    json!({
        "format": reading.format.name(),
        "told_by": told_by,
        "robots": reading.robots,
        "links": reading.links,
        "directed": reading.directed,
        "notes": reading.notes.iter().map(Note::to_string).collect::<Vec<String>>(),
    })
}

/// Without signs that steer a terminal.
fn safe(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

fn shown(named: &Named, set: NodeSet) -> Vec<String> {
    set.iter().map(|node| name(named, node)).collect()
}

/// `{1, 2, 5}`.
pub(super) fn braces(named: &Named, set: NodeSet) -> String {
    format!("{{{}}}", shown(named, set).join(", "))
}

/// `robot 1` or `robots 1, 2 and 5`.
pub(super) fn robots(named: &Named, set: NodeSet) -> String {
    match shown(named, set).as_slice() {
        [] => "no robot".to_owned(),
        [one] => format!("robot {one}"),
        [first @ .., last] => format!("robots {} and {last}", first.join(", ")),
    }
}

/// Names as values: numbers if every name of the graph is one, else strings.
pub(super) fn values(named: &Named, set: NodeSet) -> Value {
    let number = |name: &String| name.parse::<u64>().ok().filter(|number| number.to_string() == *name);
    let numbers: Option<Vec<u64>> = named.names.iter().map(number).collect();
    match numbers {
        Some(numbers) => set.iter().filter_map(|node| numbers.get(node).copied()).collect(),
        None => set.iter().filter_map(|node| named.names.get(node)).map(|name| json!(name)).collect(),
    }
}

/// A witness as in the golden file, and its exempt members.
pub(super) fn witness_value(named: &Named, witness: &Witness) -> Value {
    json!({
        "r": witness.r,
        "s": witness.s,
        "S1": values(named, witness.first),
        "S2": values(named, witness.second),
        "exempt": values(named, witness.exempt),
    })
}

/// Why the two sets of a witness never agree.
pub(super) fn witness(named: &Named, witness: &Witness) -> String {
    let side = |set| hears(named, set, set.difference(witness.exempt));
    let sides = capital(&format!("{}, and {}.", side(witness.first), side(witness.second)));
    let liars = match witness.exempt.len() {
        0 => String::new(),
        1 => format!(" {} hears more: let it lie.", capital(&robots(named, witness.exempt))),
        _ => format!(" {} hear more: let them lie.", capital(&robots(named, witness.exempt))),
    };
    let end = match witness.r - 1 {
        0 => " So neither side ever learns of the other, and they never agree.".to_owned(),
        discards => {
            let ends = match discards {
                1 => "the highest and the lowest value".to_owned(),
                _ => format!("the {discards} highest and the {discards} lowest values"),
            };
            format!(" A robot that discards {ends} keeps none of these, so the two sides never agree.")
        }
    };
    format!("{sides}{liars}{end}")
}

/// Who keeps which value if the liars of a witness play it.
pub(super) fn split(named: &Named, split: &Split) -> String {
    let group = |set: NodeSet, value: &str| match set.len() {
        1 => format!("{} keeps {value}", robots(named, set)),
        _ => format!("{} agree on {value}", robots(named, set)),
    };
    let groups = [group(split.first, "one value"), group(split.second, "another")];
    let between = match split.between.len() {
        0 => String::new(),
        1 => format!(
            " {} hears both sides and may end anywhere between.",
            capital(&robots(named, split.between))
        ),
        _ => format!(
            " {} hear both sides and may end anywhere between.",
            capital(&robots(named, split.between))
        ),
    };
    format!("Who would still agree: {}.{between}", groups.join(", "))
}

/// Who would still agree, as a value of `--json`.
pub(super) fn split_value(named: &Named, split: &Split) -> Value {
    json!({
        "groups": [values(named, split.first), values(named, split.second)],
        "between": values(named, split.between),
        "liars": values(named, split.liars),
    })
}

/// What `members` of `set` hear outside of it.
pub(super) fn hears(named: &Named, set: NodeSet, members: NodeSet) -> String {
    let outside = |node: usize| named.graph.in_neighbors(node).difference(set).len();
    let most = members.iter().map(outside).max().unwrap_or(0);
    let verb = if members.len() == 1 { "hears" } else { "hear" };
    let amount = match (most, members.len()) {
        (0, _) => "nobody".to_owned(),
        (1, 1) => "1 robot".to_owned(),
        (most, 1) => format!("{most} robots"),
        (1, _) => "at most 1 robot".to_owned(),
        (most, _) => format!("at most {most} robots"),
    };
    format!("{} {verb} {amount} outside {}", robots(named, members), braces(named, set))
}

/// With a capital first letter.
pub(super) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// How something is known, after "proved by".
pub(super) fn proof(certificate: Certificate) -> String {
    match certificate {
        Certificate::Nothing => "the definition, which asks nothing here".to_owned(),
        Certificate::Degrees { degree_min } => format!("its least degree, {degree_min}"),
        Certificate::Pairs => "pairs: no two robots can hold out in disjoint sets".to_owned(),
        Certificate::Eigenvalues => "eigenvalues: two such sets have more robots than there are".to_owned(),
        Certificate::Search { nodes } => format!("exhaustive search of {}", count(nodes, "set")),
        Certificate::Table { subsets } => format!("a table of all {subsets} subsets"),
        Certificate::Shifted { steps } => format!("the answer for r + {steps}"),
        other => other.to_string(),
    }
}

/// `single liar`, `2 liars`, after "any".
pub(super) fn liars(number: usize) -> String {
    if number == 1 { "single liar".to_owned() } else { format!("{number} liars") }
}

/// `1 set`, `2 sets`.
pub(super) fn count(number: u64, what: &str) -> String {
    if number == 1 { format!("1 {what}") } else { format!("{number} {what}s") }
}
