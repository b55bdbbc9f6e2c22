//! Several teams in one text: `[[teams]]` in place of `[team]`. Each is read as a scenario of its own, in which its tables take the place of
//! those of the whole text.

use core::ops::Range;
use std::borrow::Cow;

use closeranks_core::num::Vector;
use closeranks_core::settings::range::ROBOTS_MAX;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::checks;
use super::fields;
use super::files::Files;
use super::problem::Problem;
use super::reader::Reader;
use super::value::{describe, whole};
use crate::geometry::squared_distance;
use crate::scenario::Scenario;
use crate::scenario::start::Start;

/// How many teams a text has at most.
const TEAMS_MAX: usize = 32;
/// What a team may have for itself in place of what stands outside; all else in its table is what `[team]` has.
const OWN: [&str; 5] = ["name", "start", "values", "motion", "attack"];

/// True if the text names several teams.
pub(super) fn are_in(table: &DeTable<'_>) -> bool {
    table.contains_key("teams")
}

/// The scenario of a text with several teams, or everything that is wrong with it.
pub(super) fn scenario(table: &DeTable<'_>, files: &Files) -> Result<Scenario, Vec<Problem>> {
    let teams = listed(table)?;
    let mut read = Vec::new();
    let mut problems = Vec::new();
    for team in &teams {
        let mut reader = team.reader(files);
        let scenario = fields::read(&mut reader, &team.table);
        if reader.is_clean() {
            checks::check(&mut reader, &scenario);
        }
        problems.extend(reader.finish().into_iter().map(|problem| team.named(problem)));
        read.push(scenario);
    }
    problems = each_once(problems);
    if problems.is_empty() {
        problems = together(&read, &teams);
    }
    if problems.is_empty() { Ok(all(table, read)) } else { Err(problems) }
}

/// What is not understood in such a text.
pub(super) fn misread(table: &DeTable<'_>, files: &Files) -> Vec<Problem> {
    let teams = match listed(table) {
        Ok(teams) => teams,
        Err(problems) => return problems,
    };
    let read = |team: &Team<'_>| {
        let mut reader = team.reader(files);
        fields::read(&mut reader, &team.table);
        reader.finish().into_iter().map(|problem| team.named(problem)).collect::<Vec<_>>()
    };
    each_once(teams.iter().flat_map(read).collect())
}

/// One of several teams.
struct Team<'text> {
    /// Which one, from 0, where its table stands, and where all of them do.
    index: usize,
    place: Range<usize>,
    all: Range<usize>,
    /// How many robots the others have.
    strangers: u16,
    /// The fields of the whole text in whose place it has its own.
    own: Vec<String>,
    /// The text as if it were of this team alone.
    table: DeTable<'text>,
}

impl Team<'_> {
    fn reader(&self, files: &Files) -> Reader {
        let mut reader = Reader::of_team(files, self.index as u64, self.strangers);
        reader.beside = &OWN;
        reader.place("teams", self.all.clone());
        reader
    }

    /// A problem by the name that its field has in the whole text.
    fn named(&self, problem: Problem) -> Problem {
        let (head, rest) = match problem.field.split_once('.') {
            Some((head, rest)) => (head, format!(".{rest}")),
            None => (problem.field.as_str(), String::new()),
        };
        let field = match head {
            "team" => format!("teams[{}]{rest}", self.index),
            _ if self.own.iter().any(|own| own == head) => format!("teams[{}].{head}{rest}", self.index),
            _ => return problem,
        };
        let span = if problem.span == (0..0) { self.place.clone() } else { problem.span };
        Problem { span, field, ..problem }
    }
}

/// The teams of the text, each with a text of its own.
fn listed<'text>(table: &DeTable<'text>) -> Result<Vec<Team<'text>>, Vec<Problem>> {
    let Some(value) = table.get("teams") else { return Ok(Vec::new()) };
    let refuse = |span: Range<usize>, field: &str, found: String, allowed: String| {
        vec![Problem { span, field: field.to_owned(), found, allowed }]
    };
    let items = value.get_ref().as_array().filter(|items| (2..=TEAMS_MAX).contains(&items.len()));
    let Some(items) = items else {
        let found = value
            .get_ref()
            .as_array()
            .map_or_else(|| describe(value.get_ref()), |items| format!("a list of {}", items.len()));
        return Err(refuse(value.span(), "teams", found, format!("a list of 2 to {TEAMS_MAX} tables")));
    };
    if let Some(team) = table.get("team") {
        let allowed = "[team] for one team, or [[teams]] for several".to_owned();
        return Err(refuse(team.span(), "team", "beside [[teams]]".to_owned(), allowed));
    }
    let obstacles = table.get("obstacles").and_then(|value| value.get_ref().as_table());
    if let Some(drawn) = obstacles.and_then(|obstacles| obstacles.get("drawn")) {
        let allowed = "obstacles that are listed: those that are drawn keep away from one start".to_owned();
        return Err(refuse(drawn.span(), "obstacles.drawn", "beside [[teams]]".to_owned(), allowed));
    }
    let mut sizes = Vec::new();
    for (index, item) in items.iter().enumerate() {
        let Some(entries) = item.get_ref().as_table() else {
            let found = describe(item.get_ref());
            return Err(refuse(item.span(), &format!("teams[{index}]"), found, "a table".to_owned()));
        };
        let robots = entries.get("robots").map_or(Some(11), |robots| whole(robots.get_ref()));
        sizes.push(robots.filter(|robots| *robots <= u64::from(ROBOTS_MAX)).unwrap_or(2));
    }
    let robots: u64 = sizes.iter().sum();
    if robots > u64::from(ROBOTS_MAX) {
        let (found, allowed) = (format!("{robots} robots in all"), format!("at most {ROBOTS_MAX}"));
        return Err(refuse(value.span(), "teams", found, allowed));
    }
    let team = |(index, item): (usize, &Spanned<DeValue<'text>>)| {
        let (table, own) = alone(table, item);
        let strangers = u16::try_from(robots - sizes[index]).unwrap_or(u16::MAX);
        Team { index, place: item.span(), all: value.span(), strangers, own, table }
    };
    Ok(items.iter().enumerate().map(team).collect())
}

