//! Which controller to take, as docs/which.md says it.

use clap::Args;
use closeranks_sim::advice::question::Question;

/// What robots tell each other, and what becomes of it.
#[derive(Args, Clone, Copy, Debug)]
pub(super) struct Talk {
    /// Robots tell each other nothing of their motion.
    #[arg(long)]
    silent: bool,
    /// Share of messages that are lost [default: 0].
    #[arg(long, value_name = "P", value_parser = share)]
    loss: Option<f64>,
}

/// A condition of the table of docs/which.md, and how wide a team ended in it, m.
struct Measured {
    about: &'static str,
    links_m: f64,
    budget_m: f64,
}

const TABLE: [Measured; 9] = [
    Measured { about: "11 robots, 5 ms", links_m: 1.953, budget_m: 1.604 },
    Measured { about: "20 ms", links_m: 1.952, budget_m: 1.574 },
    Measured { about: "100 ms", links_m: 1.951, budget_m: 1.548 },
    Measured { about: "half of all messages lost", links_m: 1.952, budget_m: 1.574 },
    Measured { about: "positions wrong by 1 cm, stated", links_m: 1.941, budget_m: 1.546 },
    Measured { about: "a lag of 20 ms, stated", links_m: 1.659, budget_m: 1.380 },
    Measured { about: "assume = free", links_m: 1.746, budget_m: 1.521 },
    Measured { about: "40 robots", links_m: 1.952, budget_m: 1.603 },
    Measured { about: "40 robots, 100 ms", links_m: 1.947, budget_m: 1.558 },
];

impl Talk {
    /// The controller to take.
    pub(super) fn controller(&self) -> &'static str {
        if self.silent || self.loses_all() { "budget" } else { "links" }
    }

    fn loses_all(&self) -> bool {
        self.loss.is_some_and(|loss| loss >= 1.0)
    }

    /// The controller to take, why, and what was measured nearest to what is asked.
    pub(super) fn advice(&self, question: &Question, assume: &str) -> String {
        let why = if self.silent {
            "Robots that tell each other nothing of their motion take budget: it reckons with what they sense alone."
        } else if self.loses_all() {
            "Nothing that they tell arrives, so robots take budget: it reckons with what they sense alone."
        } else {
            "Robots that talk take links: they agree on the links that they keep, and get farther than with budget, in every \
             condition measured. Robots that do not talk take budget (--silent)."
        };
        let Measured { about, links_m, budget_m } = self.nearest(question, assume);
        format!(
            "{why} Of the conditions in docs/which.md the nearest is: {about}. There links ended {links_m} m wide and budget \
             {budget_m} m, in the mean of 60 starts. composed is for comparison with the paper: in discrete time it promises \
             nothing."
        )
    }

    /// The condition whose trouble is most like that of the question; without any, by team and tick.
    fn nearest(&self, question: &Question, assume: &str) -> &'static Measured {
        let scenario = question.settled();
        let (slow, many) = (scenario.tick_s() > 0.05, scenario.team.robots > 25);
        let about = match () {
            () if scenario.errors.tracking_m > 0.0 => "a lag of 20 ms, stated",
            () if scenario.errors.position_m > 0.0 => "positions wrong by 1 cm, stated",
            () if assume == "free" => "assume = free",
            () if !self.silent && self.loss.is_some_and(|loss| loss > 0.0) => "half of all messages lost",
            () if many && slow => "40 robots, 100 ms",
            () if many => "40 robots",
            () if slow => "100 ms",
            () if scenario.tick_s() > 0.01 => "20 ms",
            () => "11 robots, 5 ms",
        };
        TABLE.iter().find(|measured| measured.about == about).unwrap_or(&TABLE[0])
    }
}

fn share(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    number.ok_or_else(|| "allowed is a number, 0 to 1".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_has_the_numbers() {
        let page = include_str!("../../../../docs/which.md");
        for Measured { about, links_m, budget_m } in &TABLE {
            let row = format!("| {about} | {links_m:.3} | {budget_m:.3} |");
            assert!(page.contains(&row), "docs/which.md must have: {row}");
            assert!(links_m > budget_m, "{about}: the advice is that of the table");
        }
    }
}
