//! The counts of docs/reliability as CSV, and its tables as Markdown.

use core::fmt::Write as _;
use std::collections::BTreeMap;

use closeranks_report::sweep::confidence::upper_95;

/// The controllers of the campaign, in the order of tables.
pub(crate) const CONTROLLERS: [&str; 3] = ["budget", "links", "composed"];

/// One controller in one finished sweep: a line of `runs.csv`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    pub(crate) seed: u64,
    pub(crate) commit: String,
    pub(crate) controller: String,
    /// Runs, those in which something was promised at some time, and those in which everything was promised throughout.
    pub(crate) runs: u64,
    pub(crate) promised: u64,
    pub(crate) throughout: u64,
    /// Runs in which a law was violated although everything held that it rests on.
    pub(crate) violating: u64,
}

/// What was counted, of what, under which controller, and two numbers: a line of `laws.csv` or of `values.csv`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Count {
    pub(crate) of: String,
    pub(crate) value: String,
    pub(crate) controller: String,
    pub(crate) numbers: [u64; 2],
}

pub(crate) const RUNS: &str = "seed,commit,controller,runs,promised,throughout,violating";
pub(crate) const LAWS: &str = "law,looked_at,controller,violated,broken";
pub(crate) const VALUES: &str = "drawn,value,controller,runs,violating";

/// The lines of a CSV below its head, each with as many cells as the head.
fn cells<'a>(text: &'a str, head: &str) -> Result<Vec<Vec<&'a str>>, String> {
    let mut lines = text.lines();
    if lines.next() != Some(head) {
        return Err(format!("the first line is not `{head}`"));
    }
    let of = |line: &'a str| line.split(',').collect::<Vec<_>>();
    let all: Vec<_> = lines.map(of).collect();
    match all.iter().find(|cells| cells.len() != head.split(',').count()) {
        Some(cells) => Err(format!("`{}` has {} cells", cells.join(","), cells.len())),
        None => Ok(all),
    }
}

fn number(cell: &str) -> Result<u64, String> {
    cell.parse().map_err(|_| format!("`{cell}` is no whole number"))
}

/// Reads `runs.csv`.
pub(crate) fn read_runs(text: &str) -> Result<Vec<Shard>, String> {
    let of = |cells: Vec<&str>| {
        Ok(Shard {
            seed: number(cells[0])?,
            commit: cells[1].to_owned(),
            controller: cells[2].to_owned(),
            runs: number(cells[3])?,
            promised: number(cells[4])?,
            throughout: number(cells[5])?,
            violating: number(cells[6])?,
        })
    };
    cells(text, RUNS)?.into_iter().map(of).collect()
}

/// Reads `laws.csv` or `values.csv`.
pub(crate) fn read_counts(text: &str, head: &str) -> Result<Vec<Count>, String> {
    let of = |cells: Vec<&str>| {
        let [of, value, controller] = [0, 1, 2].map(|place| cells[place].to_owned());
        Ok(Count { of, value, controller, numbers: [number(cells[3])?, number(cells[4])?] })
    };
    cells(text, head)?.into_iter().map(of).collect()
}

/// `runs.csv`.
pub(crate) fn write_runs(shards: &[Shard]) -> String {
    let mut out = format!("{RUNS}\n");
    for Shard { seed, commit, controller, runs, promised, throughout, violating } in shards {
        let _ = writeln!(out, "{seed},{commit},{controller},{runs},{promised},{throughout},{violating}");
    }
    out
}

/// `laws.csv` or `values.csv`.
pub(crate) fn write_counts(counts: &[Count], head: &str) -> String {
    let mut out = format!("{head}\n");
    for Count { of, value, controller, numbers: [first, second] } in counts {
        let _ = writeln!(out, "{of},{value},{controller},{first},{second}");
    }
    out
}

/// The sum over all shards of a controller.
pub(crate) fn total(shards: &[Shard], controller: &str, of: impl Fn(&Shard) -> u64) -> u64 {
    shards.iter().filter(|shard| shard.controller == controller).map(of).sum()
}

/// What all shards come to: a line a controller.
pub(crate) fn totals_table(shards: &[Shard]) -> String {
    let mut out = "| controller | runs | something was promised | everything throughout | violating | at most (95 %) |\n\
                   | --- | --- | --- | --- | --- | --- |\n"
        .to_owned();
    for name in CONTROLLERS {
        let sum = |of: fn(&Shard) -> u64| total(shards, name, of);
        let (runs, promised, violating) =
            (sum(|shard| shard.runs), sum(|shard| shard.promised), sum(|shard| shard.violating));
        let throughout = sum(|shard| shard.throughout);
        let most = 100.0 * upper_95(violating, promised.max(1));
        let [runs, promised, throughout, violating] = [runs, promised, throughout, violating].map(grouped);
        let _ =
            writeln!(out, "| `{name}` | {runs} | {promised} | {throughout} | {violating} | {most:.4} % |");
    }
    out
}

