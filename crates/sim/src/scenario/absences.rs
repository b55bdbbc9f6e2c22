//! Robots of the roster that are not in the plane for a while: when they leave, when they come, and where.

use closeranks_core::num::Vector;
use closeranks_core::settings::range::{Allowed, MAGNITUDE_MAX};
use toml::de::DeValue;

use crate::controllers::Controller;
use crate::faults::Spell;
use crate::parse::common::{ANY, NOT_NEGATIVE, set, small};
use crate::parse::reader::{Reader, Section};
use crate::parse::value::number;
use crate::scenario::Scenario;

/// How many times robots may leave in a run.
const ABSENCES_MAX: usize = 1_000;

/// A robot that has no body for a while. It is in the roster all the time, so that nobody's number, F or F' changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Absence {
    /// Who, from when, and until when; the end is infinite for a robot that does not come again.
    pub spell: Spell,
    /// Where it comes afterwards, m, one number a dimension; drawn in range of somebody if it is not said.
    pub at_m: Option<Vec<f64>>,
    /// True if nobody is told when it leaves.
    pub silent: bool,
}

impl Absence {
    /// Reads the list `absent` of the table `team`, in the order of robots and times.
    pub(crate) fn read(
        reader: &mut Reader,
        section: &mut Section<'_>,
        robots: u16,
        dimension: usize,
    ) -> Vec<Self> {
        let one =
            |reader: &mut Reader, section: &mut Section<'_>| Self::one(reader, section, robots, dimension);
        let mut all = reader.tables(section, "absent", ABSENCES_MAX, one);
        all.sort_by(|one, other| {
            one.spell.robot.cmp(&other.spell.robot).then(one.spell.from_s.total_cmp(&other.spell.from_s))
        });
        all
    }

    fn one(reader: &mut Reader, section: &mut Section<'_>, robots: u16, dimension: usize) -> Self {
        let given = section.has("robot");
        let robot = reader.whole(section, "robot", 1..u64::from(robots) + 1).map(small);
        if !given {
            let (field, allowed) = (section.name("robot"), format!("a whole number, 1 to {robots}"));
            reader.refuse_in(section, &field, "not there", allowed);
        }
        let from_s = reader.number_or(section, "from_s", NOT_NEGATIVE, 0.0);
        let to_s = reader.number(section, "to_s", Allowed::LeftOpen(from_s, MAGNITUDE_MAX));
        let words = [("announced", false), ("silently", true)];
        let mut silent = false;
        set(&mut silent, reader.word(section, "leaves", &words));
        let coordinate = format!("a finite number (m), {ANY}");
        let field = section.name("at_m");
        let inside = |value: &DeValue<'_>| number(value).filter(|number| ANY.holds(*number));
        let at_m = reader.list(section, "at_m", &coordinate, inside);
        if let Some(at_m) = at_m.as_ref().filter(|at_m| at_m.len() != dimension) {
            reader.refuse(&field, format!("a list of {}", at_m.len()), format!("{dimension} numbers"));
        }
        let spell = Spell { robot: robot.unwrap_or(1), from_s, to_s: to_s.unwrap_or(f64::INFINITY) };
        Self { spell, at_m, silent }
    }

    /// Notes what cannot be run: a robot that leaves while it is away, and whoever has no idea of absent robots.
    pub(crate) fn check(reader: &mut Reader, scenario: &Scenario) {
        if scenario.absences.is_empty() {
            return;
        }
        let field = "team.absent";
        let pairs = scenario.absences.iter().zip(scenario.absences.iter().skip(1));
        let mut overlapping = pairs
            .map(|(one, next)| (one.spell, next.spell))
            .filter(|(one, next)| one.robot == next.robot && next.from_s <= one.to_s);
        if let Some((one, next)) = overlapping.next() {
            let found = format!("robot {} leaves at {} s, while it is away", one.robot, next.from_s);
            return reader.refuse(field, found, format!("later than {} s", one.to_s));
        }
        if !scenario.controller.row().runs_with_absent() {
            let local = Controller::ALL.iter().filter(|of| of.row().runs_with_absent());
            let names: Vec<_> = local.map(|of| of.name()).collect();
            let found = format!(
                "under controller \"{}\", which looks at all of the roster",
                scenario.controller.name()
            );
            return reader.refuse(field, found, format!("only under {}", names.join(", ")));
        }
        if !scenario.consensus.is_of_robots() {
            let found = "beside a rule or values that the world runs";
            return reader.refuse(field, found, "rules of robots, and values of one number");
        }
        match scenario.dimension {
            3 => Self::check_places::<3>(reader, scenario),
            _ => Self::check_places::<2>(reader, scenario),
        }
        if scenario.ranks.is_some() {
            reader.refuse(field, "beside team.ranks", "one of the two: ranks are chosen for all who start");
        }
    }

    /// Nobody ever comes to a place that is too near to an obstacle.
    fn check_places<const D: usize>(reader: &mut Reader, scenario: &Scenario) {
        let said = scenario.absences.iter().filter_map(Self::place_m::<D>).collect::<Vec<_>>();
        let keep_m = scenario.start_clearance_m::<D>();
        if let Some((place, index, gap_m)) = scenario.obstacles.too_near(&said, keep_m) {
            let obstacle = scenario.obstacles.field(index);
            let found = format!("{gap_m:.4} m between {:?} and {obstacle}", said[place]);
            let allowed = format!("at least {keep_m} m: obstacles.clearance_m and what stated errors cost");
            reader.refuse("team.absent", found, allowed);
        }
    }

    /// The place where the robot comes, m, if it is said.
    pub(crate) fn place_m<const D: usize>(&self) -> Option<Vector<D>> {
        Vector::<D>::try_from(self.at_m.as_deref()?).ok()
    }
}
