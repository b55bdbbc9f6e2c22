//! Optimal reciprocal collision avoidance (van den Berg, Guy, Lin, Manocha 2011): collision avoidance alone.
//!
//! For each pair of robots at `p = x_j − x_i` with velocities of difference `v = v_i − v_j`, let VO be the velocities of
//! difference that bring the two closer than Δ_d within τ, and u the shortest way from v to its boundary, with the outward
//! normal n there. Each robot does half of it:
//!
//! ```text
//! (w − (v_i + u/2))·n ≥ 0        for the new velocity w of robot i
//! ```
//!
//! and takes the velocity closest to the desired one that satisfies all of these and the input box. Needs: positions and
//! velocities of the robots in range. Assumes that all do the same and reach the velocities that they choose. Where no
//! velocity satisfies everything, the source takes the one that breaks the constraints least; here those that
//! are broken are moved until they no longer are, and the outcome is `Infeasible`.

use closeranks_core::num::{Vector, add_scaled, dot, length, sqrt, subtract};

use crate::controllers::shared::half_spaces::HalfSpaces;
use crate::controllers::{Answer, TeamView, Velocities};

/// The controller, with scratch for the constraints of one robot.
#[derive(Clone, Debug, Default)]
pub struct Orca {
    planes: HalfSpaces,
}

impl Velocities for Orca {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        let input = &view.params.settings().limits.input;
        for (robot, answer) in answers.iter_mut().enumerate() {
            self.constrain(robot, view);
            *answer = self.planes.closest(&view.desired_m_s[robot], &view.velocities_m_s[robot], input);
        }
    }
}

impl Orca {
    /// The constraints of a robot: one for each other robot in range.
    fn constrain<const D: usize>(&mut self, robot: usize, view: &TeamView<'_, D>) {
        self.planes.clear();
        let (own, radius_m) = (&view.positions_m[robot], view.params.link().radius_m);
        let velocity = &view.velocities_m_s[robot];
        for other in (0..view.positions_m.len()).filter(|other| *other != robot) {
            let p = subtract(&view.positions_m[other], own);
            if dot(&p, &p) <= radius_m * radius_m {
                let (n, u) = way_out(&p, &subtract(velocity, &view.velocities_m_s[other]), view);
                self.planes.push(&n, dot(&n, &add_scaled(velocity, 0.5, &u)));
            }
        }
    }
}

/// The outward normal of VO and the way u to its boundary, m/s, for robots at `p` (m) whose velocities differ by `v` (m/s).
///
/// VO is a cone with a ball in place of its tip: the ball of radius Δ_d/τ around p/τ. Robots that are too close already are to
/// part within a tick.
fn way_out<const D: usize>(p: &Vector<D>, v: &Vector<D>, view: &TeamView<'_, D>) -> (Vector<D>, Vector<D>) {
    let settings = view.params.settings();
    let radius_m = settings.limits.distance_min_m;
    let (distance_m2, gap_m2) = (dot(p, p), dot(p, p) - radius_m * radius_m);
    let horizon_s =
        if gap_m2 > 0.0 { view.tuning.horizon_s } else { settings.clock.level_period.as_secs_f64() };
    let from_ball = add_scaled(v, -1.0 / horizon_s, p);
    let back = dot(&from_ball, p);
    if gap_m2 <= 0.0 || (back < 0.0 && back * back > radius_m * radius_m * dot(&from_ball, &from_ball)) {
        return outward(&from_ball, radius_m / horizon_s, p);
    }
    // The point t p of the axis from which the ball of radius Δ_d t touches the cone where it is nearest to v.
    let across = distance_m2 * dot(v, v) - dot(p, v) * dot(p, v);
    let (b, c) = (dot(p, v), dot(v, v) - across / gap_m2);
    let t = (b + sqrt((b * b - distance_m2 * c).max(0.0))) / distance_m2;
    outward(&add_scaled(v, -t, p), radius_m * t, p)
}

/// From a point at `offset` of the middle of a ball straight to its boundary. In the middle itself both robots turn the same way.
fn outward<const D: usize>(offset: &Vector<D>, radius: f64, p: &Vector<D>) -> (Vector<D>, Vector<D>) {
    let size = length(offset);
    let n = if size > 0.0 { offset.map(|component| component / size) } else { aside(p) };
    (n, n.map(|component| (radius - size) * component))
}

