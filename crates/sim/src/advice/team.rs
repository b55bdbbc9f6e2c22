//! Who counts for whom, and which F and n go together.

use closeranks_core::controller::assume::Assume;
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::settings::params::Params;
use closeranks_core::settings::range::ROBOTS_MAX;

use super::halving::last_whole;
use super::level::most;
use super::patch::Spacings;
use super::question::Question;

/// What follows from n and F.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counts {
    /// How many neighbours a robot must keep.
    pub need: u16,
    /// How many of the others count at most: all, or all but the F that are left out.
    pub counted: u16,
    /// h of a robot if all stood at one point: no start has more.
    pub h_most: f64,
    /// The largest F for this n with which some h is not negative at one point.
    pub faults_max: Option<u16>,
    /// The largest F for this n with which there is a patch with every h ≥ 0 and all robots far enough apart.
    pub faults_max_apart: Option<u16>,
    /// The least n for this F with which some h is not negative at one point.
    pub robots_min: Option<u16>,
}

impl Counts {
    pub(super) fn new<const D: usize>(question: &Question, params: &Params<D>) -> Self {
        let team = params.settings().team;
        let left_out = match question.scenario.budget.assume {
            Assume::Obedient => 0,
            Assume::Free => team.faults,
        };
        let with = |robots, faults| of_team::<D>(question, robots, faults);
        let fits = |faults| with(team.robots, faults).is_some_and(|params| most(&params) >= 0.0);
        let apart = |faults| with(team.robots, faults).is_some_and(|params| Spacings::exist(&params));
        Self {
            need: params.need().need(RobotId(1)),
            counted: params.need().counting(RobotId(1)).saturating_sub(left_out),
            h_most: most(params),
            faults_max: last_whole((team.robots - 1) / 2, fits),
            faults_max_apart: last_whole((team.robots - 1) / 2, apart),
            robots_min: robots_min::<D>(question, team.faults),
        }
    }
}

/// The least n for so many malicious robots.
///
/// From n to n + 2 every robot has two more neighbours and needs one more. So h at one point rises with all even n and with all
/// odd n if a link weighs more than a half, and falls with all of them if it weighs less.
fn robots_min<const D: usize>(question: &Question, faults: u16) -> Option<u16> {
    let least = faults.saturating_mul(2).saturating_add(1).max(2);
    let top =
        last_whole(ROBOTS_MAX, |robots| robots < least || of_team::<D>(question, robots, faults).is_some())?;
    let fits = |robots| of_team::<D>(question, robots, faults).is_some_and(|params| most(&params) >= 0.0);
    [least, least.saturating_add(1)].into_iter().filter_map(|first| first_of_its_kind(first, top, fits)).min()
}

/// The first of `first`, `first + 2`, ... up to `top` that `fits`, if from there on all do, or if it is `first`.
fn first_of_its_kind(first: u16, top: u16, fits: impl Fn(u16) -> bool) -> Option<u16> {
    let steps = top.checked_sub(first)? / 2;
    let at = |step: u16| first + 2 * step;
    if fits(first) {
        return Some(first);
    }
    let last_without = last_whole(steps, |step| !fits(at(step)))?;
    (last_without < steps).then(|| at(last_without + 1))
}

/// The settings of the same question for another team, if it may be.
fn of_team<const D: usize>(question: &Question, robots: u16, faults: u16) -> Option<Params<D>> {
    let mut asked = question.settled();
    (asked.team.robots, asked.team.faults) = (robots, faults);
    asked.params().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    /// The least n is sought by halving; here one n after another is tried.
    #[test]
    fn the_least_team_is_the_first_that_fits() {
        let mut found = 0;
        for (q2, epsilon) in [(0.3, None), (0.02, None), (0.015, None), (0.01, None), (0.3, Some(0.04))] {
            for (faults, assume) in [0, 1, 3, 7]
                .into_iter()
                .flat_map(|faults| [(faults, Assume::Obedient), (faults, Assume::Free)])
            {
                let mut question = Question::new(Scenario::default()).under(assume);
                (question.scenario.budget.q2, question.scenario.budget.epsilon) = (Some(q2), epsilon);
                let fits = |robots: &u16| {
                    of_team::<2>(&question, *robots, faults).is_some_and(|params| most(&params) >= 0.0)
                };
                let (least, first) = (robots_min::<2>(&question, faults), (2..400).find(fits));
                assert_eq!(least, first, "q2 = {q2}, F = {faults}, {assume:?}");
                found += usize::from(least.is_some());
            }
        }
        assert!((20..40).contains(&found), "{found} of 40 have an answer");
    }
}
