//! `run --live`: the run, drawn in the terminal while it goes on, for people who work over ssh.
//!
//! A picture is drawn over the one before by moving the cursor up. Nothing of the terminal is changed, so it is as it was whenever the
//! program ends.

mod canvas;
mod table;

use core::fmt::Write as _;
use core::time::Duration;
use std::thread;
use std::time::Instant;

use anyhow::{Result, bail};
use closeranks_sim::output::snapshot::Snapshot;
use closeranks_sim::scenario::Scenario;
use console::{Term, truncate_str};

use canvas::{Picture, Region};

/// Time between two pictures.
const FRAME: Duration = Duration::from_millis(50);
/// What a picture needs.
const COLUMNS_MIN: usize = 30;
const ROWS_MIN: usize = 10;
/// From so many columns on there is a table beside the picture.
const TABLE_FROM: usize = 90;
/// Rows that stay free below the picture, for the prompt.
const FREE: usize = 1;

/// Shows one run.
pub(crate) struct Live<'a> {
    term: Term,
    scenario: &'a Scenario,
    malicious: Vec<bool>,
    /// Seconds of the run in a second.
    speed: f64,
    region: Region,
    start: Instant,
    last: Option<Instant>,
    /// Lines of the last picture, and the size of the terminal that it was made for.
    drawn: usize,
    size: (u16, u16),
}

impl<'a> Live<'a> {
    /// Gets ready to show a run of `scenario`; refuses when nobody can see it.
    pub(crate) fn new(scenario: &'a Scenario, speed: f64) -> Result<Self> {
        let term = Term::stdout();
        if !term.is_term() {
            bail!(
                "`--live` draws in a terminal, and standard output is none; allowed is a terminal, or no `--live`"
            );
        }
        let size = term.size();
        Ok(Self {
            term,
            scenario,
            malicious: scenario.malicious_mask(),
            speed,
            region: Region::default(),
            start: now(),
            last: None,
            drawn: 0,
            size,
        })
    }

    /// Looks at a tick: waits until it is due, and draws it if the last picture is old enough.
    pub(crate) fn tick(&mut self, tick: &Snapshot<'_>) -> Result<()> {
        self.region.include(tick);
        let due = Duration::try_from_secs_f64(tick.time_s / self.speed).unwrap_or(Duration::MAX);
        let is_last = tick.tick == self.scenario.ticks();
        if let Some(early) = due.checked_sub(self.start.elapsed()) {
            thread::sleep(early);
        }
        if is_last || self.last.is_none_or(|last| last.elapsed() >= FRAME) {
            self.draw(tick)?;
            self.last = Some(now());
        }
        Ok(())
    }

    fn draw(&mut self, tick: &Snapshot<'_>) -> Result<()> {
        let size = self.term.size();
        if size != self.size {
            self.term.clear_screen()?;
            (self.size, self.drawn) = (size, 0);
        }
        let (rows, columns) = (usize::from(size.0), usize::from(size.1));
        let lines = self.lines(tick, columns, rows);
        let mut text = String::new();
        if self.drawn > 0 {
            let _ = write!(text, "\x1b[{}A", self.drawn);
        }
        for line in &lines {
            // Clears what was there, so that a shorter line leaves nothing of a longer one.
            let _ = writeln!(text, "\r\x1b[2K{line}");
        }
        self.drawn = lines.len();
        self.term.write_str(&text)?;
        Ok(())
    }

    fn lines(&self, tick: &Snapshot<'_>, columns: usize, rows: usize) -> Vec<String> {
        if columns < COLUMNS_MIN || rows < ROWS_MIN {
            let small = format!("{columns} x {rows} is too small, {COLUMNS_MIN} x {ROWS_MIN} will do");
            return vec![cut(&small, columns)];
        }
        let with_table = columns >= TABLE_FROM;
        let high = rows - FREE - 2;
        let wide = if with_table { columns - table::COLUMNS - 2 } else { columns - 1 };
        let picture = Picture {
            now: tick,
            malicious: &self.malicious,
            radius_m: self.scenario.link.radius_m,
            region: self.region,
        };
        let mut body = canvas::lines(&picture, wide, high);
        if with_table {
            let table = table::lines(tick, &self.malicious, high);
            for (line, more) in body.iter_mut().zip(table) {
                let _ = write!(line, " {more}");
            }
        }
        let title = cut(&table::title(self.scenario, tick), columns);
        let summary = cut(&table::summary(tick, &self.malicious), columns);
        [title].into_iter().chain(body).chain([summary]).collect()
    }
}

/// A text for one line of the terminal: its last column stays free, else some terminals begin a new line.
fn cut(text: &str, columns: usize) -> String {
    truncate_str(&crate::output::printable(text), columns.saturating_sub(1), "…").into_owned()
}

#[expect(clippy::disallowed_methods, reason = "the pace at which people see a run, which changes no run")]
fn now() -> Instant {
    Instant::now()
}
