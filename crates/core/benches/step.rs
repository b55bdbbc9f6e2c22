//! One robot: the program alone, the row with its program, a whole tick, a consensus round.
//!
//! `cargo bench -p closeranks-core`

mod offsets;

use closeranks_core::controller::AnyController;
use closeranks_core::equations::composition::Term;
use closeranks_core::equations::link::Link;
use closeranks_core::message::Message;
use closeranks_core::num::dot;
use closeranks_core::num::scaled::Scaled;
use closeranks_core::program::InputBox;
use closeranks_core::program::box_row::{Row, closest};
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::robot::sized::SizedRobot;
use closeranks_core::settings::params::{Params, Settings};
use closeranks_core::settings::{Controller, LinksSettings};
use closeranks_core::time::Instant;
use closeranks_core::wmsr;
use divan::{Bencher, black_box};
use offsets::OFFSETS;

fn main() {
    divan::main();
}

const BOX: InputBox<2> = InputBox::of([-1.5; 2], [1.5; 2]);

#[divan::bench]
fn program_free(bencher: Bencher<'_, '_>) {
    let row = Row { normal: [1.0, 0.4], bound: -3.0 };
    bencher.bench(|| closest(black_box(&[0.8, 0.3]), black_box(&row), black_box(&BOX)));
}

#[divan::bench]
fn program_active(bencher: Bencher<'_, '_>) {
    let row = Row { normal: [-1.3, 0.7], bound: 0.05 };
    bencher.bench(|| closest(black_box(&[0.8, 0.3]), black_box(&row), black_box(&BOX)));
}

/// The answer lies on an edge of the box, so the kinks are walked.
#[divan::bench]
fn program_active_at_an_edge(bencher: Bencher<'_, '_>) {
    let row = Row { normal: [-0.9, 1.3], bound: 2.2 };
    bencher.bench(|| closest(black_box(&[0.4, 0.9]), black_box(&row), black_box(&BOX)));
}

#[divan::bench]
fn program_infeasible(bencher: Bencher<'_, '_>) {
    let row = Row { normal: [-1.3, 0.7], bound: 4.0 };
    bencher.bench(|| closest(black_box(&[0.8, 0.3]), black_box(&row), black_box(&BOX)));
}

#[divan::bench]
fn row_and_program_of_ten_neighbours(bencher: Bencher<'_, '_>) {
    let params = Params::<2>::new(Settings::default()).expect("defaults are valid");
    let AnyController::Composed(controller) = params.controller() else { return };
    let (composed, shape) = (controller.composed, *params.link());
    let term = move |offset_m: &[f64; 2], told: f64| -> Option<Term<2>> {
        let link: Link<Scaled> = shape.link(offset_m)?;
        let collision = composed.collision_term(dot(offset_m, offset_m));
        Some(Term { offset_m: *offset_m, link, collision, told: composed.degree_term(told) })
    };
    bencher.with_inputs(|| OFFSETS).bench_values(|offsets| {
        let mut terms = [None; 10];
        for (slot, offset) in terms.iter_mut().zip(&offsets) {
            *slot = term(black_box(offset), black_box(7.2));
        }
        let own = composed.degree_term(black_box(7.1));
        let composition = composed.compose(own, terms.iter().flatten().copied());
        closest(black_box(&[1.0, 0.0]), &composition.row, &BOX)
    });
}

#[divan::bench]
fn tick_of_a_robot_with_ten_neighbours(bencher: Bencher<'_, '_>) {
    let params = Params::<2>::new(Settings::default()).expect("defaults are valid");
    let mut robot = SizedRobot::<2, 10>::new(params, RobotId(1), 0.0).expect("memory is enough");
    let mut nanos = 0;
    bencher.bench_local(|| {
        nanos += 5_000_000;
        let sequence = u32::try_from(nanos / 5_000_000).unwrap_or(u32::MAX);
        let _ = robot.sense(Instant::from_nanos(nanos), [0.0, 0.0]);
        for (id, offset) in (2..).map(RobotId).zip(OFFSETS) {
            let _ = robot.observe(id, black_box(offset));
        }
        let _ = black_box(robot.share());
        for id in (2..12).map(RobotId) {
            if let Ok(message) =
                Message::new(sequence, Instant::from_nanos(nanos), Some(black_box(7.2)), Some(1.0))
            {
                let _ = robot.receive(id, &message);
            }
        }
        robot.tick([1.0, 0.0])
    });
}

/// Eleven robots of `links` with ten neighbours each, who hand over what they tell: a step of one is an eleventh of it.
#[divan::bench]
fn tick_of_eleven_robots_of_links(bencher: Bencher<'_, '_>) {
    let controller = Controller::Links(LinksSettings::default());
    let params = Params::<2>::new(Settings { controller, ..Settings::default() }).expect("valid");
    let positions: Vec<_> = (1..).map(RobotId).zip(OFFSETS.into_iter().chain([[0.0; 2]])).collect();
    let robot =
        |(id, _): &(RobotId, _)| SizedRobot::<2, 10>::new(params, *id, 0.0).expect("memory is enough");
    let mut robots: Vec<_> = positions.iter().map(robot).collect();
    let mut nanos = 0;
    bencher.bench_local(|| {
        nanos += 5_000_000;
        for (robot, (own, position)) in robots.iter_mut().zip(&positions) {
            let _ = robot.sense(Instant::from_nanos(nanos), *position);
            for (id, other) in positions.iter().filter(|(id, _)| id != own) {
                let _ = robot.observe(*id, black_box(*other));
            }
        }
        for sender in 0..robots.len() {
            let Some(message) = robots[sender].share() else { continue };
            for receiver in (0..robots.len()).filter(|receiver| *receiver != sender) {
                if let Some(notice) = robots[sender].notice(&message, positions[receiver].0) {
                    let _ = robots[receiver].receive_notice(positions[sender].0, &notice);
                }
            }
        }
        for robot in &mut robots {
            black_box(robot.tick([1.0, 0.0]));
        }
    });
}

#[divan::bench]
fn consensus_round_of_ten_values(bencher: Bencher<'_, '_>) {
    let told = [3.0, -250.0, 40.0, 499.0, -13.0, 77.0, 0.5, -499.0, 120.0, 8.0];
    bencher.with_inputs(|| told).bench_refs(|told| wmsr::update(black_box(5.0), told, 2));
}
