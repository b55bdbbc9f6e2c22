//! The scenario as it was run: the text of its file with what the command line changed in it.

use closeranks_sim::parse;
use closeranks_sim::scenario::Scenario;

/// A text that reads as `scenario`, as near to `text` as can be. Where no small change of it does, a comment on top says
/// what was changed.
pub(crate) fn as_run(text: &str, scenario: &Scenario) -> String {
    let seeded = with_field(text, None, "seed", &scenario.seed.to_string());
    let kind = format!("\"{}\"", scenario.controller.name());
    let steered = |text: &str| with_field(text, Some("controller"), "kind", &kind);
    let candidates = [text.to_owned(), seeded.clone(), steered(text), steered(&seeded)];
    let is_it = |text: &String| parse::scenario(text).is_ok_and(|read| read == *scenario);
    candidates.into_iter().find(is_it).unwrap_or_else(|| {
        let (seed, controller) = (scenario.seed, scenario.controller.name());
        format!("# run with --seed {seed} --controller {controller}\n{text}")
    })
}

/// `text` with `key = value` in its part `table`, or above all tables; a line with the key is replaced.
fn with_field(text: &str, table: Option<&str>, key: &str, value: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let heads = || lines.iter().enumerate().filter(|(_, line)| line.trim_start().starts_with('['));
    let start = match table {
        None => Some(0),
        Some(name) => {
            heads().find(|(_, line)| line.trim() == format!("[{name}]")).map(|(index, _)| index + 1)
        }
    };
    let field = format!("{key} = {value}");
    let Some(start) = start else {
        return format!("{}\n\n[{}]\n{field}\n", text.trim_end(), table.unwrap_or_default());
    };
    let end = heads().map(|(index, _)| index).find(|index| *index >= start).unwrap_or(lines.len());
    let is_field = |line: &&str| line.split_once('=').is_some_and(|(name, _)| name.trim() == key);
    let place = lines[start..end].iter().position(is_field).map(|place| start + place);
    let (before, after) = match place {
        Some(place) => (&lines[..place], &lines[place + 1..]),
        None => lines.split_at(first_field(&lines, start, end)),
    };
    let all = before.iter().copied().chain([field.as_str()]).chain(after.iter().copied());
    all.flat_map(|line| [line, "\n"]).collect()
}

/// After the comments that a part begins with.
fn first_field(lines: &[&str], start: usize, end: usize) -> usize {
    let comments = lines[start..end].iter().take_while(|line| line.starts_with('#')).count();
    start + comments
}

#[cfg(test)]
mod tests {
    use super::*;
    use closeranks_sim::scenario::Controller;

    fn read(text: &str) -> Scenario {
        parse::scenario(text).unwrap()
    }

    /// The page of `run --seed 7` used to show the file's `seed = 1`.
    #[test]
    fn the_text_says_what_was_run() {
        let files = [
            "",
            "# a comment\nname = \"a\"\n",
            "seed = 3\n[team]\nrobots = 9\n",
            "[controller]\nkind = \"none\"\n[clock]\ntau_1_s = 0.02\n",
            "[controller]\nalpha = 2.0\n",
            "controller = { kind = \"none\" }\n",
        ];
        for file in files {
            let scenario = read(file);
            assert_eq!(as_run(file, &scenario), file);
            let seeded = Scenario { seed: 7, ..scenario };
            assert_eq!(read(&as_run(file, &seeded)), seeded, "{file}");
            let both = seeded.under(Controller::Budget);
            let text = as_run(file, &both);
            let said = text.starts_with("# run with --seed 7 --controller budget\n");
            assert!(said || read(&text) == both, "{text}");
        }
        let told = as_run("# why\nname = \"a\"\n", &Scenario { seed: 5, ..read("name = \"a\"\n") });
        assert_eq!(told, "# why\nseed = 5\nname = \"a\"\n");
    }
}
