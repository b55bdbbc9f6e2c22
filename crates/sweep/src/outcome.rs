//! What a sweep came to: for people and for machines.

use core::fmt::Write as _;

use closeranks_report::sweep::broken;
use closeranks_report::sweep::confidence::upper_95;
use closeranks_report::sweep::tables::{controllers, values};
use closeranks_report::sweep::tally::{Share, Tally, Violating, promises};
use closeranks_report::table::{number, telling, text};
use closeranks_sim::controllers::Controller;
use closeranks_sim::law::Law;
use serde_json::{Map, Value, json};

use crate::PROGRAM;
use crate::manifest::Manifest;

/// A counted sweep.
#[derive(Clone, Copy, Debug)]
pub struct Outcome<'a> {
    /// What decided it.
    pub manifest: &'a Manifest,
    /// Its counts.
    pub tally: &'a Tally,
    /// Laws that count.
    pub laws: &'a [&'a str],
}

/// Laws that some controller promises, in the order of reports.
#[must_use]
pub fn laws(tally: &Tally) -> Vec<&'static str> {
    let promised = |law: &&str| tally.controllers.keys().any(|name| promises(name, law));
    Law::ALL.into_iter().map(Law::name).filter(promised).collect()
}

impl Outcome<'_> {
    /// False if a promised law was violated under a controller that guarantees its promises, or, where there is none, under any.
    #[must_use]
    pub fn is_good(&self) -> bool {
        let shares = &self.tally.controllers;
        let guarantees =
            |name: &str| Controller::named(name).is_some_and(|controller| controller.row().guarantees);
        let judged: Vec<&Share> =
            shares.iter().filter(|(name, _)| guarantees(name)).map(|(_, share)| share).collect();
        let all_good = |mut shares: core::slice::Iter<'_, &Share>| shares.all(|share| share.violating == 0);
        if judged.is_empty() {
            shares.values().all(|share| share.violating == 0)
        } else {
            all_good(judged.iter())
        }
    }

    /// How many runs of what.
    #[must_use]
    pub fn head(&self) -> String {
        let Manifest { seed, shard, runs, .. } = self.manifest;
        let part = if shard.is_whole() { String::new() } else { format!(", shard {shard} of {runs} runs") };
        let redraws = match self.tally.redraws {
            0 => String::new(),
            redraws => format!("; {redraws} draws could not be run and were drawn again"),
        };
        format!("{} runs, seed {seed}{part}{redraws}", self.tally.runs)
    }

    /// The command that repeats a run.
    #[must_use]
    pub fn command(&self, one: &Violating) -> String {
        format!(
            "closeranks run {} --draw {} --sweep-seed {} --controller {}",
            quoted(&self.manifest.file),
            one.run,
            self.manifest.seed,
            one.controller
        )
    }

    /// The first violating runs: what happened, and the command that repeats it.
    #[must_use]
    pub fn violating(&self) -> Vec<(String, String)> {
        let told = |one: &Violating| {
            let of = |value: Option<f64>| telling(value.unwrap_or(f64::NAN), 4);
            let what = format!(
                "run {} under {}: {} at t = {} s{}: {}, demanded {}",
                one.run,
                one.controller,
                one.law,
                number(one.time_s.unwrap_or(f64::NAN), 3),
                who(&one.robots),
                of(one.seen),
                of(one.demanded)
            );
            (what, self.command(one))
        };
        self.tally.violating.iter().map(told).collect()
    }

    /// For people.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = format!("{}\n\n{}", self.head(), text(&controllers(self.tally, self.laws)));
        let _ = write!(out, "\n{}\n{}", broken::CAPTION, text(&broken::table(self.tally)));
        let by_value = values(self.tally);
        if !by_value.rows.is_empty() {
            let _ = write!(out, "\n{}", text(&by_value));
        }
        let violating = self.violating();
        if !violating.is_empty() {
            out.push_str("\nthe first violations of each controller, and how to repeat them:\n");
        }
        for (what, command) in violating {
            let _ = writeln!(out, "  {what}\n    {command}");
        }
        out
    }

    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        let controllers =
            self.tally.controllers.iter().map(|(name, share)| (name.clone(), self.share(name, share)));
        let violating = self.tally.violating.iter().map(|one| {
            json!({
                "run": one.run, "controller": one.controller, "law": one.law, "time_s": one.time_s,
                "robots": one.robots,
                "seen": one.seen, "demanded": one.demanded, "command": self.command(one),
            })
        });
        json!({
            "runs": self.tally.runs,
            "seed": self.manifest.seed,
            "shard": self.manifest.shard.to_string(),
            "redraws": self.tally.redraws,
            "version": PROGRAM.version,
            "commit": PROGRAM.commit,
            "controllers": controllers.collect::<Map<_, _>>(),
            "by_value": self.by_value(),
            "first_violations": violating.collect::<Vec<_>>(),
            "ok": self.is_good(),
        })
    }

    fn share(&self, name: &str, share: &Share) -> Value {
        let laws = self.laws.iter().filter(|law| promises(name, law)).map(|law| {
            let runs = share.laws.get(*law).copied().unwrap_or(0);
            ((*law).to_owned(), json!(runs))
        });
        json!({
            "runs": share.runs,
            "violations": share.violating,
            "upper_95": upper_95(share.violating, share.runs),
            "by_invariant": laws.collect::<Map<_, _>>(),
            "broken_at_all": share.broken,
            "gyration_m": share.gyration_mean_m(),
        })
    }

    fn by_value(&self) -> Value {
        let count = |[runs, violations]: &[u64; 2]| json!({ "runs": runs, "violations": violations });
        let fields = self.tally.fields.iter().filter_map(|(path, values)| {
            let values = values.as_ref()?.iter().map(|(value, counts)| {
                let counts = counts.iter().map(|(name, one)| (name.clone(), count(one)));
                (value.clone(), Value::Object(counts.collect()))
            });
            Some((path.clone(), Value::Object(values.collect())))
        });
        Value::Object(fields.collect())
    }
}

/// The robots of a violation.
fn who(robots: &[i64]) -> String {
    match robots {
        [] => String::new(),
        [robot] => format!(", robot {robot}"),
        [robot, other, ..] => format!(", robots {robot} and {other}"),
    }
}

/// A word as a shell takes it.
#[must_use]
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "._-/+:@%,=".contains(c);
    if word.chars().all(is_plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}