/// The whole text with what the `item` of one team has, and the fields of the text in whose place that stands.
fn alone<'text>(table: &DeTable<'text>, item: &Spanned<DeValue<'text>>) -> (DeTable<'text>, Vec<String>) {
    let (mut alone, mut own) = (table.clone(), Vec::new());
    alone.remove("teams");
    let mut team = DeTable::new();
    for (key, value) in item.get_ref().as_table().into_iter().flatten() {
        let name = key.get_ref().as_ref();
        if OWN.contains(&name) {
            alone.remove(name);
            alone.insert(key.clone(), value.clone());
            own.push(name.to_owned());
        } else {
            team.insert(key.clone(), value.clone());
        }
    }
    let key = Spanned::new(item.span(), Cow::Borrowed("team"));
    alone.insert(key, Spanned::new(item.span(), DeValue::Table(team)));
    (alone, own)
}

/// What is shared is read for every team, and told once.
fn each_once(mut problems: Vec<Problem>) -> Vec<Problem> {
    problems.sort_by_key(|problem| problem.span.start);
    let mut seen: Vec<Problem> = Vec::new();
    problems.retain(|problem| {
        let new = !seen.contains(problem);
        if new {
            seen.push(problem.clone());
        }
        new
    });
    problems
}

/// What is wrong with teams beside each other, each of which is right by itself.
fn together(read: &[Scenario], teams: &[Team<'_>]) -> Vec<Problem> {
    match read.first().map_or(2, |scenario| scenario.dimension) {
        3 => one_point::<3>(read, teams),
        _ => one_point::<2>(read, teams),
    }
}

/// Robots of different teams that start at one point.
fn one_point<const D: usize>(read: &[Scenario], teams: &[Team<'_>]) -> Vec<Problem> {
    let starts: Vec<Vec<Vector<D>>> =
        read.iter().map(|scenario| scenario.positions().unwrap_or_default()).collect();
    for (second, team) in teams.iter().enumerate() {
        for (first, earlier) in starts[..second].iter().enumerate() {
            for (robot, x) in starts[second].iter().enumerate() {
                let Some(other) = earlier.iter().position(|y| squared_distance(x, y) == 0.0) else {
                    continue;
                };
                let found = format!(
                    "such that robot {} is at {x:?}, where robot {} of teams[{first}] is",
                    robot + 1,
                    other + 1
                );
                let allowed = "a different point for each robot, for instance with start.at_m".to_owned();
                let field = format!("teams[{second}].start");
                return vec![Problem { span: team.place.clone(), field, found, allowed }];
            }
        }
    }
    Vec::new()
}

/// All teams as one scenario, whose robots are numbered through.
fn all(table: &DeTable<'_>, teams: Vec<Scenario>) -> Scenario {
    let mut whole = teams.first().cloned().unwrap_or_default();
    let name = table.get("name").and_then(|name| name.get_ref().as_str());
    whole.name = name.map_or_else(|| Scenario::default().name, str::to_owned);
    whole.malicious.clear();
    whole.absences.clear();
    (whole.ranks, whole.strangers) = (None, 0);
    (whole.start, whole.start_at_m) = (Start::Listed(starts(&teams)), Vec::new());
    let mut first = 0;
    for team in &teams {
        whole.malicious.extend(team.malicious.iter().map(|robot| first + robot));
        whole.team.faults = whole.team.faults.max(team.team.faults);
        let moved = team.absences.iter().cloned().map(|mut absence| {
            absence.spell.robot += first;
            absence
        });
        whole.absences.extend(moved);
        first += team.team.robots;
    }
    whole.team.robots = first;
    Scenario { teams, ..whole }
}

/// Where the robots of all teams start, m.
fn starts(teams: &[Scenario]) -> Vec<Vec<f64>> {
    let of = |team: &Scenario| -> Vec<Vec<f64>> {
        match team.dimension {
            3 => team.positions::<3>().unwrap_or_default().iter().map(|x| x.to_vec()).collect(),
            _ => team.positions::<2>().unwrap_or_default().iter().map(|x| x.to_vec()).collect(),
        }
    };
    teams.iter().flat_map(of).collect()
}
