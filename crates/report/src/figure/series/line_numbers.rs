//! Numbers of robots at the right ends of their lines, moved apart where they would overlap.

use crate::figure::panel::axes::Axes;
use crate::svg::path::PathData;
use crate::svg::{Element, Piece, Svg};

/// Font size of a number.
const SIZE: f64 = 7.5;
/// Least distance of two numbers.
const STEP: f64 = 7.6;
/// Room between the panel and a number, with a line to it.
const LEAD: f64 = 6.0;

/// The right end of a line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct End {
    /// Its height on the page.
    pub(crate) y: f64,
    /// The robot, from 1.
    pub(crate) robot: usize,
    /// Its colour.
    pub(crate) colour: &'static str,
    /// It is malicious.
    pub(crate) malicious: bool,
}

/// Draws a number for every end, or for as many as there is room for: malicious robots first, then the lowest lines.
pub(crate) fn draw(svg: &mut Svg, axes: &Axes, ends: Vec<End>) {
    let ends = shown(ends, axes.place.height);
    let heights =
        spread(&ends.iter().map(|end| end.y).collect::<Vec<_>>(), axes.place.top, axes.place.bottom());
    let right = axes.place.left + axes.place.width;
    svg.begin(&Element::group().number("font-size", SIZE).number("stroke-width", 0.6));
    for (end, height) in ends.iter().zip(heights) {
        let mut lead = PathData::default();
        lead.start([right, end.y]);
        lead.continue_to([right + LEAD - 1.0, height]);
        svg.add(lead.element().text("stroke", end.colour).text("fill", "none"));
        let at = [right + LEAD, height + 0.36 * SIZE];
        let text = Element::new("text").point(["x", "y"], at).text("fill", end.colour);
        svg.add(text.label(&[Piece::Plain(&end.robot.to_string())]));
    }
    svg.end();
}

/// The ends that get a number, from top to bottom.
fn shown(mut ends: Vec<End>, height: f64) -> Vec<End> {
    ends.retain(|end| end.y.is_finite());
    ends.sort_by(|a, b| b.malicious.cmp(&a.malicious).then(b.y.total_cmp(&a.y)));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some tens of lines")]
    ends.truncate((height / STEP) as usize);
    ends.sort_by(|a, b| a.y.total_cmp(&b.y).then(a.robot.cmp(&b.robot)));
    ends
}

/// Heights at least a step apart, near `wanted`, which ascend, between `top` and `bottom`.
fn spread(wanted: &[f64], top: f64, bottom: f64) -> Vec<f64> {
    let mut heights = wanted.to_vec();
    let mut least = top;
    for height in &mut heights {
        *height = height.max(least);
        least = *height + STEP;
    }
    let mut most = bottom;
    for height in heights.iter_mut().rev() {
        *height = height.min(most);
        most = *height - STEP;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_do_not_overlap_and_stay_beside_the_panel() {
        for wanted in [vec![50.0; 9], vec![0.0, 1.0, 2.0, 99.0, 99.0], vec![100.0; 5], vec![20.0, 60.0]] {
            let heights = spread(&wanted, 0.0, 100.0);
            assert!(heights.windows(2).all(|pair| pair[1] - pair[0] > STEP - 1e-9), "{heights:?}");
            assert!(heights.iter().all(|height| (-1e-9..=100.0).contains(height)), "{heights:?}");
        }
        assert_eq!(spread(&[20.0, 60.0], 0.0, 100.0), [20.0, 60.0]);
    }

    #[test]
    fn where_room_is_short_the_malicious_and_the_lowest_have_numbers() {
        let end =
            |robot: u8| End { y: f64::from(robot), robot: robot.into(), colour: "", malicious: robot == 1 };
        let robots = |ends: Vec<End>| ends.into_iter().map(|end| end.robot).collect::<Vec<_>>();
        assert_eq!(robots(shown((1..=40).map(end).collect(), 4.0 * STEP)), [1, 38, 39, 40]);
    }
}
