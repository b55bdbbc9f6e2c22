//! An advice in sentences.

use closeranks_sim::advice::patch::{self, Best};
use closeranks_sim::advice::{Advice, Fit};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::start::Start;

use super::numbers::{down, given, plain, up};
use super::{Asked, tables};
use crate::wrap;

/// What every terminal, mail and README has room for.
const WIDTH: usize = 80;

fn wrapped(text: &str) -> String {
    wrap::wrapped(text, WIDTH)
}

/// Everything, in lines that a terminal has room for.
pub(super) fn told(asked: &Asked, advice: &Advice) -> String {
    let mut parts = vec![wrapped(&team(asked)), wrapped(&counting(asked, advice)), tables::fits(advice)];
    let fits: String = advice.fits.iter().map(|fit| wrapped(&spacings(asked, fit))).collect();
    parts.push(fits + &wrapped(&starting(asked, advice)));
    parts.extend(file(asked, advice).map(|text| wrapped(&text)));
    parts.push(wrapped(&asked.talk.advice(&asked.question, advice.fit().assume)));
    parts.push(wrapped(&assumption(advice)));
    parts.push(wrapped(&faults(asked, advice)));
    parts.push(wrapped(&motion(asked, advice)));
    parts.extend(costs(advice));
    parts.join("\n")
}

/// How spacings are judged.
const HOW: &str = "The start is a patch of the lattice, the places nearest to the origin. From the least to the largest spacing \
                   the share of h that is left falls from 1 to 0, and the share of the way grows from 0 to 1; most room is where \
                   both are the same.";

fn team(asked: &Asked) -> String {
    let (question, scenario) = (&asked.question, asked.question.settled());
    format!(
        "{} robots of which {} may be malicious, in {} dimensions, under the controller {}. Links reach {} m, robots stay {} m \
         apart. A robot goes up to {} m/s along each axis, {} m/s in all; its tick is {} s. {}",
        scenario.team.robots,
        scenario.team.faults,
        scenario.dimension,
        scenario.controller.name(),
        given(scenario.link.radius_m),
        given(scenario.limits.distance_min_m),
        given(question.axis_speed_m_s()),
        plain(question.speed_m_s()),
        scenario.tick_s(),
        errors(&scenario),
    )
}

/// What is stated of errors.
fn errors(scenario: &Scenario) -> String {
    let stated = [
        (scenario.errors.position_m, "m: sensed positions are wrong by at most that"),
        (
            scenario.errors.tracking_m,
            "m: robots are at most that far from where their velocities would have taken them",
        ),
        (scenario.clock.hold_max().as_secs_f64() - scenario.tick_s(), "s: ticks are late by at most that"),
    ];
    let stated = stated.iter().filter(|(bound, _)| *bound > 0.0);
    let stated: Vec<String> = stated.map(|(bound, about)| format!("{} {about}", plain(*bound))).collect();
    if stated.is_empty() {
        return "Positions, moves and ticks are exact.".to_owned();
    }
    format!("Stated errors: {}.", stated.join("; "))
}

/// 2F + 1 and n, needs and those who count.
fn counting(asked: &Asked, advice: &Advice) -> String {
    let team = asked.question.scenario.team;
    let sentence = |Fit { assume, counts, .. }: &Fit| {
        let verdict = if counts.need <= counts.counted { "can" } else { "CANNOT" };
        let (need, counted) = (counts.need, counts.counted);
        format!("Under {assume} a robot must keep {need} of the {counted} that count, which {verdict} be.")
    };
    let [obedient, free] = &advice.fits;
    let sum = 2 * u32::from(team.faults) + 1;
    format!("2F + 1 = {sum} is at most n = {}. {} {}", team.robots, sentence(obedient), sentence(free))
}

/// The spacings under one assumption, or why there are none.
fn spacings(asked: &Asked, fit: &Fit) -> String {
    let (assume, spacings, counts) = (fit.assume, &fit.spacings, &fit.counts);
    match (spacings.best, spacings.largest_m) {
        (Some(Best { spacing_m, h, share }), Some(largest_m)) => format!(
            "Under {assume} a start exists, with spacings from {} m (least h {}) to {} m (least h 0). At {} m there is most room: \
             h is {}, and both shares are {}.",
            up(spacings.least_m),
            plain(spacings.h_at_least),
            down(largest_m),
            plain(spacing_m),
            plain(h),
            plain(share),
        ),
        (_, Some(largest_m)) => format!(
            "Under {assume} there is NO such start: for every h >= 0 the spacing is allowed to be at most {} m, but robots are \
             certainly far enough apart only from {} m, where the least h is {}. A larger --radius, a smaller --distance-min, \
             smaller errors or fewer --faults help.",
            down(largest_m),
            up(spacings.least_m),
            plain(spacings.h_at_least),
        ),
        _ if counts.need > counts.counted => format!(
            "Under {assume} there is NO start: F is {}, and n = {} allows {}.",
            asked.question.scenario.team.faults,
            asked.question.scenario.team.robots,
            most(counts.faults_max),
        ),
        _ => format!(
            "Under {assume} there is NO start: even with all robots at one point h is {}, because a link of R = {} m and q2 = {} \
             weighs too little with what is stated of errors. A larger --q2 or --radius, or smaller errors, help.",
            plain(counts.h_most),
            given(asked.question.scenario.link.radius_m),
            plain(fit.link.q2),
        ),
    }
}

