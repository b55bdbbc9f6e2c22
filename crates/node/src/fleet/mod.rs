//! A whole team on this machine: a process a robot, liars among them, a bad network, and the simulator's monitors beside it.

pub mod attacker;
pub mod camp;
pub mod events;
pub mod table;
pub mod tape;
pub mod verdict;

use core::sync::atomic::AtomicBool;
use std::path::PathBuf;

use closeranks_sim::world::RunError;
use core::time::Duration;

use crate::clock::{Clock, Kind};
use crate::fleet::attacker::Attacker;
use crate::fleet::camp::{Camp, CampError};
use crate::fleet::events::Events;
use crate::fleet::table::Table;
use crate::fleet::tape::{Sinks, Tape, TapeError};
use crate::fleet::verdict::{Costs, Verdict};
use crate::plant::pace::Pace;
use crate::plant::world::World;
use crate::scenarios::FleetScenario;
use crate::session::{Net, SessionError};

/// How long robots may take to start.
const PATIENCE: Duration = Duration::from_mins(1);
/// How long the router may take to start, ms.
const ROUTER_MS: u32 = 30_000;

/// What the user asks for.
#[derive(Clone, Debug)]
pub struct Options {
    /// How long, s, instead of the time in the scenario.
    pub duration_s: Option<f64>,
    /// Seed of every random draw, instead of that in the scenario.
    pub seed: Option<u64>,
    /// Where keys, the roster, configurations and proofs are kept. They are thrown away if there is none.
    pub folder: Option<PathBuf>,
    /// Whether to draw a table while it runs.
    pub live: bool,
}

/// Why a fleet did not run.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each says what it is about itself")]
pub enum FleetError {
    #[error(transparent)]
    Camp(#[from] CampError),
    #[error(transparent)]
    Session(#[from] SessionError),
    #[error(transparent)]
    Run(#[from] RunError),
    #[error(transparent)]
    Tape(#[from] TapeError),
    #[error("robots {robots} did not report within {seconds} s; with --out DIR their logs are kept")]
    Absent { robots: String, seconds: u64 },
}

/// Runs the fleet until its time is over or `stop`, and says what came of it. What happens goes into `sinks`.
pub fn run(
    file: &FleetScenario,
    options: &Options,
    sinks: Sinks,
    stop: &AtomicBool,
) -> Result<Verdict, FleetError> {
    let mut file = file.clone();
    if let Some(seed) = options.seed {
        (file.scenario.seed, file.text) = (seed, with_seed(&file.text, seed));
    }
    file.scenario.duration_s = options.duration_s.unwrap_or(file.scenario.duration_s);
    if file.scenario.dimension == 3 {
        run_in::<3>(&file, options, sinks, stop)
    } else {
        run_in::<2>(&file, options, sinks, stop)
    }
}

/// Least, middle and greatest share of a core that a robot used in so many s; robots that were started anew do not count.
fn cpu_share(begin_s: &[Option<f64>], end_s: &[Option<f64>], seconds: f64) -> [f64; 3] {
    let both = begin_s.iter().zip(end_s).filter_map(|(begin, end)| Some(end.as_ref()? - begin.as_ref()?));
    let mut shares: Vec<f64> =
        both.filter(|used| *used >= 0.0).map(|used| used / seconds.max(1e-9)).collect();
    shares.sort_by(f64::total_cmp);
    let at = |place: usize| shares.get(place).copied().unwrap_or(0.0);
    [at(0), at(shares.len() / 2), at(shares.len().saturating_sub(1))]
}

/// The text of a scenario with another seed.
fn with_seed(text: &str, seed: u64) -> String {
    let Ok(mut table) = toml::from_str::<toml::Table>(text) else { return text.to_owned() };
    table.insert("seed".into(), toml::Value::Integer(i64::try_from(seed).unwrap_or(i64::MAX)));
    toml::to_string(&table).unwrap_or_else(|_| text.to_owned())
}

fn run_in<const D: usize>(
    file: &FleetScenario,
    options: &Options,
    sinks: Sinks,
    stop: &AtomicBool,
) -> Result<Verdict, FleetError> {
    let scenario = &file.scenario;
    sinks.check(scenario)?;
    let mut camp = Camp::build(file, options.folder.clone())?;
    camp.start_all()?;
    let net = Net::open_within(&camp.network("client"), "client", Some(ROUTER_MS))?;
    let clock = Clock::start(Kind::Machine);
    let world = World::<D>::new(scenario, camp.roster(), clock.now())?;
    let mut plant = Pace::new(world, camp.roster(), camp.plant_key(), 1, clock, &net)?;
    let mut table = Table::new(options.live, scenario);
    let here = plant.gather(PATIENCE, stop, &mut |world, now| table.draw(world, &camp.states(), now));
    if !here {
        let absent = plant.world().reports().iter().zip(1..).filter(|(report, _)| report.is_none());
        let absent: Vec<String> = absent.map(|(_, id): (_, u16)| id.to_string()).collect();
        camp.stop_all();
        return Err(FleetError::Absent { robots: absent.join(", "), seconds: PATIENCE.as_secs() });
    }
    let mut tape = Tape::new(sinks, scenario, &file.text)?;
    let (memory_start, cpu_start) = (camp.memory_kb(), camp.cpu_s());
    let attacker = Attacker::start(&camp.network("client"), scenario, file.fleet.garbage_per_s)?;
    let mut events = Events::new(&file.fleet);
    let length = Duration::from_secs_f64(scenario.duration_s);
    let began = clock.now();
    plant.run(length, stop, &mut |world, now| {
        let since_s = now.since(began).as_secs_f64();
        events.happen(since_s, &mut camp);
        camp.notice_deaths();
        tape.tick(&world.snapshot());
        table.draw(world, &camp.states(), now);
    });
    let injected = attacker.map_or(0, Attacker::stop);
    let memory_kb = [memory_start, camp.memory_kb()];
    let cpu_share = cpu_share(&cpu_start, &camp.cpu_s(), clock.now().since(began).as_secs_f64());
    let proofs = camp.proofs();
    camp.stop_all();
    table.end();
    let costs = Costs { memory_kb, cpu_share };
    let verdict = Verdict::new(scenario, plant, &camp, costs, proofs, injected);
    net.close();
    tape.finish()?;
    Ok(verdict)
}
