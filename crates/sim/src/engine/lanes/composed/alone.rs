//! A robot whose numbers are of no usual size: its sums are added up as it does on its own, and it decides by itself.

use closeranks_core::controller::composed::ComposedController;
use closeranks_core::controller::{AtOnce, Decision, Motion, Neighbor, Own};
use closeranks_core::equations::link::Link;
use closeranks_core::num::{dot, subtract};
use closeranks_core::robot::scratch::Scratch;

use crate::engine::roster::Roster;
use crate::frame::Frame;

/// The decision of `robot` in `frame`, in which levels were told.
#[cold]
pub(super) fn decide<const D: usize>(
    controller: &ComposedController<D>,
    robot: usize,
    roster: &Roster,
    frame: &Frame<D>,
    scratch: &mut Scratch<'_, D>,
) -> Decision<D> {
    let position_m = frame.positions_m[robot];
    let offset_m = |other: usize| subtract(&position_m, &frame.positions_m[other]);
    let link = |other: usize| -> Option<Link<f64>> {
        let offset_m = offset_m(other);
        controller.link().link_at(dot(&offset_m, &offset_m))
    };
    let others = (0..frame.told.len()).filter(|other| *other != robot && link(*other).is_some());
    let told = controller.told(Some(frame.told[robot]));
    let mut sums = controller.sums(&told);
    for other in others.clone() {
        let heard = controller.told(Some(frame.told[other]));
        controller.hear(&mut sums, &heard);
        let pair = link(other).and_then(|link| controller.pair(&offset_m(other), &link));
        if let Some(pair) = pair {
            controller.add(&mut sums, &offset_m(other), &pair, [&told, &heard]);
        }
    }
    let neighbors = others.map(|other| Neighbor {
        member: roster.member(other),
        offset_m: offset_m(other),
        pair: None,
        known: Some(frame.told[other]),
    });
    let (level, told_level, degree) = (frame.levels[robot], frame.told[robot], frame.degrees[robot]);
    let own = Own { member: roster.member(robot), level, told_level, degree };
    let motion =
        Motion { position_m, desired_m_s: frame.asked_m_s[robot], before_m_s: frame.velocities_m_s[robot] };
    controller.decide(&own, &sums, neighbors, &motion, scratch)
}
