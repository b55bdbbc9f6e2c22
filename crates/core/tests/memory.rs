//! The sizes that README.md states are those of this build, and the smallest robots of the table are large enough.

use std::fs;

use closeranks_core::{BudgetSettings, Controller, Params, RobotId, Settings, SizedRobot};

#[path = "../examples/memory.rs"]
mod example;

#[test]
fn the_readme_has_the_table() {
    example::main();
    let Ok(readme) = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md")) else {
        return;
    };
    if cfg!(target_pointer_width = "64") {
        assert!(readme.contains(&example::table()), "README.md must have:\n{}", example::table());
    }
}

#[test]
fn the_least_rows_are_enough() {
    let controller = Controller::Budget(BudgetSettings::default());
    let params = Params::<2>::new(Settings { controller, ..Settings::default() }).unwrap();
    SizedRobot::<2, 3, 4>::new(params, RobotId(1), 1.0).unwrap();
    SizedRobot::<2, 10, 3>::new(params, RobotId(1), 1.0).unwrap();
    SizedRobot::<2, 5, 2>::new(params, RobotId(1), 1.0).unwrap_err();
}
