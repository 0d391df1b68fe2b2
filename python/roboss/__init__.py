"""RoBOSS: deterministic physics of many robots in one world, as numpy arrays.

    >>> import roboss
    >>> world = roboss.load(roboss.example("crossroads.sdf"))
    >>> sim = roboss.Simulation(world, threads=2)
    >>> cars = sim.robots("car_*")
    >>> cars.set_joint_targets(10.0)        # rad/s, all joints of all cars
    >>> sim.step(500)
    >>> cars.pose.shape                     # x y z, quaternion x y z w
    (16, 7)
    >>> sim.time
    1.0

SI units and radians everywhere; positions and velocities in the world frame and its axes. Robots are the first axis of
all arrays. The result is the same to the last bit for any number of threads, and the same as that of `roboss run`.
"""
from . import pickling as pickling
from . import randomize as randomize
from . import terrain as terrain
from ._core import Diagnostic, Save
from .batch import Batch
from .camera import Camera, RobotCameras
from .builder import ModelBuilder, WorldBuilder
from .errors import (ArgumentError, ClusterError, JournalError, OrderError, RobossError, SaveError, SensorError,
                     StateError, UnknownNameError, ViewError, WorldError, WorldWarning)
from .journal import Journal
from .kinematics import Follower, IKSolution, RobotModel
from .mujoco_order import MujocoOrder
from .padded import PaddedRobots
from .parameters import JointParameters, LinkParameters, Surroundings
from .radio import Message, Radio
from .remote import RemoteSimulation, connect
from .robots import Robots
from .sensor_description import Parameter, SensorDescription, ValueDescription
from .sensors import Sensor
from .specs import ActionSpec, Columns, ObservationSpec
from .run import CONTACT
from .simulation import Simulation
from .trajectories import CartesianTrajectory, JointTrajectory, ctraj, jtraj
from .view import View
from .world import World, example, load

__version__ = "0.2.0"
__all__ = [
    "ActionSpec", "ArgumentError", "Batch", "CONTACT", "Camera", "CartesianTrajectory", "ClusterError", "Columns",
    "Diagnostic", "Follower", "IKSolution", "JointParameters", "JointTrajectory", "Journal", "JournalError",
    "LinkParameters", "Message", "ModelBuilder", "MujocoOrder", "ObservationSpec", "OrderError", "PaddedRobots",
    "Parameter", "Radio", "RemoteSimulation", "RobossError", "RobotCameras", "RobotModel", "Robots", "Save",
    "SaveError", "Sensor", "SensorDescription", "SensorError", "Simulation", "StateError", "Surroundings",
    "UnknownNameError", "ValueDescription", "View", "ViewError", "World", "WorldBuilder", "WorldError", "WorldWarning",
    "connect", "ctraj", "example", "jtraj", "load",
]
