//! The controller `links` as a robot runs it: its lists, its rows, the closest velocity, and its worth.

use crate::controller::assume::Assume;
use crate::controller::clearance::Clearance;
use crate::controller::links::Links;
use crate::controller::links::cut::{Among, Cuts};
use crate::controller::links::peer::{Ledger, Peer};
use crate::controller::links::rows::Beside;
use crate::controller::links::slack::Slack;
use crate::controller::{Control, Decision, Kept, Motion, Standing, View};
use crate::equations::link::LinkShape;
use crate::id::Member;
use crate::need::{Keep, Need};
use crate::num::{Vector, add_scaled};
use crate::obstacle::Obstacle;
use crate::program::InputBox;
use crate::program::balls::reach::Reach;
use crate::robot::neighbor::Slot;
use crate::robot::report::{Mode, Reason};
use crate::robot::scratch::{Needs, Scratch};
use crate::settings::{LinksSettings, Settings};
use crate::time::Instant;

/// The controller with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinksController<const D: usize> {
    /// The parameters of the rows and of the rule who releases whom.
    pub links: Links,
    reach: Reach<D>,
    pub(super) slack: Slack,
    input: InputBox<D>,
    clearance: Clearance,
    cuts: Cuts,
    hold_s: f64,
    /// A neighbour that is not sensed for more ticks than this is given up.
    unseen_max: u32,
    /// The links of the team; their weights are of no use here.
    shape: LinkShape,
}

impl<const D: usize> LinksController<D> {
    pub(crate) fn new(settings: &Settings<D>, parameters: &LinksSettings, shape: LinkShape) -> Self {
        let (errors, reach) = (settings.error_bounds(), settings.reach());
        let (keep, spare) = match parameters.assume {
            Assume::Obedient => (Keep::Neighbors, 0),
            Assume::Free => (Keep::NormalNeighbors, settings.team.faults),
        };
        let (period, hold_s) = (settings.clock.level_period, settings.clock.hold_max().as_secs_f64());
        let distance_min_m = settings.limits.distance_min_m + 2.0 * errors.away_m;
        let links = Links {
            need: settings.need(keep),
            spare,
            assume: parameters.assume,
            radius_m: Links::held_radius_m(shape.radius_m, &errors),
            sight_m: shape.radius_m + errors.offset_m,
            distance_min_m,
            distance_held_m: Links::held_distance_m(distance_min_m),
            move_max_m: reach.longest_m(),
            speed_max_m_s: reach.longest_m() / hold_s,
            gamma: parameters.gamma(period),
            gamma_c: parameters.gamma_c(period),
            errors,
            horizon_s: parameters.horizon_s,
            pass_right: parameters.pass_right,
            told_max: settings.clock.told_max,
        };
        let (input, clearance, cuts) = (settings.limits.input, Clearance::new(settings), Cuts::new(settings));
        let ticks = settings.clock.told_max.as_nanos() / period.as_nanos().max(1);
        let unseen_max = u32::try_from(ticks).unwrap_or(u32::MAX);
        let slack = Slack::new(&links, &reach);
        Self { links, reach, slack, input, clearance, cuts, hold_s, unseen_max, shape }
    }

    /// The desired velocity as the robot tells and follows it.
    fn wish(&self, view: &View<'_, D>, desired: &Vector<D>) -> Vector<D> {
        let heard = view.sensed().filter_map(|slot| {
            let told = slot.peer.told_within(view.now, self.links.told_max)?;
            Some((slot.offset_m, &told.head.wish_m_s))
        });
        self.links.turned(desired, heard)
    }

    fn decision(&self, view: &View<'_, D>, desired: &Vector<D>, scratch: &mut Scratch<'_, D>) -> Decision<D> {
        let others = view.slots.iter().map(|slot| Beside::of(slot, view.ledger.obliged));
        let others = others.chain(view.strangers.iter().map(Beside::stranger));
        let counted = view.slots.iter().filter(|slot| slot.peer.is_counted()).count();
        let (position_m, before_m_s) = (view.position_m, view.before_m_s);
        let motion = Motion { position_m, desired_m_s: self.wish(view, desired), before_m_s };
        self.decide(view.member(), counted, others, &motion, scratch)
    }

    /// Notes how much room each link has. A neighbour to which it is certainly cut is held as one that has just come into range: nothing
    /// of what was agreed with it is left.
    //= theory sec:cut-admitted
    fn look_past(&self, map: &[Obstacle<D>], ledger: &Ledger<D>, slots: &mut [Slot<D>]) {
        for slot in slots {
            let own_m = add_scaled(&slot.position_m, 1.0, &slot.offset_m);
            slot.room = Among::new(self.cuts, own_m, map).room(&slot.offset_m, slot.gone_m);
            if slot.sensed && slot.room.is_lost() {
                slot.peer = Peer::new(ledger.numbers.last());
            }
        }
    }

