// Interfaces of ROS 2 that sensors publish: sensor_msgs and nav_msgs. See standard_messages.h.
#pragma once

#include "ros2_types/messages/standard_messages.h"

namespace roboss::ros2 {

/// sensor_msgs/msg/LaserScan
struct LaserScan {
    static constexpr const char* kName = "sensor_msgs/msg/LaserScan";
    Header header;              ///< time and frame
    float angle_min = 0,        ///< rad, about z, of the first beam
        angle_max = 0,          ///< rad, of the last
        angle_increment = 0,    ///< rad, from beam to beam
        time_increment = 0,     ///< s, from beam to beam; 0: all at once
        scan_time = 0,          ///< s, from scan to scan
        range_min = 0,          ///< m
        range_max = 0;          ///< m
    std::vector<float> ranges,  ///< m; +inf: nothing in range, -inf: something nearer (REP 117)
        intensities;            ///< of each beam, or empty

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("angle_min", m.angle_min);
        visit("angle_max", m.angle_max);
        visit("angle_increment", m.angle_increment);
        visit("time_increment", m.time_increment);
        visit("scan_time", m.scan_time);
        visit("range_min", m.range_min);
        visit("range_max", m.range_max);
        visit("ranges", m.ranges);
        visit("intensities", m.intensities);
    }
};

/// sensor_msgs/msg/PointField
struct PointField {
    static constexpr const char* kName = "sensor_msgs/msg/PointField";
    static constexpr std::uint8_t kUint8 = 2, kFloat32 = 7;  ///< values of `datatype`
    std::string name;                                        ///< "x", "y", "z", "intensity", "rgb"
    std::uint32_t offset = 0;                                ///< bytes, in a point
    std::uint8_t datatype = kFloat32;                        ///< of its numbers
    std::uint32_t count = 1;                                 ///< how many

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("name", m.name);
        visit("offset", m.offset);
        visit("datatype", m.datatype);
        visit("count", m.count);
    }
};

/// sensor_msgs/msg/PointCloud2
struct PointCloud2 {
    static constexpr const char* kName = "sensor_msgs/msg/PointCloud2";
    Header header;                         ///< time and frame
    std::uint32_t height = 1,              ///< rows; 1: the points have no order
        width = 0;                         ///< points of a row
    std::vector<PointField> point_fields;  ///< what a point consists of: `fields`
    bool is_bigendian = false;             ///< order of the bytes of a number
    std::uint32_t point_step = 0,          ///< bytes of a point
        row_step = 0;                      ///< bytes of a row
    std::vector<std::uint8_t> data;        ///< height * row_step
    bool is_dense = true;                  ///< all numbers are finite

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("height", m.height);
        visit("width", m.width);
        visit("fields", m.point_fields);
        visit("is_bigendian", m.is_bigendian);
        visit("point_step", m.point_step);
        visit("row_step", m.row_step);
        visit("data", m.data);
        visit("is_dense", m.is_dense);
    }
};

/// sensor_msgs/msg/Imu
struct Imu {
    static constexpr const char* kName = "sensor_msgs/msg/Imu";
    Header header;                                           ///< time and frame
    Quaternion orientation;                                  ///< of the sensor
    std::array<double, 9> orientation_covariance{};          ///< rad^2; first -1: no orientation
    Vector3 angular_velocity;                                ///< rad/s, sensor axes
    std::array<double, 9> angular_velocity_covariance{};     ///< (rad/s)^2
    Vector3 linear_acceleration;                             ///< m/s^2, sensor axes, without gravity's pull
    std::array<double, 9> linear_acceleration_covariance{};  ///< (m/s^2)^2

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("orientation", m.orientation);
        visit("orientation_covariance", m.orientation_covariance);
        visit("angular_velocity", m.angular_velocity);
        visit("angular_velocity_covariance", m.angular_velocity_covariance);
        visit("linear_acceleration", m.linear_acceleration);
        visit("linear_acceleration_covariance", m.linear_acceleration_covariance);
    }
};

