//! Single questions, each answered in one sentence.

use closeranks_graph::decide::Robustness;
use closeranks_graph::effort::{Effort, Meter};
use closeranks_graph::evidence::Claim;
use closeranks_graph::formats::Named;
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::leaders;
use closeranks_graph::local::{self, LocalWitness, Withstands};
use closeranks_graph::ranks::Order;
use closeranks_graph::verdict::{Certificate, Verdict};
use serde_json::{Value, json};

use super::answer::{Answer, numbers};
use super::certificate::Proof;
use super::words;

/// Is it (r,s)-robust; asked as "any F liars" if `faults` is given.
pub(super) fn robust(
    named: &Named,
    (r, s): (usize, usize),
    faults: Option<usize>,
    limit: &str,
    meter: &mut Meter<'_>,
) -> Answer {
    let question = json!({ "r": r, "s": s });
    let survives = faults.map_or(String::new(), |faults| format!("any {}: ", words::liars(faults)));
    match Robustness::new(&named.graph, &Effort::UNLIMITED).decide(r, s, meter) {
        Verdict::Robust(certificate) => {
            let how = words::proof(certificate);
            let survives = if faults.is_some() { format!("survives {survives}") } else { survives };
            Answer {
                holds: true,
                sentence: format!("Yes: {survives}({r},{s})-robust, proved by {how}."),
                numbers: numbers(named, &question, "yes", &json!({ "proved_by": how, "witness": null })),
                proof: match certificate {
                    Certificate::Degrees { .. } => Proof::Claim(Claim::Degrees { r }),
                    _ => Proof::Robust { r, s },
                },
                ..Answer::default()
            }
        }
        Verdict::NotRobust(witness) => {
            let survives = if faults.is_some() { format!("does not survive {survives}") } else { survives };
            let found = json!({ "witness": words::witness_value(named, &witness) });
            let sentence = format!("No: {survives}not ({r},{s})-robust, proved by a witness.");
            let answer =
                Answer { sentence, numbers: numbers(named, &question, "no", &found), ..Answer::default() };
            answer.with_witness(named, &witness)
        }
        Verdict::Unknown => undecided(named, &question, &format!("({r},{s})-robust"), limit),
    }
}

/// The answer when the time is up.
pub(super) fn undecided(named: &Named, question: &Value, what: &str, limit: &str) -> Answer {
    Answer {
        sentence: format!("Undecided within {limit}: whether it is {what}; --time-limit gives more time."),
        numbers: numbers(named, question, "undecided", &json!({})),
        ..Answer::default()
    }
}

/// Strong robustness with respect to leaders: is it r, or how large.
pub(super) fn leaders(named: &Named, leaders: NodeSet, r: Option<usize>) -> Answer {
    let who = words::robots(named, leaders);
    let Some(most) = leaders::strong_r_max(&named.graph, leaders) else {
        let more = json!({ "strong_r_max": null });
        let question = json!({ "leaders": words::values(named, leaders), "r": r });
        let sentence = "Yes: all robots are leaders, there is nobody to follow.".to_owned();
        return Answer {
            holds: true,
            sentence,
            numbers: numbers(named, &question, "yes", &more),
            ..Answer::default()
        };
    };
    let asked = r.unwrap_or(most);
    let holds = asked <= most;
    let sentence = match r {
        Some(r) if holds => format!("Yes: strongly {r}-robust with respect to {who} (largest r: {most})."),
        Some(r) => format!("No: not strongly {r}-robust with respect to {who} (largest r: {most})."),
        None => format!("Strongly {most}-robust with respect to {who}, and for no larger r."),
    };
    let closed = leaders::closed_set(&named.graph, leaders, if holds { most + 1 } else { asked });
    let closed = closed.unwrap_or(NodeSet::EMPTY);
    let missed = if holds { most + 1 } else { asked };
    let why = format!(
        "Who hears {missed} or more that follow follows too: {} never would.",
        words::robots(named, closed)
    );
    let question = json!({ "leaders": words::values(named, leaders), "r": asked });
    let more = json!({ "strong_r_max": most, "closed": words::values(named, closed) });
    Answer {
        holds,
        sentence,
        why: if closed.is_empty() { Vec::new() } else { vec![why, liars_led(most)] },
        numbers: numbers(named, &question, if holds { "yes" } else { "no" }, &more),
        sets: [closed, leaders, NodeSet::EMPTY],
        labels: ["never follow", "leaders", ""],
        ..Answer::default()
    }
}

fn liars_led(most: usize) -> String {
    match most.checked_sub(1) {
        None => "So not even honest robots all follow.".to_owned(),
        Some(over) => format!(
            "With at most F = {} liars in every neighbourhood, all others follow honest leaders.",
            over / 2
        ),
    }
}

