//! What a robot was sensed at last may be wrong, and is used for a while. Two runs of the campaign in which a law was broken
//! where its assumptions held, because the robots and the monitors had different ideas of how long.

use closeranks_sim::law::Law;
use closeranks_sim::parse;
use closeranks_sim::world::{Options, run};

/// How often `law` was broken, and how often where its assumptions held.
fn broken(text: &str, law: Law) -> [u64; 2] {
    let scenario = parse::scenario(text).expect("a scenario");
    let run = run(&scenario, Options::default(), &mut |_| ()).expect("a run");
    let verdict = run.summary.verdicts.of(law);
    [verdict.count, verdict.covered]
}

/// Robot 2 was sensed well inside R while it walked away. Robot 3 counted on it for as long as it could not have left from
/// there, which was longer than a wrong sighting is excused, and said `Guaranteed` with a neighbour too few. Since robots of `links` reckon
/// with whom they do not sense (sec:unseen-links) it gives robot 2 up in time, and nothing is broken at all.
#[test]
fn a_frozen_sensor_lets_nobody_be_counted_on_for_long() {
    assert_eq!(broken(FROZEN, Law::Mode), [0, 0]);
}

/// Robot 4 was sensed well inside R when it was beyond. Robot 3 reckoned with it until it might have left, and only then said
/// that it had lost it; the monitor had expected to hear `Guaranteed` again by that time.
#[test]
fn who_reckons_with_a_robot_that_has_left_finds_out_later() {
    assert_eq!(broken(JUMP, Law::Mode), [0, 0]);
}

const JUMP: &str = "
dimension = 3
duration_s = 2.0
seed = 1249540988763734

[clock]
tau_1_s = 0.01
tau_2_s = 0.1
told_max_s = 0.5

[controller]
kind = \"links\"

[links]
gamma = 0.3892484201508202
gamma_c = 0.6002501380249909
horizon_s = 1.7442026799936796
pass = \"right\"

[sensing.jump]
by_m = 0.10595185814284035
from_s = 0.5649901776304879
robot = 4
to_s = 1.1429117406796485

[start]
distance_min_m = 0.336108123756688
half_side_m = 0.8892291839054491
kind = \"random\"

[team]
faults = 0
robots = 7
";

const FROZEN: &str = "
duration_s = 4.0
seed = 2461062560768533

[attack]
motion = \"flee\"

[attack.level]
kind = \"faces\"
max = 20.0
min = -20.0

[clock]
tau_1_s = 0.01
tau_2_s = 0.1
told_max_s = 0.5

[controller]
kind = \"links\"

[links]
gamma = 0.3843066476355417
gamma_c = 0.770808435600376
horizon_s = 7.073363194164245

[plant]
missed = 0.02

[sensing.frozen]
from_s = 0.37455189953012535
robot = 2
to_s = 1.5965527431619742

[start]
distance_min_m = 0.3767535698806702
half_side_m = 0.7558645002856798
kind = \"random\"

[team]
faults = 2
robots = 6
";
