//! `closeranks advise`: from team, radius, speed, tick and stated errors to what is possible.

mod json;
mod numbers;
mod options;
mod tables;
mod which;
mod words;

use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use closeranks_sim::advice::question::Question;
use closeranks_sim::advice::{self, AdviceError};
use closeranks_sim::output::summary::StartSummary;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{self, Options};

use crate::{output, results, source};

pub(crate) const HELP: &str = "\
Says which controller to take, which starts, speeds, ticks and F are possible under the controller budget, and what stated
errors cost:

    closeranks advise                                   # the paper's team: 11 robots, F = 2, R = 3 m
    closeranks advise --robots 20 --faults 4 --radius 5 --speed 0.5 --tick 0.02
    closeranks advise --position-error 0.01 --lag 0.02  # what these two cost
    closeranks advise --assume free                     # liars may move as they like
    closeranks advise --silent                          # robots tell each other nothing of their motion
    closeranks advise --dimension 3 --json | jq .start  # positions to copy into a scenario
    closeranks advise scenarios/budget.toml             # of a scenario, and whether its start is inside
    closeranks advise scenarios/budget.toml --faults 3  # the same with another F

Options replace what the file says. A number that no option sets is the default of scenarios.

Exit codes: 0 a start exists, 1 none does, 2 bad input.";

#[derive(Args, Debug)]
pub(crate) struct Advise {
    /// Scenario to take everything from that no option sets, a TOML file; `-` reads standard input.
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    #[command(flatten)]
    options: options::Numbers,
    #[command(flatten)]
    talk: which::Talk,
    /// Whether malicious robots move by the rules, or as they like.
    #[arg(long, value_parser = ["obedient", "free"])]
    assume: Option<String>,
    /// 2 or 3.
    #[arg(long, value_parser = ["2", "3"])]
    dimension: Option<String>,
    /// Print the numbers as JSON instead of sentences.
    #[arg(long)]
    json: bool,
}

/// What was asked, and what is known of the scenario behind it.
struct Asked {
    question: Question,
    talk: which::Talk,
    /// Where the start of the file lies under `budget`, if there is one for this team.
    start: Option<StartSummary>,
    /// The controller that the file names.
    controller: Option<&'static str>,
}

/// Answers; false if no start exists.
pub(crate) fn advise(arguments: &Advise) -> Result<bool> {
    let asked = asked(arguments)?;
    let advice = match advice::advise(&asked.question) {
        Ok(advice) => advice,
        Err(error) => bail!(refused(&asked.question, &error)),
    };
    if arguments.json {
        output::say(&results::json::text(&json::advice(&asked, &advice)));
    } else {
        output::say(&words::told(&asked, &advice));
    }
    Ok(advice.fit().exists())
}

fn asked(arguments: &Advise) -> Result<Asked> {
    let file = arguments.file.as_deref().map(source::scenario).transpose()?.map(|(scenario, _)| scenario);
    if file.as_ref().is_some_and(|file| !file.teams.is_empty()) {
        bail!("the scenario has several teams ([[teams]]), allowed is one: ask for each by its numbers");
    }
    let mut question = Question::new(file.clone().unwrap_or_default());
    if let Some(dimension) = &arguments.dimension {
        question.set_dimension(if dimension == "3" { 3 } else { 2 });
    }
    if let Some(assume) = &arguments.assume {
        question.set_assume(assume);
    }
    arguments.options.fill(&mut question);
    let start = file.as_ref().and_then(|_| start(&question));
    Ok(Asked { question, talk: arguments.talk, start, controller: file.map(|file| file.controller.name()) })
}

/// Where the start of the scenario lies: its first tick under `budget`. None if there is no such start.
fn start(question: &Question) -> Option<StartSummary> {
    let scenario = Scenario { duration_s: 0.0, ..question.settled() };
    let run = world::run(&scenario, Options { without_phi: true, ..Options::default() }, &mut |_| ());
    run.ok().map(|run| run.summary.start)
}

/// What is wrong, by the name of the option.
fn refused(question: &Question, AdviceError { error, too_fast }: &AdviceError) -> String {
    let name = options::name(error.field.name());
    let Some(limits) = too_fast else {
        let why = error.field.why();
        let why = if why.is_empty() { String::new() } else { format!(" ({why})") };
        return format!("{name} is {}, allowed is {}{why}", error.value, error.allowed);
    };
    let (speed_m_s, tick_s) = (question.axis_speed_m_s(), question.scenario.tick_s());
    let moved = format!(
        "at {speed_m_s} m/s along each axis a robot moves up to {} m before its next tick, and with what is stated of errors robots out of range could meet",
        numbers::plain(question.move_max_m())
    );
    match (limits.speed_m_s, limits.tick_s) {
        (None, _) => format!(
            "{name} is {}, allowed is less than --radius less what stated errors cost: links reach {} m, and not even robots \
             that stand still fit",
            error.value, question.scenario.link.radius_m
        ),
        (Some(speed), Some(tick)) => format!(
            "{moved}: --speed is {speed_m_s}, allowed is at most {} with this tick; or --tick is {tick_s}, allowed is at most {} \
             with this speed",
            numbers::down(speed),
            numbers::down(tick)
        ),
        (Some(speed), None) => format!(
            "{moved}: --speed is {speed_m_s}, allowed is at most {} with this tick; no tick is short enough for this speed and these errors",
            numbers::down(speed)
        ),
    }
}
