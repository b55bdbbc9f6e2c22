//! The world is stepped from outside: the loop of a run, wishes and lies that are given, and what is refused.

use closeranks_sim::attack::{LevelAttack, ValueAttack};
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Controller, Limits, Scenario};
use closeranks_sim::world::any::{AnyGiven, AnyWorld};
use closeranks_sim::world::given::{Given, GivenError};
use closeranks_sim::world::{Engine, Options, World, run};

fn short() -> Scenario {
    Scenario { duration_s: 1.0, ..Scenario::default() }
}

fn recorded() -> Options {
    Options { record: true, ..Options::default() }
}

#[test]
fn stepping_is_what_a_run_does() {
    let scenario = short();
    let whole = run(&scenario, recorded(), &mut |_| ()).unwrap();
    let mut world = World::<2>::new(&scenario, recorded()).unwrap();
    let mut steps = 0;
    while !world.is_over() {
        world.step();
        steps += 1;
    }
    assert_eq!(steps, scenario.ticks() + 1);
    assert_eq!(world.finish(), whole);
}

/// The same wishes from outside give the same run, with either engine and any controller.
#[test]
fn wishes_that_are_given_are_wishes() {
    for controller in Controller::ALL {
        for engine in [Engine::Team, Engine::Robots] {
            let scenario = Scenario { controller: *controller, ..short() };
            let options = Options { engine, ..recorded() };
            let mut own = World::<2>::new(&scenario, options).unwrap();
            let mut given = World::<2>::new(&scenario, options).unwrap();
            for _ in 0..100 {
                let desired = own.step().desired_m_s.clone();
                given.step_with(&Given { desired_m_s: Some(&desired), ..Given::default() }).unwrap();
            }
            assert_eq!(own.finish(), given.finish(), "{controller:?}");
        }
    }
}

/// Who prepares a tick sees where it finds the robots, and changes nothing; a tick that was only prepared is no part of the run.
#[test]
fn a_tick_that_is_prepared_is_the_same_tick() {
    let scenario = Scenario { controller: Controller::Budget, ..short() };
    for engine in [Engine::Team, Engine::Robots] {
        let options = Options { engine, ..recorded() };
        let mut plain = World::<2>::new(&scenario, options).unwrap();
        let mut prepared = World::<2>::new(&scenario, options).unwrap();
        for _ in 0..100 {
            let positions = prepared.prepare().positions_m.clone();
            let desired = prepared.prepare().desired_m_s.clone();
            let frame = plain.step();
            assert_eq!((&positions, &desired), (&frame.positions_m, &frame.desired_m_s));
            prepared.step_with(&Given { desired_m_s: Some(&desired), ..Given::default() }).unwrap();
        }
        prepared.prepare();
        assert_ne!(prepared.frame().positions_m, plain.frame().positions_m);
        assert_eq!(prepared.finish(), plain.finish());
    }
}

/// A bias that is told from outside gives the run of that attack; what is given for normal robots is not used.
#[test]
fn lies_that_are_given_are_told() {
    let attack = closeranks_sim::attack::Attack {
        value: ValueAttack::Constant { value: 7.0 },
        ..LevelAttack::Bias(-2.5).into()
    };
    for engine in [Engine::Team, Engine::Robots] {
        let options = Options { engine, ..recorded() };
        let mut lying = World::<2>::new(&Scenario { attack: attack.clone(), ..short() }, options).unwrap();
        let honest = Scenario { attack: ValueAttack::None.into(), ..short() };
        let mut given = World::<2>::new(&honest, options).unwrap();
        let values = [7.0; 11];
        for _ in 0..100 {
            let mut levels = lying.step().told.clone();
            levels[5] = 1e9;
            given
                .step_with(&Given { levels: Some(&levels), values: Some(&values), desired_m_s: None })
                .unwrap();
        }
        assert_eq!(lying.frame().positions_m, given.frame().positions_m);
        assert_eq!(lying.frame().values, given.frame().values);
    }
}

#[test]
fn arrays_of_another_length_and_no_numbers_are_refused_and_nothing_moves() {
    let mut world = AnyWorld::new(&short(), Options::default()).unwrap();
    world.step();
    let before = world.positions_m().to_vec();
    let desired = |numbers| AnyGiven { desired_m_s: Some(numbers), ..AnyGiven::default() };
    let length = |found, robots| GivenError::Length { array: "desired_m_s", found, robots };
    assert_eq!(world.step_with(&desired(&[0.0; 21])), Err(length(21, 22)));
    assert_eq!(world.step_with(&desired(&[0.0; 20])), Err(length(10, 11)));
    let mut wrong = [0.0; 22];
    wrong[5] = f64::NAN;
    assert_eq!(world.step_with(&desired(&wrong)), Err(GivenError::Number { array: "desired_m_s", robot: 3 }));
    let huge = AnyGiven { values: Some(&[1e301; 11]), ..AnyGiven::default() };
    let refused = world.step_with(&huge).unwrap_err();
    assert_eq!(refused.to_string(), "`values` of robot 1 is not a finite number that can be told");
    assert_eq!((world.ticks_done(), world.positions_m()), (1, &before[..]));
    world.step_with(&desired(&[0.0; 22])).unwrap();
    assert_eq!(world.ticks_done(), 2);
}

#[test]
fn three_dimensions_are_three_numbers_a_robot() {
    let limits = Limits { input_min_m_s: vec![-1.5; 3], input_max_m_s: vec![1.5; 3], ..Limits::default() };
    let start = Start::Random { half_side_m: 0.9, distance_min_m: 0.4 };
    let scenario = Scenario { dimension: 3, limits, start, ..short() };
    let mut world = AnyWorld::new(&scenario, Options::default()).unwrap();
    world.step();
    assert_eq!((world.dimension(), world.positions_m().len(), world.degrees().len()), (3, 33, 11));
    assert!(World::<2>::new(&scenario, Options::default()).is_err());
}
