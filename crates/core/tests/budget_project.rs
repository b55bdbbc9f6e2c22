//! The closest point of balls, half-spaces and a box: admissible always, and certified to be the closest.

use budget_case::Case;
use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::program::balls::Program;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::program::{InputBox, Outcome};
use seeded::Seeded;

mod budget_case;
mod seeded;

const CASES: u64 = 2_000;

/// The certificate leaves less than this, m, in boxes of some 1 m.
const GAP_M: f64 = 1e-12;

//= theory sec:program type=test
#[test]
fn the_answer_is_certified_to_be_the_closest() {
    let mut seen = [0; 6];
    for seed in 0..CASES {
        seen[check_gap(&Case::<1>::ordinary(seed)).min(1)] += 1;
        seen[2 + check_gap(&Case::<2>::ordinary(seed)).min(1)] += 1;
        seen[4 + check_gap(&Case::<3>::ordinary(seed)).min(1)] += 1;
    }
    assert!(seen.iter().all(|&count| count > CASES / 20), "free and active per dimension: {seen:?}");
}

fn check_gap<const D: usize>(case: &Case<D>) -> usize {
    let closest = case.solve();
    let v = closest.displacement_m;
    assert_eq!(closest.outcome == Outcome::Free, case.admits(&case.desired), "{case:?}");
    let gap = case.gap(&v);
    assert!(gap <= GAP_M, "{v:?} may be {gap:e} m too far from the desired one in {case:?}");
    closest.working
}

//= theory sec:program type=test
#[test]
fn no_admissible_point_nearby_or_on_any_ray_is_closer() {
    for seed in 0..CASES / 4 {
        check_samples(&Case::<2>::ordinary(seed), seed, 1e-12);
        check_samples(&Case::<3>::ordinary(seed), seed, 1e-12);
    }
}

//= theory sec:program type=test
#[test]
fn degenerate_sets_have_an_admissible_answer_that_no_sample_beats() {
    for seed in 0..CASES {
        check_samples(&Case::<1>::degenerate(seed), seed, 1e-9);
        check_samples(&Case::<2>::degenerate(seed), seed, 1e-9);
        check_samples(&Case::<3>::degenerate(seed), seed, 1e-9);
    }
}

fn check_samples<const D: usize>(case: &Case<D>, seed: u64, allowed: f64) {
    let v = case.solve().displacement_m;
    let mut random = Seeded(!seed);
    for k in 0..60 {
        let size = [1.0, 1e-2, 1e-5][k % 3];
        let step = core::array::from_fn(|_| size * random.between(-1.0, 1.0));
        let around = add_scaled(&v, 1.0, &step);
        let point = if k % 2 == 0 { around } else { into(case, &around) };
        if case.admits(&point) {
            let toward = subtract(&point, &v);
            let sum = add_scaled(&subtract(&point, &case.desired), 1.0, &subtract(&v, &case.desired));
            let gain = -dot(&toward, &sum) / (1e-30 + length(&sum));
            assert!(gain <= allowed, "{point:?} is {gain:e} m closer than {v:?} in {case:?}");
        }
    }
}

/// The farthest admissible point on the way from 0 to `v`, by halving.
fn into<const D: usize>(case: &Case<D>, v: &Vector<D>) -> Vector<D> {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let inside = case.admits(&v.map(|component| middle * component));
        *if inside { &mut low } else { &mut high } = middle;
    }
    v.map(|component| low * component)
}

/// The search may begin at the answer itself, close to it, or anywhere: the answer is the same up to rounding over the angle of
/// the two boundaries that decide. Often it is found at once.
//= theory sec:program type=test
#[test]
fn wherever_one_looks_first_the_answer_is_the_same() {
    let mut met = [0; 2];
    for seed in 0..CASES {
        met[0] += check_guesses(&Case::<2>::ordinary(seed), seed, 1e-13);
        met[1] += check_guesses(&Case::<3>::ordinary(seed), seed, 1e-13);
        check_guesses(&Case::<1>::degenerate(seed), seed, 1e-9);
        check_guesses(&Case::<2>::degenerate(seed), seed, 1e-9);
        check_guesses(&Case::<3>::degenerate(seed), seed, 1e-9);
    }
    assert!(met.iter().all(|met| *met > CASES / 20), "{met:?} of {CASES} were found at once");
}