/// sensor_msgs/msg/NavSatStatus
struct NavSatStatus {
    static constexpr const char* kName = "sensor_msgs/msg/NavSatStatus";
    std::int8_t status = 0;     ///< 0: a fix
    std::uint16_t service = 1;  ///< 1: GPS

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("status", m.status);
        visit("service", m.service);
    }
};

/// sensor_msgs/msg/NavSatFix
struct NavSatFix {
    static constexpr const char* kName = "sensor_msgs/msg/NavSatFix";
    Header header;                                ///< time and frame
    NavSatStatus status;                          ///< a fix
    double latitude = 0,                          ///< degrees north
        longitude = 0,                            ///< degrees east
        altitude = 0;                             ///< m above the ellipsoid of WGS 84
    std::array<double, 9> position_covariance{};  ///< m^2, rows of east, north, up
    std::uint8_t position_covariance_type = 0;    ///< 0: unknown, 2: of the diagonal

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("status", m.status);
        visit("latitude", m.latitude);
        visit("longitude", m.longitude);
        visit("altitude", m.altitude);
        visit("position_covariance", m.position_covariance);
        visit("position_covariance_type", m.position_covariance_type);
    }
};

/// sensor_msgs/msg/MagneticField
struct MagneticField {
    static constexpr const char* kName = "sensor_msgs/msg/MagneticField";
    Header header;                                      ///< time and frame
    Vector3 magnetic_field;                             ///< T, sensor axes
    std::array<double, 9> magnetic_field_covariance{};  ///< T^2

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("magnetic_field", m.magnetic_field);
        visit("magnetic_field_covariance", m.magnetic_field_covariance);
    }
};

/// sensor_msgs/msg/FluidPressure
struct FluidPressure {
    static constexpr const char* kName = "sensor_msgs/msg/FluidPressure";
    Header header;              ///< time and frame
    double fluid_pressure = 0,  ///< Pa
        variance = 0;           ///< Pa^2; 0: unknown

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("fluid_pressure", m.fluid_pressure);
        visit("variance", m.variance);
    }
};

/// sensor_msgs/msg/Range
struct Range {
    static constexpr const char* kName = "sensor_msgs/msg/Range";
    static constexpr std::uint8_t kUltrasound = 0, kInfrared = 1;  ///< values of radiation_type
    Header header;                                                 ///< time and frame
    std::uint8_t radiation_type = kUltrasound;                     ///< what it sends
    float field_of_view = 0,                                       ///< rad, of the whole cone
        min_range = 0,                                             ///< m
        max_range = 0,                                             ///< m
        range = 0,                                                 ///< m, as LaserScan::ranges
        variance = 0;                                              ///< m^2; 0: unknown

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("radiation_type", m.radiation_type);
        visit("field_of_view", m.field_of_view);
        visit("min_range", m.min_range);
        visit("max_range", m.max_range);
        visit("range", m.range);
        visit("variance", m.variance);
    }
};

/// sensor_msgs/msg/Image
struct ImageMessage {
    static constexpr const char* kName = "sensor_msgs/msg/Image";
    Header header;                   ///< time, and the optical frame: z ahead, x right, y down
    std::uint32_t height = 0,        ///< rows
        width = 0;                   ///< columns
    std::string encoding;            ///< "rgb8", "mono8", "mono16", "32FC1"
    std::uint8_t is_bigendian = 0;   ///< order of the bytes of a number
    std::uint32_t step = 0;          ///< bytes of a row
    std::vector<std::uint8_t> data;  ///< rows from the top

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("height", m.height);
        visit("width", m.width);
        visit("encoding", m.encoding);
        visit("is_bigendian", m.is_bigendian);
        visit("step", m.step);
        visit("data", m.data);
    }
};

/// sensor_msgs/msg/RegionOfInterest
struct RegionOfInterest {
    static constexpr const char* kName = "sensor_msgs/msg/RegionOfInterest";
    std::uint32_t x_offset = 0,  ///< columns
        y_offset = 0,            ///< rows
        height = 0,              ///< rows; 0: the whole image
        width = 0;               ///< columns; 0: the whole image
    bool do_rectify = false;     ///< of a part that is rectified

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("x_offset", m.x_offset);
        visit("y_offset", m.y_offset);
        visit("height", m.height);
        visit("width", m.width);
        visit("do_rectify", m.do_rectify);
    }
};

