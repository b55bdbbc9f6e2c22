//! The theorem where every sensed position is wrong by up to e, as a rule right at the bound, and what happens without the
//! margin.

use budget_team::{Team, crate_rows};
use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::curvature::Curvature;
use closeranks_core::controller::budget::settings::Form;
use closeranks_core::controller::errors::ErrorBounds;
use closeranks_core::equations::link::{Link, LinkShape};
use closeranks_core::num::{length, subtract};

mod budget_team;
mod seeded;

const CASES: [(Assume, Form); 3] =
    [(Assume::Obedient, Form::Level), (Assume::Obedient, Form::Link), (Assume::Free, Form::Link)];

/// Runs teams that sense with an error of up to `error_m` and reckon with `stated_m`, and returns how many ticks held.
fn law<const D: usize>(assume: Assume, form: Form, error_m: f64, stated_m: f64) -> Result<usize, String> {
    let mut ticks = 0;
    for seed in 0..60 {
        let Some(mut team) = Team::<D>::random(seed, assume, form) else { continue };
        (team.error_m, team.budget.errors) = (error_m, ErrorBounds::new(stated_m, 0.0));
        for tick in 0..20 {
            team.tick(&crate_rows).map_err(|broken| format!("seed {seed}, tick {tick}: {broken}"))?;
            ticks += 1;
        }
    }
    Ok(ticks)
}

//= theory sec:margins type=test
#[test]
fn no_error_within_the_margin_breaks_the_law() {
    for (assume, form) in CASES {
        for error_m in [0.002, 0.03] {
            let plane = law::<2>(assume, form, error_m, error_m).unwrap();
            assert!(plane > 300, "only {plane} ticks");
            law::<3>(assume, form, error_m, error_m).unwrap();
        }
    }
}

#[test]
fn an_error_beyond_the_margin_breaks_it() {
    for (assume, form) in CASES {
        assert!(law::<2>(assume, form, 0.03, 0.0).is_err(), "{assume:?}, {form:?}");
    }
}

/// The gradient at a wrong place is off by no more than the bound says.
//= theory eq:gradient-error type=test
#[test]
fn the_gradient_is_known_to_its_error() {
    for q2 in [0.05, 0.3, 0.9] {
        let shape = LinkShape { radius_m: 3.0, q1: 2.099, q2 };
        let curvature = Curvature::new(shape);
        let gradient = |r: &[f64; 2]| shape.link(r).map_or([0.0; 2], |link: Link<f64>| link.gradient(r));
        let mut tightest: f64 = 0.0;
        for k in 0..320 {
            let r = [0.01 * f64::from(k), 0.0];
            for turn in 0..16 {
                let angle = f64::from(turn) * core::f64::consts::TAU / 16.0;
                let error_m = 0.001 + 0.1 * f64::from(turn % 3);
                let moved = [r[0] + error_m * libm::cos(angle), error_m * libm::sin(angle)];
                let off = length(&subtract(&gradient(&moved), &gradient(&r)));
                let bound = curvature.gradient_error(r[0], error_m * (1.0 + 1e-12));
                assert!(off <= bound, "{off} above {bound} at {} m", r[0]);
                tightest = tightest.max(off / bound);
            }
        }
        assert!(tightest > 0.9, "{tightest}");
    }
}
