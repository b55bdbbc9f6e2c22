//! A team of held links at once: the bits of [`crate::engine::fleet`] in a world in which nothing goes wrong, at a fraction of the time.
//!
//! What a robot holds of a neighbour is a [`Bond`](closeranks_core::controller::links::bond::Bond) of few bytes in one list of the whole team, and messages are a word from
//! bond to bond. Who releases whom, the rows and the closest velocity are those of a robot on its own.

pub(crate) mod lent;
mod lists;
mod piece;
mod spare;

use closeranks_core::controller::links::bond::{Moment, Voice};
use closeranks_core::controller::links::control::LinksController;
use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::num::Vector;
use closeranks_core::obstacle::Obstacle;
use closeranks_core::robot::missing::Horizon;
use closeranks_core::settings::params::Params;

use crate::attack::liars::Liars;
use crate::engine::bench::Decided;
use crate::engine::consensus::Consensus;
use crate::engine::held::lists::{Lists, Rule};
use crate::engine::held::piece::{Agreed, Desk, Scene};
use crate::engine::roster::Roster;
use crate::engine::workers::{Piece, Workers, share};
use crate::frame::Frame;
use crate::geometry::near::small;
use crate::scenario::Scenario;

/// A team whose robots tell lists of links, in a perfect network.
#[derive(Clone, Debug)]
pub struct Held<const D: usize> {
    params: Params<D>,
    team: Robots<D>,
    map: Vec<Obstacle<D>>,
    horizon: Horizon,
    consensus: Consensus,
    malicious: Vec<u16>,
    /// What each of those who compute the team needs.
    desks: Vec<Desk<D>>,
    decided: Vec<Decided<D>>,
    agreed: Vec<Agreed>,
    tick: u32,
    period_nanos: u64,
}

/// What the robots know in a tick.
#[derive(Clone, Debug)]
struct Robots<const D: usize> {
    controller: LinksController<D>,
    roster: Roster,
    moment: Moment,
    lists: Lists<D>,
    /// What each said to all when it spoke last.
    voices: Vec<Voice<D>>,
    /// Where each wanted to go in the tick before, m/s.
    wishes_m_s: Vec<Vector<D>>,
}

impl<const D: usize> Held<D> {
    /// True if all that can happen to robots with these `params` can be told in bonds: positions and moves have no errors.
    pub(crate) fn covers(params: &Params<D>) -> bool {
        let errors = params.settings().errors;
        errors.position_m == 0.0 && errors.tracking_m == 0.0
    }

    /// The team of `scenario` under `controller`, that of `params`, with initial `values`.
    #[must_use]
    pub fn new(
        scenario: &Scenario,
        params: Params<D>,
        controller: LinksController<D>,
        values: &[f64],
    ) -> Self {
        let (count, period) = (values.len(), params.settings().clock.level_period.as_nanos());
        let period_nanos = u64::try_from(period).unwrap_or(u64::MAX);
        let team = Robots {
            controller,
            roster: Roster::new(scenario, &params),
            moment: Moment::new(0, period_nanos),
            lists: Lists::new(count),
            voices: vec![Voice::SILENCE; count],
            wishes_m_s: vec![[0.0; D]; count],
        };
        let lies = scenario.malicious_mask();
        Self {
            map: scenario.obstacles.in_dimension(),
            horizon: Horizon::new(&params),
            params,
            team,
            consensus: Consensus::new(scenario, values),
            malicious: (0..count).filter(|robot| lies[*robot]).map(small).collect(),
            desks: Vec::new(),
            decided: vec![Decided::NOTHING; count],
            agreed: vec![Agreed::NOTHING; count],
            tick: 0,
            period_nanos,
        }
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars, workers: &dyn Workers) {
        self.team.moment = Moment::new(self.tick, self.period_nanos);
        liars.begin_tick(self.tick);
        self.look_and_agree(&frame.positions_m, workers);
        self.note_who_is_near(frame);
        self.team.lists.exchange(self.desks.iter_mut().flat_map(Desk::news), &self.team.moment);
        self.mark(frame);
        self.tell(frame, liars);
        self.hold_round(frame, liars);
        self.decide(frame, workers);
        self.note(frame);
        self.tick = self.tick.saturating_add(1);
    }

    /// Every robot looks around and decides whom it lists: at once where its neighbours are the same as in the tick before, which they mostly are, else
    /// once they are known.
    fn look_and_agree(&mut self, positions_m: &[Vector<D>], workers: &dyn Workers) {
        let Robots { controller, roster, lists, moment, .. } = &mut self.team;
        let (radius_m, horizon) = (self.params.link().radius_m, self.horizon);
        let rule = Rule { controller, horizon, roster, moment: *moment };
        let may_be_same = lists.look(positions_m, radius_m, &rule);
        self.agreed.iter_mut().for_each(|agreed| agreed.outdated = !may_be_same);
        let scene = Scene { positions_m, radius_m2: radius_m * radius_m, updated: false };
        if may_be_same {
            self.agree(scene, workers);
        }
        let outdated = self.agreed.iter().enumerate().filter(|(_, agreed)| agreed.outdated);
        let Robots { controller, roster, lists, moment, .. } = &mut self.team;
        let rule = Rule { controller, horizon, roster, moment: *moment };
        outdated.for_each(|(robot, _)| lists.update(robot, positions_m, &rule));
        lists.looked(positions_m, &rule);
        if self.agreed.iter().any(|agreed| agreed.outdated) {
            self.agree(Scene { updated: true, ..scene }, workers);
        }
        self.take_voices();
    }

