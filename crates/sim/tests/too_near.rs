//! Two robots that start nearer to each other than robots may be: they say so, come apart by themselves, and then promise.

use closeranks_core::num::{length, subtract};
use closeranks_core::program::Outcome;
use closeranks_core::robot::report::Mode;
use closeranks_sim::parse;
use closeranks_sim::world::{Options, World};

/// Six robots who wish to rest, robots 1 and 2 of them 0.1 m apart where 0.3 m are demanded.
const NEAR: &str = "
duration_s = 4.0
[team]
robots = 6
faults = 1
malicious = []
[clock]
tau_1_s = 0.02
[start]
kind = \"listed\"
positions_m = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.8], [0.0, -0.8], [0.9, 0.5], [0.9, -0.5]]
[motion]
kind = \"hold\"
";

//= theory sec:recovery type=test
#[test]
fn who_is_too_near_moves_apart_and_says_so() {
    for controller in ["budget", "links"] {
        let scenario = parse::scenario(&format!("{NEAR}[controller]\nkind = \"{controller}\"\n")).unwrap();
        let mut world = World::<2>::new(&scenario, Options::default()).unwrap();
        let mut before_m = 0.1;
        while !world.is_over() {
            let frame = world.step();
            let [one, other] = [0, 1].map(|robot| frame.positions_m[robot]);
            let distance_m = length(&subtract(&one, &other));
            assert!(distance_m >= before_m - 1e-9, "{controller}: never nearer");
            if distance_m < 0.3 - 1e-6 {
                let says = |robot: usize| {
                    frame.outcomes[robot] == Outcome::Recovering && frame.modes[robot] != Mode::Guaranteed
                };
                assert!(says(0) && says(1), "{controller}: at {distance_m} m {:?}", frame.modes);
            }
            before_m = distance_m.min(0.3);
        }
        let frame = world.frame();
        let gap_m = (frame.positions_m[0][0] - frame.positions_m[1][0]).abs();
        assert!(gap_m > 0.3 - 1e-9, "{controller}: {gap_m}");
        assert!(frame.modes.iter().all(|mode| *mode == Mode::Guaranteed), "{controller}: {:?}", frame.modes);
        assert!(world.monitors().verdicts().iter().all(|one| one.covered == 0 || one.law.is_about_phi()));
    }
}
