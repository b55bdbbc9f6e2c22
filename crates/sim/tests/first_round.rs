//! A run of `scenarios/campaign-ranks.toml` in which values came closer by less than the monitor demanded. Two faults of the world's own
//! account: after rounds in which too little was heard it reckoned with the values used in rounds before, of which there were none, and
//! so with a mean of one value; and it took liars that change bits of their lists at random for liars with one voice, although
//! those bits may be those of a value, for each neighbour others.

use closeranks_sim::law::Law;
use closeranks_sim::parse;
use closeranks_sim::world::{Options, run};

#[test]
fn values_need_not_come_closer_than_means_of_what_was_heard_in_the_round() {
    let scenario = parse::scenario(GARBLED).expect("a scenario");
    assert!(!scenario.attack.has_one_voice());
    let run = run(&scenario, Options::default(), &mut |_| ()).expect("a run");
    assert_eq!(run.summary.verdicts.of(Law::Agreement).covered, 0);
}

const GARBLED: &str = r#"
dimension = 3
duration_s = 4.0
name = "campaign-ranks"
seed = 6952027638819888

[attack]
motion = "obedient"

[attack.level]
bias = 1.916143032569785
kind = "bias"

[attack.lists]
kind = "garbage"

[attack.value]
kind = "random"

[clock]
error_s = 0.06
hold_max_s = 0.011
tau_1_s = 0.01
tau_2_s = 0.1

[controller]
assume = "obedient"
kind = "links"
position_error_m = 0.0

[link]
radius_m = 2.761765711315441

[links]
gamma = 0.030177694717823087
gamma_c = 0.7487553539252011
horizon_s = 2.2749857189130447
pass = "none"

[motion]
kind = "paper"

[network]
burst_begin = 0.02
burst_end = 0.21905373038089354

[start]
distance_min_m = 0.39318935393585935
half_side_m = 1.098396121948517
kind = "random"

[team]
faults = 2
robots = 7

[team.malicious]
local = 2

[team.ranks]
core = 7
kind = "own"
listen = "counted"
"#;
