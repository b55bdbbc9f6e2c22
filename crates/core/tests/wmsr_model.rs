//! `wmsr::update` against a model of which Coq has proved that it is a round of W-MSR (proofs/trim.v).
//!
//! The model writes a table, `wmsr_model/table.txt`: every round with own value 0, up to four told values from −2 to 2
//! and F up to 2, and 500 larger ones. `proofs/check.sh` writes it anew, demands that it has not changed, and hands this
//! test a far longer one in `CLOSERANKS_WMSR_TABLE`.
//!
//! A line is `F own | told … | below above kept sum least greatest`. All numbers are small and whole, so sums are exact
//! in `f64` and the mean is the correctly rounded quotient of two of them.

use closeranks_core::wmsr::{Round, update};

const TABLE: &str = include_str!("wmsr_model/table.txt");

//= theory thm:contraction type=test
#[test]
fn rust_gives_the_answers_of_the_proved_model() {
    assert_eq!(check(TABLE), 2_843, "cases in the committed table");
    if let Some(path) = std::env::var_os("CLOSERANKS_WMSR_TABLE") {
        let table = std::fs::read_to_string(&path).unwrap();
        let cases = check(&table);
        assert!(cases >= 100_000, "{cases} cases in {}", path.display());
    }
}

/// Compares every line and counts them.
fn check(table: &str) -> usize {
    for line in table.lines() {
        let parts: Vec<Vec<f64>> = line.split('|').map(numbers).collect();
        let [setup, told, answer] = &parts[..] else { panic!("three parts in `{line}`") };
        let [faults, own] = setup[..] else { panic!("F and own value in `{line}`") };
        let mut told = told.clone();
        let round = update(own, &mut told, count(faults));
        assert_eq!(round, expected(answer), "{line}");
    }
    table.lines().count()
}

/// The round that the model's answer describes.
fn expected(answer: &[f64]) -> Round {
    let [below, above, kept, sum, low, high] = *answer else { panic!("six numbers in {answer:?}") };
    Round {
        value: sum / (kept + 1.0),
        below: count(below).into(),
        above: count(above).into(),
        low,
        high,
        kept: count(kept).into(),
    }
}

fn numbers(text: &str) -> Vec<f64> {
    let number = |word: &str| word.parse::<i32>().unwrap_or_else(|_| panic!("`{word}` is no number"));
    text.split_whitespace().map(|word| f64::from(number(word))).collect()
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small counts of the table")]
fn count(number: f64) -> u16 {
    number as u16
}
