"""Types of ROS 2 for Cyclone DDS, from the lines below, which are those of the public definitions without constants.

A line is a message: its name, then its fields. A service has its request before "---" and its reply after it; an action has
its goal, result and feedback. simulation_interfaces is of version 1.6.1, control_msgs of Jazzy.
"""
import re
from dataclasses import make_dataclass

from cyclonedds.idl import IdlStruct, types

DEFINITIONS = """
builtin_interfaces/Time: int32 sec, uint32 nanosec
builtin_interfaces/Duration: int32 sec, uint32 nanosec
std_msgs/Header: builtin_interfaces/Time stamp, string frame_id
std_msgs/String: string data
rosgraph_msgs/Clock: builtin_interfaces/Time clock
geometry_msgs/Vector3: float64 x, float64 y, float64 z
geometry_msgs/Point: float64 x, float64 y, float64 z
geometry_msgs/Quaternion: float64 x, float64 y, float64 z, float64 w
geometry_msgs/Pose: geometry_msgs/Point position, geometry_msgs/Quaternion orientation
geometry_msgs/PoseStamped: std_msgs/Header header, geometry_msgs/Pose pose
geometry_msgs/PoseWithCovariance: geometry_msgs/Pose pose, float64[36] covariance
geometry_msgs/Twist: geometry_msgs/Vector3 linear, geometry_msgs/Vector3 angular
geometry_msgs/TwistWithCovariance: geometry_msgs/Twist twist, float64[36] covariance
geometry_msgs/Accel: geometry_msgs/Vector3 linear, geometry_msgs/Vector3 angular
geometry_msgs/Transform: geometry_msgs/Vector3 translation, geometry_msgs/Quaternion rotation
geometry_msgs/TransformStamped: std_msgs/Header header, string child_frame_id, geometry_msgs/Transform transform
tf2_msgs/TFMessage: geometry_msgs/TransformStamped[] transforms
nav_msgs/Odometry: std_msgs/Header header, string child_frame_id, geometry_msgs/PoseWithCovariance pose,
  geometry_msgs/TwistWithCovariance twist
sensor_msgs/LaserScan: std_msgs/Header header, float32 angle_min, float32 angle_max, float32 angle_increment,
  float32 time_increment, float32 scan_time, float32 range_min, float32 range_max, float32[] ranges, float32[] intensities
sensor_msgs/JointState: std_msgs/Header header, string[] name, float64[] position, float64[] velocity, float64[] effort

unique_identifier_msgs/UUID: uint8[16] uuid
action_msgs/GoalInfo: unique_identifier_msgs/UUID goal_id, builtin_interfaces/Time stamp
action_msgs/GoalStatus: action_msgs/GoalInfo goal_info, int8 status
action_msgs/GoalStatusArray: action_msgs/GoalStatus[] status_list
action_msgs/CancelGoal: action_msgs/GoalInfo goal_info --- int8 return_code, action_msgs/GoalInfo[] goals_canceling

trajectory_msgs/JointTrajectoryPoint: float64[] positions, float64[] velocities, float64[] accelerations, float64[] effort,
  builtin_interfaces/Duration time_from_start
trajectory_msgs/JointTrajectory: std_msgs/Header header, string[] joint_names, trajectory_msgs/JointTrajectoryPoint[] points
trajectory_msgs/MultiDOFJointTrajectoryPoint: geometry_msgs/Transform[] transforms, geometry_msgs/Twist[] velocities,
  geometry_msgs/Twist[] accelerations, builtin_interfaces/Duration time_from_start
trajectory_msgs/MultiDOFJointTrajectory: std_msgs/Header header, string[] joint_names,
  trajectory_msgs/MultiDOFJointTrajectoryPoint[] points
control_msgs/JointTolerance: string name, float64 position, float64 velocity, float64 acceleration
control_msgs/JointComponentTolerance: string joint_name, uint16 component, float64 position, float64 velocity,
  float64 acceleration
control_msgs/FollowJointTrajectory: trajectory_msgs/JointTrajectory trajectory,
  trajectory_msgs/MultiDOFJointTrajectory multi_dof_trajectory, control_msgs/JointTolerance[] path_tolerance,
  control_msgs/JointComponentTolerance[] component_path_tolerance, control_msgs/JointTolerance[] goal_tolerance,
  control_msgs/JointComponentTolerance[] component_goal_tolerance, builtin_interfaces/Duration goal_time_tolerance
  --- int32 error_code, string error_string
  --- std_msgs/Header header, string[] joint_names, trajectory_msgs/JointTrajectoryPoint desired,
  trajectory_msgs/JointTrajectoryPoint actual, trajectory_msgs/JointTrajectoryPoint error, string[] multi_dof_joint_names,
  trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_desired,
  trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_actual, trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_error

simulation_interfaces/Result: uint8 result, string error_message
simulation_interfaces/Bounds: uint8 type, geometry_msgs/Vector3[] points
simulation_interfaces/EntityCategory: uint8 category
simulation_interfaces/TagsFilter: string[] tags, uint8 filter_mode
simulation_interfaces/EntityFilters: string filter, simulation_interfaces/EntityCategory[] categories,
  simulation_interfaces/TagsFilter tags, simulation_interfaces/Bounds bounds
simulation_interfaces/EntityInfo: simulation_interfaces/EntityCategory category, string description, string[] tags
simulation_interfaces/EntityState: std_msgs/Header header, geometry_msgs/Pose pose, geometry_msgs/Twist twist,
  geometry_msgs/Accel acceleration
simulation_interfaces/NamedPose: string name, string description, string[] tags, geometry_msgs/Pose pose
simulation_interfaces/Resource: string uri, string resource_string
simulation_interfaces/SimulationState: uint8 state
simulation_interfaces/SimulatorFeatures: uint16[] features, string[] spawn_formats, string custom_info
simulation_interfaces/SpawnRequest: string name, bool allow_renaming, simulation_interfaces/Resource entity_resource,
  string entity_namespace, geometry_msgs/PoseStamped initial_pose
simulation_interfaces/SpawnResult: simulation_interfaces/Result result, string entity_name
simulation_interfaces/Spawnable: string uri, string description, simulation_interfaces/Bounds spawn_bounds
simulation_interfaces/WorldResource: string name, simulation_interfaces/Resource world_resource, string description,
  string[] tags
simulation_interfaces/DeleteEntity: string entity --- simulation_interfaces/Result result
simulation_interfaces/GetAvailableWorlds: string[] additional_sources, simulation_interfaces/TagsFilter filter,
  bool offline_only, bool continue_on_error
  --- simulation_interfaces/Result result, simulation_interfaces/WorldResource[] worlds
simulation_interfaces/GetCurrentWorld: --- simulation_interfaces/Result result, simulation_interfaces/WorldResource world
simulation_interfaces/GetEntities: simulation_interfaces/EntityFilters filters
  --- simulation_interfaces/Result result, string[] entities
simulation_interfaces/GetEntitiesStates: simulation_interfaces/EntityFilters filters
  --- simulation_interfaces/Result result, string[] entities, simulation_interfaces/EntityState[] states
simulation_interfaces/GetEntityBounds: string entity --- simulation_interfaces/Result result, simulation_interfaces/Bounds bounds
simulation_interfaces/GetEntityInfo: string entity --- simulation_interfaces/Result result, simulation_interfaces/EntityInfo info
simulation_interfaces/GetEntityState: string entity
  --- simulation_interfaces/Result result, simulation_interfaces/EntityState state
simulation_interfaces/GetNamedPoseBounds: string name --- simulation_interfaces/Result result, simulation_interfaces/Bounds bounds
simulation_interfaces/GetNamedPoses: simulation_interfaces/TagsFilter tags
  --- simulation_interfaces/Result result, simulation_interfaces/NamedPose[] poses
simulation_interfaces/GetSimulationState: --- simulation_interfaces/SimulationState state, simulation_interfaces/Result result
simulation_interfaces/GetSimulatorFeatures: --- simulation_interfaces/SimulatorFeatures features
simulation_interfaces/GetSpawnables: string[] sources
  --- simulation_interfaces/Result result, simulation_interfaces/Spawnable[] spawnables
simulation_interfaces/LoadWorld: string uri, string resource_string, bool fail_on_unsupported_element,
  bool ignore_missing_or_unsupported_assets --- simulation_interfaces/Result result, simulation_interfaces/WorldResource world
simulation_interfaces/ResetSimulation: uint8 scope --- simulation_interfaces/Result result
simulation_interfaces/SetEntityInfo: string entity, simulation_interfaces/EntityInfo info --- simulation_interfaces/Result result
simulation_interfaces/SetEntityState: string entity, simulation_interfaces/EntityState state
  --- simulation_interfaces/Result result
simulation_interfaces/SetSimulationState: simulation_interfaces/SimulationState state --- simulation_interfaces/Result result
simulation_interfaces/SpawnEntity: string name, bool allow_renaming, string uri, string resource_string,
  string entity_namespace, geometry_msgs/PoseStamped initial_pose
  --- simulation_interfaces/Result result, string entity_name
simulation_interfaces/SpawnEntities: simulation_interfaces/SpawnRequest[] spawn_requests
  --- simulation_interfaces/Result result, simulation_interfaces/SpawnResult[] results
simulation_interfaces/StepSimulation: uint64 steps --- simulation_interfaces/Result result
simulation_interfaces/UnloadWorld: --- simulation_interfaces/Result result
simulation_interfaces/SimulateSteps: uint64 steps --- simulation_interfaces/Result result
  --- uint64 completed_steps, uint64 remaining_steps

ros_gz_interfaces/Entity: uint64 id, string name, uint8 type
ros_gz_interfaces/EntityFactory: string name, bool allow_renaming, string sdf, string sdf_filename, string clone_name,
  geometry_msgs/Pose pose, string relative_to
ros_gz_interfaces/WorldReset: bool all, bool time_only, bool model_only
ros_gz_interfaces/WorldControl: bool pause, bool step, uint32 multi_step, ros_gz_interfaces/WorldReset reset, uint32 seed,
  builtin_interfaces/Time run_to_sim_time
ros_gz_interfaces/SpawnEntity: ros_gz_interfaces/EntityFactory entity_factory --- bool success
ros_gz_interfaces/DeleteEntity: ros_gz_interfaces/Entity entity --- bool success
ros_gz_interfaces/SetEntityPose: ros_gz_interfaces/Entity entity, geometry_msgs/Pose pose --- bool success
ros_gz_interfaces/ControlWorld: ros_gz_interfaces/WorldControl world_control --- bool success
"""
PRIMITIVES = {name: getattr(types, name) for name in ("int8", "uint8", "int32", "uint16", "uint32", "int64", "uint64", "float32",
                                                      "float64")} | {"bool": bool, "string": str}
