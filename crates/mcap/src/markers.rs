//! A tick as a picture for viewers of ROS 2: robots, their numbers, links and ranges. Liars are vermillion boxes, others blue balls.

use closeranks_sim::output::snapshot::Snapshot;

use crate::cdr::Writer;
use crate::links::{Link, links_between};
use crate::look::Look;
use crate::messages::{MAP, pose};

/// Kinds of `visualization_msgs/Marker`.
const CUBE: u32 = 1;
const SPHERE: u32 = 2;
const CYLINDER: u32 = 3;
const LINE_LIST: u32 = 5;
const TEXT: u32 = 9;

type Color = [f32; 4];
/// The colours of figures: `svg/palette.rs`.
const NORMAL: Color = [0.0, 0.447, 0.698, 1.0];
const MALICIOUS: Color = [0.835, 0.369, 0.0, 1.0];
const DOWN: Color = [0.6, 0.6, 0.6, 1.0];
const LINK: Color = [0.627, 0.627, 0.627, 0.8];
const LINK_MALICIOUS: Color = [0.835, 0.369, 0.0, 0.8];
const NUMBER: Color = [1.0, 1.0, 1.0, 1.0];
const RANGE_ALPHA: f32 = 0.04;

/// One marker; what is not said is empty.
struct Marker<'a> {
    space: &'a str,
    id: usize,
    kind: u32,
    position_m: [f64; 3],
    scale_m: [f64; 3],
    color: Color,
    points_m: Vec<[f64; 3]>,
    text: String,
}

/// `visualization_msgs/MarkerArray` of a tick.
pub(crate) fn markers(now: &Snapshot<'_>, time_ns: u64, look: &Look) -> Vec<u8> {
    let positions_m: Vec<[f64; 3]> =
        (0..now.robots()).map(|index| now.vector(now.positions_m, index)).collect();
    let links = links_between(&positions_m, &look.malicious, look.radius_m, &look.map);
    let mut all: Vec<Marker<'_>> = Vec::new();
    for (index, position_m) in positions_m.iter().enumerate() {
        let color = color(look, now, index);
        all.extend([body(look, index, *position_m, color), number(look, index, *position_m)]);
        all.push(range(look, now.dimension, index, *position_m, color));
    }
    all.push(lines(look, 0, &positions_m, links.iter().filter(|link| !link.malicious)));
    all.push(lines(look, 1, &positions_m, links.iter().filter(|link| link.malicious)));
    let mut writer = Writer::default();
    writer.count(all.len());
    for marker in &all {
        marker.write(&mut writer, time_ns);
    }
    writer.end()
}

fn color(look: &Look, now: &Snapshot<'_>, index: usize) -> Color {
    match (now.down[index], look.malicious[index]) {
        (true, _) => DOWN,
        (false, true) => MALICIOUS,
        (false, false) => NORMAL,
    }
}

fn body(look: &Look, index: usize, position_m: [f64; 3], color: Color) -> Marker<'static> {
    let kind = if look.malicious[index] { CUBE } else { SPHERE };
    let scale_m = [look.body_m; 3];
    Marker { color, ..Marker::new("robots", index + 1, kind, position_m, scale_m) }
}

fn number(look: &Look, index: usize, [x, y, z]: [f64; 3]) -> Marker<'static> {
    let size_m = 0.7 * look.body_m;
    let above_m = [x, y, z + look.body_m];
    let marker = Marker::new("numbers", index + 1, TEXT, above_m, [size_m; 3]);
    Marker { color: NUMBER, text: format!("{}", index + 1), ..marker }
}

fn range(look: &Look, dimension: usize, index: usize, position_m: [f64; 3], color: Color) -> Marker<'static> {
    let wide_m = 2.0 * look.radius_m;
    let [red, green, blue, _] = color;
    let (kind, tall_m) = if dimension == 2 { (CYLINDER, 0.01 * look.body_m) } else { (SPHERE, wide_m) };
    let marker = Marker::new("ranges", index + 1, kind, position_m, [wide_m, wide_m, tall_m]);
    Marker { color: [red, green, blue, RANGE_ALPHA], ..marker }
}

fn lines<'a>(
    look: &Look,
    id: usize,
    positions_m: &[[f64; 3]],
    links: impl Iterator<Item = &'a Link>,
) -> Marker<'static> {
    let points_m = links.flat_map(|link| [positions_m[link.first], positions_m[link.second]]).collect();
    let marker = Marker::new("links", id, LINE_LIST, [0.0; 3], [0.1 * look.body_m, 0.0, 0.0]);
    Marker { color: if id == 0 { LINK } else { LINK_MALICIOUS }, points_m, ..marker }
}

impl<'a> Marker<'a> {
    fn new(space: &'a str, id: usize, kind: u32, position_m: [f64; 3], scale_m: [f64; 3]) -> Self {
        let (points_m, text) = (Vec::new(), String::new());
        Self { space, id, kind, position_m, scale_m, color: NORMAL, points_m, text }
    }

    fn write(&self, writer: &mut Writer, time_ns: u64) {
        writer.header(time_ns, MAP);
        writer.text(self.space);
        writer.count(self.id);
        writer.word(self.kind);
        writer.word(0); // action: add or change
        pose(writer, &self.position_m);
        writer.doubles(&self.scale_m);
        for part in self.color {
            writer.float(part);
        }
        writer.word(0); // lifetime: for ever
        writer.word(0);
        writer.byte(0); // not locked to its frame
        writer.count(self.points_m.len());
        for point_m in &self.points_m {
            writer.doubles(point_m);
        }
        writer.count(0); // one colour for all points
        writer.text(""); // no texture, and the image of none
        writer.header(0, "");
        writer.text("");
        writer.count(0);
        writer.count(0);
        writer.text(&self.text);
        writer.text(""); // no mesh, and the file of none
        writer.text("");
        writer.count(0);
        writer.byte(0);
    }
}
