//! The table of all numbers: each is what it was set to, and belongs to some controller.

use closeranks_core::settings::field::TABLE;
use closeranks_core::settings::{BudgetSettings, Controller, LinksSettings, Settings};

#[test]
fn what_is_set_is_what_one_gets() {
    for row in &TABLE {
        let controllers = [
            Controller::default(),
            Controller::Budget(BudgetSettings::default()),
            Controller::Links(LinksSettings::default()),
        ];
        let mut found = 0;
        for controller in controllers {
            let mut settings = Settings::<2> { controller, ..Settings::default() };
            let mut parts = settings.parts(3.0);
            (row.set)(&mut parts, 4.0);
            if let Some(value) = (row.get)(&parts) {
                assert!((value - 4.0).abs() < 1e-12, "{}", row.name);
                found += 1;
            }
        }
        assert!(found > 0, "{} belongs to no controller", row.name);
        assert_eq!(row.field.name(), row.name);
        assert!(!row.about.is_empty());
    }
}
