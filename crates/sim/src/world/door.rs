//! Who is in the plane: robots leave it, wait until there is room for them, and come.

use closeranks_core::num::{Vector, add_scaled, sqrt};
use closeranks_core::obstacle::Obstacle;
use closeranks_core::settings::params::Params;

use crate::frame::{Frame, nowhere};
use crate::geometry::squared_distance;
use crate::output::attendance::{Attendance, Refused};
use crate::plant::Bodies;
use crate::random::{Random, Stream};
use crate::scenario::Scenario;
use crate::scenario::absences::Absence;
use crate::scenario::turn::gap_m;

/// How often a place is drawn for a robot in a tick before it waits for the next.
const TRIES: u32 = 200;

/// Lets robots leave and come in a run.
#[derive(Clone, Debug)]
pub(super) struct Door<const D: usize> {
    absences: Vec<Absence>,
    random: Random,
    obstacles: Vec<Obstacle<D>>,
    starts_m: Vec<Vector<D>>,
    tick_s: f64,
    /// R, m, and how far a robot may be seen in a tick of those who move, m.
    radius_m: f64,
    reach_m: f64,
    /// How far from robots and from obstacles a robot comes, m.
    needed_m: f64,
    clear_m: f64,
    attendance: Attendance,
}

impl<const D: usize> Door<D> {
    /// For the robots of `scenario`, who start at `starts_m`.
    pub(super) fn new(scenario: &Scenario, params: &Params<D>, starts_m: &[Vector<D>]) -> Self {
        let (kept, radius_m) = (params.kept(), params.link().radius_m);
        // Both robots may be away from their references, and the one that comes may sense itself wrong.
        let unknown_m =
            if kept.errors.away_m > 0.0 { kept.errors.away_m + scenario.errors.position_m } else { 0.0 };
        Self {
            absences: scenario.absences.clone(),
            random: Random::new(scenario.seed, Stream::Arrivals),
            obstacles: scenario.obstacles.in_dimension(),
            starts_m: starts_m.to_vec(),
            tick_s: scenario.tick_s(),
            radius_m,
            reach_m: radius_m + 2.0 * params.reach().longest_m() + 2.0 * kept.errors.away_m,
            needed_m: kept.distance_min_m + unknown_m,
            clear_m: scenario.start_clearance_m::<D>(),
            attendance: Attendance::default(),
        }
    }

    /// What became of those who came and went.
    pub(super) fn attendance(&self) -> Attendance {
        self.attendance
    }

    /// Takes those out of `frame` who are not there when the run begins. Nobody notices.
    pub(super) fn open(&self, frame: &mut Frame<D>) {
        for index in 0..frame.positions_m.len() {
            if self.is_away(index, 0.0) {
                remove(index, frame);
            }
        }
    }

    /// Lets robots leave and come at the beginning of `tick`.
    pub(super) fn begin_tick(&mut self, tick: u32, frame: &mut Frame<D>, bodies: &mut Bodies<D>) {
        if self.absences.is_empty() {
            return;
        }
        frame.presence.begin_tick();
        let time_s = f64::from(tick) * self.tick_s;
        for index in 0..frame.positions_m.len() {
            match (frame.presence.absent[index], self.is_away(index, time_s)) {
                (false, true) => self.leave(index, time_s, frame),
                (true, false) => self.come(index, tick, time_s, frame, bodies),
                // Bodies that move may have taken nowhere somewhere.
                (true, true) => frame.positions_m[index] = nowhere(),
                (false, false) => {}
            }
        }
    }

    fn of(&self, index: usize) -> impl Iterator<Item = &Absence> {
        self.absences.iter().filter(move |absence| absence.spell.index() == index)
    }

    fn is_away(&self, index: usize, time_s: f64) -> bool {
        self.of(index).any(|absence| absence.spell.lasts(time_s))
    }

    fn leave(&mut self, index: usize, time_s: f64, frame: &mut Frame<D>) {
        let place_m = frame.positions_m[index];
        let near = |other: &Vector<D>| squared_distance(other, &place_m) <= self.reach_m * self.reach_m;
        for (bereft, other) in frame.presence.bereft.iter_mut().zip(&frame.positions_m) {
            *bereft |= near(other);
        }
        let silent = self.of(index).any(|absence| absence.silent && absence.spell.lasts(time_s));
        (frame.presence.unannounced[index], frame.presence.dismissed[index]) = (silent, !silent);
        frame.presence.changed = true;
        remove(index, frame);
        self.attendance.left += 1;
    }

    fn come(&mut self, index: usize, tick: u32, time_s: f64, frame: &mut Frame<D>, bodies: &mut Bodies<D>) {
        let over = self.of(index).filter(|absence| absence.spell.to_s <= time_s);
        let said_m = over.last().and_then(Absence::place_m);
        let found = match said_m {
            Some(place_m) => self.refuses(&place_m, frame).map_or(Ok(place_m), Err),
            None => self.draw(index, frame),
        };
        match found {
            Ok(place_m) => {
                frame.positions_m[index] = place_m;
                bodies.place(index, &place_m);
                frame.presence.absent[index] = false;
                frame.presence.arrived[index] = true;
                frame.presence.changed = true;
                self.attendance.arrived += 1;
            }
            Err(why) => {
                frame.positions_m[index] = nowhere();
                let robot = u16::try_from(index + 1).unwrap_or(u16::MAX);
                self.attendance.refused = self.attendance.refused.saturating_add(1);
                self.attendance.first.get_or_insert((tick, robot, why));
            }
        }
    }

    /// Why nobody can come to this place.
    fn refuses(&self, place_m: &Vector<D>, frame: &Frame<D>) -> Option<Refused> {
        for (other, x) in (1_u16..).zip(&frame.positions_m) {
            let distance_m = sqrt(squared_distance(x, place_m));
            if distance_m < self.needed_m {
                return Some(Refused::Robot { other, distance_m, needed_m: self.needed_m });
            }
        }
        let apart = frame.strangers.positions_m.iter().map(|x| sqrt(squared_distance(x, place_m)));
        if let Some(distance_m) = apart.into_iter().find(|apart_m| *apart_m < self.needed_m) {
            return Some(Refused::Stranger { distance_m, needed_m: self.needed_m });
        }
        let gaps = self.obstacles.iter().map(|one| gap_m(one, place_m));
        let distance_m = gaps.fold(f64::INFINITY, f64::min);
        (distance_m < self.clear_m).then_some(Refused::Obstacle { distance_m, needed_m: self.clear_m })
    }

    /// A place within range of somebody, evenly around one who is drawn; the place of the start if nobody is there.
    fn draw(&mut self, index: usize, frame: &Frame<D>) -> Result<Vector<D>, Refused> {
        let there: Vec<Vector<D>> = frame.positions_m.iter().filter(|x| !x[0].is_nan()).copied().collect();
        if there.is_empty() {
            let start_m = self.starts_m[index];
            return self.refuses(&start_m, frame).map_or(Ok(start_m), Err);
        }
        for _ in 0..TRIES {
            let who = usize::try_from(self.random.below(there.len() as u64)).unwrap_or(0);
            let place_m = add_scaled(&there[who], self.radius_m, &self.random.in_ball());
            if self.refuses(&place_m, frame).is_none() {
                return Ok(place_m);
            }
        }
        Err(Refused::NoPlace)
    }
}

/// Takes the body of a robot away.
fn remove<const D: usize>(index: usize, frame: &mut Frame<D>) {
    frame.presence.absent[index] = true;
    frame.positions_m[index] = nowhere();
    frame.references_m[index] = nowhere();
    frame.velocities_m_s[index] = [0.0; D];
}
