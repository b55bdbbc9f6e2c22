//! `bridge ENDPOINT`: zenoh-plugin-ros2dds between the DDS of this machine and the Zenoh router at ENDPOINT (tcp/127.0.0.1:7447).

use std::process::exit;

use zenoh::Config;
use zenoh::internal::plugins::PluginsManager;
use zenoh::internal::runtime::RuntimeBuilder;
use zenoh_plugin_ros2dds::ROS2Plugin;

#[tokio::main]
async fn main() {
    let Some(endpoint) = std::env::args().nth(1) else {
        eprintln!("usage: bridge ENDPOINT");
        exit(2);
    };
    let mut config = Config::default();
    for (key, value) in [
        ("mode", "\"client\"".to_owned()),
        ("connect/endpoints", format!("[\"{endpoint}\"]")),
        ("scouting/multicast/enabled", "false".to_owned()),
        ("plugins/ros2dds", "{ nodename: \"bridge\" }".to_owned()),
    ] {
        config.insert_json5(key, &value).expect("a field of Zenoh's configuration");
    }
    let mut plugins = PluginsManager::static_plugins_only();
    plugins.declare_static_plugin::<ROS2Plugin, _>("ros2dds", true);
    let mut runtime = RuntimeBuilder::new(config).plugins_manager(plugins).build().await.expect("a session");
    runtime.start().await.expect("the plugin starts");
    std::future::pending::<()>().await;
}
