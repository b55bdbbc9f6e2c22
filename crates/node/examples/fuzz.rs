//! Looks for bytes that break what must hold for whatever comes from the network, for as long as one has, and counts what was tried in
//! `fuzz/executions.txt`.
//!
//! ```text
//! cargo run --release --example fuzz -- 60 node_envelope node_report node_look node_proof ros_pose ros_odometry ros_twist
//! ```
//!
//! The time in seconds is for each target. There are no files: changed are bytes that robots write.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program for a terminal")]

use std::process::ExitCode;

use closeranks_core::{Instant, Mode, Outcome, RobotId};
use closeranks_mcap::cdr::Writer;
use closeranks_node::ros::messages::{
    Pose, Twist, read_odometry, read_pose_stamped, read_twist, twist, twist_stamped,
};
use closeranks_node::wire::envelope::{ECHOES_MAX, Echo, Envelope, Letter, Purpose};
use closeranks_node::wire::proof::Proof;
use closeranks_node::wire::report::Report;
use closeranks_node::wire::sensed::Sensed;
use ed25519_dalek::SigningKey;
use spend::{arguments, spend};

#[expect(dead_code, reason = "bytes are made here, not read from files")]
#[path = "../../checks/tests/mutated/mod.rs"]
mod mutated;
#[path = "../../core/tests/seeded/mod.rs"]
mod seeded;
#[path = "../../checks/tests/mutated/spend.rs"]
mod spend;

