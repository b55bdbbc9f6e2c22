//! What robots decide on in a tick, and what is noted of them in its frame.

use closeranks_core::equations::composition::Composed;
use closeranks_core::num::dot;
use closeranks_core::program::Outcome;
use closeranks_core::robot::Robot;
use closeranks_core::robot::neighbor::Slot;
use closeranks_core::robot::report::Mode;

use crate::attack::liars::Liars;
use crate::engine::fleet::Fleet;
use crate::faults::outages::Downtime;
use crate::frame::Frame;
use crate::transport::Transport;

impl<const D: usize, T: Transport> Fleet<D, T> {
    pub(super) fn control(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let input = self.params.settings().limits.input;
        let mut scratch = self.memory.lend();
        let (mut ends, tells): (u32, bool) = (0, self.params.tells_paper_levels());
        for (index, robot) in self.robots.iter_mut().enumerate() {
            if frame.presence.absent[index] {
                vanish(index, frame);
                continue;
            }
            if self.edges.downtime.down(index) {
                stand(index, frame, &self.edges.downtime);
                continue;
            }
            let output = robot.tick(frame.asked_m_s[index], &mut scratch);
            frame.velocities_m_s[index] = match liars.velocity(index, &frame.positions_m, &input) {
                Some(velocity) => velocity,
                None => output.velocity_m_s,
            };
            frame.degrees[index] = output.report.degree;
            frame.levels[index] = if self.lists {
                output.report.level
            } else {
                let counted = robot.neighbors().iter().filter(|slot| robot.counts(slot));
                counted.fold(0.0, |level, slot| level + slot.link().weight)
            };
            frame.h[index] = output.report.h;
            frame.told[index] = robot.told_level();
            frame.phis[index] = match output.report.phi {
                Some(phi) => phi,
                None if frame.wants_phi && tells => phi(robot, &self.composed),
                None => f64::NAN,
            };
            frame.outcomes[index] = output.report.outcome;
            frame.missing[index] = robot.misses_somebody();
            frame.modes[index] = output.report.mode;
            frame.values[index] = liars.value(index, robot.value());
            frame.held[index] = robot.value();
            if self.lists {
                frame.counted[index].clear();
                frame.counted[index].extend(robot.counted().map(|id| id.0));
                frame.rows[index].clear();
                frame.rows[index].extend(robot.keeps_rows_for().map(|id| id.0));
            }
            ends += u32::from(output.report.degree);
            if output.report.round.is_some() {
                let [counted, [all, liars]] = heard(robot, &self.malicious);
                // A robot whose clock differs may end two rounds of its own in one of the world.
                let [all_before, liars_before] = frame.listened[index];
                frame.heard[index] = counted;
                frame.listened[index] = [all.max(all_before), liars.max(liars_before)];
            }
        }
        frame.links = ends / 2;
    }
}

/// What is known of a robot that is down: how it moves. It has no φ_i and solves no program; the rest stays as it was.
fn stand<const D: usize>(index: usize, frame: &mut Frame<D>, downtime: &Downtime) {
    frame.velocities_m_s[index] = downtime.without_command(index, frame.velocities_m_s[index]);
    frame.missing[index] = false;
    frame.modes[index] = Mode::Stopped;
    frame.outcomes[index] = Outcome::Free;
    frame.phis[index] = f64::NAN;
}

/// Of a robot that is not there nothing is known.
fn vanish<const D: usize>(index: usize, frame: &mut Frame<D>) {
    frame.velocities_m_s[index] = [0.0; D];
    (frame.degrees[index], frame.missing[index]) = (0, false);
    for numbers in [&mut frame.levels, &mut frame.told, &mut frame.h, &mut frame.phis] {
        numbers[index] = f64::NAN;
    }
    (frame.values[index], frame.held[index]) = (f64::NAN, f64::NAN);
    frame.outcomes[index] = Outcome::Free;
    frame.modes[index] = Mode::Stopped;
    (frame.heard[index], frame.listened[index]) = ([0; 2], [0; 2]);
    frame.counted[index].clear();
    frame.rows[index].clear();
}

/// φ_i of a robot whose controller does not use it, from what it senses and was told.
fn phi<const D: usize>(robot: &Robot<D, Vec<Slot<D>>>, composed: &Composed) -> f64 {
    let slots = || robot.neighbors().iter();
    let distances_m2 = slots().map(|slot| dot(&slot.offset_m(), &slot.offset_m()));
    composed.phi(robot.told_level(), slots().filter_map(Slot::told_level), distances_m2)
}

/// How many values of robots that count for it a robot used in its round, and how many of them were those of normal robots; and how
/// many values it used at all, and how many of them were those of malicious robots.
fn heard<const D: usize>(robot: &Robot<D, Vec<Slot<D>>>, malicious: &[bool]) -> [[u16; 2]; 2] {
    let spoke = robot.neighbors().iter().filter(|slot| slot.told_value().is_some() && robot.listens_to(slot));
    let [mut counted, mut normal, mut all, mut liars] = [0; 4];
    for slot in spoke {
        let (counts, lies) = (robot.counts(slot), malicious[usize::from(slot.id().0) - 1]);
        all += 1;
        counted += u16::from(counts);
        normal += u16::from(counts && !lies);
        liars += u16::from(lies);
    }
    [[counted, normal], [all, liars]]
}
