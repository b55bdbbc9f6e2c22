//! The program of one robot (seq:qp) against its optimality conditions and against a grid.
//!
//! The conditions (Karush, Kuhn, Tucker): u is the answer if and only if it is in the box, satisfies the row, and
//! `u = clip(u_des + λ normal)` for one λ ≥ 0, which is 0 unless the row holds with equality. Rounding: every quantity is an
//! inner product of D terms, so all tolerances are `ROUNDING` times the sum of the magnitudes that were added.

#![expect(clippy::float_cmp, reason = "components rest on their bounds exactly")]

use closeranks_core::num::{Vector, dot};
use closeranks_core::program::box_row::{Row, closest};
use closeranks_core::program::{InputBox, Outcome};
use seeded::Seeded;

mod seeded;

/// Three inner products of at most 3 terms, a quotient and a product: below 16 roundings.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
const CASES: u64 = 4_000;

struct Case<const D: usize> {
    desired: Vector<D>,
    row: Row<D>,
    input: InputBox<D>,
}

//= paper seq:qp type=test
//= theory sec:box-row type=test
#[test]
fn the_answer_satisfies_the_optimality_conditions() {
    let mut seen = [0; 3];
    for seed in 0..CASES {
        check_optimality(&Case::<1>::random(seed, 3.0), &mut seen);
        check_optimality(&Case::<2>::random(seed, 3.0), &mut seen);
        check_optimality(&Case::<3>::random(seed, 3.0), &mut seen);
    }
    assert!(seen.iter().all(|&count| count > CASES / 4), "free, active, infeasible: {seen:?}");
}

//= paper seq:qp type=test
//= theory sec:box-row type=test
#[test]
fn no_feasible_grid_point_is_closer() {
    for seed in 0..400 {
        check_grid::<1>(&Case::random(seed, 3.0), 400);
        check_grid::<2>(&Case::random(seed, 3.0), 40);
        check_grid::<3>(&Case::random(seed, 3.0), 12);
    }
}

//= theory sec:holds type=test
#[test]
fn the_row_holds_however_far_away_the_desired_velocity_is() {
    for far in [1e3, 1e6, 1e10, 1e16, 1e40, 1e155, 1e200, f64::MAX] {
        for seed in 0..500 {
            check_row(&Case::<1>::random(seed, far));
            check_row(&Case::<2>::random(seed, far));
            check_row(&Case::<3>::random(seed, far));
        }
    }
}

#[test]
fn the_row_holds_when_its_components_have_nothing_in_common() {
    for seed in 0..CASES {
        let mut case = Case::<3>::random(seed, 3.0);
        let mut random = Seeded(seed);
        case.row.normal = core::array::from_fn(|_| {
            [1e150, 1e-300, 1.0, 1e-20][random.below(4)] * random.between(-2.0, 2.0)
        });
        case.row.bound = case.some_bound(&mut random);
        check_row(&case);
    }
}

fn check_row<const D: usize>(case: &Case<D>) {
    let solution = closest(&case.desired, &case.row, &case.input);
    let u = solution.velocity_m_s;
    assert!(case.input.contains(&u), "{u:?} outside the box of {case:?}");
    assert!(u.iter().all(|component| component.is_finite()), "{u:?} of {case:?}");
    let missing = case.row.bound - dot(&case.row.normal, &u);
    let allowed = ROUNDING * case.magnitude(&case.corner());
    match solution.outcome {
        Outcome::Free => assert!(missing <= 0.0 && u == case.input.clip(&case.desired), "{u:?} of {case:?}"),
        Outcome::Active => assert!(missing.abs() <= allowed, "{u:?} misses by {missing:e} in {case:?}"),
        Outcome::Infeasible => {
            assert!(missing > 0.0, "{u:?} satisfies {case:?}");
            assert_eq!(u, case.furthest(), "the most of normal·u, then the closest, in {case:?}");
        }
        Outcome::Recovering => panic!("not an outcome of this program: {case:?}"),
    }
}

fn check_optimality<const D: usize>(case: &Case<D>, seen: &mut [u64; 3]) {
    check_row(case);
    let solution = closest(&case.desired, &case.row, &case.input);
    seen[solution.outcome as usize] += 1;
    if solution.outcome == Outcome::Active {
        let clipped = case.input.clip(&case.desired);
        assert!(dot(&case.row.normal, &clipped) < case.row.bound, "the row need not act in {case:?}");
        check_multiplier(case, &solution.velocity_m_s);
    }
}

