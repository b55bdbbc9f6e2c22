//! The sentences of the paper's section V, each held against the runs.

use closeranks_sim::law::Law;
use closeranks_sim::output::record::Record;
use closeranks_sim::output::summary::Summary;

use super::content::Claim;
use super::table::number;

/// The runs that the paper's section V speaks of, from one start.
#[derive(Clone, Copy, Debug)]
pub struct SectionFive<'a> {
    /// F′.
    pub required: u16,
    /// Δ_d, m.
    pub distance_min_m: f64,
    /// Nominal, understating, overstating.
    pub runs: [&'a Summary; 3],
    /// Every tick of the three.
    pub records: [&'a Record; 3],
    /// The desired motion without any filter.
    pub unfiltered: &'a Summary,
}

/// Growth below this part of the desired speed (1 m/s) counts as having stopped.
const STOPPED_M_S: f64 = 0.01;

impl SectionFive<'_> {
    /// Every claim with its numbers.
    #[must_use]
    pub fn claims(&self) -> Vec<Claim> {
        [self.before(), self.kept(), self.effects(), self.let_go(), self.theorem()].concat()
    }

    fn each(&self, what: impl Fn(&Summary) -> String) -> String {
        let [nominal, under, over] = self.runs.map(what);
        format!("nominal {nominal}, understating {under}, overstating {over}")
    }

    fn all(&self, holds: impl Fn(&Summary) -> bool) -> bool {
        self.runs.into_iter().all(holds)
    }

    fn before(&self) -> Vec<Claim> {
        let free = &self.unfiltered.extremes;
        vec![
            claim(
                "Each simulation begins with every robot having at least seven neighbors",
                self.all(|run| run.start.degree_min >= self.required),
                format!("least degree at the start: {}", self.each(|run| run.start.degree_min.to_string())),
            ),
            claim(
                "robots will move in four different directions, which would break the network",
                free.degree_min < Some(self.required),
                format!(
                    "without the filter the least degree of normal robots falls to {}",
                    degree(free.degree_min)
                ),
            ),
            claim(
                "and prevent resilient consensus",
                free.rounds_to_agree.is_none(),
                match free.rounds_to_agree {
                    Some(rounds) => format!(
                        "without the filter values still agree, in round {rounds}, before the network breaks"
                    ),
                    None => {
                        format!("without the filter the spread of values stays at {}", number(free.spread, 1))
                    }
                },
            ),
        ]
    }

    fn kept(&self) -> Vec<Claim> {
        vec![
            claim(
                "robots eventually stop dispersing",
                self.all(|run| run.spreading_m_s[1].abs() < STOPPED_M_S),
                format!(
                    "growth of the radius of gyration at the end, m/s (robots want 1, below {STOPPED_M_S} counts as stopped): {}",
                    self.each(|run| number(run.spreading_m_s[1], 4))
                ),
            ),
            claim(
                "to allow normal robots maintain at least seven neighbors",
                self.all(|run| run.broken(Law::Degree) == 0),
                format!(
                    "least degree of normal robots: {}",
                    self.each(|run| degree(run.extremes.degree_min))
                ),
            ),
            claim(
                "while avoiding collisions",
                self.all(|run| run.broken(Law::Distance) == 0),
                format!(
                    "least distance, m (demanded {}): {}{}",
                    self.distance_min_m,
                    self.each(|run| number(run.extremes.distance_min_m, 3)),
                    if self.runs[0].start.distance_min_m < self.distance_min_m {
                        "; the start itself is too close"
                    } else {
                        ""
                    }
                ),
            ),
            claim(
                "these variations in updates do not compromise resilient consensus",
                self.all(|run| run.broken(Law::Interval) == 0 && run.extremes.rounds_to_agree.is_some()),
                format!(
                    "rounds until normal values agree to 1 in 1000, inside their initial interval: {}",
                    self.each(|run| run
                        .extremes
                        .rounds_to_agree
                        .map_or("never".into(), |rounds| rounds.to_string()))
                ),
            ),
        ]
    }

    fn effects(&self) -> Vec<Claim> {
        let [nominal, under, over] = self.runs;
        let gyration =
            format!("radius of gyration at the end, m: {}", self.each(|run| number(run.gyration_m, 3)));
        let near = |run: &Summary| run.liar_distance_m.unwrap_or(f64::NAN);
        vec![
            claim(
                "understating behaviors impose more connectivity constraints for normal robots to remain close to malicious agents",
                near(under) < near(nominal),
                format!(
                    "mean distance from normal to malicious robots, m: {}",
                    self.each(|run| number(near(run), 3))
                ),
            ),
            claim(
                "leading to a more compact network",
                under.gyration_m < nominal.gyration_m,
                gyration.clone(),
            ),
            claim(
                "overstating behaviors relax these constraints, allowing normal agents to move more freely and form a more dispersed network",
                over.gyration_m > nominal.gyration_m,
                gyration,
            ),
        ]
    }

    /// One sentence, two measures: the paper points to h_i in its Fig. 2(c), the words speak of neighbours.
    fn let_go(&self) -> Vec<Claim> {
        let [h_nominal, h_under, h_over] = self.records.map(malicious_below_zero);
        let [.., over] = self.runs;
        vec![
            claim(
                "one malicious robot fails to maintain seven neighbors",
                h_over == 1,
                format!(
                    "by h_i, as Fig. 2(c) shows it: malicious robots whose h_i was ever below 0: nominal {h_nominal}, \
                     understating {h_under}, overstating {h_over}"
                ),
            ),
            paraphrase(
                "The same by degree: one malicious robot has fewer than seven neighbors when both overstate.",
                over.malicious_below == 1,
                format!(
                    "malicious robots that ever had fewer than {}: {}; least degree when overstating: {}. In h_i a link counts \
                     the less the longer it is: h_i is below 0 before a neighbour is lost, also where none is lost at all",
                    self.required,
                    self.each(|run| run.malicious_below.to_string()),
                    degree(over.extremes.malicious_degree_min)
                ),
            ),
        ]
    }

    fn theorem(&self) -> Vec<Claim> {
        vec![
            paraphrase(
                "[thm:cbf-qp, hypothesis] The start lies in the safe set: every phi_i >= 0.",
                self.all(|run| run.start.inside),
                format!("least phi_i at the start: {}", self.each(|run| number(run.start.phi_min, 4))),
            ),
            paraphrase(
                "[lem:equivalence] The program of every robot is feasible at all times.",
                self.all(|run| run.broken(Law::Feasible) == 0),
                format!("infeasible programs: {}", self.each(|run| run.broken(Law::Feasible).to_string())),
            ),
            paraphrase(
                "[thm:cbf-qp, part 1] The set of all phi_i >= 0 is never left.",
                self.all(|run| run.broken(Law::Shares) == 0),
                format!(
                    "negative phi_i (per robot and tick; docs/theory, sec:phi): {}",
                    self.each(|run| run.broken(Law::Shares).to_string())
                ),
            ),
            paraphrase(
                "[cor:naive] With nominal updating malicious robots keep seven neighbors too.",
                self.runs[0].malicious_below == 0,
                format!("their least degree: {}", degree(self.runs[0].extremes.malicious_degree_min)),
            ),
        ]
    }
}

/// How many malicious robots had a negative h_i at some tick.
fn malicious_below_zero(record: &Record) -> usize {
    let robots = usize::from(record.robots).max(1);
    let is_below = |index: usize| record.h.iter().skip(index).step_by(robots).any(|h| *h < 0.0);
    let malicious = record.malicious.iter().enumerate().filter(|(_, malicious)| **malicious);
    malicious.filter(|(index, _)| is_below(*index)).count()
}

/// Words of the paper, as printed.
fn claim(sentence: &str, holds: bool, numbers: String) -> Claim {
    Claim { sentence: sentence.to_owned(), is_quotation: true, holds, numbers }
}

/// What a theorem of the paper says, in our words.
fn paraphrase(sentence: &str, holds: bool, numbers: String) -> Claim {
    Claim { is_quotation: false, ..claim(sentence, holds, numbers) }
}

fn degree(least: Option<u16>) -> String {
    least.map_or("none".to_owned(), |degree| degree.to_string())
}
