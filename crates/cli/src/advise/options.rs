//! The numbers of the command line: which field of a scenario each sets.

use clap::Args;
use closeranks_sim::advice::question::{Question, allowed};

/// Each option with the name of its number in files; `speed` and `lag` are in no file.
const NAMES: [(&str, &str); 11] = [
    ("--robots", "team.robots"),
    ("--faults", "team.faults"),
    ("--radius", "link.radius_m"),
    ("--q2", "controller.q2"),
    ("--distance-min", "controller.distance_min_m"),
    ("--tick", "clock.tau_1_s"),
    ("--hold", "clock.hold_max_s"),
    ("--position-error", "controller.position_error_m"),
    ("--tracking-error", "controller.tracking_error_m"),
    ("--speed", "speed"),
    ("--lag", "lag"),
];

#[derive(Args, Debug)]
#[command(allow_negative_numbers = true)]
pub(super) struct Numbers {
    /// n, how many robots there are [default: 11].
    #[arg(long, value_name = "N", value_parser = robots)]
    robots: Option<f64>,
    /// F, how many of them may be malicious [default: 2, or as many as n allows].
    #[arg(long, value_name = "F", value_parser = faults)]
    faults: Option<f64>,
    /// R, how far a link reaches [default: 3].
    #[arg(long, value_name = "M", value_parser = |text: &str| number("link.radius_m", text))]
    radius: Option<f64>,
    /// The steepness of the weight of a link, 1/m^4 [default: chosen from tick, speed and stated errors].
    #[arg(long, value_name = "Q2", value_parser = |text: &str| number("controller.q2", text))]
    q2: Option<f64>,
    /// How near two robots may come [default: 0.3].
    #[arg(long, value_name = "M", value_parser = |text: &str| number("controller.distance_min_m", text))]
    distance_min: Option<f64>,
    /// The greatest speed along each axis, m/s [default: 1.5].
    #[arg(long, value_name = "M_S", value_parser = |text: &str| number("speed", text))]
    speed: Option<f64>,
    /// How often robots move, s [default: 0.005].
    #[arg(long, value_name = "S", value_parser = |text: &str| number("clock.tau_1_s", text))]
    tick: Option<f64>,
    /// How long a velocity may be held: the tick and its jitter, s [default: the tick].
    #[arg(long, value_name = "S", value_parser = |text: &str| number("clock.hold_max_s", text))]
    hold: Option<f64>,
    /// Bound of the error of every sensed position [default: 0].
    #[arg(long, value_name = "M", value_parser = |text: &str| number("controller.position_error_m", text))]
    position_error: Option<f64>,
    /// Time constant of how bodies follow velocities, s: the tracking error is this times the greatest speed [default: 0].
    #[arg(long, value_name = "S", value_parser = |text: &str| number("lag", text), conflicts_with = "tracking_error")]
    lag: Option<f64>,
    /// Bound of how far a robot is from where its velocities would have taken it [default: 0].
    #[arg(long, value_name = "M", value_parser = |text: &str| number("controller.tracking_error_m", text))]
    tracking_error: Option<f64>,
}

impl Numbers {
    /// Sets what was given. F comes after n, which may lower it.
    pub(super) fn fill(&self, question: &mut Question) {
        let given = [
            self.robots,
            self.faults,
            self.radius,
            self.q2,
            self.distance_min,
            self.tick,
            self.hold,
            self.position_error,
            self.tracking_error,
            self.speed,
            self.lag,
        ];
        for ((_, field), value) in NAMES.into_iter().zip(given) {
            if let Some(value) = value {
                question.set(field, value);
            }
        }
    }
}

/// The option that sets a field; the field itself if there is none.
pub(super) fn name(field: &'static str) -> &'static str {
    NAMES.iter().find(|(_, name)| *name == field).map_or(field, |(option, _)| option)
}

fn robots(text: &str) -> Result<f64, String> {
    whole("team.robots", text)
}

fn faults(text: &str) -> Result<f64, String> {
    whole("team.faults", text)
}

/// A whole number that the field may be.
fn whole(field: &str, text: &str) -> Result<f64, String> {
    let number = number(field, text)?;
    if number.fract() == 0.0 { Ok(number) } else { Err("allowed is a whole number".to_owned()) }
}

/// A number that the field may be, whatever the others are.
fn number(field: &str, text: &str) -> Result<f64, String> {
    let Some(allowed) = allowed(field) else { return Err("allowed is nothing".to_owned()) };
    let number = text.parse().ok().filter(|number| allowed.holds(*number));
    number.ok_or_else(|| format!("allowed is a number, {allowed}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_option_is_a_number_of_a_scenario() {
        for (option, field) in NAMES {
            assert!(allowed(field).is_some(), "{option}");
            assert_eq!(name(field), option);
        }
    }
}
