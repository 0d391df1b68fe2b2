"""The city and its cars in MuJoCo: MJCF made from the same SDF file, behind the calls that roboss.envs.CityTask uses.

So the task, its observations and its Python are the same for both engines; only what steps and measures differs. Stated
where engines differ:

- Motors are MuJoCo's velocity actuators with the same torque limit; kv = 2 N m s/rad and the integrator "implicitfast"
  make them hold their speeds (with the Euler integrator more than kv = 0.375 is unstable).
- These cars turn by dragging their wheels sideways. With Coulomb friction alone they turn on the spot at 2.18 rad/s where
  the wheels' rims move at 0.66 m/s: the moments of friction about the middle balance there,
  0.13 m (0.66 m/s - 0.13 m w) = (0.15 m)^2 w, for wheels at (0.15 m, 0.13 m). RoBOSS's cars do 1.99 rad/s (wheels are
  4 cm wide), MuJoCo's with its default contacts 0.2 to 0.6: its convex contacts push a wheel that slides upwards, so the
  car hops from wheel to wheel. Softer contacts (solref 0.1 s) keep the wheels on the ground; TURN_GAIN makes up for what
  is still missing, so that the same actions turn the cars alike: 0.3, 1.3 and 2.0 rad/s where RoBOSS's do 0.6, 1.2, 2.0.
- Contacts, solver and tolerances are otherwise MuJoCo's defaults (pyramidal cones are the fastest). The laser has no
  noise (mj_multiRay from the same place).
"""
import re
from concurrent.futures import ThreadPoolExecutor

import mujoco
import numpy as np

from roboss.envs import CityTask
from roboss.envs.city_view import BEAMS, RANGE_M

SOLID = re.compile(r"<collision name=\"part_\d+\"><pose>([^<]*)</pose><geometry>(.*?)</geometry>")
WHEELS = (("front_left", 0.15, 0.13), ("front_right", 0.15, -0.13), ("rear_left", -0.15, 0.13), ("rear_right", -0.15, -0.13))
TURN_GAIN = 2.0
HEAD = """<mujoco><compiler angle="radian" eulerseq="XYZ"/>
<option timestep="{dt}" gravity="0 0 -9.8" integrator="implicitfast"/><size memory="{memory}"/><worldbody>
<geom name="ground" type="plane" size="0 0 1" friction="0.9" solref="0.1 1"/>
"""
CHASSIS = """<body name="{name}" pos="{x} {y} 0.08"><freejoint/>
<inertial pos="0 0 0" mass="5" diaginertia="0.0208333 0.0708333 0.0833333"/>
<geom type="box" size="0.2 0.1 0.05" friction="0.4"/>
"""
WHEEL = """<body pos="{x} {y} -0.03"><joint name="{name}_{wheel}" axis="0 1 0"/>
<inertial pos="0 0 0" mass="0.3" diaginertia="0.0002275 0.000375 0.0002275"/>
<geom type="cylinder" size="0.05 0.02" euler="1.5707963 0 0" friction="0.9" solref="0.1 1"/></body>
"""
MOTOR = '<velocity joint="{name}_{wheel}" kv="2" ctrlrange="-40 40" forcerange="-0.8 0.8"/>\n'


def mjcf_of(sdf, names, waiting, dt):
    """MJCF of the city of an SDF text, with cars of these names at the poses where they wait."""
    text = [HEAD.format(dt=dt, memory=f"{64 + 8 * len(names)}M")]
    for pose, shape in SOLID.findall(sdf):
        x, y, z, _, _, yaw = map(float, pose.split())
        numbers = [float(number) for number in re.findall(r"[\d.]+(?=[ <])", shape)]
        size = numbers if "<box>" in shape else [numbers[0], numbers[1]]
        half = [size[0], size[1] / 2] if "<cylinder>" in shape else [side / 2 for side in size]
        kind = "cylinder" if "<cylinder>" in shape else "box"
        text.append(f'<geom type="{kind}" pos="{x} {y} {z}" euler="0 0 {yaw}" size="{" ".join(map(str, half))}"/>\n')
    for name, (x, y) in zip(names, waiting[:, :2]):
        text.append(CHASSIS.format(name=name, x=x, y=y))
        text += [WHEEL.format(name=name, wheel=wheel, x=wx, y=wy) for wheel, wx, wy in WHEELS]
        text.append("</body>\n")
    text.append("</worldbody><actuator>\n")
    text += [MOTOR.format(name=name, wheel=wheel) for name in names for wheel, _, _ in WHEELS]
    return "".join(text) + "</actuator></mujoco>"


