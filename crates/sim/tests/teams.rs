//! Several teams in one space: distances are kept between all robots, and everything else in each team alone.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_sim::law::Law;
use closeranks_sim::parse::scenario;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::any::AnyWorld;
use closeranks_sim::world::{Options, Run, RunError, World, initial_numbers, run};

const CROSSING: &str = include_str!("../../../scenarios/teams.toml");

fn done(scenario: &Scenario) -> Run {
    let options = Options { robustness: true, digest: true, without_phi: true, ..Options::default() };
    run(scenario, options, &mut |_| ()).unwrap()
}

fn crossing(controller: Controller) -> Scenario {
    Scenario { duration_s: 8.0, ..scenario(CROSSING).unwrap() }.under(controller).lasting(8.0)
}

/// The same for so long in all teams.
trait Lasting {
    fn lasting(self, duration_s: f64) -> Self;
}

impl Lasting for Scenario {
    fn lasting(mut self, duration_s: f64) -> Self {
        self.duration_s = duration_s;
        self.teams.iter_mut().for_each(|team| team.duration_s = duration_s);
        self
    }
}

/// They meet, nobody comes too near, and each team stays robust and agrees within its own interval, which is far from that of the other.
//= theory sec:strangers type=test
#[test]
fn teams_that_cross_keep_their_distance_and_their_own_promises() {
    for controller in [Controller::Budget, Controller::Links] {
        let scenario = crossing(controller);
        let run = done(&scenario);
        let broken: Vec<_> = run.summary.violations(&scenario).collect();
        assert!(broken.is_empty(), "{controller:?}: {broken:?}");
        assert_eq!(run.summary.failures(&scenario).count(), 0);
        let least_m = run.summary.extremes.distance_min_m;
        assert!((0.3 - 1e-9..0.5).contains(&least_m), "they meet: {least_m}");
        for (team, came) in scenario.teams.iter().zip(&run.teams) {
            let need = team.team.faults + team.team.robots / 2;
            assert!(came.summary.extremes.degree_min >= Some(need), "{controller:?}: {came:?}");
            assert!(
                came.summary.extremes.degree_min <= Some(team.team.robots - 1),
                "others are no neighbours"
            );
            assert!(came.summary.extremes.spread < 1.0, "{}", came.summary.extremes.spread);
            assert!(
                came.rounds
                    .iter()
                    .all(|round| round.f_max.least >= i16::try_from(team.team.faults).unwrap().into())
            );
        }
    }
}

/// Without a controller they run into each other, and the law about all robots notices; within the teams nobody does.
#[test]
fn robots_of_different_teams_that_collide_are_noticed() {
    let scenario = crossing(Controller::None);
    let run = done(&scenario);
    assert!(run.summary.broken(Law::Distance) > 0 && run.summary.broken(Law::Path) > 0);
    assert!(run.teams.iter().all(|team| team.summary.broken(Law::Distance) == 0));
    let robots = run.summary.verdicts.of(Law::Distance).first.unwrap().robots;
    assert!(robots[0] <= 7 && (8..=12).contains(&robots[1]), "numbered through: {robots:?}");
}

fn text(of: &str, more: &str) -> String {
    format!(
        "duration_s = 1.0\nseed = 4\n[controller]\nkind = \"{of}\"\n{more}\n\
         [[teams]]\nrobots = 5\nfaults = 1\nstart = {{ kind = \"hexagon\" }}\nmotion = {{ kind = \"wander\" }}\n\
         [[teams]]\nrobots = 6\nfaults = 1\nstart = {{ kind = \"hexagon\", at_m = [900.0, 0.0] }}\n"
    )
}

/// A team does what it does alone, bit for bit, while the other is out of sight.
#[test]
fn a_team_that_meets_nobody_is_as_if_alone() {
    for of in ["budget", "links", "none"] {
        let both = scenario(&text(of, "")).unwrap();
        let alone = Scenario { strangers: 0, ..both.teams[0].clone() };
        let (mut both, mut alone) = (
            AnyWorld::new(&both, Options::default()).unwrap(),
            AnyWorld::new(&alone, Options::default()).unwrap(),
        );
        while !alone.is_over() {
            both.step();
            alone.step();
            assert_eq!(both.positions_m()[..10], *alone.positions_m(), "{of}");
            assert_eq!(both.held()[..5], *alone.held(), "{of}");
        }
    }
}

/// Each team begins with its own values, drawn with its own seed.
#[test]
fn values_of_all_teams_are_those_that_they_begin_with() {
    let spread = "[consensus]\ndimension = 2\n";
    for more in ["", spread] {
        let scenario = scenario(&text("budget", more)).unwrap();
        let world = AnyWorld::new(&scenario, Options::default()).unwrap();
        let numbers = initial_numbers(&scenario).unwrap();
        assert_eq!(numbers[0], world.held(), "{more}");
        assert_ne!(numbers[0][..5], numbers[0][5..10]);
        assert!(numbers.iter().all(|column| column.len() == 11), "{more}");
    }
}