/// A direction across `p` that is the opposite for −`p`.
fn aside<const D: usize>(p: &Vector<D>) -> Vector<D> {
    let mut across = [0.0; D];
    if D > 1 {
        (across[0], across[1]) = (p[1], -p[0]);
    }
    let size = length(&across);
    let first = core::array::from_fn(|d| if d == 0 { 1.0 } else { 0.0 });
    if size > 0.0 { across.map(|component| component / size) } else { first }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attack::ValueAttack;
    use crate::controllers::{Controller, Tuning};
    use crate::law::Law;
    use crate::scenario::Scenario;
    use crate::scenario::desired::Desired;
    use crate::scenario::start::Start;
    use crate::world::{Options, World, run};
    use closeranks_core::settings::Team;

    fn scenario(robots: u16, start: Start, desired: Desired) -> Scenario {
        let (team, malicious) = (Team { robots, faults: 0 }, Vec::new());
        let attack = ValueAttack::None.into();
        Scenario {
            controller: Controller::Orca,
            team,
            malicious,
            attack,
            start,
            desired,
            ..Scenario::default()
        }
    }

    /// A boundary of VO is where the least distance within τ is Δ_d: a velocity just outside of it is safe, one just inside is not.
    #[test]
    fn the_way_out_ends_where_robots_just_miss_each_other() {
        let scenario = scenario(2, Start::Inside, Desired::Hold);
        let params = scenario.params::<2>().unwrap();
        let tuning = Tuning::horizon(2.0);
        let view =
            TeamView { params: &params, positions_m: &[], velocities_m_s: &[], desired_m_s: &[], tuning };
        let nearest = |p: &Vector<2>, v: &Vector<2>| {
            let time_s = (dot(p, v) / dot(v, v)).clamp(0.0, Tuning::USUAL.horizon_s);
            length(&add_scaled(p, -time_s, v))
        };
        for (p, v) in [
            ([1.0, 0.2], [0.9, 0.1]),
            ([2.0, -1.0], [1.4, -0.6]),
            ([0.5, 0.5], [0.2, 0.4]),
            ([1.5, 0.0], [0.7, 0.0]),
        ] {
            let (n, u) = way_out(&p, &v, &view);
            assert!((length(&n) - 1.0).abs() < 1e-12);
            let edge = add_scaled(&v, 1.0, &u);
            assert!((nearest(&p, &edge) - 0.3).abs() < 1e-9, "{p:?} {v:?}");
            assert!(nearest(&p, &add_scaled(&edge, 1e-3, &n)) > 0.3);
            assert!(nearest(&p, &add_scaled(&edge, -1e-3, &n)) < 0.3);
        }
    }

    /// What the source claims: robots in each other's way pass without a collision, and without agreeing on anything.
    #[test]
    fn robots_that_meet_pass_each_other_and_none_collide() {
        let places = vec![vec![-2.0, 0.0], vec![2.0, 0.0]];
        let mut world =
            World::<2>::new(&scenario(2, Start::Listed(places), Desired::Hold), Options::default()).unwrap();
        for _ in 0..1_200 {
            let goals = [[2.0, 0.0], [-2.0, 0.0]];
            let to =
                |k: usize| subtract(&goals[k], &world.frame().positions_m[k]).map(|x| x.clamp(-1.0, 1.0));
            let desired = [to(0), to(1)];
            let given = crate::world::given::Given { desired_m_s: Some(&desired), ..Default::default() };
            world.step_with(&given).unwrap();
        }
        let [x, _] = world.frame().positions_m[0];
        assert!(x > 1.8, "it got past the other one: {x}");
        assert_eq!(world.monitors().verdicts().of(Law::Path).count, 0);
        let start = Start::Random { half_side_m: 2.5, distance_min_m: 0.45 };
        // Everybody wants to the same place: where no velocity is allowed any more, robots come closer by micrometres.
        for seed in 0..5 {
            let crowd = Scenario { seed, duration_s: 6.0, ..scenario(12, start.clone(), Desired::Gather) };
            let summary = run(&crowd, Options::default(), &mut |_| ()).unwrap().summary;
            let least_m = summary.extremes.distance_min_m;
            assert!(least_m > 0.3 - 1e-4, "seed {seed}: {least_m}");
        }
    }
}