EMPTY = [("structure_needs_at_least_one_member", types.uint8)]
LINES = dict(line.split(":", 1) for line in DEFINITIONS.replace("\n  ", " ").split("\n") if line)
made = {}


def type_of(words):
    """The type of a field: "string", "float64[36]", "geometry_msgs/Point[]"."""
    name, _, count = words.partition("[")
    one = PRIMITIVES.get(name) or message(name)
    if not count:
        return one
    return types.array[one, int(count[:-1])] if count != "]" else types.sequence[one]


def fields_of(text):
    pairs = (field.split() for field in text.split(",") if field.strip())
    return [(name, type_of(kind)) for kind, name in pairs] or EMPTY


def struct(name, fields):
    """A type of DDS by the name of an interface: "nav_msgs/msg/Odometry"."""
    package, kind, last = name.split("/")
    if name not in made:
        made[name] = make_dataclass(last, fields, bases=(IdlStruct,), eq=False, namespace={
            "__idl_typename__": f"{package}::{kind}::dds_::{last}_"})
    return made[name]


def message(name):
    """The message of this name, which has no "msg" in it: "nav_msgs/Odometry"."""
    package, last = name.split("/")
    return struct(f"{package}/msg/{last}", fields_of(LINES[name]))


def parts(name):
    """The fields of the parts of a service or an action."""
    return [fields_of(part) for part in LINES[name].split("---")]


def value(kind, **given):
    """A message whose fields are 0, false or empty but for those that are given."""
    def empty(field):
        if isinstance(field, type) and issubclass(field, IdlStruct):
            return value(field)
        if field in (str, bool):
            return field()
        size = re.search(r"array\[.*, (\d+)\]", str(field))
        return [0] * int(size[1]) if size else [] if "sequence" in str(field) else 0
    unknown = set(given) - set(kind.__dataclass_fields__)
    assert not unknown, f"{kind.__name__} has no {unknown}"
    return kind(**{name: given[name] if name in given else empty(field.type) for name, field in kind.__dataclass_fields__.items()})