class Cars:
    """Some cars of some worlds, as roboss.Robots; the joints of all cars are front left, front right, rear left, rear right."""

    joint_velocity_limits = np.full(4, 40.0)

    def __init__(self, model, worlds, rows, is_batch):
        self.model, self.worlds, self.rows, self.is_batch = model, worlds, np.asarray(rows), is_batch
        self.cars = model.nq // 11
        angles = np.linspace(-0.5 * np.pi, 0.5 * np.pi, BEAMS)
        self.beams = np.stack([np.cos(angles), np.sin(angles), np.zeros(BEAMS)], axis=1)

    def __len__(self):
        return len(self.rows)

    def __getitem__(self, key):
        if isinstance(key, str):
            return self  # the laser
        return Cars(self.model, self.worlds, self.rows[key], self.is_batch)

    def _shaped(self, rows):
        array = np.stack(rows)
        return array if self.is_batch else array[0]

    def _each(self, values, columns):
        """The part of each world of an array, one row or one number for all cars."""
        full = np.broadcast_to(values, (len(self.worlds), len(self.rows), columns))
        return zip(self.worlds, full)

    @property
    def pose(self):
        """As Robots.pose: x y z, quaternion x y z w, of the model frame (the chassis is 0.08 m above it when upright)."""
        found = []
        for data in self.worlds:
            q = data.qpos.reshape(self.cars, 11)[self.rows]
            found.append(np.concatenate([q[:, :2], q[:, 2:3] - 0.08, q[:, 4:7], q[:, 3:4]], axis=1))
        return self._shaped(found)

    @pose.setter
    def pose(self, values):
        for data, part in self._each(values, 7):
            q = data.qpos.reshape(self.cars, 11)
            q[self.rows, :3] = part[:, :3] + [0, 0, 0.08]
            q[self.rows, 3:7] = part[:, [6, 3, 4, 5]]

    @property
    def twist(self):
        """As Robots.twist, but for the angular velocity in the frame of the chassis: of an upright car the same yaw rate."""
        return self._shaped([data.qvel.reshape(self.cars, 10)[self.rows, :6] for data in self.worlds])

    @twist.setter
    def twist(self, values):
        for data, part in self._each(values, 6):
            data.qvel.reshape(self.cars, 10)[self.rows, :6] = part

    def _set_joints(self, array, values):
        for data, part in self._each(values, 4):
            getattr(data, array).reshape(self.cars, -1)[self.rows, -4:] = part

    joint_position = property(fset=lambda self, values: self._set_joints("qpos", values))
    joint_velocity = property(fset=lambda self, values: self._set_joints("qvel", values))

    def set_joint_targets(self, targets, joints):
        """Targets of the wheels, in the order of `joints`; both sides differ by TURN_GAIN more (see the top)."""
        order = [joints.index(wheel) for wheel, _, _ in WHEELS]
        for data, part in self._each(targets, 4):
            mean = part.mean(axis=1, keepdims=True)
            data.ctrl.reshape(self.cars, 4)[self.rows] = (mean + TURN_GAIN * (part - mean))[:, order].clip(-40, 40)

    @property
    def touching(self):
        """As Robots.touching: contacts with other geoms than the ground (geom 0)."""
        found = []
        for data in self.worlds:
            pairs = data.contact.geom
            bodies = self.model.geom_bodyid[pairs[(pairs != 0).all(axis=1)]]
            touched = np.zeros(self.cars, dtype=bool)
            touched[(bodies[bodies > 0] - 1) // 5] = True
            found.append(touched[self.rows])
        return self._shaped(found)

    def read(self):
        """Ranges of the lasers, (cars, beams), m; inf: nothing within reach."""
        return self._shaped([self._scan(data) for data in self.worlds])

    def _scan(self, data):
        mujoco.mj_kinematics(self.model, data)
        ranges, hit = np.empty((len(self.rows), BEAMS)), np.empty(BEAMS, dtype=np.int32)
        for scan, car in zip(ranges, self.rows):
            body = 1 + 5 * car
            turn = data.xmat[body].reshape(3, 3)
            start = data.xpos[body] + turn @ [0.205, 0, 0.02]
            mujoco.mj_multiRay(self.model, data, start, (self.beams @ turn.T).ravel(), None, True, body, hit, scan, None,
                               BEAMS, RANGE_M)
        return np.where(ranges < 0, np.inf, ranges)


class DepthCameras:
    """As roboss.RobotCameras, for depths: rays from the same places, as MuJoCo's renderer needs OpenGL.

    Args:
        cars: all cars of all worlds.
        rays: directions in the frame of the car, (rows, columns, 3).
    """

    def __init__(self, cars, position, rays, far):
        self.cars, self.position, self.far = cars, np.asarray(position) - [0, 0, 0.08], far  # from the chassis
        self.shape, self.rays = rays.shape[:2], rays.reshape(-1, 3)

    def depth(self):
        """Distances, m, (cars, rows, columns) or with an axis of worlds in front; inf: nothing within reach."""
        return self.cars._shaped([self._look(data) for data in self.cars.worlds])

    def _look(self, data):
        model, count = self.cars.model, len(self.rays)
        mujoco.mj_kinematics(model, data)
        depths, hit = np.empty((len(self.cars), count)), np.empty(count, dtype=np.int32)
        for depth, car in zip(depths, self.cars.rows):
            body = 1 + 5 * car
            turn = data.xmat[body].reshape(3, 3)
            mujoco.mj_multiRay(model, data, data.xpos[body] + turn @ self.position, (self.rays @ turn.T).ravel(), None, True,
                               body, hit, depth, None, count, self.far)
        return np.where(depths < 0, np.inf, depths).reshape(-1, *self.shape)


class Worlds:
    """MjData of all worlds, stepped as roboss.Simulation or roboss.Batch are."""

    def __init__(self, model, world, worlds, threads):
        self.model, self.world = model, world
        self.worlds = [mujoco.MjData(model) for _ in range(worlds)]
        self.pool = ThreadPoolExecutor(threads) if threads > 1 and worlds > 1 else None
        if threads > 1 and worlds == 1:
            mujoco.mju_threadpool(self.worlds[0], threads)

    def step(self, ticks=1):
        """Advances all worlds. The GIL is released inside."""
        if self.pool:
            list(self.pool.map(lambda data: mujoco.mj_step(self.model, data, ticks), self.worlds))
        else:
            for data in self.worlds:
                mujoco.mj_step(self.model, data, ticks)
        return np.zeros(len(self.worlds), dtype=bool)

    def reset(self, seed=None):
        """Back to the start."""
        for data in self.worlds:
            mujoco.mj_resetData(self.model, data)


class MujocoCityTask(CityTask):
    """The task of the city, in MuJoCo.

    Args:
        sdf: path of the city.
        cars, worlds, threads: as of CityTask.
    """

    def __init__(self, sdf, cars, worlds=1, threads=1):
        super().__init__(cars, worlds=worlds, world=sdf, threads=1)
        with open(sdf, encoding="utf-8") as file:
            text = mjcf_of(file.read(), self.names, self._outside, self.simulation.world.dt)
        model = mujoco.MjModel.from_xml_string(text)
        self.simulation = Worlds(model, self.simulation.world, worlds, threads)
        self.simulations = [self.simulation] if worlds == 1 else [_One(model, data) for data in self.simulation.worlds]
        self.robots = Cars(model, self.simulation.worlds, np.arange(cars), worlds > 1)
        self._robots_of = [Cars(model, [data], np.arange(cars), False) for data in self.simulation.worlds]


class _One:
    """One of several worlds."""

    def __init__(self, model, data):
        self.model, self.data = model, data

    def reset(self, seed=None):
        """Back to the start."""
        mujoco.mj_resetData(self.model, self.data)
