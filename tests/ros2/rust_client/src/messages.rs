//! The messages of ROS 2 that the visitor uses, field by field as they stand in CDR.
use ros2_client::Message;
use serde::{Deserialize, Serialize};

/// Structures with these fields, as messages.
macro_rules! messages {
    ($($name:ident { $($field:ident: $kind:ty),* $(,)? })*) => {$(
        #[derive(Debug, Clone, Default, Serialize, Deserialize)]
        pub struct $name { $(pub $field: $kind),* }
        impl Message for $name {}
    )*};
}

messages! {
    Stamp { sec: i32, nanosec: u32 }
    Header { stamp: Stamp, frame_id: String }
    Clock { clock: Stamp }
    Vector3 { x: f64, y: f64, z: f64 }
    Quaternion { x: f64, y: f64, z: f64, w: f64 }
    Pose { position: Vector3, orientation: Quaternion }
    Twist { linear: Vector3, angular: Vector3 }
    PoseWithCovariance { pose: Pose, covariance: [[f64; 6]; 6] }
    TwistWithCovariance { twist: Twist, covariance: [[f64; 6]; 6] }
    Odometry { header: Header, child_frame_id: String, pose: PoseWithCovariance, twist: TwistWithCovariance }
    LaserScan {
        header: Header, angle_min: f32, angle_max: f32, angle_increment: f32, time_increment: f32, scan_time: f32,
        range_min: f32, range_max: f32, ranges: Vec<f32>, intensities: Vec<f32>,
    }
    // simulation_interfaces. A message without fields has one byte.
    Empty { placeholder: u8 }
    Outcome { result: u8, error_message: String }
    StateReply { state: u8, result: Outcome }
    SetState { state: u8 }
    SetStateReply { result: Outcome }
    Steps { steps: u64 }
    StepsResult { result: Outcome }
    StepsFeedback { completed_steps: u64, remaining_steps: u64 }
}
