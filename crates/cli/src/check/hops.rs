//! Robustness over several hops: `--hops L`.

use closeranks_graph::effort::Meter;
use closeranks_graph::formats::Named;
use closeranks_graph::hops::{self, HopQuestion, HopVerdict, HopWitness, NODES_MAX};
use serde_json::{Value, json};

use super::answer::{Answer, numbers};
use super::{question, words};

/// What is asked with `--hops`, for machines.
pub(super) fn asked(question: HopQuestion) -> Value {
    let HopQuestion { hops, r, s, liars } = question;
    json!({ "hops": hops, "r": r, "s": s, "liars": liars })
}

/// One question.
pub(super) fn one(
    named: &Named,
    question: HopQuestion,
    asked: &Value,
    limit: &str,
    meter: &mut Meter<'_>,
) -> Answer {
    let what = what(question);
    let yes = |proof: &str| {
        let numbers = numbers(named, asked, "yes", &json!({ "proved_by": proof, "witness": null }));
        Answer {
            holds: true,
            sentence: format!("Yes: {what}, proved by {proof}."),
            numbers,
            ..Answer::default()
        }
    };
    match hops::decide(&named.graph, question, meter) {
        Ok(HopVerdict::RobustWithOneHop) => yes("one hop, which is enough"),
        Ok(HopVerdict::Robust) => yes("trying all sets"),
        Ok(HopVerdict::NotRobust(witness)) => {
            let more = json!({ "witness": witness_value(named, &witness, meter) });
            let numbers = numbers(named, asked, "no", &more);
            with_witness(
                Answer {
                    sentence: format!("No: not {what}, proved by a witness."),
                    numbers,
                    ..Answer::default()
                },
                named,
                &witness,
            )
        }
        Ok(HopVerdict::TooLarge) => Answer {
            sentence: format!(
                "Not known: whether it is {what}; all sets are tried of up to {NODES_MAX} robots."
            ),
            numbers: numbers(named, asked, "undecided", &json!({})),
            ..Answer::default()
        },
        Err(_) => question::undecided(named, asked, &what, limit),
    }
}

/// The largest F that is survived over so many hops.
pub(super) fn largest(named: &Named, hops: usize, limit: &str, meter: &mut Meter<'_>) -> Answer {
    let asked = json!({ "hops": hops });
    let mut survived = -1;
    loop {
        let faults = usize::try_from(survived + 1).unwrap_or(0);
        let question = HopQuestion::survives(hops, faults);
        let answer = one(named, question, &asked, limit, meter);
        if answer.holds && faults < named.graph.node_count() {
            survived += 1;
            continue;
        }
        return told(named, answer, (hops, survived), limit);
    }
}

/// The answer about `survived` + 1 liars as one about the largest number.
fn told(named: &Named, answer: Answer, (hops, survived): (usize, i64), limit: &str) -> Answer {
    let liars = |number: i64| words::liars(usize::try_from(number).unwrap_or(0));
    let least = match survived {
        -1 => format!("Does not agree over {} even if nobody lies", words::count(hops as u64, "hop")),
        0 => format!("Agrees over {} if nobody lies", words::count(hops as u64, "hop")),
        _ => format!("Survives any {} over {}", liars(survived), words::count(hops as u64, "hop")),
    };
    let exact = answer.numbers["answer"] != "undecided";
    let most = match (exact, survived) {
        (true, -1) => String::new(),
        (true, _) => format!("; not any {}", liars(survived + 1)),
        (false, _) => format!("; whether any {} was not settled within {limit}", liars(survived + 1)),
    };
    let value = if exact { json!(survived) } else { json!([survived, null]) };
    let more = json!({ "f_max": value, "witness": answer.numbers["witness"] });
    let numbers = numbers(named, &json!({ "hops": hops }), if exact { "yes" } else { "undecided" }, &more);
    Answer { holds: exact, sentence: format!("{least}{most}."), numbers, ..answer }
}

fn what(question: HopQuestion) -> String {
    let HopQuestion { hops, r, s, liars } = question;
    let liars = match liars {
        0 => String::new(),
        1 => " for any liar on the way".to_owned(),
        _ => format!(" for any {liars} liars on the way"),
    };
    format!("({r},{s})-robust with {}{liars}", words::count(hops as u64, "hop"))
}

fn witness_value(named: &Named, witness: &HopWitness, meter: &mut Meter<'_>) -> Value {
    let reached = witness.reached(&named.graph, meter).ok();
    json!({
        "liars": words::values(named, witness.liars),
        "S1": words::values(named, witness.first),
        "S2": words::values(named, witness.second),
        "reached": reached.map(|reached| words::values(named, reached)),
    })
}

fn with_witness(mut answer: Answer, named: &Named, witness: &HopWitness) -> Answer {
    let HopQuestion { hops, r, s, .. } = witness.question;
    let liars = match witness.liars.len() {
        0 => "Even if all pass on what is true".to_owned(),
        1 => format!("If {} passes on nothing that is true", words::robots(named, witness.liars)),
        _ => format!("If {} pass on nothing that is true", words::robots(named, witness.liars)),
    };
    answer.why.push(format!(
        "{liars}, then of {} and of {} fewer than {s} are reached from outside of their set over {r} or more disjoint paths of at most \
         {}, and not all of either. Let those lie, and the two sides never agree.",
        words::braces(named, witness.first),
        words::braces(named, witness.second),
        words::count(hops as u64, "hop"),
    ));
    answer.sets = [witness.first, witness.second, witness.liars];
    answer.labels = ["one side", "the other side", "pass on lies"];
    answer
}
