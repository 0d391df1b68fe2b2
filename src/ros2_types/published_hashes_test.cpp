// The types of commands, services and actions are those that others know: hashes as published with Jazzy and
// Kilted, and where none are, as the generator of ROS 2 makes them from the published definitions.
#include <gtest/gtest.h>

#include "ros2_types/action_type.h"
#include "ros2_types/messages/command_messages.h"
#include "ros2_types/messages/control_messages.h"
#include "ros2_types/messages/gazebo_services.h"
#include "ros2_types/messages/gripper_messages.h"
#include "ros2_types/messages/parameter_services.h"
#include "ros2_types/messages/simulation_entity_services.h"
#include "ros2_types/messages/simulation_run_services.h"
#include "ros2_types/messages/simulation_services_v1.h"
#include "ros2_types/messages/simulation_spawn_services.h"
#include "ros2_types/messages/simulation_world_services.h"
#include "ros2_types/messages/standard_services.h"

namespace roboss::ros2 {
namespace {

template <class T>
void expect_hash(const std::string& published) {
    EXPECT_EQ(type_hash(describe<T>()), "RIHS01_" + published) << T::kName;
}

TEST(PublishedHashes, Commands) {
    expect_hash<Duration>("e8d009f659816f758b75334ee1a9ca5b5c0b859843261f14c7f937349599d93b");
    expect_hash<Empty>("20b625256f32d5dbc0d04fee44f43c41e51c70d3502f84b4a08e7a9c26a96312");
    expect_hash<Bool>("feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9");
    expect_hash<Int32>("b6578ded3c58c626cfe8d1a6fb6e04f706f97e9f03d2727c9ff4e74b1cef0deb");
    expect_hash<Float32>("7170d3d8f841f7be3172ce5f4f59f3a4d7f63b0447e8b33327601ad64d83d6e2");
    expect_hash<Float64>("705ba9c3d1a09df43737eb67095534de36fd426c0587779bda2bc51fe790182a");
    expect_hash<MultiArrayDimension>("5e773a60a4c7fc8a54985f307c7837aa2994252a126c301957a24e31282c9cbe");
    expect_hash<MultiArrayLayout>("4c66e6f78e740ac103a94cf63259f968e48c617e7699e829b63c21a5cb50dac6");
    expect_hash<Float32MultiArray>("0599f6f85b4bfca379873a0b4375a0aca022156bd2d7021275d116ed1fa8bfe0");
    expect_hash<PoseArray>("af0cc36d190e104d546d168d6b39df04fa4b4ccecf59cb4c9ed328d3d5004aa0");
    expect_hash<Float64MultiArray>("1025ddc6b9552d191f89ef1a8d2f60f3d373e28b283d8891ddcc974e8c55397f");
    expect_hash<TwistStamped>("5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64");
    expect_hash<AccelMessage>("dc448243ded9b1fcbcca24aba0c22f013dae06c354ba2d849571c0a2a3f57ca0");
    expect_hash<JointTrajectory>("179b33eba59d676f6d967ac71fe35e7ca2f64b2f3928f4a018cec115e213796e");
    expect_hash<JointTrajectoryPoint>("de8907036d8bd45aac6f30cc9044a3d4a329c42cbf719aff7d95a584cfa532d7");
    expect_hash<MultiDofJointTrajectory>("3a18fd095292a65cfde8833c72985a30af981f3ec44494655c6267262b443a4a");
    expect_hash<MultiDofJointTrajectoryPoint>(
        "6ada1085b5ee64eaa069b074968e69f0e27c8c5e6f5bb0586dd1c834ef0e32b8");
}

TEST(PublishedHashes, Trajectories) {
    expect_hash<JointTolerance>("c254f9cece0f3b733017b6990fd46d1326e25242d6b8844398c97d9a88e7d648");
    expect_hash<JointComponentTolerance>("739ea7566931944d33830fa10f1bf5e7a7fbdc3172bce7a7eaac642bd6e3ffa4");
    expect_hash<FollowJointTrajectory>("ff29901b2693f5deb847e96084a1c2cdb26e70b7c847be21859b70a55fb29cf0");
    expect_hash<FollowJointTrajectory::Goal>(
        "8a9060704b269608f5a340934cc26e66869dd14bdac29e2e7fd9ec8b9882d205");
    expect_hash<FollowJointTrajectory::Result>(
        "8002e99ed2c14c6faa522f2a93c26d744c5982f254f9e98ff9c6f19789bdb220");
    expect_hash<FollowJointTrajectory::Feedback>(
        "0bb018d181bdc6384dd75365480967bd1d6eaee4ef3dd597c64cd0b8bdc10867");
    expect_hash<FeedbackMessage<FollowJointTrajectory>>(
        "95618cc73912d99b9acaa17d2da5e832cb0bfdeede7534fa8ec600feca2a6c4b");
    expect_hash<SendGoal<FollowJointTrajectory>>(
        "b13789dddc325a7a962825c45e28c77d37237ec129dd0c34dc5994562938c57f");
    expect_hash<SendGoal<FollowJointTrajectory>::Request>(
        "179c93691f1f6d1d115881ff88c3917b7cc6eac2ba4bf56766cc7c4389e19ef1");
    expect_hash<GetResult<FollowJointTrajectory>>(
        "e3ceb38e3e1867c8dc0f46014df26e90eb93422f27e9e97f936e07f94be4bc8b");
    expect_hash<FollowJointTrajectoryBefore63>(
        "738ebcb7a2d7cfa42f9f1001cc99ce3a4383d1cfe508015d9be8485e4b1c66f6");
    expect_hash<FeedbackMessage<FollowJointTrajectoryBefore63>>(
        "80398fcb9674a79081a9906e2ccf0c804dd7cb15e22e362e606ee87186beab71");
}

TEST(PublishedHashes, Actions) {
    expect_hash<Uuid>("1b8e8aca958cbea28fe6ef60bf6c19b683c97a9ef60bb34752067d0f2f7ab437");
    expect_hash<GoalInfo>("6398fe763154554353930716b225947f93b672f0fb2e49fdd01bb7a7e37933e9");
    expect_hash<GoalStatus>("32f4cfd717735d17657e1178f24431c1ce996c878c515230f6c5b3476819dbb9");
    expect_hash<GoalStatusArray>("6c1684b00f177d37438febe6e709fc4e2b0d4248dca4854946f9ed8b30cda83e");
    expect_hash<CancelGoal>("573d8b0a534451d7bc2ac8c5ffde8ac14b8593b7001175d0cd6516dcbeb8689a");
    expect_hash<CancelGoal::Request>("3d3c84653c1f96918086887e1dcb236faec88b81a5b14fd4cf4840065bcdf8af");
    expect_hash<CancelGoal::Response>("35e682cf3f510e83c70a82a4aac888496dedee56773bf9d8e5e0aa81f9e1c960");
}

TEST(PublishedHashes, StandardServices) {
    expect_hash<std_srvs::Empty>("5888399dedec5ccc85ea6451949fd2c9f97bfdf963f9a588821639fcd31b5d19");
    expect_hash<std_srvs::Empty::Request>("458eaf200a3f63d9cc53d19436edebc0c140ef4c93ca75d5bd4ce19fd7759e35");
    expect_hash<std_srvs::Empty::Response>(
        "0a2858b3f60df644a61d0fa44cfc923a3d3628e0ad9c8ad8534b1a2c92a413dc");
    expect_hash<std_srvs::Trigger>("eeff2cd6fa5ad9d27cdf4dec64818317839b62f212a91e6b5304b634b2062c5f");
    expect_hash<std_srvs::Trigger::Request>(
        "d010825374ce8918e72bfd826c82603e60f45419e932ea976f807b74a863a199");
    expect_hash<std_srvs::Trigger::Response>(
        "2d946c21e2fc3f1e9ca6986a8191d85fcc70097a8bb7771a053564bc47009cdf");
    expect_hash<std_srvs::SetBool>("abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a");
    expect_hash<std_srvs::SetBool::Request>(
        "c62fbb99d94e1b25e8ef9e109f9581956bb1b3361a45a4e5810c36a90d29932e");
    expect_hash<std_srvs::SetBool::Response>(
        "d0814e7f7b4880ab77e9c57426c7aa1562ab69f11eef8e2e968812f9cbd0b059");
}

TEST(PublishedHashes, Parameters) {
    using namespace rcl_interfaces;
    expect_hash<ParameterValue>("115fc089a387e23c7ecd3525c9189c379109119d6ab82e8dfbde0fdf6a7f9b68");
    expect_hash<Parameter>("ddfe6442cffc462317adb5c92536a7b6dd55858c5c3e1e328165a6b73c2831af");
    expect_hash<FloatingPointRange>("e6af23a23c177fee5f3075c8b1e435162a9b63c863d78c06017460b49684262d");
    expect_hash<IntegerRange>("f7b7fdc0f65f07702e099218e13288c3963bcb9345bde78b560e6cd19800fc5a");
    expect_hash<ParameterDescriptor>("52175dbfda6c51153101d33d2a9da05743f66f02d5ab2ca9ec4709b46b73d704");
    expect_hash<SetParametersResult>("cfcc0fb0371ee5159b403960ef4300f8f9d2f1fd6117c8666b7f9654d528a9b1");
    expect_hash<ListParametersResult>("237ae3428413dcbcfb452b510c42355f3a2b021dc091afa3e18526d57022f1cd");
    expect_hash<ParameterEvent>("043e627780fcad87a22d225bc2a037361dba713fca6a6b9f4b869a5aa0393204");
    expect_hash<GetParameters>("bf9803d5c74cf989a5de3e0c2e99444599a627c7ff75f97b8c05b01003675cbc");
    expect_hash<GetParameterTypes>("da199c878688b3e530bdfe3ca8f74cb9fa0c303101e980a9e8f260e25e1c80ca");
    expect_hash<DescribeParameters>("845b484d71eb0673dae682f2e3ba3c4851a65a3dcfb97bddd82c5b57e91e4cff");
    expect_hash<ListParameters>("3e6062bfbb27bfb8730d4cef2558221f51a11646d78e7bb30a1e83afac3aad9d");
    expect_hash<SetParameters>("56eed9a67e169f9cb6c1f987bc88f868c14a8fc9f743a263bc734c154015d7e0");
    expect_hash<SetParametersAtomically>("0e192ef259c07fc3c07a13191d27002222e65e00ccec653ca05e856f79285fcd");
}

TEST(PublishedHashes, SimulationMessages) {
    using namespace simulation_interfaces;
    using simulation_interfaces::Result;
    expect_hash<Result>("cf43a306adff3337a0a47143d8f5689933bc70a30478f13b077dc1fe3bc5ad17");
    expect_hash<Resource>("2bb1939cf80f8d2f284afba53cbec60b5ff33759bd39b714128ea8867a34c51a");
    expect_hash<Bounds>("e8624fe51f0f5548197542697d924c5699ac7198f1e4c68e50c3ca2af73f5b3f");
    expect_hash<TagsFilter>("5c3efc51e8ed04c266c09cb4691ec95b964cd410558e01d8c83646b038826b45");
    expect_hash<EntityCategory>("43bdf7933fddf75f6970f7a8fe7078524355d821d390b3954bb46ac36c03dfe1");
    expect_hash<EntityFilters>("8e7b12e8ea062f14c55de4877221fe1b7cd9749665a7ad8a4ab855fc4b148303");
    expect_hash<EntityInfo>("3b9a2e7fa00f9a59d325b6e47904044c421561a385682027c7fc06c359806319");
    expect_hash<EntityState>("2e0464a85eb80a939025075d6c20761eca6a4cb9d6baf2c0ba373467c8b598d0");
    expect_hash<NamedPose>("b32da2a039b1840f605ec025b7991a18efacac662fac272818d1ae6e2b12bc27");
    expect_hash<SimulationState>("bb9f87ccdd98fba113052a512d9801e84ce732d0a2b3c2b0cb281828de36e415");
    expect_hash<SimulatorFeatures>("8b101c8529bc0ea3dcf056078254768f39832b9ef0adaf93bd5cea96c0de3305");
    expect_hash<Spawnable>("8675aa686f0df1ed7874a6ec210fdce1ac1c07f4e49fc26ec7fb6fe729f6772e");
    expect_hash<WorldResource>("e3b65ecf904b9b115673e4a343c6aa3d28c19e185a71228faa64b783afcf2403");
    expect_hash<SpawnResult>("dbc277304b6c24bfb2a631cea8f52e2b005d583ec0a6c86b11613f5ce6486da1");
    expect_hash<SpawnRequest>("94a349a865ccf673c18c080520299c88c3d8d5f4842ecf1482d6c997ac4b69f9");
}

TEST(PublishedHashes, SimulationServices) {
    using namespace simulation_interfaces;
    expect_hash<SpawnEntity>("66860313e11009faddbfc8568e5d410d1a11607fe75eeb1308671dc0406fe3a7");
    expect_hash<SpawnEntities>("41703a359ee032bf4fc230f144f531705ba039a2e97edeae1f7997dd83b04857");
    expect_hash<DeleteEntity>("ff7e96a5b83dc8e2bb34b8b034480028b3a24d9f8376b2c0590bac3704be3e28");
    expect_hash<GetEntities>("cb90004c48cd50f37732fb008e22c34c261dd680a723bf0f85d8437ea4498bf7");
    expect_hash<GetEntitiesStates>("0a76170d0c1c90e1eaf805cfab78ea801d1f82df309a28c1f0fae4b570f19754");
    expect_hash<GetEntityBounds>("17be8d36231178a5eed0de0344b55c19975581627a9aec30a4fee9926a35deed");
    expect_hash<GetEntityInfo>("953b7ab6bfc35063f5c9a72463c6ce489baa10249a7fa510926d342a34b0d29e");
    expect_hash<SetEntityInfo>("867fe2b6812f3e021859171f9b788560d66bb7079d640030baf6c0bb2dd2631e");
    expect_hash<GetEntityState>("749c91f2a2353d98367b64f2995a0f5842ce92a08ec1ffb3e185540a91557fb5");
    expect_hash<SetEntityState>("fba636c91d38832dbd4f6896ffce54ff98fd9929962b0533546b56ce00f988ac");
    expect_hash<GetSpawnables>("3e25fd827d8bcbd9db5e36ccb190efa22d6f6313897861268ab923bf091a992a");
    expect_hash<GetSimulatorFeatures>("abb9439c8cf196722a469fb6c68b44b484f198c2a1356ac38849a29c2a20a794");
    expect_hash<GetSimulationState>("3362dcebee4b1afebbf9c4beee5c79c1455385aded62092a892d61fde8644f30");
    expect_hash<SetSimulationState>("a868b916dce49974f637ba252141258c4b07b0c06858b88af560e3eb6bfbcb30");
    expect_hash<ResetSimulation>("4ce285d7ff9b8ac70dcc95161f32bf54c05a6f4b13427990e41ab40c36c39646");
    expect_hash<StepSimulation>("913fe0653690ce6bf8f09f316e6a626747012e9fca31e26719910d417aa8565c");
    expect_hash<GetNamedPoses>("c3d12ab920115bfd4733f6d20516adc3968fb438538540997c37e200e02b04e3");
    expect_hash<GetNamedPoseBounds>("59fa8dd2c68ba6771160cc66a628ac99fa95e2748fa0a43c2cc62a2e5f3f6fdc");
    expect_hash<GetAvailableWorlds>("ce5589b5523f2732d1969a3c5a7e6b17a387091df8190c62f78d7fdd1109e3e3");
    expect_hash<GetCurrentWorld>("79ed4e910e1b7a1c9f7950ff758bfba3535bf0dec669054e8af115a099724ddd");
    expect_hash<LoadWorld>("87d0ded1bfddb40a74d0bedb963fdd592fbedb14d0057d597850404b73c338af");
    expect_hash<UnloadWorld>("ac7f9a73df1b5b15015d854c5ac552b7726506e22f886c6792804f0b7f88b30b");
    expect_hash<SimulateSteps>("f0837c898e1219cd73bf4c041feab41e8c533e8e1057e982744dba7b093467eb");
    expect_hash<FeedbackMessage<SimulateSteps>>(
        "a30dee7ee7380769e616406ec5067b238aa2b27e1dbd7a5957fba1d908d7754d");
    expect_hash<SendGoal<SimulateSteps>>("504407b9ff5617a737df8222cf581452b4f2e699e11e940d8d36590c5fb07d01");
    expect_hash<GetResult<SimulateSteps>>("a1dae0516ab5c70d6d797e1bcd55c9448dfbb1966643f1ebd3e3f153d8169ae0");
}

TEST(PublishedHashes, SimulationServicesOfVersion1) {
    using namespace simulation_interfaces_v1;
    expect_hash<Spawnable>("8c22025d840e7a05ab31ba56f998b06458b549a9744b4695be25b778829fc176");
    expect_hash<GetSpawnables>("3bc0266bf8236058ff589c44512e013afe4f295427c39d44cff363d1c956bf36");
    expect_hash<SpawnEntity>("d4c086345d4194a5fc4c9ae45095736ca4062b5cdac4d06a42dec93d683e03cf");
    expect_hash<SetEntityState>("ca210e7d2b66629ae133c8e1edf5246e618106d75c78ed0556c0e7a33c59ee5e");
    expect_hash<LoadWorld>("f210682338f195f6f06191b46b20ec4992bddf485d33e2cffab2dd15341b4e3e");
}

TEST(PublishedHashes, Grippers) {
    expect_hash<GripperTarget>("57eb8f326c9889ca8bb34ead82cc94cc09bf6bc5c3b6c09546dca3a00b589890");
    expect_hash<GripperCommand>("e17c0e644eccf14bea84a0a93e0977182872c2eb7873ca6694900059b46dbc84");
    expect_hash<GripperCommand::Goal>("607d9f41eb241e1922e90f02125e87ae6bfb78f7f64a71dc92630263d01f8b6d");
    expect_hash<GripperCommand::Result>("bf512d5aa6a0e4fe4d8be22b2ec4a1973c3d250fa1f65e47450322c25c45c0a0");
    expect_hash<GripperCommand::Feedback>("8f7c520077bab528bb9161ee3b83c81eee1f8aecadb8922ce82c79d667a819c4");
    expect_hash<FeedbackMessage<GripperCommand>>(
        "392ff03fcd872f9dc2405cbeb2897fcf011ad9998458b6aa85c603b8a49e431d");
    expect_hash<SendGoal<GripperCommand>>("6bf8cc4ce80cd499e7dd3258c03c50c3fa6672b469ff8355339ef1df77fcd212");
    expect_hash<GetResult<GripperCommand>>(
        "7e60a7606063d4a2728d21badac099e68b734a196ac3ab42d1d4c668eb0bb3cd");
    expect_hash<ParallelGripperCommand>("adfd3c1ebe8abc38ebcc0e454b6423d291d4010dd5697d14eca5b9be4726ae18");
    expect_hash<ParallelGripperCommand::Goal>(
        "412807b6b6acf2bf406fb0cf3b5c8f84286cd4e4d425734155aa1ff41caa0063");
    expect_hash<ParallelGripperCommand::Result>(
        "51acbcd62aa44097d3877c506eab1146856fa8768628ffbe102c1699152d2afa");
    expect_hash<ParallelGripperCommand::Feedback>(
        "ed6f7c4e5aea7f960432663c0e762e001a0a1f5cc0130d126e60041412d0543c");
    expect_hash<FeedbackMessage<ParallelGripperCommand>>(
        "c61f4cf99d06c5a3e24bed17c2910bdf66a30d89461e2ac7b5fd538a34b022cc");
    expect_hash<SendGoal<ParallelGripperCommand>>(
        "567c37373fed1260adbe047415688c73e4f3e94b2e3982761ecc71fd63d710a7");
    expect_hash<GetResult<ParallelGripperCommand>>(
        "e4c7f0e8a831ce5625ed20abcd13796406d945f92ebc7ad5972e0b0d29b381bd");
}

TEST(PublishedHashes, GazeboMessages) {
    expect_hash<UInt32>("a5c874829b752bc5fa190024b0ad76f578cc278271e855c7d02a818b3516fb4a");
    expect_hash<Altimeter>("c1e452c867a0dd147e2a612d1f78e5da9675ae5ef75c0950ad1520f004101703");
    expect_hash<JointWrench>("aa50610f0bc1a9f1f42a04e6d76da729968d0f91b62f48b2040c4dc866c02686");
    expect_hash<GazeboContact>("ba5acbac280b8650f9ad7caf995888ff8aca861742e0159d8d36efe8460d0db3");
    expect_hash<Contacts>("2cf36dd51e105580839fb7d6c028846a6342a8dfd62fde733d05f3e0c9ec4b5b");
}

TEST(PublishedHashes, GazeboServices) {
    using namespace ros_gz_interfaces;
    expect_hash<GazeboEntity>("266a26f377057ebb0a1f08f7fb9dc435a841d9ec4fa3ab8fa0085e66e653504e");
    expect_hash<EntityFactory>("30d015e26a60c37f44fcfb19b52b27957020705b0ba314e6ca37a5e0d2f6091d");
    expect_hash<WorldReset>("3c89a38589db6e493cc132aa44b69ac7f49c9ffc0770f51883500da1f5b4275e");
    expect_hash<WorldControl>("5ab5d57c81967008a869636e532ec8b8a1afb1a7ddb38a38e92053d032dd2145");
    expect_hash<SpawnEntity>("5723a17a5fd50febee91c2f668058fbcbf3c91b66473196f16190f469e9a4e92");
    expect_hash<DeleteEntity>("81761ca6f55a4234530e8b82da89b57c9400ee8b5a9b747766aec8e921d9d820");
    expect_hash<SetEntityPose>("abe4bc11c7e7955ec1b4ea7f9456b4928b629b12071b911d48745c071483498f");
    expect_hash<ControlWorld>("057cd1cd69ccd13a18dd304595e3cd31d57af3bbb69186c3e21577a6e5d5d282");
}

}  // namespace
}  // namespace roboss::ros2
