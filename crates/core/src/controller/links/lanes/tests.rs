//! A robot of sixteen worlds at once against the same robot of each.

use super::*;
use crate::controller::links::bond::{Bond, Look, NEVER, Said, Voice};
use crate::controller::links::line::Line;
use crate::id::{Member, RobotId};
use crate::settings::params::Params;
use crate::settings::{Controller, LinksSettings, Settings, Team};

const OTHERS: usize = 7;
const TICK: u32 = 40;
const PERIOD_NANOS: u64 = 50_000_000;

/// Numbers that follow from a seed.
struct Draw(u64);

impl Draw {
    fn below(&mut self, most: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        u32::try_from((self.0 >> 33) % u64::from(most)).unwrap()
    }

    fn chance(&mut self, percent: u32) -> bool {
        self.below(100) < percent
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * f64::from(self.below(1_000_000)) / 1e6
    }

    fn vector(&mut self, most: f64) -> Vector<2> {
        [self.between(-most, most), self.between(-most, most)]
    }

    /// Often nothing, else a time that may be over in this tick.
    fn time_s(&mut self, most_s: f64) -> f64 {
        match self.below(4) {
            0 => self.between(0.0, most_s),
            1 => self.between(0.0, 0.1),
            _ => 0.0,
        }
    }

    fn voice(&mut self, controller: &LinksController<2>) -> Voice<2> {
        let price_m = match self.below(4) {
            0 => f64::INFINITY,
            1 => self.between(0.0, 9.0),
            _ => 0.0,
        };
        controller.voice(price_m, self.vector(2.0))
    }

    fn deal(&mut self) -> Deal {
        Deal {
            released: self.chance(30),
            unused_s: self.between(0.0, 3.1),
            lapsed_s: self.time_s(20.0),
            barred_s: self.time_s(4.0),
            bar_s: [0.0, 2.0, 4.0, 1_000.0][self.below(4) as usize],
            waiting_ticks: if self.chance(80) { 0 } else { u16::try_from(self.below(13)).unwrap() },
        }
    }

    fn bond(&mut self, promised: bool) -> Bond {
        let born = TICK - 1 - self.below(3);
        let listed = if self.chance(70) { born + self.below(TICK - born) } else { NEVER };
        let their = Said { listed: self.chance(70), promised: self.chance(80) };
        Bond { born, listed, held: listed != NEVER && self.chance(80), promised, their }
    }
}

/// What a robot of one world holds of all others, at these offsets (m), and what they told.
#[derive(Clone)]
struct World {
    wish_m_s: Vector<2>,
    offsets_m: [Vector<2>; OTHERS],
    held: [(Bond, Deal); OTHERS],
    voices: [Voice<2>; OTHERS],
}

impl World {
    fn drawn(draw: &mut Draw, controller: &LinksController<2>) -> Self {
        let radius_m = controller.links.radius_m;
        // Of some worlds all offsets are alike, so that keys are equal.
        let alike = draw.chance(10).then(|| draw.vector(0.6 * radius_m));
        let held = |draw: &mut Draw| {
            let promised = draw.chance(80);
            (draw.bond(promised), draw.deal())
        };
        Self {
            wish_m_s: draw.vector(1.5),
            offsets_m: core::array::from_fn(|_| alike.unwrap_or_else(|| draw.vector(0.7 * radius_m))),
            held: core::array::from_fn(|_| held(draw)),
            voices: core::array::from_fn(|_| {
                if alike.is_some() { controller.voice(0.0, [0.0; 2]) } else { draw.voice(controller) }
            }),
        }
    }

    fn lines(&mut self, moment: &Moment, looks: [Look; OTHERS]) -> [Line<'_, 2>; OTHERS] {
        let mut held = self.held.iter_mut().zip(&self.offsets_m).zip(&self.voices).zip(2..);
        looks.map(|look| {
            let ((((bond, deal), offset_m), voice), number) = held.next().unwrap();
            Line::new((member(number), true), *offset_m, (bond, deal), voice, None, moment).looked_at(look)
        })
    }
}

fn member(number: u16) -> Member {
    Member { id: RobotId(number), rank: 0 }
}

fn controller() -> LinksController<2> {
    let team = Team { robots: 8, faults: 1 };
    let settings =
        Settings { team, controller: Controller::Links(LinksSettings::default()), ..Settings::default() };
    Params::new(settings).unwrap().controller().lists().unwrap()
}

