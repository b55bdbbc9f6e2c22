//! The robots of a tick as lines of text, and the tick in one line.

use closeranks_sim::output::snapshot::Snapshot;
use closeranks_sim::scenario::Scenario;
use console::{Style, pad_str, truncate_str};

/// Columns that the table of robots takes.
pub(crate) const COLUMNS: usize = 47;
/// Characters of the bar of h.
const BAR: usize = 8;
/// An h that fills the bar.
const H_FULL: f64 = 2.0;

/// At most `rows` lines: a head, robots, and how many more there are.
pub(crate) fn lines(now: &Snapshot<'_>, malicious: &[bool], rows: usize) -> Vec<String> {
    let head = format!("{:>5} {:>5} {:<BAR$} {:>8}  mode", "robot", "near", "h", "value");
    let mut lines = vec![Style::new().dim().apply_to(head).to_string()];
    let robots = now.robots();
    let shown = if robots < rows { robots } else { rows.saturating_sub(2) };
    lines.extend((0..shown).map(|index| line(now, malicious, index)));
    if shown < robots {
        lines.push(format!("  and {} more", robots - shown));
    }
    lines.truncate(rows);
    lines
}

fn line(now: &Snapshot<'_>, malicious: &[bool], index: usize) -> String {
    let is_malicious = malicious.get(index).copied().unwrap_or(false);
    let mark = if is_malicious { '■' } else { '●' };
    let short = now.degree[index] < now.required_degree;
    let near = format!("{}/{}", now.degree[index], now.required_degree);
    let mode = if now.down[index] { "down" } else { now.modes[index].name() };
    let text =
        format!("{mark}{:>4} {near:>5} {} {:>8.2}  {mode}", index + 1, bar(now.h(index)), now.value[index]);
    let style = match (short && !is_malicious, is_malicious) {
        (true, _) => Style::new().red().bold(),
        (false, true) => Style::new().yellow(),
        (false, false) => Style::new(),
    };
    style.apply_to(truncate_str(&text, COLUMNS, "…")).to_string()
}

/// A bar that is empty at 0 and says so below.
fn bar(h: f64) -> String {
    if h < 0.0 {
        return format!("{:<BAR$}", "below 0");
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 8")]
    let full = (h / H_FULL * 8.0).round().min(8.0) as usize;
    pad_str(&"▪".repeat(full), BAR, console::Alignment::Left, None).into_owned()
}

/// What is run and when.
pub(crate) fn title(scenario: &Scenario, now: &Snapshot<'_>) -> String {
    let controller = scenario.controller.name();
    format!("{}  {controller}  t = {:.2} s of {:.0} s", scenario.name, now.time_s, scenario.duration_s)
}

/// How the honest robots are.
pub(crate) fn summary(now: &Snapshot<'_>, malicious: &[bool]) -> String {
    let honest = || (0..now.robots()).filter(|index| !malicious.get(*index).copied().unwrap_or(false));
    let Some(weakest) = honest().min_by(|a, b| now.h(*a).total_cmp(&now.h(*b))) else {
        return String::new();
    };
    let degree = honest().map(|index| now.degree[index]).min().unwrap_or(0);
    let values = honest().map(|index| now.value[index]);
    let (low, high) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    format!(
        "honest robots: fewest neighbours {degree} of {} needed, least h {:.3} (robot {}), values {low:.2} to {high:.2}",
        now.required_degree,
        now.h(weakest),
        weakest + 1
    )
}