type Files = Vec<(String, Vec<u8>)>;
type Target = (&'static str, Files, fn(&[u8]));

fn main() -> ExitCode {
    let Some((time, targets)) = arguments() else {
        eprintln!(
            "a number of seconds and one or more targets are needed: fuzz 60 node_envelope ros_odometry"
        );
        return ExitCode::from(2);
    };
    let all = all();
    for target in &targets {
        let Some((name, files, check)) = all.iter().find(|(name, _, _)| name == target) else {
            let names: Vec<&str> = all.iter().map(|(name, _, _)| *name).collect();
            eprintln!("no target is called `{target}`, allowed are {}", names.join(", "));
            return ExitCode::from(2);
        };
        if !spend(name, files, check, time) {
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

fn all() -> [Target; 7] {
    let (look, report) = (look().encode(), report().encode());
    let [first, second, bare] =
        [(Purpose::Report, &report[..], 3), (Purpose::Sensed, &look, 1), (Purpose::Say, b"hello", 0)]
            .map(|(purpose, payload, echoes)| envelope(purpose, payload, echoes));
    let proof = Proof { first: first.clone(), second: second.clone() }.encode();
    let files = |all: &[&[u8]]| -> Files {
        all.iter().enumerate().map(|(number, bytes)| (format!("seed {number}"), bytes.to_vec())).collect()
    };
    let twists = [twist(&Twist::default()), twist_stamped(5, "base_link", &Twist::default())];
    [
        ("node_envelope", files(&[&first, &second, &bare]), check_envelope),
        ("node_report", files(&[&report, &look]), check_report),
        ("node_look", files(&[&look, &report]), check_look),
        ("node_proof", files(&[&proof, &first]), check_proof),
        ("ros_pose", files(&[&pose_stamped(), &odometry()]), check_pose),
        ("ros_odometry", files(&[&odometry(), &pose_stamped()]), check_odometry),
        ("ros_twist", files(&[&twists[0], &twists[1], &odometry()]), check_twist),
    ]
}

fn look() -> Sensed<2> {
    let others = (1..6).map(|id| (RobotId(id), [f64::from(id), -0.5])).collect();
    Sensed { at: Instant::from_nanos(7), own_m: [1.0, -2.0], others }
}

fn report() -> Report<2> {
    Report {
        at: Instant::from_nanos(7),
        velocity_m_s: [0.5, 0.25],
        desired_m_s: [1.0, 0.0],
        reference_m: [0.0, 2.0],
        began_anew: true,
        mode: Mode::Guaranteed,
        outcome: Outcome::Active,
        degree: 8,
        degree_margin: 1,
        level: 7.5,
        told: 7.0,
        h: 0.5,
        value: 500.0,
        held: 499.0,
        heard: vec![RobotId(2), RobotId(3)],
        counted: vec![RobotId(2)],
        rows: vec![RobotId(2), RobotId(4), RobotId(5)],
        told_age_ms: 10,
        missed: 1,
        busy_us: 80,
        rejects: Default::default(),
    }
}

fn envelope(purpose: Purpose, payload: &[u8], echoes: u16) -> Vec<u8> {
    let echoes: Vec<Echo> =
        (0..echoes).map(|id| Echo { id: RobotId(id), epoch: 1, sequence: 9, hash: [3; 16] }).collect();
    let letter = Letter {
        purpose,
        id: RobotId(1),
        epoch: 2,
        sequence: 3,
        sent: Instant::from_nanos(9),
        payload,
        echoes: &echoes,
    };
    letter.seal(&[5; 32], &SigningKey::from_bytes(&[7; 32])).unwrap_or_default()
}

fn pose_stamped() -> Vec<u8> {
    let mut writer = Writer::default();
    writer.header(1_000_000_002, "map");
    writer.doubles(&[1.0, -2.0, 0.5, 0.0, 0.0, 0.6, 0.8]);
    writer.end()
}

fn odometry() -> Vec<u8> {
    let mut writer = Writer::default();
    writer.header(1_000_000_002, "odom");
    writer.text("base_link");
    writer.doubles(&[1.0, -2.0, 0.5, 0.0, 0.0, 0.6, 0.8]);
    writer.doubles(&[0.0; 78]);
    writer.end()
}

/// An envelope is the bytes that it came in, and has no more echoes than may be.
fn check_envelope(bytes: &[u8]) {
    let Some(envelope) = Envelope::parse(bytes) else { return };
    assert_eq!(envelope.bytes(), bytes);
    assert!(envelope.echoes().count() <= ECHOES_MAX && envelope.payload.len() <= bytes.len());
}

/// What is read is written in the same bytes, in two and in three dimensions.
fn check_report(bytes: &[u8]) {
    if let Some(report) = Report::<2>::parse(bytes) {
        assert_eq!(report.encode(), bytes);
    }
    if let Some(report) = Report::<3>::parse(bytes) {
        assert_eq!(report.encode(), bytes);
    }
}

fn check_look(bytes: &[u8]) {
    if let Some(look) = Sensed::<2>::parse(bytes) {
        assert_eq!(look.encode(), bytes);
    }
    if let Some(look) = Sensed::<3>::parse(bytes) {
        assert_eq!(look.encode(), bytes);
    }
}

fn check_proof(bytes: &[u8]) {
    if let Ok(proof) = Proof::parse(bytes) {
        assert_eq!(proof.encode(), bytes);
    }
}

/// A pose has finite numbers, and its orientation is a rotation.
fn check(pose: &Pose) {
    let square: f64 = pose.orientation.iter().map(|part| part * part).sum();
    assert!(pose.position_m.iter().all(|part| part.is_finite()) && (square - 1.0).abs() < 1e-3, "{pose:?}");
}

fn check_pose(bytes: &[u8]) {
    if let Some((_, pose)) = read_pose_stamped(bytes) {
        check(&pose);
    }
}

fn check_odometry(bytes: &[u8]) {
    if let Some((_, pose)) = read_odometry(bytes) {
        check(&pose);
    }
}

/// What is read of a twist is written in the same bytes if there is no header to lose.
fn check_twist(bytes: &[u8]) {
    if let Some(read) = read_twist(bytes, false) {
        assert!(read.linear_m_s.iter().chain(&read.angular_rad_s).all(|part| part.is_finite()));
        assert_eq!(read_twist(&twist(&read), false), Some(read));
    }
    if let Some(read) = read_twist(bytes, true) {
        assert_eq!(read_twist(&twist_stamped(0, "", &read), true), Some(read));
    }
}
