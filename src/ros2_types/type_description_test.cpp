// The types of messages are those that ROS 2 knows: hashes as published with Jazzy and Kilted.
#include "ros2_types/type_description.h"

#include <gtest/gtest.h>

#include "ros2_types/messages/action_messages.h"
#include "ros2_types/messages/command_messages.h"
#include "ros2_types/messages/parameter_services.h"
#include "ros2_types/messages/sensor_messages.h"

namespace roboss::ros2 {
namespace {

template <Message M>
void expect_hash(const std::string& published) {
    EXPECT_EQ(type_hash(describe<M>()), "RIHS01_" + published) << M::kName;
}

TEST(TypeDescription, HashesAreThePublishedOnes) {
    expect_hash<Time>("b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197");
    expect_hash<Point>("6963084842a9b04494d6b2941d11444708d892da2f4b09843b9c43f42a7f6881");
    expect_hash<PoseMessage>("d501954e9476cea2996984e812054b68026ae0bfae789d9a10b23daf35cc90fa");
    expect_hash<PoseStamped>("10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8");
    expect_hash<PoseWithCovariance>("9a7c0fd234b7f45c6098745ecccd773ca1085670e64107135397aee31c02e1bb");
    expect_hash<Quaternion>("8a765f66778c8ff7c8ab94afcc590a2ed5325a1d9a076ffff38fbce36f458684");
    expect_hash<TransformMessage>("beb83fbe698636351461f6f35d1abb20010c43d55374d81bd041f1ba2581fddc");
    expect_hash<TransformStamped>("0a241f87d04668d94099cbb5ba11691d5ad32c2f29682e4eb5653424bd275206");
    expect_hash<TwistMessage>("9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a");
    expect_hash<TwistWithCovariance>("49f574f033f095d8b6cd1beaca5ca7925e296e84af1716d16c89d38b059c8c18");
    expect_hash<Vector3>("cc12fe83e4c02719f1ce8070bfd14aecd40f75a96696a67a2a1f37f7dbb0765d");
    expect_hash<WrenchMessage>("018e8519d57c16adbe97c9fe1460ef21fec7e31bc541de3d653a35895677ce52");
    expect_hash<WrenchStamped>("8dc3deaf06b2ab281f9f9a742a8961c328ca7cec16e3fd6586d3a5c83fa78f77");
    expect_hash<Odometry>("3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
    expect_hash<Clock>("692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564");
    expect_hash<BatteryState>("4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741");
    expect_hash<CameraInfo>("b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275");
    expect_hash<FluidPressure>("22dfb2b145a0bd5a31a1ac3882a1b32148b51d9b2f3bab250290d66f3595bc32");
    expect_hash<ImageMessage>("d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47");
    expect_hash<Imu>("7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b");
    expect_hash<JointStateMessage>("a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e");
    expect_hash<LaserScan>("64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828");
    expect_hash<MagneticField>("e80f32f56a20486c9923008fc1a1db07bbb273cbbf6a5b3bfa00835ee00e4dff");
    expect_hash<NavSatFix>("62223ab3fe210a15976021da7afddc9e200dc9ec75231c1b6a557fc598a65404");
    expect_hash<NavSatStatus>("d1ed3befa628e09571bd273b888ba1c1fd187c9a5e0006b385d7e5e9095a3204");
    expect_hash<PointCloud2>("9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5");
    expect_hash<PointField>("5c6a4750728c2bcfbbf7037225b20b02d4429634732146b742dee1726637ef01");
    expect_hash<Range>("b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a");
    expect_hash<RegionOfInterest>("ad16bcba5f9131dcdba6fbded19f726f5440e3c513b4fb586dd3027eeed8abb1");
    expect_hash<Header>("f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01");
    expect_hash<String>("df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
    expect_hash<TFMessage>("e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
}

TEST(TypeDescription, DefinitionsNameFieldsAndAllTypesThatTheyConsistOf) {
    EXPECT_EQ(definition_text(describe<Clock>()),
              "builtin_interfaces/Time clock\n" + std::string(80, '=') +
                  "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
    const std::string odometry = definition_text(describe<Odometry>());
    EXPECT_TRUE(
        odometry.starts_with("std_msgs/Header header\nstring child_frame_id\n"
                             "geometry_msgs/PoseWithCovariance pose\n"))
        << odometry;
    EXPECT_NE(odometry.find("MSG: geometry_msgs/Vector3\nfloat64 x\n"), std::string::npos) << odometry;
    EXPECT_NE(odometry.find("float64[36] covariance\n"), std::string::npos) << odometry;
}

TEST(TypeDescription, DefinitionsHaveConstantsAndBoundsButNoInventedFields) {
    EXPECT_TRUE(definition_text(describe<GoalStatus>())
                    .starts_with("int8 STATUS_UNKNOWN=0\nint8 STATUS_ACCEPTED=1\n"));
    EXPECT_NE(definition_text(describe<rcl_interfaces::ParameterDescriptor>())
                  .find("rcl_interfaces/IntegerRange[<=1] integer_range\n"),
              std::string::npos);
    EXPECT_EQ(definition_text(describe<Empty>()), "");
}

}  // namespace
}  // namespace roboss::ros2
