//! One robot among ten others, for a program without an operating system, heap or standard library.
//!
//! `closeranks-core` is all that it needs. `scripts/bare-metal.sh` builds it for a microcontroller, says how large it is, and
//! runs it in an emulator, where it must answer with the same bits as on the machine that built it.

#![no_std]

use core::hint::black_box;
use core::time::Duration;

use closeranks_core::{
    BudgetSettings, Clock, Controller, Instant, MESSAGE_BYTES, Message, Params, RobotId, Settings, SizedRobot,
};

/// Where robots 2 to 11 stand, m. Robot 1 starts in their middle.
const OTHERS_M: [[f64; 2]; 10] = [
    [1.0, 0.0],
    [0.8, 0.6],
    [0.3, 1.0],
    [-0.3, 1.0],
    [-0.8, 0.6],
    [-1.0, 0.0],
    [-0.8, -0.6],
    [-0.3, -1.0],
    [0.3, -1.0],
    [0.8, -0.6],
];
const PERIOD: Duration = Duration::from_millis(5);
const PERIOD_S: f64 = 0.005;

/// Robot 1 of eleven, as in the paper, and its world: the others stand still, and it drives away from them.
pub struct Scene {
    robot: SizedRobot<2, 10>,
    now: Instant,
    position_m: [f64; 2],
    sequence: u32,
}

impl Scene {
    /// The start; `None` if the settings were not accepted.
    pub fn new() -> Option<Self> {
        let settings = Settings {
            controller: Controller::Budget(BudgetSettings::default()),
            clock: Clock { hold_max: Some(Duration::from_millis(6)), ..Clock::default() },
            ..Settings::default()
        };
        let robot = SizedRobot::new(Params::new(black_box(settings)).ok()?, RobotId(1), 1.0).ok()?;
        Some(Self { robot, now: Instant::START, position_m: [0.0; 2], sequence: 0 })
    }

    /// One tick in the order that `Robot` asks for; gives the velocity, m/s. What is refused is left out, as where nobody
    /// can be asked.
    pub fn tick(&mut self) -> [f64; 2] {
        self.sequence += 1;
        let _ = self.robot.sense(self.now, self.position_m);
        for (id, position_m) in (2..).zip(OTHERS_M) {
            let _ = self.robot.observe(RobotId(id), position_m);
        }
        black_box(self.robot.share().map(|message| message.encode()));
        for id in 2..=11 {
            if let Some(Ok(message)) = self.heard(id).map(|bytes| Message::parse(&black_box(bytes))) {
                let _ = self.robot.receive(RobotId(id), &message);
            }
        }
        let velocity_m_s = self.robot.tick(black_box([1.2, 0.4])).velocity_m_s;
        self.position_m = [0, 1].map(|d| self.position_m[d] + PERIOD_S * velocity_m_s[d]);
        self.now = self.now.after(PERIOD);
        velocity_m_s
    }

    /// What robot `id` tells: that it has three links more than it must, and its number as its value.
    fn heard(&self, id: u16) -> Option<[u8; MESSAGE_BYTES]> {
        let told = Message::new(self.sequence, self.now, Some(10.0), Some(f64::from(id))).ok()?;
        Some(told.encode())
    }

    /// The value on which it agrees with the others.
    pub fn value(&self) -> f64 {
        self.robot.value()
    }
}

/// Takes the bits of a number into a digest (FNV-1a, 64 bits). Begin with [`DIGEST`].
pub fn digest(digest: u64, number: f64) -> u64 {
    let mix = |digest: u64, byte: u8| (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    number.to_le_bytes().into_iter().fold(digest, mix)
}

/// The digest of no number.
pub const DIGEST: u64 = 0xcbf2_9ce4_8422_2325;

/// Ticks that are run: five seconds.
pub const TICKS: u32 = 1_000;
