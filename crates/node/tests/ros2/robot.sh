# Sourced by run.sh and rclpy.sh: a team of two, of which robot_1 is a node among topics; needs `node`, `port` and `keys`.
cat > team.toml << 'T'
[team]
robots = 2
faults = 0
[controller]
kind = "budget"
position_error_m = 0.03
tracking_error_m = 0.03
input_min_m_s = [-0.5, -0.5]
input_max_m_s = [0.5, 0.5]
[clock]
tau_1_s = 0.1
tau_2_s = 0.4
hold_max_s = 0.15
T
"$node" roster new team --parameters team.toml > new.txt
"$node" roster add team robot_1 > /dev/null
"$node" roster add team robot_2 > /dev/null
"$node" roster sign team
cat > robot_1.toml << T
robot = "robot_1"
roster = "team/roster.toml"
operator = "$(sed -n 's/^operator //p' new.txt)"
key = "team/robot_1.key"
epoch = "robot_1.epoch"
[network]
mode = "client"
connect = ["tcp/127.0.0.1:$port"]
[plant]
kind = "ros2"
keys = "$keys"
source_timeout = 0.5
[desired]
source = "ros2"
T
