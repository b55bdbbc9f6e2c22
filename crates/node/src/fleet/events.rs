//! What happens to the processes of a fleet, in the order of its time.

use crate::fleet::camp::Camp;
use crate::scenarios::Fleet;

/// What is done to a process.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Deed {
    Kill(u16),
    Revive(u16),
    RestartRouter,
}

/// Deeds with their times, s.
pub struct Events {
    deeds: Vec<(f64, Deed)>,
    next: usize,
}

impl Events {
    /// What the table `fleet` says.
    #[must_use]
    pub fn new(fleet: &Fleet) -> Self {
        let kills = fleet.kill.iter().map(|kill| (kill.at_s, Deed::Kill(kill.robot)));
        let back = fleet.kill.iter().filter_map(|kill| Some((kill.back_s?, Deed::Revive(kill.robot))));
        let routers = fleet.restart_router_s.iter().map(|at_s| (*at_s, Deed::RestartRouter));
        let mut deeds: Vec<_> = kills.chain(back).chain(routers).collect();
        deeds.sort_by(|first, second| first.0.total_cmp(&second.0));
        Self { deeds, next: 0 }
    }

    /// Does all that is due at `since_s`.
    pub fn happen(&mut self, since_s: f64, camp: &mut Camp) {
        while let Some((_, deed)) = self.deeds.get(self.next).filter(|(at_s, _)| *at_s <= since_s) {
            match deed {
                Deed::Kill(id) => camp.kill(*id),
                Deed::Revive(id) => camp.revive(*id),
                Deed::RestartRouter => camp.restart_router(),
            }
            self.next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenarios::Kill;

    #[test]
    fn deeds_come_in_the_order_of_their_times() {
        let kill =
            vec![Kill { robot: 4, at_s: 2.0, back_s: Some(5.0) }, Kill { robot: 3, at_s: 1.0, back_s: None }];
        let events = Events::new(&Fleet { kill, restart_router_s: vec![3.0], ..Fleet::default() });
        let deeds: Vec<Deed> = events.deeds.iter().map(|(_, deed)| *deed).collect();
        assert_eq!(deeds, [Deed::Kill(3), Deed::Kill(4), Deed::RestartRouter, Deed::Revive(4)]);
    }
}