    /// The decision of robot `own`, which counts on so many neighbours and has these `others`. Its desired velocity is
    /// [`turned`](Links::turned) already.
    pub fn decide(
        &self,
        own: Member,
        counted: usize,
        others: impl Iterator<Item = Beside<D>>,
        motion: &Motion<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D> {
        let desired_m = motion.desired_m_s.map(|component| component * self.hold_s);
        let among = Among::new(self.cuts, motion.position_m, scratch.map);
        let mut rows = self.links.rows(others, &among, &desired_m, (self.reach, &self.slack), scratch.rows);
        self.clearance.push(&motion.position_m, scratch.map, &mut rows.program);
        self.clearance.recover(&motion.position_m, scratch.map, &mut rows);
        let moved = rows.decide(&motion.before_m_s.map(|component| component * self.hold_s));
        let velocity = moved.displacement_m.map(|component| component / self.hold_s);
        let uncounted = (counted < usize::from(self.links.keep(own))).then_some(Reason::Uncounted);
        let doubt = match moved.doubt {
            Some(Reason::Uncertain) | None => uncounted.or(moved.doubt),
            grave => grave,
        };
        Decision { velocity_m_s: self.input.clip(&velocity), outcome: moved.outcome, phi: None, doubt }
    }
}

impl<const D: usize> Control<D> for LinksController<D> {
    fn need(&self) -> &Need {
        &self.links.need
    }

    fn sight_m(&self, _radius_m: f64) -> f64 {
        self.links.sight_m
    }

    fn promises(&self) -> bool {
        true
    }

    fn kept(&self, _link: &LinkShape, _distance_min_m: f64) -> Kept {
        let Links { distance_min_m, gamma_c, errors, .. } = self.links;
        let link = LinkShape { radius_m: self.shape.radius_m - 2.0 * errors.away_m, ..self.shape };
        Kept { gamma_c, errors, ..Kept::plain(&link, distance_min_m) }
    }

    fn keep(&self, own: Member) -> u16 {
        self.links.keep(own)
    }

    fn is_obeyed(&self) -> bool {
        self.links.assume == Assume::Obedient
    }

    /// Two rows a neighbour and two for each axis. Whoever is not sensed for a while has an error, and so all corners of a cube.
    fn needs(&self, neighbors: usize) -> Needs {
        let corners = 1_usize << D.min(8);
        let rows = neighbors.saturating_mul(2).saturating_mul(corners).saturating_add(self.reach.rows());
        Needs { values: neighbors, sightings: 0, rows }
    }

    fn tells_lists(&self) -> bool {
        true
    }

    fn keeps_unseen(&self, slot: &Slot<D>) -> bool {
        let Peer { hold, vanished, inside, unseen_ticks, .. } = &slot.peer;
        *inside || ((hold.is_bound() || *vanished) && *unseen_ticks <= self.unseen_max)
    }

    /// A neighbour that was well inside when it was sensed last cannot have left in a tick.
    fn misses(&self, slot: &Slot<D>) -> bool {
        slot.peer.vanished
    }

    fn agree(
        &self,
        own: Member,
        ledger: &mut Ledger<D>,
        slots: &mut [Slot<D>],
        now: Instant,
        scratch: &mut Scratch<'_, D>,
    ) {
        if scratch.map.iter().any(|obstacle| obstacle.cuts_links) {
            self.look_past(scratch.map, ledger, slots);
        }
        self.links.agree(own, ledger, slots, now, scratch.values);
    }

    /// How many neighbours the robot counts on.
    fn level(&self, view: &View<'_, D>, _scratch: &mut Scratch<'_, D>) -> f64 {
        view.slots.iter().filter(|slot| slot.peer.is_counted()).fold(0.0, |level, _| level + 1.0)
    }

    fn alone(&self, view: &View<'_, D>, desired: &Vector<D>, scratch: &mut Scratch<'_, D>) -> Decision<D> {
        self.decision(view, desired, scratch)
    }

    /// The answer is guaranteed as long as the robot counts on enough neighbours and nothing else that it can check speaks
    /// against it.
    fn mode(&self, standing: &Standing) -> Mode {
        standing.reason.map_or(Mode::Guaranteed, Mode::Degraded)
    }
}
