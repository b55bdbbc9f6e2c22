//! What people look at in ROS 2: `diagnostic_msgs/DiagnosticArray` and `visualization_msgs/MarkerArray`. They are written and never read.

use closeranks_mcap::cdr::Writer;

/// Most texts or markers in a message.
const LISTED_MAX: usize = 64;

/// How a diagnosis is to be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// All is well.
    Ok = 0,
    /// Something should be looked at.
    Warn = 1,
    /// It does not work.
    Error = 2,
}

/// What a robot says of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnosis {
    /// How it is to be taken.
    pub level: Level,
    /// Of what it is.
    pub name: String,
    /// In a word.
    pub message: String,
    /// Of which robot.
    pub hardware: String,
    /// More, as names and values.
    pub values: Vec<(String, String)>,
}

/// Begins a sequence, and says how many of its elements are written.
fn count(writer: &mut Writer, of: usize) -> usize {
    let listed = of.min(LISTED_MAX);
    writer.count(listed);
    listed
}

fn words(writer: &mut Writer, numbers: &[u32]) {
    for number in numbers {
        writer.word(*number);
    }
}

/// The bytes of a `DiagnosticArray` with one status, at `nanos` since 1970.
#[must_use]
pub fn diagnostics(nanos: u64, of: &Diagnosis) -> Vec<u8> {
    let mut writer = Writer::default();
    writer.header(nanos, "");
    writer.word(1);
    writer.byte(of.level as u8);
    for text in [&of.name, &of.message, &of.hardware] {
        writer.text(text);
    }
    let listed = count(&mut writer, of.values.len());
    for (name, value) in &of.values[..listed] {
        writer.text(name);
        writer.text(value);
    }
    writer.end()
}

/// Something to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Pairs of points, m, each joined by a line.
    Lines(Vec<[f64; 3]>),
    /// A text above a point, m.
    Text([f64; 3], String),
}

/// A shape with its name and colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Which group it is of; a new one of a group replaces the last.
    pub group: String,
    /// What it is.
    pub shape: Shape,
    /// Red, green, blue, opacity, from 0 to 1.
    pub color: [f32; 4],
}

/// The bytes of a `MarkerArray` in `frame`, at `nanos` since 1970. Markers vanish after a second without new ones.
#[must_use]
pub fn markers(nanos: u64, frame: &str, of: &[Marker]) -> Vec<u8> {
    let mut writer = Writer::default();
    let listed = count(&mut writer, of.len());
    for marker in &of[..listed] {
        writer.header(nanos, frame);
        write_marker(&mut writer, marker);
    }
    writer.end()
}

fn write_marker(writer: &mut Writer, marker: &Marker) {
    const LINE_LIST: u32 = 5;
    const TEXT: u32 = 9;
    const LINE_M: f64 = 0.02;
    const LETTER_M: f64 = 0.15;
    let (kind, at, points, text, scale) = match &marker.shape {
        Shape::Lines(points) => (LINE_LIST, [0.0; 3], &points[..], "", [LINE_M, 0.0, 0.0]),
        Shape::Text(at, text) => (TEXT, *at, &[][..], text.as_str(), [0.0, 0.0, LETTER_M]),
    };
    writer.text(&marker.group);
    // Number 0 of its group, its kind, and the action to add it.
    words(writer, &[0, kind, 0]);
    writer.doubles(&at);
    writer.doubles(&[0.0, 0.0, 0.0, 1.0]);
    writer.doubles(&scale);
    marker.color.iter().for_each(|part| writer.float(*part));
    // For one second, not locked to its frame.
    words(writer, &[1, 0]);
    writer.byte(0);
    // Lines are whole: an even number of points.
    let listed = count(writer, points.len()) & !1;
    writer.doubles(points[..listed].as_flattened());
    // No colours of single points, no texture (its name, header, format and data), no points on it.
    writer.word(0);
    writer.text("");
    writer.header(0, "");
    writer.text("");
    words(writer, &[0, 0]);
    writer.text(text);
    // No mesh: its name, its file's name and data, and whether its materials are used.
    writer.text("");
    writer.text("");
    writer.word(0);
    writer.byte(0);
}

#[cfg(test)]
mod tests {
    use sha2::{Digest as _, Sha256};

    use super::*;
    use crate::bytes::hex;

    fn digest(bytes: &[u8]) -> String {
        format!("{} {}", bytes.len(), &hex(&Sha256::digest(bytes))[..16])
    }

    /// The expected digests are of what `rosbags` 0.11.9 writes for the same messages: `tests/ros2/golden.py`.
    #[test]
    fn others_write_the_same_bytes() {
        let diagnosis = Diagnosis {
            level: Level::Warn,
            name: "closeranks: robot_1".into(),
            message: "degree".into(),
            hardware: "robot_1".into(),
            values: vec![("degree".into(), "3".into()), ("blocked for s".into(), "1.5".into())],
        };
        assert_eq!(digest(&diagnostics(5_000_000_007, &diagnosis)), "128 b8c8fb06d7a89220");
        let lines = Shape::Lines(vec![[0.0, 0.0, 0.0], [1.0, 2.0, 0.5]]);
        let text = Shape::Text([0.0, 0.0, 0.3], "HOLD 3".into());
        let both = [("links", lines, [0.0, 1.0, 0.0, 1.0]), ("mode", text, [1.0, 1.0, 1.0, 1.0])];
        let both = both.map(|(group, shape, color)| Marker { group: group.into(), shape, color });
        assert_eq!(digest(&markers(5_000_000_007, "map", &both)), "521 7f1dc20323e84af7");
    }

    #[test]
    fn lists_are_bounded() {
        let many = Shape::Lines(vec![[0.0; 3]; 1_000]);
        let marker = Marker { group: "x".into(), shape: many, color: [0.0; 4] };
        assert!(markers(0, "map", &vec![marker; 3]).len() < 3 * (64 * 24 + 400));
    }
}
