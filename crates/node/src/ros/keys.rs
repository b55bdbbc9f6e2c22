//! Keys, attachment and tokens of rmw_zenoh.
//!
//! ```text
//! key         domain/topic/type/hash            0/robot_1/cmd_vel/geometry_msgs::msg::dds_::TwistStamped_/RIHS01_5f0f...
//! attachment  sequence, i64 | time since 1970 in ns, i64 | 16 | 16 bytes that name the publisher     33 bytes
//! ```

use serde::{Deserialize, Serialize};

/// A message type, with the hash of its definition (RIHS01), which has been the same since Iron.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Type {
    package: &'static str,
    name: &'static str,
    hash: &'static str,
}

const fn of(package: &'static str, name: &'static str, hash: &'static str) -> Type {
    Type { package, name, hash }
}

/// `geometry_msgs/msg/Twist`.
pub const TWIST: Type =
    of("geometry_msgs", "Twist", "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a");
/// `geometry_msgs/msg/TwistStamped`.
pub const TWIST_STAMPED: Type =
    of("geometry_msgs", "TwistStamped", "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64");
/// `geometry_msgs/msg/PoseStamped`.
pub const POSE_STAMPED: Type =
    of("geometry_msgs", "PoseStamped", "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8");
/// `nav_msgs/msg/Odometry`.
pub const ODOMETRY: Type =
    of("nav_msgs", "Odometry", "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
/// `diagnostic_msgs/msg/DiagnosticArray`.
pub const DIAGNOSTICS: Type = of(
    "diagnostic_msgs",
    "DiagnosticArray",
    "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
);
/// `visualization_msgs/msg/MarkerArray`.
pub const MARKERS: Type = of(
    "visualization_msgs",
    "MarkerArray",
    "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf",
);

/// Which ROS 2 is on the other side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Distro {
    /// Its keys have no hashes.
    Humble,
    /// Hashes in keys.
    #[default]
    Jazzy,
    /// As Jazzy.
    Kilted,
}

/// What carries ROS 2 over Zenoh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Form {
    /// Zenoh itself is the middleware of ROS 2.
    #[default]
    #[serde(rename = "rmw_zenoh")]
    RmwZenoh,
    /// A bridge between DDS and Zenoh, `zenoh-plugin-ros2dds`: keys are topics, and nothing is attached.
    #[serde(rename = "ros2dds")]
    Ros2dds,
}

/// How topics become keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Naming {
    /// ROS_DOMAIN_ID.
    pub domain: u16,
    /// Which ROS 2 is on the other side.
    pub distro: Distro,
    /// What carries it.
    pub form: Form,
}

impl Naming {
    /// The key of a topic.
    #[must_use]
    pub fn key(&self, topic: &str, of: &Type) -> String {
        let topic = topic.trim_start_matches('/');
        match self.form {
            Form::Ros2dds => topic.to_owned(),
            Form::RmwZenoh => format!("{}/{topic}/{}", self.domain, self.kind(of)),
        }
    }

    /// Type and hash as they stand in keys and tokens.
    #[must_use]
    pub fn kind(&self, of: &Type) -> String {
        let Type { package, name, hash } = of;
        match self.distro {
            Distro::Humble => format!("{package}::msg::dds_::{name}_/TypeHashNotSupported"),
            Distro::Jazzy | Distro::Kilted => format!("{package}::msg::dds_::{name}_/RIHS01_{hash}"),
        }
    }

    /// The tokens that make a node with one topic visible to `ros2 node list` and `ros2 topic list`. Data flows without them, and a bridge
    /// does not know them.
    #[must_use]
    pub fn tokens(&self, session: &str, node: &str, number: u32, (topic, of): (&str, &Type)) -> Vec<String> {
        if self.form == Form::Ros2dds {
            return Vec::new();
        }
        let topic = topic.trim_start_matches('/').replace('/', "%");
        let mine = format!("@ros2_lv/{}/{session}/0", self.domain);
        vec![
            format!("{mine}/0/NN/%/%/{node}"),
            format!("{mine}/{number}/MP/%/%/{node}/%{topic}/{}/::,10:,:,:,,", self.kind(of)),
        ]
    }

    /// The keys of the tokens of others with topics; none where a bridge carries ROS 2.
    #[must_use]
    pub fn all_tokens(&self) -> Option<String> {
        (self.form == Form::RmwZenoh).then(|| format!("@ros2_lv/{}/**", self.domain))
    }