/// Two teams that start in each other are pushed apart; meanwhile those who are too near say so, and nobody is towed.
#[test]
fn teams_that_start_too_near_come_apart() {
    for of in ["budget", "links"] {
        let near =
            text(of, "").replace("at_m = [900.0, 0.0]", "at_m = [0.1, 0.08]").replace("wander", "hold");
        let near = scenario(&near.replace("duration_s = 1.0", "duration_s = 3.0")).unwrap();
        let mut world = AnyWorld::new(&near, Options::default()).unwrap();
        let least_m = |flat: &[f64]| {
            let (places, _) = flat.as_chunks::<2>();
            let pairs = places[..5].iter().flat_map(|x| places[5..].iter().map(move |y| (x, y)));
            pairs.map(|(x, y)| (x[0] - y[0]).hypot(x[1] - y[1])).fold(f64::INFINITY, f64::min)
        };
        world.step();
        let start_m = least_m(world.positions_m());
        let said = world.modes().iter().filter(|mode| mode.name() == "outside safe set").count();
        assert!(start_m < 0.15 && said > 1, "{of}: {start_m} {said}");
        while !world.is_over() {
            world.step();
        }
        assert!(least_m(world.positions_m()) > 0.299, "{of}: {}", least_m(world.positions_m()));
        let run = world.finish();
        for law in [Law::Untowed, Law::Mode, Law::Decay] {
            assert_eq!(run.summary.broken(law), 0, "{of}: {law:?} {:?}", run.summary.verdicts.of(law));
        }
    }
}

/// A robot that comes waits while one of another team stands where it is to come.
#[test]
fn who_comes_waits_for_robots_of_other_teams() {
    let late = text("budget", "").replace(
        "[[teams]]\nrobots = 6\nfaults = 1",
        "[[teams]]\nrobots = 6\nfaults = 1\nabsent = [{ robot = 6, to_s = 0.2, at_m = [0.0, 0.1] }]",
    );
    let run = done(&scenario(&late.replace("wander", "hold")).unwrap());
    let (tick, robot, why) = run.summary.attendance.first.unwrap();
    assert_eq!((tick, robot, run.summary.attendance.arrived), (40, 11, 0));
    assert!(why.to_string().starts_with("a robot of another team was 0.1"), "{why}");
    assert_eq!(run.summary.violations(&scenario(&late).unwrap()).count(), 0);
}

#[test]
fn what_cannot_be_is_refused_by_the_name_of_its_team() {
    let good = text("budget", "");
    for (from, to, field, allowed) in [
        (
            "[[teams]]\nrobots = 5",
            "[team]\nrobots = 3\n[[teams]]\nrobots = 5",
            "team",
            "[[teams]] for several",
        ),
        ("robots = 6", "robotz = 6", "teams[1].robotz", "robots"),
        ("robots = 6", "robots = 1", "teams[1].robots", "2 to"),
        (
            "faults = 1\nstart = { kind = \"hexagon\", at",
            "faults = 3\nstart = { kind = \"hexagon\", at",
            "teams[1].faults",
            "2F + 1",
        ),
        ("at_m = [900.0, 0.0]", "at_m = [900.0]", "teams[1].start.at_m", "2 numbers"),
        ("at_m = [900.0, 0.0]", "at_m = [0.0, 0.0]", "teams[1].start", "a different point"),
        ("kind = \"wander\"", "kind = \"fly\"", "teams[0].motion.kind", "wander"),
        ("kind = \"budget\"", "kind = \"composed\"", "teams", "budget, links, none"),
        ("kind = \"budget\"", "kind = \"orca\"", "teams", "budget, links, none"),
        ("kind = \"budget\"", "kind = \"budget\"\n[link]\nradius_m = -1.0", "link.radius_m", "0"),
        (
            "kind = \"budget\"",
            "kind = \"budget\"\n[obstacles]\ndrawn = { discs = 1 }",
            "obstacles.drawn",
            "listed",
        ),
    ] {
        assert!(good.contains(from), "{from}");
        let problems = scenario(&good.replacen(from, to, 1)).unwrap_err();
        let told = problems[0].to_string();
        assert!(told.starts_with(&format!("`{field}` is ")) && told.contains(allowed), "{told}");
        assert_eq!(problems.len(), 1, "{problems:?}");
    }
    let one = "[[teams]]\nrobots = 5\n";
    assert!(scenario(one).unwrap_err()[0].to_string().contains("a list of 2 to 32 tables"));
    let several = scenario(&good).unwrap();
    assert_eq!(World::<2>::new(&several, Options::default()).err(), Some(RunError::Teams));
}

/// What is printed of the one mistake in a text, and the line at which it points.
#[track_caller]
fn mistake(text: &str) -> (String, usize) {
    let problems = scenario(text).unwrap_err();
    assert_eq!(problems.len(), 1, "{problems:?}");
    (problems[0].to_string(), problems[0].line(text))
}

#[test]
fn a_misspelt_field_of_a_team_is_refused_with_all_that_a_team_may_have() {
    let good = text("budget", "");
    let all = "allowed is `name`, `start`, `values`, `motion`, `attack`, `robots`, `faults`, `malicious`, `ranks`, `absent`";
    for (from, to, field) in [
        ("robots = 6", "robotz = 6", "robotz"),
        ("start = { kind = \"hexagon\", at", "starts = { kind = \"hexagon\", at", "starts"),
        ("robots = 6", "robots = 6\nlink = { radius_m = 2.0 }", "link"),
    ] {
        let (told, line) = mistake(&good.replacen(from, to, 1));
        assert_eq!(told, format!("`teams[1].{field}` is not a field here, {all}"));
        assert!(line >= 11, "{line}");
    }
    let (told, _) = mistake("[team]\nname = \"one\"\n");
    assert!(told.ends_with("allowed is `robots`, `faults`, `malicious`, `ranks`, `absent`"), "{told}");
}

#[test]
fn controllers_without_rows_for_other_teams_are_refused_at_the_teams() {
    for of in ["composed", "lambda2"] {
        let told = mistake(&text(of, ""));
        let expected = format!(
            "`teams` is under controller \"{of}\", which has no row for robots of other teams, \
             allowed is several teams only under budget, links, none"
        );
        assert_eq!(told, (expected, 6));
    }
}