/// 1 if the answer was found where it was looked for first, while a search would have looked at more rows; else 0.
fn check_guesses<const D: usize>(case: &Case<D>, seed: u64, allowed: f64) -> u64 {
    let cold = case.solve();
    let mut random = Seeded(!seed);
    let sizes = [0.0, 1e-9, 1e-4, 1.0, f64::INFINITY];
    let befores = sizes.map(|size| -> Vector<D> {
        core::array::from_fn(|d| cold.displacement_m[d] + size * random.between(-1.0, 1.0))
    });
    for before in &befores {
        let warm = case.solve_from(before);
        let distance = |v: &Vector<D>| length(&subtract(v, &case.desired));
        let farther = distance(&warm.displacement_m) - distance(&cold.displacement_m);
        assert!(farther.abs() <= allowed, "{farther:e} m farther from {before:?} in {case:?}");
        assert_eq!(warm.outcome, cold.outcome, "from {before:?} in {case:?}");
    }
    u64::from(cold.working > 2 && case.solve_from(&cold.displacement_m).working == 2)
}

#[test]
fn a_circle_that_meets_the_rest_in_two_arcs() {
    // a lens of two discs, cut by a wall whose two ends are both vertices
    let input = InputBox::of([-5.0; 2], [5.0; 2]);
    let rows = vec![
        Row::new([2.0, 0.0], 1.0, 3.0),  // centre (−1, 0), radius 2
        Row::new([-2.0, 0.0], 1.0, 3.0), // centre (1, 0), radius 2
        Row::new([0.0, 1.0], 0.0, 1.0),
    ];
    for (x, sign) in [(0.9, 1.0), (-0.9, -1.0)] {
        let case = Case { desired: [x, 4.0], rows: rows.clone(), input };
        let v = case.solve().displacement_m;
        let corner = [sign * (libm::sqrt(3.0) - 1.0), 1.0];
        assert!(length(&subtract(&v, &corner)) < 1e-14, "{v:?} is not {corner:?}");
    }
}

#[test]
fn sets_that_are_a_point_or_a_line() {
    let input = InputBox::of([-1.0; 2], [1.0; 2]);
    let tangent = vec![Row::new([1.0, 2.0], 1.0, 0.0), Row::new([-1.0, -2.0], 3.0, 0.0)];
    let point = Case { desired: [0.4, 0.3], rows: tangent, input };
    // 0 up to the margin of `Row::holds`
    assert!(length(&point.solve().displacement_m) < 1e-14);

    let between = vec![Row::new([0.1, 0.3], 0.0, 0.0), Row::new([-0.1, -0.3], 0.0, 0.0)];
    let line = Case { desired: [0.6, 0.3], rows: between, input };
    let v = line.solve().displacement_m;
    assert!(length(&subtract(&v, &[0.45, -0.15])) < 1e-15, "{v:?} slides along the line");

    let nowhere = Case { input: InputBox::of([0.0; 2], [0.0; 2]), ..line };
    assert_eq!(nowhere.solve().displacement_m, [0.0, 0.0]);
}

#[test]
fn any_floats_give_an_admissible_answer() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, -f64::MAX, 5e-324, -0.0, 1e-160, 1e155];
    for seed in 0..CASES {
        let mut random = Seeded(seed);
        let mut number = || odd.get(random.below(14)).copied().unwrap_or(random.between(-2.0, 2.0));
        let input = InputBox::of([number(), number()], [number(), number()]);
        let reach = Reach::new(&input, number().abs());
        let mut memory = [Row::default(); 12];
        let mut program = Program::new(&mut memory, reach);
        for _ in 0..8 {
            program.push(Row::new([number(), number()], number(), number()));
        }
        let v = program.closest(&[number(), number()]).displacement_m;
        assert!(reach.contains(&v) && program.rows().iter().all(|row| row.holds(&v)), "{v:?} of {program:?}");
    }
}

#[test]
fn too_little_memory_allows_no_move() {
    let reach = Reach::new(&InputBox::of([-1.0; 2], [1.0; 2]), 1.0);
    let mut memory = [Row::default(); 5];
    let mut program = Program::new(&mut memory, reach);
    program.push(Row::new([1.0, 0.0], 1.0, 9.0));
    program.push(Row::new([1.0, 0.0], 1.0, 0.1));
    assert!(!program.is_full() && program.rows().len() == 5, "a row that holds everywhere needs no place");
    program.push(Row::new([0.0, 1.0], 1.0, 0.1));
    assert!(program.is_full());
    assert_eq!(program.closest(&[0.5, 0.5]).displacement_m, [0.0, 0.0]);
}

#[test]
fn a_desired_displacement_far_away() {
    for far in [1e3, 1e6, 1e12, 1e100, 1e307] {
        for seed in 0..300 {
            let mut case = Case::<2>::ordinary(seed);
            let near = case.desired;
            case.desired = near.map(|component| far * component);
            let v = case.solve().displacement_m;
            // the answer tends to the point farthest in that direction
            let direction = near.map(|component| component / length(&near));
            let mut random = Seeded(seed);
            for _ in 0..20 {
                let any = core::array::from_fn(|_| random.between(-1.5, 1.5));
                let lead = dot(&direction, &subtract(&into(&case, &any), &v));
                assert!(lead <= 10.0 / far.min(1e6), "{lead} of {case:?}");
            }
        }
    }
}
