//! The data set of labelled graphs: `cargo run --release -p closeranks-graph --example dataset > docs/data/robustness.csv`.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example")]

mod recipes;
mod row;

fn main() {
    println!("{}", row::HEAD);
    for recipe in recipes::recipes() {
        println!("{}", row::row(&recipe));
    }
}
