//! One robot for up to ten neighbours in a program without an operating system, heap or standard library.
//!
//! It shows that `closeranks-core` is all that such a program needs, and the linker says how large it is:
//! `scripts/bare-metal.sh`. The functions at the end stand for the parts of a real board. Their arguments and answers pass
//! through `black_box`, so the compiler cannot compute anything in advance.

#![no_std]
#![no_main]

use core::hint::black_box;
use core::panic::PanicInfo;
use core::time::Duration;

use closeranks_core::{
    BudgetSettings, Clock, Controller, Instant, MESSAGE_BYTES, Message, Params, RobotId, Settings,
    SizedRobot,
};

/// The team of the paper: eleven robots in the plane, so ten neighbours at most.
type Robot = SizedRobot<2, 10>;

/// Where the program begins. A board would set up its memory and its clock first.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    if let Some(mut robot) = robot() {
        loop {
            step(&mut robot);
        }
    }
    stop()
}

fn robot() -> Option<Robot> {
    let settings = Settings {
        controller: Controller::Budget(BudgetSettings::default()),
        clock: Clock { hold_max: Some(Duration::from_millis(6)), ..Clock::default() },
        ..Settings::default()
    };
    Robot::new(Params::new(black_box(settings)).ok()?, RobotId(black_box(1)), black_box(1.0)).ok()
}

/// One tick in the order that `Robot` asks for. What is refused is left out, as on a board that cannot ask anybody.
fn step(robot: &mut Robot) {
    let _ = robot.sense(now(), position(0));
    for id in 2..=11 {
        let _ = robot.observe(RobotId(id), position(id));
    }
    if let Some(message) = robot.share() {
        send(&message.encode());
    }
    for id in 2..=11 {
        if let Ok(message) = Message::parse(&received(id)) {
            let _ = robot.receive(RobotId(id), &message);
        }
    }
    drive(robot.tick(desired()).velocity_m_s);
}

fn now() -> Instant {
    Instant::from_nanos(black_box(0))
}

fn position(robot: u16) -> [f64; 2] {
    black_box([f64::from(robot), 0.0])
}

fn desired() -> [f64; 2] {
    black_box([1.0, 0.0])
}

fn received(sender: u16) -> [u8; MESSAGE_BYTES] {
    black_box([sender.to_le_bytes()[0]; MESSAGE_BYTES])
}

fn send(bytes: &[u8; MESSAGE_BYTES]) {
    black_box(bytes);
}

fn drive(velocity_m_s: [f64; 2]) {
    black_box(velocity_m_s);
}

fn stop() -> ! {
    loop {
        core::hint::spin_loop();
    }
}

/// A board would stop its motors here. The core itself has no input on which it panics.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    stop()
}
