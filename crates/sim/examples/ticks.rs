//! temp
use closeranks_sim::{
    attack::Liars,
    frame::Frame,
    scenario::Scenario,
    start::Start,
    team::Team,
    world::{initial_values, want},
};
fn main() {
    let n: u16 = std::env::args().nth(1).unwrap().parse().unwrap();
    let k: u32 = std::env::args().nth(2).unwrap().parse().unwrap();
    let radius_m = match n {
        11 => 3.0,
        100 => 7.0,
        _ => 22.0,
    };
    let s = Scenario { robots: n, radius_m, start: Start::Hexagon { spacing_m: 0.6 }, ..Scenario::default() };
    let p = s.params::<2>().unwrap();
    let v = initial_values(&s).unwrap();
    let mut f = Frame::new(s.start.positions(&s).unwrap(), v.clone());
    let mut t = Team::new(&s, p, &v);
    let mut l = Liars::new(&s);
    #[allow(clippy::disallowed_methods)]
    let t0 = std::time::Instant::now();
    for _ in 0..k {
        want(&s, &mut f);
        t.step(&mut f, &mut l);
        f.integrate(s.tick_s());
    }
    println!("{:?} per tick {:?}", t0.elapsed() / k, f.levels[0]);
}