/// Every shard: a line each.
pub(crate) fn shards_table(shards: &[Shard]) -> String {
    let mut by_shard: BTreeMap<(u64, &str), Vec<&Shard>> = BTreeMap::new();
    for shard in shards {
        by_shard.entry((shard.seed, &shard.commit)).or_default().push(shard);
    }
    let mut out =
        "| seed | commit | runs | `budget`, violating | `links`, violating | `composed`, violating |\n\
                   | --- | --- | --- | --- | --- | --- |\n"
            .to_owned();
    for ((seed, commit), of) in by_shard {
        let runs = of.iter().map(|shard| shard.runs).max().unwrap_or(0);
        let cells = CONTROLLERS.map(|name| {
            let one = of.iter().find(|shard| shard.controller == name);
            one.map_or("-".to_owned(), |shard| grouped(shard.violating))
        });
        let _ = writeln!(out, "| {seed} | {commit} | {} | {} |", grouped(runs), cells.join(" | "));
    }
    out
}

/// Of every law and controller how many runs violated it, and how many broke it at all.
pub(crate) fn laws_table(counts: &[Count]) -> String {
    let mut out = "| law | `budget`, violated | `links`, violated | `composed`, violated | `budget`, broken at all | `links`, broken at all | `composed`, broken at all |\n\
                   | --- | --- | --- | --- | --- | --- | --- |\n"
        .to_owned();
    for (law, _) in names(counts) {
        let cell = |name: &str, which: usize| {
            let one = counts.iter().find(|count| count.of == law && count.controller == name);
            let held = one.filter(|count| which == 1 || count.value == "promised");
            held.map_or("-".to_owned(), |count| grouped(count.numbers[which]))
        };
        let cells = [0, 1].map(|which| CONTROLLERS.map(|name| cell(name, which)).join(" | "));
        let _ = writeln!(out, "| `{law}` | {} |", cells.join(" | "));
    }
    out
}

/// Of every drawn value how many runs had it, and how many of them are violating; where a controller had fewer runs, of how many.
pub(crate) fn values_table(counts: &[Count]) -> String {
    let mut out =
        "| drawn | value | runs | `budget`, violating | `links`, violating | `composed`, violating |\n\
                   | --- | --- | --- | --- | --- | --- |\n"
            .to_owned();
    let mut before = String::new();
    let mut seen = Vec::new();
    for count in counts {
        let key = (count.of.clone(), count.value.clone());
        if seen.contains(&key) {
            continue;
        }
        let of = |name: &str| {
            let is_it =
                |one: &&Count| one.of == count.of && one.value == count.value && one.controller == name;
            let cell = |[runs, violating]: [u64; 2]| {
                let all =
                    if runs == count.numbers[0] { String::new() } else { format!(" of {}", grouped(runs)) };
                grouped(violating) + &all
            };
            counts.iter().find(is_it).map_or("-".to_owned(), |one| cell(one.numbers))
        };
        let head = if before == count.of { String::new() } else { format!("`{}`", count.of) };
        let cells = CONTROLLERS.map(of).join(" | ");
        let _ = writeln!(out, "| {head} | {} | {} | {cells} |", count.value, grouped(count.numbers[0]));
        before.clone_from(&count.of);
        seen.push(key);
    }
    out
}

/// The things that were counted, each once, in the order in which they come.
fn names(counts: &[Count]) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    for count in counts {
        if !found.iter().any(|(of, _)| *of == count.of) {
            found.push((count.of.clone(), count.value.clone()));
        }
    }
    found
}

/// The page with its tables between `<!-- table NAME -->` and `<!-- end -->` as they are now; an error if a place is missing.
pub(crate) fn page(text: &str, tables: &[(&str, String)]) -> Result<String, String> {
    let mut text = text.to_owned();
    for (name, table) in tables {
        let mark = format!("<!-- table {name} -->\n");
        let begin = text.find(&mark).ok_or_else(|| format!("no place for the table `{name}`"))? + mark.len();
        let length =
            text[begin..].find("<!-- end -->").ok_or_else(|| format!("the table `{name}` has no end"))?;
        text.replace_range(begin..begin + length, &format!("\n{table}\n"));
    }
    Ok(text)
}

/// All tables of the page.
pub(crate) fn tables(shards: &[Shard], laws: &[Count], values: &[Count]) -> [(&'static str, String); 4] {
    [
        ("totals", totals_table(shards)),
        ("shards", shards_table(shards)),
        ("laws", laws_table(laws)),
        ("values", values_table(values)),
    ]
}

/// A number as people read it: 1,234,567.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let (mut out, count) = (String::new(), digits.len());
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (count - place).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}