/// Lets the robot of every world agree, all side by side, and gives their prices.
fn agree(controller: &LinksController<2>, moment: Moment, worlds: &mut [World; LANES]) -> Lane {
    let (time, keep) = (MomentInLanes::new(moment).unwrap(), controller.links.keep(member(1)));
    let vectors = |of: &dyn Fn(&World) -> Vector<2>| -> [Lane; 2] {
        core::array::from_fn(|d| core::array::from_fn(|k| of(&worlds[k])[d]))
    };
    let (own_m, wishes_m_s) = ([[0.0; LANES]; 2], vectors(&|world| world.wish_m_s));
    let mut pairs = [PairInLanes::NONE; OTHERS];
    let (mut ends, mut looks) = ([EndInLanes::NONE; OTHERS], [LookInLanes::NOTHING; OTHERS]);
    let (mut says, mut hears) = ([SaidInLanes::NOTHING; OTHERS], [SaidInLanes::NOTHING; OTHERS]);
    let mut turn = TurnInLanes::NOTHING;
    for other in 0..OTHERS {
        // Whoever is at the origin sees another one at the opposite of its offset.
        let other_m = vectors(&|world| world.offsets_m[other].map(|x| -x));
        let told_m_s = vectors(&|world| controller.capped(&world.voices[other].wish_m_s));
        let prices_m = core::array::from_fn(|k| worlds[k].voices[other].price_m);
        let mut changed = [0.0; LANES];
        pairs[other].measure(&own_m, &other_m, 1e9, &mut changed);
        assert_eq!(changed, [1.0; LANES]);
        for (k, world) in worlds.iter().enumerate() {
            let (bond, deal) = &world.held[other];
            (pairs[other].sensed[k], pairs[other].born[k]) = (1.0, f64::from(bond.born));
            ends[other].put(k, bond, deal);
            says[other].put(k, bond.said());
            hears[other].put(k, bond.heard());
        }
        let facing = Facing {
            pair: &pairs[other],
            own_m: &own_m,
            other_m: &other_m,
            wishes_m_s: &wishes_m_s,
            voice: &VoiceInLanes { prices_m, wishes_m_s: told_m_s },
            said: [&says[other], &hears[other]],
        };
        controller.look_in_lanes(&time, &facing, &mut ends[other], &mut looks[other], &mut turn);
    }
    let prices_m = controller.promise_in_lanes(keep, &turn, &mut looks, &mut says);
    for other in 0..OTHERS {
        let held = (&ends[other], &hears[other]);
        controller.note_events_in_lanes(keep, &pairs[other], held, &looks[other], &mut turn);
    }
    for (k, world) in worlds.iter_mut().enumerate() {
        let mut seen = [Look::default(); OTHERS];
        for (other, (held, seen)) in world.held.iter_mut().zip(&mut seen).enumerate() {
            let said = [&says[other], &hears[other]];
            let (bond, deal, look) = ends[other].line(k, pairs[other].born[k], said, &looks[other]);
            (*held, *seen) = ((bond, deal), look);
        }
        if is_so(turn.eventful[k]) {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small sum of ones"
            )]
            let counted = turn.counted[k] as usize;
            controller.part_at_once(member(1), &moment, &mut world.lines(&moment, seen), counted);
        }
    }
    prices_m
}

#[test]
fn a_robot_of_many_worlds_agrees_as_it_does_in_each() {
    let (controller, draw) = (controller(), &mut Draw(7));
    let moment = Moment::new(TICK, PERIOD_NANOS);
    let (mut promised, mut changed, mut priced) = (0, 0, 0);
    for round in 0..400 {
        let drawn: [World; LANES] = core::array::from_fn(|_| World::drawn(draw, &controller));
        let mut together = drawn.clone();
        let prices_m = agree(&controller, moment, &mut together);
        for (k, (mut alone, together)) in drawn.clone().into_iter().zip(&together).enumerate() {
            let wish_m_s = alone.wish_m_s;
            let (lines, values) =
                (&mut alone.lines(&moment, [Look::default(); OTHERS])[..], &mut [0.0; OTHERS][..]);
            let agreed = controller.agree_at_once(member(1), &moment, &wish_m_s, (lines, values), |_| {});
            let price_m = agreed.price_m;
            assert_eq!(price_m.to_bits(), prices_m[k].to_bits(), "round {round}, world {k}");
            assert_eq!(alone.held, together.held, "{round}, {k}");
            promised += alone.held.iter().filter(|(bond, _)| bond.promised).count();
            let lists = |world: &World| world.held.map(|(bond, _)| bond.listed);
            changed += usize::from(lists(&alone) != lists(&drawn[k]));
            priced += usize::from(price_m > 0.0 && price_m.is_finite());
        }
    }
    assert!(promised > 3_000 && changed > 1_000 && priced > 100, "{promised} {changed} {priced}");
}
