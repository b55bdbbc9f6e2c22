//! Every controller that a scenario can name, one row each: what it is called, what it promises and needs to know, and how it
//! is made.
//!
//! A controller that a robot runs by itself lives in [`closeranks_core::controller`]. One that looks at the whole team
//! implements [`Velocities`] in a file beside this one; robots then run without a controller of their own and are asked
//! for the velocities that it finds, while links, levels, consensus, liars and monitors are those of the engine.

pub mod central_composed;
pub mod central_robustness;
pub mod fixed_topology;
pub mod k_connectivity;
pub mod lambda2;
pub mod min_composition;
pub mod orca;
pub mod p_choose_r;
pub mod pairwise;
mod row;
mod shared;

use closeranks_core::settings;

use row::of_others;
pub use row::{Amid, Answer, Counted, Inside, Knows, Make, Parameters, Row, TeamView, Tuning, Velocities};

use crate::law::Law;

/// Makes the closed enums of all controllers and of those with global state out of the table.
macro_rules! controllers {
    (
        table { $($(#[$doc:meta])* $name:ident: $row:expr,)* }
        global { $($global:ident: $type:ty,)* }
    ) => {
        /// The controllers, in the order of their names.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Controller {
            $($(#[$doc])* $name,)*
        }

        impl Controller {
            /// All, in the order of their names.
            pub const ALL: &'static [Self] = &[$(Self::$name,)*];

            /// What is to be known of it.
            #[must_use]
            pub fn row(self) -> &'static Row {
                match self {
                    $(Self::$name => const { &$row },)*
                }
            }
        }

        /// A controller with global state, of whichever kind.
        #[derive(Clone, Debug)]
        pub enum Global {
            $(#[expect(missing_docs, reason = "its file says what it is")] $global($type),)*
        }

        impl Velocities for Global {
            fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
                match *self {
                    $(Self::$global(ref mut controller) => controller.velocities(view, answers),)*
                }
            }
        }
    };
}

controllers! {
    table {
        /// Ours (docs/budget.md).
        Budget: Row {
            name: "budget",
            about: "ours, from what is sensed alone: a guarantee in discrete time that no message can touch",
            knows: Knows::Local,
            needs: "senses",
            tuning: Tuning::USUAL,
            guarantees: true,
            ranks: true,
            uses_phi: false,
            amid: Amid::Avoids,
            strangers: Amid::Avoids,
            cuts: Amid::Refuses,
            promises: &Law::PROMISED,
            counted: Counted::Covered,
            expects: &Law::PROMISED,
            inside: Inside::Margins,
            make: Make::Local(|of| settings::Controller::Budget(of.budget)),
        },
        /// The paper's composed constraint for all robots at once ([`central_composed`]).
        CentralComposed: of_others("central-composed", "the paper's constraint before it is split: one row for the whole team",
            "everything", Tuning::USUAL,
            |of| Global::CentralComposed(central_composed::CentralComposed::new(of.composed))),
        /// Robustness by percolation ([`central_robustness`]).
        CentralRobustness: of_others("central-robustness", "robustness kept by bootstrap percolation from a core",
            "everything", Tuning::rate(1.0),
            |_| Global::CentralRobustness(central_robustness::CentralRobustness::default())),
        /// The paper's (eq:split, seq:qp).
        Composed: Row {
            name: "composed",
            about: "the paper's, as printed",
            knows: Knows::Local,
            needs: "senses and messages",
            tuning: Tuning::USUAL,
            guarantees: false,
            ranks: false,
            uses_phi: true,
            amid: Amid::Avoids,
            strangers: Amid::Refuses,
            cuts: Amid::Refuses,
            promises: &Law::COMPOSED,
            counted: Counted::Covered,
            expects: &Law::EXPECTED,
            inside: Inside::Shares,
            make: Make::Local(|of| settings::Controller::Composed(of.composed)),
        },
        /// The links of the start ([`fixed_topology`]).
        FixedTopology: of_others("fixed-topology", "the links of the start are kept",
            "positions at far ends", Tuning::rate(2.0),
            |_| Global::FixedTopology(fixed_topology::FixedTopology::default())),
        /// Node connectivity ([`k_connectivity`]).
        KConnectivity: of_others("k-connectivity", "a sparse subgraph is kept that 2F robots cannot cut",
            "everything", Tuning::rate(0.2),
            |_| Global::KConnectivity(k_connectivity::KConnectivity::default())),
        /// Algebraic connectivity ([`lambda2`]).
        Lambda2: of_others("lambda2", "algebraic connectivity is kept above 4F",
            "everything", Tuning::rate(1.0),
            |_| Global::Lambda2(lambda2::Lambda2::default())),
        /// Ours without weights (docs/links.md).
        Links: Row {
            name: "links",
            about: "ours, without weights: robots agree on the links that they keep",
            knows: Knows::Local,
            needs: "senses and messages",
            tuning: Tuning::USUAL,
            guarantees: true,
            ranks: true,
            uses_phi: false,
            amid: Amid::Avoids,
            strangers: Amid::Avoids,
            cuts: Amid::Avoids,
            promises: &Law::LINKS,
            counted: Counted::Covered,
            expects: &Law::LINKS,
            inside: Inside::Degrees,
            make: Make::Local(|scenario| settings::Controller::Links(scenario.links)),
        },
        /// The least of all barriers ([`min_composition`]).
        MinComposition: of_others("min-composition", "the least of all degrees and distances is kept",
            "everything", Tuning::rate(0.05),
            |_| Global::MinComposition(min_composition::MinComposition::default())),
        /// None: the desired velocity, cut to the box. What the paper's robots would do unfiltered.
        None: Row {
            name: "none",
            about: "the desired velocity, cut to the input box",
            knows: Knows::Local,
            needs: "nothing",
            tuning: Tuning::USUAL,
            guarantees: false,
            ranks: false,
            uses_phi: false,
            amid: Amid::Ignores,
            strangers: Amid::Ignores,
            cuts: Amid::Ignores,
            promises: &Law::EXPECTED,
            counted: Counted::All,
            expects: &Law::EXPECTED,
            inside: Inside::Margins,
            make: Make::Local(|_| settings::Controller::None),
        },
        /// Collision avoidance alone ([`orca`]).
        Orca: of_others("orca", "collision avoidance alone, by reciprocal half-planes",
            "positions, velocities", Tuning::horizon(2.0),
            |_| Global::Orca(orca::Orca::default())),
        /// The F′ nearest links of each robot ([`p_choose_r`]).
        PChooseR: of_others("p-choose-r", "each robot keeps its F' shortest links, whichever these are",
            "positions in range", Tuning::rate(2.0),
            |_| Global::PChooseR(p_choose_r::PChooseR::default())),
        /// Every link that there is ([`pairwise`]).
        Pairwise: of_others("pairwise", "every link is kept, each robot does half of it",
            "positions in range", Tuning::rate(2.0),
            |_| Global::Pairwise(pairwise::Pairwise::default())),
    }
    global {
        CentralComposed: central_composed::CentralComposed,
        CentralRobustness: central_robustness::CentralRobustness,
        FixedTopology: fixed_topology::FixedTopology,
        KConnectivity: k_connectivity::KConnectivity,
        Lambda2: lambda2::Lambda2,
        MinComposition: min_composition::MinComposition,
        Orca: orca::Orca,
        PChooseR: p_choose_r::PChooseR,
        Pairwise: pairwise::Pairwise,
    }
}

impl Controller {
    /// Its name in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The controller of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|controller| controller.name() == name)
    }

    /// True if it promises `law`.
    #[must_use]
    pub fn promises(self, law: Law) -> bool {
        self.row().promises.contains(&law)
    }

    /// True if monitors look at `law` under it: laws about φ_i where it uses φ_i, laws about what a controller says of itself
    /// where it promises them.
    #[must_use]
    pub fn watches(self, law: Law) -> bool {
        let about_phi = law.is_about_phi();
        (!about_phi || self.row().uses_phi) && (!law.is_own() || self.promises(law))
    }

    /// What every robot runs: the controller itself, or none beside one with global state.
    pub(crate) fn settings(self, parameters: &Parameters) -> settings::Controller {
        match self.row().make {
            Make::Local(make) => make(parameters),
            Make::Global(_) => settings::Controller::None,
        }
    }

    /// The controller of the whole team, if it is one.
    pub(crate) fn global(self, parameters: &Parameters) -> Option<Global> {
        match self.row().make {
            Make::Local(_) => None,
            Make::Global(make) => Some(make(parameters)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_in_order_and_lead_back() {
        assert!(Controller::ALL.is_sorted_by(|one, next| one.name() < next.name()));
        for controller in Controller::ALL {
            assert_eq!(Controller::named(controller.name()), Some(*controller));
            let row = controller.row();
            assert!(row.expects.iter().all(|law| row.promises.contains(law)), "{}", row.name);
            assert_eq!(row.knows == Knows::Global, matches!(row.make, Make::Global(_)), "{}", row.name);
        }
    }
}