/// Each component allows an interval of λ; all of them and `λ ≥ 0` must meet.
fn check_multiplier<const D: usize>(case: &Case<D>, u: &Vector<D>) {
    let InputBox { min_m_s: min, max_m_s: max, .. } = case.input;
    let largest = case.row.normal.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
    let normal = case.row.normal.map(|component| component / largest);
    let inside = |d: usize| min[d] < u[d] && u[d] < max[d];
    let square: f64 = (0..D).filter(|&d| inside(d)).map(|d| normal[d] * normal[d]).sum();
    // λ comes from one linear equation: the rounding of its sums, divided by its slope.
    let sums: f64 = (0..D).map(|d| normal[d].abs() * (u[d].abs() + case.desired[d].abs())).sum();
    let blur = if square > 0.0 { ROUNDING * (sums + (case.row.bound / largest).abs()) / square } else { 0.0 };
    let (mut low, mut high) = (-blur, f64::INFINITY);
    for d in 0..D {
        if normal[d] == 0.0 {
            assert_eq!(u[d], case.desired[d].max(min[d]).min(max[d]), "component {d} in {case:?}");
            continue;
        }
        let own = (u[d] - case.desired[d]) / normal[d];
        let blur = blur + ROUNDING * (u[d].abs() + case.desired[d].abs()) / normal[d].abs();
        let (upper_edge, lower_edge) = if normal[d] > 0.0 { (max[d], min[d]) } else { (min[d], max[d]) };
        if u[d] != upper_edge {
            high = high.min(own + blur);
        }
        if u[d] != lower_edge {
            low = low.max(own - blur);
        }
    }
    assert!(low <= high, "no λ between {low:e} and {high:e} gives {u:?} in {case:?}");
}

fn check_grid<const D: usize>(case: &Case<D>, steps: usize) {
    let solution = closest(&case.desired, &case.row, &case.input);
    let u = solution.velocity_m_s;
    let points = (steps + 1).pow(u32::try_from(D).unwrap_or(0));
    for index in 0..points {
        let point: Vector<D> = core::array::from_fn(|d| {
            let step = index / (steps + 1).pow(u32::try_from(d).unwrap_or(0)) % (steps + 1);
            let share =
                f64::from(u32::try_from(step).unwrap_or(0)) / f64::from(u32::try_from(steps).unwrap_or(1));
            case.input.min_m_s[d] + share * (case.input.max_m_s[d] - case.input.min_m_s[d])
        });
        let along = dot(&case.row.normal, &point);
        let blur = ROUNDING * case.magnitude(&case.corner());
        if solution.outcome == Outcome::Infeasible {
            assert!(
                along <= dot(&case.row.normal, &u) + blur,
                "{point:?} goes further than {u:?} in {case:?}"
            );
        } else if along >= case.row.bound + blur {
            // |p − desired|² − |u − desired|², without the cancellation
            let farther: f64 =
                (0..D).map(|d| (point[d] - u[d]) * (point[d] + u[d] - 2.0 * case.desired[d])).sum();
            let size: f64 = (0..D).map(|d| 4.0 + case.desired[d] * case.desired[d]).sum();
            assert!(farther >= -ROUNDING * size, "{point:?} is closer than {u:?} in {case:?}");
        }
    }
}

impl<const D: usize> Case<D> {
    /// Boxes with 0 inside, some flat; rows of any size, some along an axis and some nearly so; bounds from always to never.
    fn random(seed: u64, far: f64) -> Self {
        let mut random = Seeded(seed.wrapping_mul(0x0123_4567_89ab_cdef));
        let mut edge = |sign: f64| if random.below(6) == 0 { 0.0 } else { sign * random.between(0.1, 2.0) };
        let input = InputBox::of(core::array::from_fn(|_| edge(-1.0)), core::array::from_fn(|_| edge(1.0)));
        let size = [1.0, 1.0, 1e150, 1e-280, 1e-300][random.below(5)];
        let normal = core::array::from_fn(|_| {
            // no component is subnormal: those have fewer digits than the tolerances allow for
            let kinds = if size == 1e-300 { [1.0, 0.0, 1.0, 1.0] } else { [1.0, 0.0, 1e-9, 1e-17] };
            size * kinds[random.below(4)] * random.between(-2.0, 2.0)
        });
        let reach = if random.below(2) == 0 { 1.0 } else { far };
        let desired = core::array::from_fn(|_| reach * random.between(-1.0, 1.0));
        let mut case = Self { desired, row: Row { normal, bound: 0.0 }, input };
        case.row.bound = case.some_bound(&mut random);
        case
    }

    fn some_bound(&self, random: &mut Seeded) -> f64 {
        let most = dot(&self.row.normal, &self.furthest());
        let now = dot(&self.row.normal, &self.input.clip(&self.desired));
        match random.below(8) {
            0 => 0.0,
            1 => most,
            2 => now,
            _ => now + random.between(-0.2, 1.3) * (most - now),
        }
    }

    /// The box point with the most of normal·u; the closest to the desired one among several.
    fn furthest(&self) -> Vector<D> {
        let clipped = self.input.clip(&self.desired);
        core::array::from_fn(|d| match self.row.normal[d] {
            0.0 => clipped[d],
            slope if slope > 0.0 => self.input.max_m_s[d],
            _ => self.input.min_m_s[d],
        })
    }

    /// The largest magnitude of each component in the box.
    fn corner(&self) -> Vector<D> {
        core::array::from_fn(|d| self.input.max_m_s[d].max(-self.input.min_m_s[d]))
    }

    /// The sum of the magnitudes in normal·u.
    fn magnitude(&self, u: &Vector<D>) -> f64 {
        (0..D).map(|d| (self.row.normal[d] * u[d]).abs()).sum()
    }
}

impl<const D: usize> core::fmt::Debug for Case<D> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{:?} with {:?} in {:?}", self.desired, self.row, self.input)
    }
}
