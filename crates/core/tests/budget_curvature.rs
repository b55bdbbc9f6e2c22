//! The bounds of the derivatives of a link weight against dense sampling.

use closeranks_core::controller::budget::curvature::Curvature;
use closeranks_core::equations::link::{Link, LinkShape};

fn shapes() -> impl Iterator<Item = LinkShape> {
    let radii = [0.7, 1.0, 3.0];
    radii.into_iter().flat_map(|radius_m| {
        [0.02, 0.05, 0.1, 0.3, 0.9, 5.0, 48.0, 280.0].map(|q2| LinkShape { radius_m, q1: 2.099, q2 })
    })
}

fn rate(shape: &LinkShape, distance_m: f64) -> f64 {
    shape.link_at(distance_m * distance_m).map_or(0.0, |link: Link<f64>| -0.5 * link.slope)
}

/// Most negative eigenvalue of the Hessian by differences of the gradient: radial and across.
fn sampled_bend(shape: &LinkShape, distance_m: f64) -> f64 {
    let step = 1e-5;
    let gradient = |r: f64| -2.0 * rate(shape, r) * r;
    let radial = (gradient(distance_m + step) - gradient(distance_m - step)) / (2.0 * step);
    (-radial).max(2.0 * rate(shape, distance_m))
}

/// Largest sample of `of` between the two distances, ends included. A steep weight is sampled more densely.
fn most(shape: &LinkShape, low: f64, high: f64, of: impl Fn(f64) -> f64) -> f64 {
    let samples = if shape.q2 > 10.0 { 6_000 } else { 300 };
    let at = |k: u32| low + (high - low) * f64::from(k) / f64::from(samples);
    (0..=samples).map(|k| of(at(k))).fold(0.0, f64::max)
}

//= theory eq:slope-bound type=test
#[test]
fn no_sampled_slope_is_above_the_closed_form_and_some_reaches_it() {
    for shape in shapes() {
        let curvature = Curvature::new(shape);
        for (k, move_m) in (0..60).zip([0.0, 0.003, 0.01, 0.1, 0.4].into_iter().cycle()) {
            let distance = shape.radius_m * f64::from(k) / 59.0;
            let sampled = most(&shape, distance, distance + 2.0 * move_m, |r| rate(&shape, r));
            let bound = curvature.slope_max(distance, move_m, 0.0);
            assert!(sampled <= bound, "{sampled} above {bound} at {distance} of {shape:?}");
            let blur = 1e-3 * bound + 1e-12;
            assert!(bound <= sampled + blur, "{bound} far above {sampled} at {distance} of {shape:?}");
        }
    }
}

//= theory eq:curvature-bound type=test
#[test]
fn no_sampled_bend_is_above_the_closed_form_and_some_comes_close() {
    for shape in shapes() {
        let curvature = Curvature::new(shape);
        for (k, move_m) in (0..60).zip([0.0, 0.003, 0.01, 0.1, 0.4].into_iter().cycle()) {
            let distance = shape.radius_m * f64::from(k) / 60.0;
            let low = (distance - 2.0 * move_m).max(0.0);
            let sampled = most(&shape, low, distance + 2.0 * move_m, |r| sampled_bend(&shape, r));
            let bound = curvature.bend_max(distance, move_m, 0.0);
            // the differences are good to 1e-6 of the sharpest bend; the samples miss a peak by less than 1 %
            let most = curvature.bend_max(0.0, shape.radius_m, 0.0);
            let blur = 1e-2 * most;
            assert!(sampled <= bound + 1e-6 * most, "{sampled} above {bound} at {distance} of {shape:?}");
            assert!(bound <= sampled + blur, "{bound} far above {sampled} at {distance} of {shape:?}");
        }
    }
}

#[test]
fn many_bends_have_the_bits_of_each() {
    for shape in shapes() {
        let curvature = Curvature::new(shape);
        for move_m in [0.0, 0.01, 0.4] {
            for strange in [0.5, f64::NAN, f64::INFINITY, 1e200] {
                let mut distances = [0.0, 0.1, 0.69, 0.95, strange, 2.0, 2.7, 2.99, 3.2];
                let each = distances.map(|distance_m| curvature.bend_max(distance_m, move_m, 0.0));
                curvature.bends_max(&mut distances, move_m, 0.0);
                assert_eq!(each.map(f64::to_bits), distances.map(f64::to_bits));
            }
        }
    }
}

//= theory eq:curvature-bound type=test
#[test]
fn the_weight_stays_above_its_parabola() {
    let weight = |shape: &LinkShape, r: &[f64; 2]| shape.link(r).map_or(0.0, |link: Link<f64>| link.weight);
    for shape in shapes() {
        let curvature = Curvature::new(shape);
        for k in 1..40 {
            let r = [shape.radius_m * f64::from(k) / 40.0, 0.0];
            let gradient = shape.link(&r).map_or([0.0; 2], |link: Link<f64>| link.gradient(&r));
            for turn in 0..24 {
                let angle = f64::from(turn) * core::f64::consts::TAU / 24.0;
                let move_m = 0.02 + 0.04 * f64::from(turn % 5);
                let e = [2.0 * move_m * libm::cos(angle), 2.0 * move_m * libm::sin(angle)];
                let linear = weight(&shape, &r) + gradient[0] * e[0] + gradient[1] * e[1];
                let parabola = linear - 2.0 * curvature.bend_max(r[0], move_m, 0.0) * move_m * move_m;
                let moved = weight(&shape, &[r[0] + e[0], e[1]]);
                assert!(moved >= parabola - 1e-14, "{moved} < {parabola} at {} of {shape:?}", r[0]);
            }
        }
    }
}

#[test]
fn beyond_the_rim_and_for_no_number() {
    let curvature = Curvature::new(LinkShape { radius_m: 3.0, q1: 2.099, q2: 0.3 });
    assert_eq!(curvature.slope_max(3.0, 0.1, 0.0), 0.0);
    assert_eq!(curvature.bend_max(3.3, 0.1, 0.0), 0.0);
    assert!(curvature.bend_max(3.1, 0.1, 0.0) > 0.0, "it may come into range");
    assert!(
        curvature.slope_max(f64::NAN, 0.1, 0.0).is_nan() && curvature.bend_max(1.0, f64::NAN, 0.0).is_nan()
    );
}
