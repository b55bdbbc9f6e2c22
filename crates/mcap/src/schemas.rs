//! The definitions of the messages of ROS 2 that a recording holds. Each schema spells out every type that it uses, so that a
//! reader needs no other source.

use core::fmt::Write as _;

/// What a robot is like in a tick: our own type, last in the table.
pub(crate) const ROBOT_STATE: &str = "closeranks_msgs/RobotState";

/// Every type: its name and its fields, one a line. Layouts are those of ROS 2 Humble and later.
const TYPES: &[(&str, &str)] = &[
    ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"),
    ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"),
    ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"),
    ("std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"),
    ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"),
    ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"),
    ("geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"),
    ("geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"),
    ("geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"),
    ("geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"),
    ("geometry_msgs/TwistStamped", "std_msgs/Header header\ngeometry_msgs/Twist twist\n"),
    ("geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"),
    ("geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance\n"),
    (
        "nav_msgs/Odometry",
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n\
         geometry_msgs/TwistWithCovariance twist\n",
    ),
    ("geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"),
    (
        "geometry_msgs/TransformStamped",
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n",
    ),
    ("tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"),
    ("sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"),
    ("visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"),
    ("visualization_msgs/MeshFile", "string filename\nuint8[] data\n"),
    (
        "visualization_msgs/Marker",
        "int32 ARROW=0\nint32 CUBE=1\nint32 SPHERE=2\nint32 CYLINDER=3\nint32 LINE_STRIP=4\n\
         int32 LINE_LIST=5\nint32 CUBE_LIST=6\nint32 SPHERE_LIST=7\nint32 POINTS=8\n\
         int32 TEXT_VIEW_FACING=9\nint32 MESH_RESOURCE=10\nint32 TRIANGLE_LIST=11\nint32 ARROW_STRIP=12\n\
         int32 ADD=0\nint32 MODIFY=0\nint32 DELETE=2\nint32 DELETEALL=3\nstd_msgs/Header header\nstring ns\n\
         int32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\n\
         std_msgs/ColorRGBA color\nbuiltin_interfaces/Duration lifetime\nbool frame_locked\n\
         geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring texture_resource\n\
         sensor_msgs/CompressedImage texture\nvisualization_msgs/UVCoordinate[] uv_coordinates\n\
         string text\nstring mesh_resource\nvisualization_msgs/MeshFile mesh_file\n\
         bool mesh_use_embedded_materials\n",
    ),
    ("visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"),
    ("diagnostic_msgs/KeyValue", "string key\nstring value\n"),
    (
        "diagnostic_msgs/DiagnosticStatus",
        "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring message\n\
         string hardware_id\ndiagnostic_msgs/KeyValue[] values\n",
    ),
    (
        "diagnostic_msgs/DiagnosticArray",
        "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n",
    ),
    (
        ROBOT_STATE,
        "std_msgs/Header header\nuint32 tick\nuint16 robot\nbool malicious\nbool down\nuint16 degree\n\
         uint16 degree_required\nfloat64 level\nfloat64 told\nfloat64 h\nfloat64 phi_i\nfloat64 value\n\
         float64 value_told\nfloat64 degree_sensed\nfloat64 level_sensed\nstring outcome\nstring mode\n",
    ),
];

/// What stands between two definitions of a schema.
const RULE: &str = "================================================================================";

/// The definition of `name` with those of all types that it uses, each once.
pub(crate) fn schema(name: &str) -> String {
    let mut used = vec![name];
    let mut text = fields(name).to_owned();
    let mut next = 0;
    while let Some(of) = used.get(next).copied() {
        for part in parts(of) {
            if !used.contains(&part) {
                used.push(part);
                let _ = write!(text, "{RULE}\nMSG: {part}\n{}", fields(part));
            }
        }
        next += 1;
    }
    text
}

/// The name of a type as bags and channels spell it.
pub(crate) fn spelt(name: &str) -> String {
    name.replacen('/', "/msg/", 1)
}

fn fields(name: &str) -> &'static str {
    TYPES.iter().find(|(known, _)| *known == name).map_or("", |(_, fields)| fields)
}

/// The types that the fields of `name` are of, unless they are numbers and texts.
fn parts(name: &str) -> impl Iterator<Item = &'static str> {
    let types = fields(name).lines().filter_map(|line| line.split(' ').next());
    types.filter(|kind| kind.contains('/')).map(|kind| kind.trim_end_matches("[]"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_schema_is_complete() {
        for (name, _) in TYPES {
            let text = schema(name);
            let told = |kind: &str| text.contains(&format!("MSG: {kind}\n"));
            let types = text.lines().filter(|line| !line.starts_with("MSG: "));
            let types = types.filter_map(|line| line.split(' ').next()).filter(|kind| kind.contains('/'));
            for kind in types {
                assert!(told(kind.trim_end_matches("[]")), "{name} lacks {kind}");
            }
        }
        assert_eq!(schema("tf2_msgs/TFMessage").matches(RULE).count(), 6);
        assert_eq!(spelt("tf2_msgs/TFMessage"), "tf2_msgs/msg/TFMessage");
    }
}