    /// The other type, with its hash, if `token` is of somebody who has this topic with one: both would not hear each other.
    #[must_use]
    pub fn differs(&self, token: &str, topic: &str, of: &Type) -> Option<String> {
        let topic = format!("%{}", topic.trim_start_matches('/').replace('/', "%"));
        let mut parts = token.split('/').rev();
        let (_quality, hash, name, theirs) = (parts.next()?, parts.next()?, parts.next()?, parts.next()?);
        let found = format!("{name}/{hash}");
        (theirs == topic && found != self.kind(of)).then_some(found)
    }
}

/// What goes with every message: without it rmw_zenoh delivers nothing.
#[must_use]
pub fn attachment(sequence: i64, nanos: u64, publisher: &[u8; 16]) -> [u8; 33] {
    let mut bytes = [0; 33];
    bytes[..8].copy_from_slice(&sequence.to_le_bytes());
    bytes[8..16].copy_from_slice(&nanos.to_le_bytes());
    bytes[16] = 16;
    bytes[17..].copy_from_slice(publisher);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn naming(distro: Distro, form: Form) -> Naming {
        Naming { domain: 0, distro, form }
    }

    #[test]
    fn a_key_is_that_of_rmw_zenoh() {
        let jazzy = naming(Distro::Jazzy, Form::RmwZenoh);
        assert_eq!(
            jazzy.key("/robot_1/cmd_vel", &TWIST_STAMPED),
            "0/robot_1/cmd_vel/geometry_msgs::msg::dds_::TwistStamped_/\
             RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64"
        );
        let humble = naming(Distro::Humble, Form::RmwZenoh).key("a/b", &TWIST);
        assert!(humble.ends_with("/geometry_msgs::msg::dds_::Twist_/TypeHashNotSupported"));
        let tokens = jazzy.tokens("ab12", "closeranks", 7, ("/robot_1/cmd_vel", &TWIST_STAMPED));
        let [node, topic] = &tokens[..] else { panic!("{tokens:?}") };
        assert_eq!(node, "@ros2_lv/0/ab12/0/0/NN/%/%/closeranks");
        assert!(topic.starts_with(
            "@ros2_lv/0/ab12/0/7/MP/%/%/closeranks/%robot_1%cmd_vel/geometry_msgs::msg::dds_::TwistStamped_/RIHS01_5f0f"
        ));
        assert!(topic.ends_with("/::,10:,:,:,,"));
    }

    #[test]
    fn behind_a_bridge_a_key_is_the_topic() {
        let bridge = naming(Distro::Kilted, Form::Ros2dds);
        assert_eq!(bridge.key("/robot_1/cmd_vel", &TWIST_STAMPED), "robot_1/cmd_vel");
        assert!(bridge.tokens("ab", "n", 1, ("/x", &TWIST)).is_empty() && bridge.all_tokens().is_none());
    }

    #[test]
    fn another_hash_on_the_same_topic_is_noticed() {
        let jazzy = naming(Distro::Jazzy, Form::RmwZenoh);
        let token =
            |distro, of| naming(distro, Form::RmwZenoh).tokens("ab", "n", 7, ("/robot_1/odom", of)).remove(1);
        let differs = |token: &str, topic| jazzy.differs(token, topic, &ODOMETRY);
        assert_eq!(differs(&token(Distro::Kilted, &ODOMETRY), "robot_1/odom"), None);
        let humble = token(Distro::Humble, &ODOMETRY);
        let found = differs(&humble, "/robot_1/odom");
        assert_eq!(found.as_deref(), Some("nav_msgs::msg::dds_::Odometry_/TypeHashNotSupported"));
        assert!(differs(&token(Distro::Jazzy, &POSE_STAMPED), "robot_1/odom").is_some());
        for other in [humble.as_str(), "", "a/b", "@ros2_lv/0/ab/0/0/NN/%/%/n"] {
            assert_eq!(differs(other, "robot_2/odom"), None, "{other}");
        }
    }

    #[test]
    fn an_attachment_has_33_bytes() {
        let bytes = attachment(1, 2, &[7; 16]);
        assert_eq!((bytes[0], bytes[8], bytes[16], bytes[32]), (1, 2, 16, 7));
    }
}
