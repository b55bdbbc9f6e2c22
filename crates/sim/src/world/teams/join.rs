//! What several teams know of a tick as if they were one, one team after another.

use crate::frame::{Assumptions, Frame, Presence};
use crate::monitors::truth::Truth;

/// One frame of all.
pub(super) fn frame<'a, const D: usize>(frames: impl Iterator<Item = &'a Frame<D>> + Clone) -> Frame<D> {
    let mut all = Frame::new(
        gather(frames.clone(), |frame| &frame.positions_m),
        gather(frames.clone(), |frame| &frame.values),
    );
    all.desired_m_s = gather(frames.clone(), |frame| &frame.desired_m_s);
    all.asked_m_s = gather(frames.clone(), |frame| &frame.asked_m_s);
    all.velocities_m_s = gather(frames.clone(), |frame| &frame.velocities_m_s);
    all.references_m = gather(frames.clone(), |frame| &frame.references_m);
    all.degrees = gather(frames.clone(), |frame| &frame.degrees);
    all.levels = gather(frames.clone(), |frame| &frame.levels);
    all.told = gather(frames.clone(), |frame| &frame.told);
    all.h = gather(frames.clone(), |frame| &frame.h);
    all.phis = gather(frames.clone(), |frame| &frame.phis);
    all.held = gather(frames.clone(), |frame| &frame.held);
    all.more_values = columns(&frames, |frame| &frame.more_values);
    all.more_held = columns(&frames, |frame| &frame.more_held);
    all.one_level = gather(frames.clone(), |frame| &frame.one_level);
    all.one_value = gather(frames.clone(), |frame| &frame.one_value);
    all.outcomes = gather(frames.clone(), |frame| &frame.outcomes);
    all.missing = gather(frames.clone(), |frame| &frame.missing);
    all.modes = gather(frames.clone(), |frame| &frame.modes);
    all.down = gather(frames.clone(), |frame| &frame.down);
    all.presence = presence(&frames.clone().map(|frame| &frame.presence));
    all.assumptions = assumptions(&frames.clone().map(|frame| &frame.assumptions));
    all.wants_phi = frames.clone().any(|frame| frame.wants_phi);
    all.links = frames.map(|frame| frame.links).sum();
    all
}

/// Of the true state what is shown of a tick: degrees and levels.
pub(super) fn truth<'a>(truths: impl Iterator<Item = &'a Truth> + Clone) -> Truth {
    let mut all = Truth::default();
    all.neighbors = gather(truths.clone(), |truth| &truth.neighbors);
    all.levels = gather(truths, |truth| &truth.levels);
    all
}

fn presence<'a>(all: &(impl Iterator<Item = &'a Presence> + Clone)) -> Presence {
    Presence {
        absent: gather(all.clone(), |one| &one.absent),
        unannounced: gather(all.clone(), |one| &one.unannounced),
        arrived: gather(all.clone(), |one| &one.arrived),
        dismissed: gather(all.clone(), |one| &one.dismissed),
        bereft: gather(all.clone(), |one| &one.bereft),
        changed: all.clone().any(|one| one.changed),
    }
}

fn assumptions<'a>(all: &(impl Iterator<Item = &'a Assumptions> + Clone)) -> Assumptions {
    let any = |of: fn(&Assumptions) -> bool| all.clone().any(of);
    Assumptions {
        broken: any(|one| one.broken),
        sensed_wrong: gather(all.clone(), |one| &one.sensed_wrong),
        unsensed: gather(all.clone(), |one| &one.unsensed),
        renewed: any(|one| one.renewed),
        misplaced: any(|one| one.misplaced),
        unsteady: any(|one| one.unsteady),
    }
}

fn gather<'a, O: 'a, T: Clone + 'a>(
    all: impl Iterator<Item = &'a O>,
    column: impl Fn(&'a O) -> &'a Vec<T>,
) -> Vec<T> {
    all.flat_map(|one| column(one).iter().cloned()).collect()
}

/// Numbers of values beyond the first: a list for each, of the robots of all teams.
fn columns<'a, const D: usize>(
    frames: &(impl Iterator<Item = &'a Frame<D>> + Clone),
    of: impl Fn(&'a Frame<D>) -> &'a Vec<Vec<f64>>,
) -> Vec<Vec<f64>> {
    let count = frames.clone().map(|frame| of(frame).len()).min().unwrap_or(0);
    (0..count).map(|place| gather(frames.clone(), |frame| &of(frame)[place])).collect()
}
