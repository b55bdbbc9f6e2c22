//! Every controller that a scenario can name, one row each: what it is called, what it promises and needs to know, and how it
//! is made.
//!
//! A controller that a robot runs by itself lives in [`closeranks_core::controller`]. One that looks at the whole team
//! implements [`Velocities`] in a file beside this one; robots then run without a controller of their own and are asked
//! for the velocities that it finds, while links, levels, consensus, liars and monitors are those of the engine.

pub mod orca;

use closeranks_core::num::Vector;
use closeranks_core::program::Outcome;
use closeranks_core::settings::params::Params;
use closeranks_core::settings::{self, BudgetSettings, ComposedSettings, LinksSettings};

use crate::law::Law;

/// What a controller with global state is given in a tick.
#[derive(Clone, Copy, Debug)]
pub struct TeamView<'a, const D: usize> {
    /// Parameters of the team; their controller is none.
    pub params: &'a Params<D>,
    /// x_i, m.
    pub positions_m: &'a [Vector<D>],
    /// Velocities of the tick before, m/s; 0 at first.
    pub velocities_m_s: &'a [Vector<D>],
    /// u_{i,des}, m/s.
    pub desired_m_s: &'a [Vector<D>],
}

/// What such a controller answers for one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer<const D: usize> {
    /// What the robot is asked for, m/s. It is cut to the input box.
    pub velocity_m_s: Vector<D>,
    /// How it came about.
    pub outcome: Outcome,
}

/// A controller with global state.
pub trait Velocities {
    /// Fills `answers`, one a robot, in order of their numbers.
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]);
}

/// How much a controller needs to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Knows {
    /// What a robot senses and hears itself.
    Local,
    /// The state of the whole team.
    Global,
}

/// When a start is inside the safe set of a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// Every φ_i is not negative at some time (thm:cbf-qp).
    Shares,
    /// Every h_i of a normal robot is not negative, and no two robots are closer than Δ_d.
    Margins,
    /// Every normal robot has as many neighbours as it must count on, and no two robots are closer than Δ_d.
    Degrees,
}

/// Which violations of what a controller promises count against it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// Those in which everything held that the promise rests on.
    Covered,
    /// All: nothing is promised, so nothing excuses.
    All,
}

/// Parameters of all controllers that have any. They are there whichever controller is run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Parameters of `composed`.
    pub composed: ComposedSettings,
    /// Parameters of `budget`.
    pub budget: BudgetSettings,
    /// Parameters of `links`.
    pub links: LinksSettings,
}

/// How a controller is made.
#[derive(Clone, Copy, Debug)]
pub enum Make {
    /// Every robot runs it.
    Local(fn(&Parameters) -> settings::Controller),
    /// It is made for the whole team.
    Global(fn(&Parameters) -> Global),
}

/// What is to be known of a controller.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Its name in scenario files.
    pub name: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    /// How much it needs to know.
    pub knows: Knows,
    /// Whether it guarantees in discrete time what it promises. Robots then watch what that rests on: their clocks, and
    /// whether they are where their moves should have taken them.
    pub guarantees: bool,
    /// Whether ranks may tell who counts for whom.
    pub ranks: bool,
    /// Whether φ_i is part of its decisions.
    pub uses_phi: bool,
    /// The laws that sweeps hold it to.
    pub promises: &'static [Law],
    /// Which violations of them count.
    pub counted: Counted,
    /// The laws that a scenario expects if it says nothing.
    pub expects: &'static [Law],
    /// When a start is inside its safe set.
    pub inside: Inside,
    /// How it is made.
    pub make: Make,
}

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
            about: "ours: a guarantee in discrete time, for any lie and any loss of messages",
            knows: Knows::Local,
            guarantees: true,
            ranks: false,
            uses_phi: false,
            promises: &Law::PROMISED,
            counted: Counted::Covered,
            expects: &Law::PROMISED,
            inside: Inside::Margins,
            make: Make::Local(|of| settings::Controller::Budget(of.budget)),
        },
        /// The paper's (eq:split, seq:qp).
        Composed: Row {
            name: "composed",
            about: "the paper's, as printed",
            knows: Knows::Local,
            guarantees: false,
            ranks: false,
            uses_phi: true,
            promises: &Law::COMPOSED,
            counted: Counted::Covered,
            expects: &Law::EXPECTED,
            inside: Inside::Shares,
            make: Make::Local(|of| settings::Controller::Composed(of.composed)),
        },
        /// Ours without weights (docs/links.md).
        Links: Row {
            name: "links",
            about: "ours, without weights: robots agree on the links that they keep",
            knows: Knows::Local,
            guarantees: true,
            ranks: true,
            uses_phi: false,
            promises: &Law::LINKS,
            counted: Counted::Covered,
            expects: &Law::LINKS,
            inside: Inside::Degrees,
            make: Make::Local(|scenario| settings::Controller::Links(scenario.links)),
        },
        /// None: the desired velocity, cut to the box. What the paper's robots would do unfiltered.
        None: Row {
            name: "none",
            about: "the desired velocity, cut to the input box",
            knows: Knows::Local,
            guarantees: false,
            ranks: false,
            uses_phi: false,
            promises: &Law::EXPECTED,
            counted: Counted::All,
            expects: &Law::EXPECTED,
            inside: Inside::Margins,
            make: Make::Local(|_| settings::Controller::None),
        },
        /// Collision avoidance alone ([`orca`]).
        Orca: Row {
            name: "orca",
            about: "collision avoidance alone, by reciprocal half-planes",
            knows: Knows::Global,
            guarantees: false,
            ranks: false,
            uses_phi: false,
            promises: &[Law::Interval, Law::Input],
            counted: Counted::Covered,
            expects: &[Law::Interval, Law::Input],
            inside: Inside::Margins,
            make: Make::Global(|_| Global::Orca(orca::Orca::default())),
        },
    }
    global { Orca: orca::Orca, }
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