/// How to write the start down.
fn starting(asked: &Asked, advice: &Advice) -> String {
    let fit = advice.fit();
    let Some(best) = fit.spacings.best else {
        return format!("So no such team can start under {}, which was asked about.", fit.assume);
    };
    let scenario = &asked.question.scenario;
    match patch::start(scenario.team.robots, best.spacing_m, scenario.dimension) {
        Start::Hexagon { spacing_m } => {
            format!("{HOW} In a scenario: start = {{ kind = \"hexagon\", spacing_m = {} }}", plain(spacing_m))
        }
        _ => format!(
            "{HOW} In space that lattice is the closest packing (face-centred cubic); --json lists the positions of the start."
        ),
    }
}

/// Where the start of the file lies.
fn file(asked: &Asked, advice: &Advice) -> Option<String> {
    let (controller, link) = (asked.controller?, advice.fit().link);
    let Some(start) = &asked.start else {
        return Some("The start of the file is none for this team and dimension.".to_owned());
    };
    let place = if start.inside { "inside" } else { "OUTSIDE" };
    let scenario = asked.question.settled();
    let judged = format!(
        "The start of the file lies {place} the safe set of {}: its least h is {} by links with q2 = {} and epsilon = {}, its \
         least distance {} m. The file itself runs {controller}.",
        scenario.controller.name(),
        plain(start.h_min),
        plain(link.q2),
        plain(link.q1 - 2.0),
        plain(start.distance_min_m)
    );
    let stated_m = scenario.errors.tracking_m;
    Some(match asked.question.tracking_needed_m().filter(|needed_m| stated_m < *needed_m) {
        Some(needed_m) => format!(
            "{judged} Its robots LAG, for which a tracking error of {} m is enough; {} m is stated.",
            up(needed_m),
            plain(stated_m)
        ),
        None => judged,
    })
}

/// What each assumption asks, and what it costs.
fn assumption(advice: &Advice) -> String {
    let [obedient, free] = &advice.fits;
    let ask = "obedient asks that malicious robots move by the rules, whatever they tell; free lets them move as they like, but \
               for ramming, and tell each neighbour something else.";
    let cost = match (obedient.spacings.best, free.spacings.best) {
        (Some(one), Some(other)) => format!(
            "Both fit. free costs {} of h with most room ({} instead of {}) and {} m of the largest spacing; if nobody can make \
             sure that liars obey, take it.",
            plain(one.h - other.h),
            plain(other.h),
            plain(one.h),
            plain(obedient.spacings.largest_m.unwrap_or(0.0) - free.spacings.largest_m.unwrap_or(0.0)),
        ),
        (Some(_), None) => "Only obedient fits this team.".to_owned(),
        (None, Some(_)) => "Only free fits this team.".to_owned(),
        (None, None) => "Neither fits this team.".to_owned(),
    };
    format!("{ask} {cost}")
}

/// Which F, and which n.
fn faults(asked: &Asked, advice: &Advice) -> String {
    let team = asked.question.scenario.team;
    let sentence = |Fit { assume, counts, .. }: &Fit| {
        let apart = if counts.faults_max == counts.faults_max_apart {
            String::new()
        } else {
            format!(", with robots as far apart as here {}", most(counts.faults_max_apart))
        };
        let robots = match counts.robots_min {
            Some(robots) => format!("needs n of at least {robots}"),
            None => "is too many for any n".to_owned(),
        };
        format!(
            "Under {assume} n = {} allows {}{apart}; F = {} {robots}.",
            team.robots,
            most(counts.faults_max),
            team.faults
        )
    };
    advice.fits.iter().map(sentence).collect::<Vec<_>>().join(" ")
}

fn most(faults: Option<u16>) -> String {
    faults.map_or("no F at all".to_owned(), |faults| format!("F up to {faults}"))
}

/// The fastest speed and the longest tick.
fn motion(asked: &Asked, advice: &Advice) -> String {
    let (question, limits) = (&asked.question, &advice.limits);
    let one = |number: Option<f64>| number.map_or("none".to_owned(), down);
    format!(
        "With this tick the fastest speed is {} m/s along each axis (now {}), and with this speed the longest tick is {} s (now \
         {}): robots out of range must not meet in a tick, R - 2 rho - 4A > Delta_d, with the longest move rho = {} m. That is \
         what is safe; the longer the move, the less a robot may do in a tick.",
        one(limits.speed_m_s),
        question.axis_speed_m_s(),
        one(limits.tick_s),
        question.scenario.tick_s(),
        plain(question.move_max_m()),
    )
}

/// What stated errors cost: a table, or that there are none.
fn costs(advice: &Advice) -> Vec<String> {
    if advice.costs.len() < 2 {
        let text = "No errors are stated, so nothing is lost to them. --position-error, --lag and --hold say what they would \
                    cost.";
        return vec![wrapped(text)];
    }
    let fit = advice.fit();
    let spacing_m = fit.spacings.best.map_or(fit.spacings.least_m, |best| best.spacing_m);
    let text = format!(
        "What stated errors cost under {}, each by itself, at a spacing of {} m, where the least h is {} with nothing stated. Links \
         and distances are those of references, which is where velocities have taken robots; rows are made for moves of that \
         length.",
        fit.assume,
        plain(spacing_m),
        advice.costs.first().map_or("-".to_owned(), |cost| plain(cost.h)),
    );
    vec![wrapped(&text), tables::costs(&advice.costs)]
}