/// Does it survive F-local liars?
pub(super) fn local(named: &Named, faults: usize, limit: &str, meter: &mut Meter<'_>) -> Answer {
    let question = json!({ "local": true, "F": faults });
    match local_witness(named, faults, meter) {
        Known::Yes(why, order) => Answer {
            holds: true,
            sentence: format!(
                "Yes: survives liars of which no robot hears more than {faults}, proved by {why}."
            ),
            numbers: numbers(named, &question, "yes", &json!({ "proved_by": why })),
            proof: Proof::Order(order),
            ..Answer::default()
        },
        Known::No(witness) => {
            let sentence = format!(
                "No: does not survive liars of which no robot hears more than {faults}, proved by a witness."
            );
            let more = json!({ "witness": local_value(named, &witness) });
            let answer =
                Answer { sentence, numbers: numbers(named, &question, "no", &more), ..Answer::default() };
            with_local(answer, named, &witness)
        }
        Known::Open => undecided(
            named,
            &question,
            &format!("safe from liars of which no robot hears more than {faults}"),
            limit,
        ),
    }
}

enum Known {
    /// By what, and an order that proves it.
    Yes(&'static str, Order),
    No(LocalWitness),
    Open,
}

/// What is known, and an order that proves it if it is yes.
fn local_witness(named: &Named, faults: usize, meter: &mut Meter<'_>) -> Known {
    let mut robustness = Robustness::new(&named.graph, &Effort::UNLIMITED);
    // All robots are a core of their own, which a search proves.
    let core = || (0_u32..).zip(&named.names).map(|(node, _)| node).collect();
    let all = || Order { f: faults, core: core(), rest: Vec::new() };
    match local::decide(&mut robustness, faults, meter) {
        Ok(Ok(Withstands::Degrees)) => Known::Yes("its least degree", all()),
        Ok(Ok(Withstands::Robustness)) => Known::Yes("(2F+1)-robustness", all()),
        Ok(Ok(Withstands::Ranks(order))) => Known::Yes("ranks", order),
        Ok(Ok(Withstands::Search)) => Known::Yes("a search over the roles of all robots", all()),
        Ok(Err(witness)) => Known::No(witness),
        Err(_) => Known::Open,
    }
}

/// The largest F for which it survives F-local liars.
pub(super) fn local_largest(named: &Named, limit: &str, meter: &mut Meter<'_>) -> Answer {
    let mut robustness = Robustness::new(&named.graph, &Effort::UNLIMITED);
    let (known, found) = local::f_max(&mut robustness, meter);
    let exact = known.exactly().is_some();
    let least = known.least;
    let sentence = match known.exactly() {
        Some(-1) => "Does not agree even if nobody lies.".to_owned(),
        Some(0) => "Agrees if nobody lies; not if robots hear a single liar each.".to_owned(),
        Some(f) => {
            format!("Survives liars of which no robot hears more than {f}, and not more than {}.", f + 1)
        }
        None => format!(
            "Survives liars of which no robot hears more than {least}, at best {}; not settled within {limit}.",
            known.most
        ),
    };
    let value = if exact { json!(least) } else { json!([known.least, known.most]) };
    let more = json!({ "f_local": value, "proved": if exact { "exactly" } else { "bounds" } });
    let answer = if exact { "yes" } else { "undecided" };
    let numbers = numbers(named, &json!({ "local": true }), answer, &more);
    let answer = Answer { holds: exact, sentence, numbers, ..Answer::default() };
    match found {
        Some(witness) => with_local(answer, named, &witness),
        None => answer,
    }
}

fn local_value(named: &Named, witness: &LocalWitness) -> Value {
    let [malicious, first, second] =
        [witness.malicious, witness.first, witness.second].map(|set| words::values(named, set));
    json!({ "malicious": malicious, "S1": first, "S2": second })
}

fn with_local(mut answer: Answer, named: &Named, witness: &LocalWitness) -> Answer {
    let liars = if witness.malicious.is_empty() {
        "Even if nobody lies".to_owned()
    } else {
        format!(
            "If {} lie{}",
            words::robots(named, witness.malicious),
            if witness.malicious.len() == 1 { "s" } else { "" }
        )
    };
    answer.why.push(format!(
        "{liars}, the honest ones of {} and of {} hear at most {} outside of their own set, discard it, and never agree.",
        words::braces(named, witness.first),
        words::braces(named, witness.second),
        witness.f
    ));
    answer.sets = [witness.first, witness.second, witness.malicious];
    answer.labels = ["one side", "the other side", "lie"];
    answer.caption = format!("Two sides that never agree if no robot hears more than {} liars", witness.f);
    answer
}
