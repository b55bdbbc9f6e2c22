//! A robot's status as diagnoses and markers of ROS 2, from the first tick on.

use crate::clock::wall_nanos;
use crate::config::Ros2;
use crate::node::ros::Topic;
use crate::node::status::{Row, Status};
use crate::node::voice::Viewer;
use crate::ros::keys;
use crate::ros::seen::{Diagnosis, Level, Marker, Shape, diagnostics, markers};
use crate::session::{Net, SessionError, Token};

/// How often both are published, s; a change of the mode is published at once.
const EVERY_S: f64 = 0.5;
/// How far above the robot its text stands, m.
const TEXT_ABOVE_M: f64 = 0.3;

const FREE: [f32; 4] = [0.2, 0.8, 0.3, 0.8];
const IN_THE_WAY: [f32; 4] = [0.9, 0.2, 0.1, 1.0];
const WHITE: [f32; 4] = [1.0; 4];

/// What shows the status of the robot of that name in ROS 2, and what makes its topics visible.
pub(super) fn viewer(ros: &Ros2, name: &str, net: &Net) -> Result<(Viewer, Vec<Token>), SessionError> {
    let (mut said, mut tokens) =
        Topic::open(ros, (name, &ros.diagnostics_topic), 2, &keys::DIAGNOSTICS, net)?;
    let (mut drawn, others) = Topic::open(ros, (name, &ros.markers_topic), 3, &keys::MARKERS, net)?;
    tokens.extend(others);
    let (name, frame) = (name.to_owned(), ros.frame.clone());
    let mut last: Option<(f64, &'static str)> = None;
    let show = move |status: &Status| {
        let due = last.is_none_or(|(at_s, mode)| status.time_s - at_s >= EVERY_S || mode != status.mode);
        if due {
            last = Some((status.time_s, status.mode));
            let nanos = wall_nanos();
            said.send(nanos, diagnostics(nanos, &diagnosis(&name, status)));
            drawn.send(nanos, markers(nanos, &frame, &drawing(&name, status)));
        }
    };
    Ok((Box::new(show), tokens))
}

fn diagnosis(name: &str, status: &Status) -> Diagnosis {
    let level = match (status.mode, &status.blocked) {
        ("GUARANTEED", None) => Level::Ok,
        ("STOPPED", _) => Level::Error,
        _ => Level::Warn,
    };
    let mut values = vec![
        ("degree".to_owned(), status.degree.to_string()),
        ("margin".to_owned(), status.margin.to_string()),
        ("missed ticks".to_owned(), status.missed.to_string()),
    ];
    if let Some(blocked) = &status.blocked {
        values.push(("blocked for s".into(), format!("{:.1}", blocked.for_s)));
    }
    for obstacle in &status.rows {
        let with = obstacle.robot.map_or_else(|| "itself".into(), |robot| format!("robot {robot}"));
        values.push((format!("in the way: {}", word(obstacle.row)), with));
    }
    values.extend(status.distrusted.iter().map(|robot| ("not believed".into(), format!("robot {robot}"))));
    values.extend(status.rejects.iter().map(|(why, count)| (format!("rejected: {why}"), count.to_string())));
    let blocked = if status.blocked.is_some() { ", blocked" } else { "" };
    let message = format!("{}{blocked}", status.mode);
    Diagnosis { level, name: format!("closeranks: {name}"), message, hardware: name.into(), values }
}

fn word(row: Row) -> &'static str {
    match row {
        Row::Distance => "distance",
        Row::Link => "link",
        Row::Connectivity => "connectivity",
        Row::Input => "input",
    }
}

fn drawing(name: &str, status: &Status) -> Vec<Marker> {
    let point = |place: &[f64]| core::array::from_fn(|axis| place.get(axis).copied().unwrap_or(0.0));
    let own_m: [f64; 3] = point(&status.own_m);
    let lines = |blocks: bool| {
        let is_in_the_way = |robot: u16| status.rows.iter().any(|obstacle| obstacle.robot == Some(robot));
        let drawn = status.neighbors.iter().filter(|(robot, _)| is_in_the_way(*robot) == blocks);
        Shape::Lines(drawn.flat_map(|(_, place)| [own_m, point(place)]).collect())
    };
    let above_m = [own_m[0], own_m[1], own_m[2] + TEXT_ABOVE_M];
    let text = Shape::Text(above_m, format!("{} {}", status.mode, status.degree));
    let all = [("links", lines(false), FREE), ("blocks", lines(true), IN_THE_WAY), ("mode", text, WHITE)];
    // An empty list of lines is no marker for RViz.
    let drawn = all.into_iter().filter(|(_, shape, _)| *shape != Shape::Lines(Vec::new()));
    drawn.map(|(group, shape, color)| Marker { group: format!("{name}/{group}"), shape, color }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::node::status::{Blocked, Obstacle};

    #[test]
    fn who_blocks_is_said_and_drawn_in_another_colour() {
        let status = Status {
            robot: 1,
            time_s: 2.0,
            mode: "GUARANTEED",
            degree: 2,
            margin: 0,
            wanted_m_s: Some(vec![1.0, 0.0]),
            velocity_m_s: vec![0.0, 0.0],
            progress: Some(0.0),
            blocked: Some(Blocked { since_s: 0.5, for_s: 1.5 }),
            rows: vec![Obstacle { row: Row::Distance, robot: Some(2) }],
            own_m: vec![0.0, 0.0],
            neighbors: vec![(2, vec![0.3, 0.0]), (3, vec![0.0, 1.0])],
            distrusted: vec![3],
            missed: 0,
            rejects: vec![("replay", 4)],
        };
        let said = diagnosis("robot_1", &status);
        assert_eq!((said.level, said.message.as_str()), (Level::Warn, "GUARANTEED, blocked"));
        for expected in
            [("blocked for s", "1.5"), ("in the way: distance", "robot 2"), ("rejected: replay", "4")]
        {
            assert!(
                said.values.iter().any(|(name, value)| (name.as_str(), value.as_str()) == expected),
                "{said:?}"
            );
        }
        let drawn = drawing("robot_1", &status);
        let points = |group: &str| drawn.iter().find(|it| it.group == group).map(|it| it.shape.clone());
        assert_eq!(points("robot_1/blocks"), Some(Shape::Lines(vec![[0.0; 3], [0.3, 0.0, 0.0]])));
        assert_eq!(points("robot_1/links"), Some(Shape::Lines(vec![[0.0; 3], [0.0, 1.0, 0.0]])));
        let free = Status { blocked: None, rows: Vec::new(), neighbors: Vec::new(), ..status };
        assert_eq!((diagnosis("robot_1", &free).level, drawing("robot_1", &free).len()), (Level::Ok, 1));
    }
}
