//! Positions that somebody else recorded: a table with one row a moment and robot, in any order.
//!
//! ```text
//! time_s (s) or tick | robot, a number or a name | x_m, y_m[, z_m]; other columns say nothing
//! ```
//!
//! Every robot has one row at every moment.

use std::collections::BTreeSet;

use closeranks_graph::graph::set::NODE_LIMIT;

use super::positions::{ROWS_MAX, ReadError, Recording};

/// Greatest magnitude of a number.
const MOST: f64 = 1e9;

/// A column of text or of numbers, as it stands in a file.
#[derive(Debug)]
pub(super) enum Cells {
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

/// Makes a recording of columns; `column` gives one by its name, if it is there.
pub(super) fn assemble(
    mut column: impl FnMut(&str) -> Result<Option<Cells>, ReadError>,
) -> Result<Recording, ReadError> {
    let mut needed = |name: &str| column(name)?.ok_or_else(|| ReadError::NoColumn(name.to_owned()));
    let (time_name, times) = match needed("time_s") {
        Err(ReadError::NoColumn(_)) => {
            ("tick", needed("tick").map_err(|_| ReadError::NoColumn("time_s".into()))?)
        }
        times => ("time_s", times?),
    };
    let (robots, x, y) = (needed("robot")?, needed("x_m")?, needed("y_m")?);
    let z = column("z_m")?.map(|z| numbers("z_m", z)).transpose()?;
    let (times, x, y) = (numbers(time_name, times)?, numbers("x_m", x)?, numbers("y_m", y)?);
    let rows = times.len();
    let z = z.unwrap_or_else(|| vec![0.0; rows]);
    let labels = labels(robots)?;
    if rows == 0 || rows as u64 > ROWS_MAX {
        return Err(ReadError::Rows(i64::try_from(rows).unwrap_or(i64::MAX)));
    }
    if [x.len(), y.len(), z.len(), labels.len()].iter().any(|length| *length != rows) {
        return Err(ReadError::Ragged);
    }
    let names = ordered(&labels);
    if names.len() > NODE_LIMIT {
        return Err(ReadError::Robots(names.len()));
    }
    let place = |label: &String| names.iter().position(|name| name == label).unwrap_or(0);
    let places: Vec<usize> = labels.iter().map(place).collect();
    let order = in_order(&times, &places, &names, time_name)?;
    let positions_m = order.iter().map(|row| [x[*row], y[*row], z[*row]]).collect();
    let times = order.iter().step_by(names.len()).map(|row| times[*row]).collect();
    Ok(Recording { scenario: None, robots: names.len(), positions_m, times, time_name })
}

/// The numbers of a column; each finite and not huge.
fn numbers(column: &str, cells: Cells) -> Result<Vec<f64>, ReadError> {
    let wrong = |row: usize, found: String| ReadError::Value {
        column: column.to_owned(),
        row: row + 1,
        found,
        allowed: format!("a number from -{MOST} to {MOST}"),
    };
    let fits = |number: &f64| number.abs() <= MOST;
    match cells {
        Cells::Numbers(numbers) => match numbers.iter().position(|number| !fits(number)) {
            Some(row) => Err(wrong(row, numbers[row].to_string())),
            None => Ok(numbers),
        },
        Cells::Words(words) => {
            let number = |(row, word): (usize, &String)| {
                let number = word.parse::<f64>().ok().filter(fits);
                number.ok_or_else(|| wrong(row, format!("\"{}\"", shown(word))))
            };
            words.iter().enumerate().map(number).collect()
        }
    }
}

/// A word as messages show it.
fn shown(word: &str) -> String {
    word.chars().take(40).flat_map(char::escape_debug).collect()
}

/// What each row calls its robot.
fn labels(cells: Cells) -> Result<Vec<String>, ReadError> {
    let wrong = |row: usize, found: String| ReadError::Value {
        column: "robot".to_owned(),
        row: row + 1,
        found,
        allowed: "a whole number or a name".to_owned(),
    };
    match cells {
        Cells::Words(words) => match words.iter().position(String::is_empty) {
            Some(row) => Err(wrong(row, "empty".to_owned())),
            None => Ok(words),
        },
        Cells::Numbers(numbers) => {
            let is_whole = |number: &f64| number.fract() == 0.0 && number.abs() <= MOST;
            match numbers.iter().position(|number| !is_whole(number)) {
                Some(row) => Err(wrong(row, numbers[row].to_string())),
                None => Ok(numbers.iter().map(|number| format!("{number:.0}")).collect()),
            }
        }
    }
}

/// Every robot once: by number if all are numbers, else by name.
fn ordered(labels: &[String]) -> Vec<String> {
    let all: BTreeSet<&String> = labels.iter().collect();
    let mut names: Vec<String> = all.into_iter().cloned().collect();
    if names.iter().all(|name| name.parse::<i64>().is_ok()) {
        names.sort_by_key(|name| name.parse::<i64>().unwrap_or(0));
    }
    names
}

/// The rows by time and then by robot, each robot once at every moment.
fn in_order(
    times: &[f64],
    places: &[usize],
    names: &[String],
    time_name: &'static str,
) -> Result<Vec<usize>, ReadError> {
    let mut order: Vec<usize> = (0..times.len()).collect();
    let key = |row: &usize| (times[*row], places[*row]);
    order.sort_by(|a, b| key(a).0.total_cmp(&key(b).0).then(key(a).1.cmp(&key(b).1)));
    let at = |row: usize| format!("{time_name} = {}", times[row]);
    if let Some(pair) = order.windows(2).find(|pair| key(&pair[0]) == key(&pair[1])) {
        let row = pair[0].max(pair[1]);
        return Err(ReadError::Twice { row: row + 1, robot: names[places[row]].clone(), at: at(row) });
    }
    let missing = |moment: &[usize]| {
        let robot = (0..names.len()).find(|place| moment.iter().all(|row| places[*row] != *place));
        let robot = robot.map_or(String::new(), |place| names[place].clone());
        ReadError::Missing { robot, at: at(moment[0]) }
    };
    let mut moments = order.chunk_by(|a, b| times[*a] == times[*b]);
    match moments.find(|moment| moment.len() != names.len()) {
        Some(moment) => Err(missing(moment)),
        None => Ok(order),
    }
}

/// True if `line`, the first of a text, names columns of positions.
#[must_use]
pub fn is_head(line: &str) -> bool {
    let names = fields(line);
    ["x_m", "y_m"].iter().all(|name| names.contains(name))
}

fn fields(line: &str) -> Vec<&str> {
    let line = line.strip_prefix('\u{feff}').unwrap_or(line);
    line.split(',').map(|field| field.trim().trim_matches('"')).collect()
}

/// Reads a text with commas: names of columns, then one row a line.
pub fn read_csv(text: &str) -> Result<Recording, ReadError> {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let head = fields(lines.next().unwrap_or(""));
    let rows: Vec<Vec<&str>> =
        lines.take(usize::try_from(ROWS_MAX).unwrap_or(usize::MAX)).map(fields).collect();
    if let Some(row) = rows.iter().position(|row| row.len() != head.len()) {
        return Err(ReadError::Value {
            column: head.first().copied().unwrap_or("").to_owned(),
            row: row + 1,
            found: format!("in a line of {} values", rows[row].len()),
            allowed: format!("{} values, as the first line has names", head.len()),
        });
    }
    assemble(|name| {
        let place = head.iter().position(|known| *known == name);
        let words = |place: usize| rows.iter().map(|row| row[place].to_owned()).collect();
        Ok(place.map(|place| Cells::Words(words(place))))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "note,robot,time_s,y_m,x_m\n";

    fn told(rows: &str) -> String {
        read_csv(&format!("{HEAD}{rows}")).unwrap_err().to_string()
    }

    #[test]
    fn rows_come_in_any_order() {
        let recording =
            read_csv(&format!("{HEAD}a,10,0.5,4,3\nb,9,0.5,2,1\n\nc,9,0.0,0,7\nd,10,0,1,1\n")).unwrap();
        assert_eq!((recording.robots, recording.ticks()), (2, 2));
        assert_eq!(recording.at(0), [[7.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
        assert_eq!(recording.at(1), [[1.0, 2.0, 0.0], [3.0, 4.0, 0.0]]);
        assert_eq!((recording.times, recording.time_name), (vec![0.0, 0.5], "time_s"));
        assert!(read_csv("tick,robot,x_m,y_m,z_m\n0,ada,1,2,3\n0,bob,1,2,4").unwrap().scenario.is_none());
    }

    #[test]
    fn errors_name_column_row_and_value() {
        let wrong = "column `x_m`, row 2 is \"far\": allowed is a number from -1000000000 to 1000000000";
        assert_eq!(told("a,1,0,0,0\na,2,0,0,far"), wrong);
        assert_eq!(told("a,1,0,0,0\na,1,0,0,0"), "row 2: robot 1 is there twice at time_s = 0");
        assert_eq!(
            told("a,1,0,0,0\na,2,0,0,0\na,2,1,0,0"),
            "robot 1 is missing at time_s = 1: every robot needs a row at every moment"
        );
        assert!(told("a,1,0,0").contains("row 1 is in a line of 4 values"), "{}", told("a,1,0,0"));
        let none = read_csv("robot,x_m,y_m\n1,0,0").unwrap_err().to_string();
        assert_eq!(none, "no column `time_s`: allowed are time_s or tick, robot, x_m, y_m and perhaps z_m");
        assert!(told("").starts_with("0 rows"));
    }
}