    /// What all said, and who changed their lists.
    fn take_voices(&mut self) {
        let Self { team, agreed, .. } = self;
        for (robot, Agreed { agreement, .. }) in agreed.iter().enumerate() {
            team.voices[robot] = team.controller.voice(agreement.price_m, team.wishes_m_s[robot]);
            if agreement.changed {
                team.lists.has_changed(robot, &team.moment);
            }
        }
    }

    /// Who is near whom.
    fn note_who_is_near(&self, frame: &mut Frame<D>) {
        self.team.lists.count(&mut frame.degrees, &mut frame.missing);
        let ends: u32 = frame.degrees.iter().map(|degree| u32::from(*degree)).sum();
        frame.links = ends / 2;
    }

    /// Robots decide whom they list.
    fn agree(&mut self, scene: Scene<'_, D>, workers: &dyn Workers) {
        let Self { params, map, team, desks, agreed, .. } = self;
        let (count, each) = (agreed.len(), share(agreed.len(), workers));
        desks.resize_with(count.div_ceil(each), || Desk::new(params, count, map));
        let (mut bonds, mut deals) = team.lists.take();
        let mut rest = (&mut bonds[..], &mut deals[..]);
        let mut pieces: Vec<Piece<'_>> = Vec::new();
        let now = &*team;
        for (piece, (agreed, desk)) in agreed.chunks_mut(each).zip(&mut *desks).enumerate() {
            let first = piece * each;
            let last = first + agreed.len() - 1;
            let lines = now.lists.room(last).end - now.lists.room(first).start;
            let deals = now.lists.deal_room(last).end - now.lists.deal_room(first).start;
            let bonds = rest.0.split_off_mut(..lines).unwrap_or_default();
            let deals = rest.1.split_off_mut(..deals).unwrap_or_default();
            pieces.push(Box::new(move || now.agree_from(first, agreed, (bonds, deals), desk, scene)));
        }
        workers.run(pieces);
        team.lists.give(bonds, deals);
    }

    /// Who is counted on and who has a row, where that may have changed.
    fn mark(&mut self, frame: &mut Frame<D>) {
        let Robots { lists, moment, .. } = &mut self.team;
        for (robot, (counted, rows)) in frame.counted.iter_mut().zip(&mut frame.rows).enumerate() {
            let Some(neighbors) = lists.mark(robot, *moment) else { continue };
            counted.clear();
            rows.clear();
            for (other, [is_counted, is_active]) in neighbors {
                if is_counted {
                    counted.push(other + 1);
                }
                if is_active {
                    rows.push(other + 1);
                }
            }
        }
    }

    /// Levels, as they are and as they are told.
    fn tell(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        for (index, counted) in frame.counted.iter().enumerate() {
            let level = f64::from(small(counted.len()));
            frame.levels[index] = level;
            frame.h[index] = degree_barrier(level, self.team.roster.need(index));
            frame.told[index] = liars.level(index, level);
        }
    }

    /// A round of consensus, if one is due.
    fn hold_round(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let lists = &self.team.lists;
        if self.consensus.is_due(self.tick) {
            self.consensus.hold_around(frame, liars, |robot| lists.of(robot).sensed());
            return;
        }
        for robot in self.malicious.iter().map(|robot| usize::from(*robot)) {
            frame.values[robot] = liars.value(robot, frame.held[robot]);
        }
    }

    /// Every robot finds its velocity.
    fn decide(&mut self, frame: &mut Frame<D>, workers: &dyn Workers) {
        let Self { team, desks, agreed, decided, .. } = self;
        let each = share(decided.len(), workers);
        let (team, agreed, frame) = (&*team, &agreed[..], &*frame);
        let pieces = decided.chunks_mut(each).zip(desks).enumerate();
        let pieces = pieces.map(|(piece, (decided, desk))| -> Piece<'_> {
            Box::new(move || team.decide_from(piece * each, decided, agreed, desk, frame))
        });
        workers.run(pieces.collect());
    }

    /// Writes what became of every robot where it belongs.
    fn note(&mut self, frame: &mut Frame<D>) {
        let (input, wishes_m_s) = (self.params.settings().limits.input, &mut self.team.wishes_m_s);
        for (robot, decided) in self.decided.iter().enumerate() {
            decided.write(robot, frame);
            wishes_m_s[robot] = input.clip(&frame.asked_m_s[robot]);
            frame.phis[robot] = f64::NAN;
        }
    }
}