/// sensor_msgs/msg/CameraInfo
struct CameraInfo {
    static constexpr const char* kName = "sensor_msgs/msg/CameraInfo";
    Header header;                     ///< that of its image
    std::uint32_t height = 0,          ///< rows
        width = 0;                     ///< columns
    std::string distortion_model;      ///< "plumb_bob"
    std::vector<double> d;             ///< k1 k2 p1 p2 k3
    std::array<double, 9> k{},         ///< intrinsics, by rows
        r{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< rectification, by rows
    std::array<double, 12> p{};        ///< projection, by rows
    std::uint32_t binning_x = 0,       ///< 0: none
        binning_y = 0;                 ///< 0: none
    RegionOfInterest roi;              ///< the whole image

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("height", m.height);
        visit("width", m.width);
        visit("distortion_model", m.distortion_model);
        visit("d", m.d);
        visit("k", m.k);
        visit("r", m.r);
        visit("p", m.p);
        visit("binning_x", m.binning_x);
        visit("binning_y", m.binning_y);
        visit("roi", m.roi);
    }
};

/// sensor_msgs/msg/JointState
struct JointStateMessage {
    static constexpr const char* kName = "sensor_msgs/msg/JointState";
    Header header;                  ///< time
    std::vector<std::string> name;  ///< of each joint
    std::vector<double> position,   ///< rad or m
        velocity,                   ///< rad/s or m/s
        effort;                     ///< N m or N

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("name", m.name);
        visit("position", m.position);
        visit("velocity", m.velocity);
        visit("effort", m.effort);
    }
};

/// sensor_msgs/msg/BatteryState
struct BatteryState {
    static constexpr const char* kName = "sensor_msgs/msg/BatteryState";
    static constexpr std::uint8_t kCharging = 1, kDischarging = 2;  ///< values of power_supply_status
    Header header;                                                  ///< time
    float voltage = 0,                                              ///< V
        temperature = 0,                                            ///< deg C; NaN: unknown
        current = 0,                                                ///< A, negative while it discharges
        charge = 0,                                                 ///< A h
        capacity = 0,                                               ///< A h, when it was last full
        design_capacity = 0,                                        ///< A h
        percentage = 0;                                             ///< of the capacity, 0 to 1
    std::uint8_t power_supply_status = kDischarging,                ///< see above
        power_supply_health = 0,                                    ///< 0: unknown
        power_supply_technology = 0;                                ///< 0: unknown
    bool present = true;                                            ///< whether there is one
    std::vector<float> cell_voltage,                                ///< V, or empty
        cell_temperature;                                           ///< deg C, or empty
    std::string location, serial_number;                            ///< empty

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("voltage", m.voltage);
        visit("temperature", m.temperature);
        visit("current", m.current);
        visit("charge", m.charge);
        visit("capacity", m.capacity);
        visit("design_capacity", m.design_capacity);
        visit("percentage", m.percentage);
        visit("power_supply_status", m.power_supply_status);
        visit("power_supply_health", m.power_supply_health);
        visit("power_supply_technology", m.power_supply_technology);
        visit("present", m.present);
        visit("cell_voltage", m.cell_voltage);
        visit("cell_temperature", m.cell_temperature);
        visit("location", m.location);
        visit("serial_number", m.serial_number);
    }
};

/// nav_msgs/msg/Odometry
struct Odometry {
    static constexpr const char* kName = "nav_msgs/msg/Odometry";
    Header header;               ///< time, and the frame of the pose
    std::string child_frame_id;  ///< the frame of the twist
    PoseWithCovariance pose;     ///< of the child frame
    TwistWithCovariance twist;   ///< in the axes of the child frame

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("child_frame_id", m.child_frame_id);
        visit("pose", m.pose);
        visit("twist", m.twist);
    }
};

}  // namespace roboss::ros2
