//! Keys, attachment and tokens of rmw_zenoh.
//!
//! ```text
//! key         domain/topic/type/hash            0/robot_1/cmd_vel/geometry_msgs::msg::dds_::TwistStamped_/RIHS01_5f0f...
//! attachment  sequence, i64 | time since 1970 in ns, i64 | 16 | 16 bytes that name the publisher     33 bytes
//! ```

use serde::{Deserialize, Serialize};

/// A message type, with the hash of its definition (RIHS01).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Type {
    /// Its name in keys.
    pub name: &'static str,
    /// Its hash. It has been the same since Iron.
    pub hash: &'static str,
}

/// `geometry_msgs/msg/Twist`.
pub const TWIST: Type = Type {
    name: "geometry_msgs::msg::dds_::Twist_",
    hash: "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a",
};
/// `geometry_msgs/msg/TwistStamped`.
pub const TWIST_STAMPED: Type = Type {
    name: "geometry_msgs::msg::dds_::TwistStamped_",
    hash: "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64",
};
/// `geometry_msgs/msg/PoseStamped`.
pub const POSE_STAMPED: Type = Type {
    name: "geometry_msgs::msg::dds_::PoseStamped_",
    hash: "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8",
};
/// `nav_msgs/msg/Odometry`.
pub const ODOMETRY: Type = Type {
    name: "nav_msgs::msg::dds_::Odometry_",
    hash: "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
};

/// `diagnostic_msgs/msg/DiagnosticArray`.
pub const DIAGNOSTICS: Type = Type {
    name: "diagnostic_msgs::msg::dds_::DiagnosticArray_",
    hash: "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
};
/// `visualization_msgs/msg/MarkerArray`.
pub const MARKERS: Type = Type {
    name: "visualization_msgs::msg::dds_::MarkerArray_",
    hash: "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf",
};

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

/// The key of a topic.
#[must_use]
pub fn key(domain: u16, topic: &str, of: &Type, distro: Distro) -> String {
    let hash = match distro {
        Distro::Humble => "TypeHashNotSupported".to_owned(),
        Distro::Jazzy | Distro::Kilted => format!("RIHS01_{}", of.hash),
    };
    format!("{domain}/{}/{}/{hash}", topic.trim_start_matches('/'), of.name)
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

/// Whether a token is of a publisher or of a subscription.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It publishes.
    Publisher,
    /// It listens.
    Subscription,
}

/// The tokens that make a node with one topic visible to `ros2 node list` and `ros2 topic list`. Data flows without them.
#[must_use]
pub fn tokens(
    domain: u16,
    zid: &str,
    node: &str,
    number: u32,
    end: End,
    topic: &str,
    key: &str,
) -> [String; 2] {
    let kind = match end {
        End::Publisher => "MP",
        End::Subscription => "MS",
    };
    let topic = format!("%{}", topic.trim_start_matches('/').replace('/', "%"));
    // Type and hash are the last two parts of the key.
    let type_at = key.rmatch_indices('/').nth(1).map_or(0, |(at, _)| at + 1);
    let mine = format!("@ros2_lv/{domain}/{zid}/0");
    [
        format!("{mine}/0/NN/%/%/{node}"),
        format!("{mine}/{number}/{kind}/%/%/{node}/{topic}/{}/::,10:,:,:,,", &key[type_at..]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_that_of_rmw_zenoh() {
        let of = key(0, "/robot_1/cmd_vel", &TWIST_STAMPED, Distro::Jazzy);
        assert_eq!(
            of,
            "0/robot_1/cmd_vel/geometry_msgs::msg::dds_::TwistStamped_/\
             RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64"
        );
        assert!(
            key(3, "a/b", &TWIST, Distro::Humble)
                .ends_with("/geometry_msgs::msg::dds_::Twist_/TypeHashNotSupported")
        );
        let [node, topic] = tokens(0, "ab12", "closeranks", 7, End::Publisher, "/robot_1/cmd_vel", &of);
        assert_eq!(node, "@ros2_lv/0/ab12/0/0/NN/%/%/closeranks");
        assert!(topic.starts_with(
            "@ros2_lv/0/ab12/0/7/MP/%/%/closeranks/%robot_1%cmd_vel/geometry_msgs::msg::dds_::TwistStamped_/RIHS01_5f0f"
        ));
        assert!(topic.ends_with("/::,10:,:,:,,"));
    }

    #[test]
    fn an_attachment_has_33_bytes() {
        let bytes = attachment(1, 2, &[7; 16]);
        assert_eq!((bytes[0], bytes[8], bytes[16], bytes[32]), (1, 2, 16, 7));
    }
}
