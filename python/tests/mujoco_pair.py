"""One MJCF file in RoBOSS and in MuJoCo: places of all bodies, accelerations, and the forces of actuators."""
import warnings

import mujoco
import numpy as np

import roboss

CONSTRAINTS = int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
ACTUATION = int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
FREE, BALL = int(mujoco.mjtJoint.mjJNT_FREE), int(mujoco.mjtJoint.mjJNT_BALL)
WIDTH_Q, WIDTH_V = {FREE: 7, BALL: 4}, {FREE: 6, BALL: 3}


def scaled(mine, theirs):
    """Largest difference, divided by the largest entry where that is above 1."""
    return np.max(np.abs(mine - theirs), initial=0) / max(1.0, np.max(np.abs(theirs), initial=0))


def load(path, **options):
    """roboss.load without its warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", roboss.WorldWarning)
        return roboss.load(path, **options)


def names_of_bodies(model):
    """Names of MuJoCo's bodies, as the importer names those that have none."""
    return [model.body(b).name or f"body_{b}" for b in range(model.nbody)]


class RobotPair:
    """A robot of RoBOSS and its bodies, coordinates and velocities in MuJoCo."""

    def __init__(self, world, name, model):
        self.robot = roboss.RobotModel(world, name, cut_loops=True)
        self.order = roboss.MujocoOrder(self.robot)
        numbers = {body: b for b, body in enumerate(names_of_bodies(model))}
        root = numbers.get(name, 0)
        # Links of copies (<replicate>, <attach>) have the names of the original.
        prefix, _, suffix = name.partition(self.robot.links[0])
        own = {link: numbers.get(prefix + link + suffix, numbers.get(link)) for link in self.robot.links}
        for k in range(model.nbody - root):  # bodies without names, in copies
            if own.get(f"body_{k}", 0) is None:
                own[f"body_{k}"] = root + k
        self.bodies = [(link, b) for link, b in own.items() if b]
        roots = {int(model.body_rootid[b]) for _, b in self.bodies}  # of trees that equalities tie, several
        self.q, self.v, self.joints = [], [], []
        for j in range(model.njnt):
            if int(model.body_rootid[model.jnt_bodyid[j]]) not in roots:
                continue
            kind, q, v = int(model.jnt_type[j]), int(model.jnt_qposadr[j]), int(model.jnt_dofadr[j])
            self.q += range(q, q + WIDTH_Q.get(kind, 1))
            self.v += range(v, v + WIDTH_V.get(kind, 1))
            self.joints.append(j)

    def compare(self, data, forces):
        """{what: largest difference} in the state of `data`, whose mj_forward has run."""
        qpos, qvel, qacc = data.qpos[self.q], data.qvel[self.v], data.qacc[self.v]
        q, v = self.order.q(qpos), self.order.v(qpos, qvel)
        f = self.order.v(qpos, forces[self.v]) + self.robot.passive_forces(q, v)
        found = {"acceleration": scaled(self.order.qvel(q, self.robot.forward_dynamics(q, v, f)), qacc)}
        poses = self.robot.link_poses(q)
        for link, body in self.bodies:
            mine = poses[self.robot.links.index(link)]
            theirs = data.xquat[body][[1, 2, 3, 0]]
            sign = 1 if mine[3:] @ theirs >= 0 else -1
            off = max(np.abs(mine[:3] - data.xpos[body]).max(), np.abs(sign * mine[3:] - theirs).max())
            found["pose"] = max(found.get("pose", 0.0), off)
        found["round trip"] = max(scaled(self.order.qpos(q), _same_sign(qpos, self.order.qpos(q))),
                                  scaled(self.order.qvel(q, v), qvel))
        return found


def _same_sign(qpos, other):
    """qpos, its quaternions with the sign of the other's: q and -q are the same rotation."""
    return np.where(np.abs(qpos + other) < 1e-12, other, qpos)


class MujocoPair:
    """Both sides of a file."""

    def __init__(self, path):
        self.path = str(path)
        self.model = mujoco.MjModel.from_xml_path(self.path)
        self.data = mujoco.MjData(self.model)
        self.world = load(self.path)
        names = names_of_bodies(self.model)
        moving = {names[self.model.body_rootid[self.model.jnt_bodyid[j]]] for j in range(self.model.njnt)}
        self.robots = [RobotPair(self.world, name, self.model) for name in self.world.robots if name in moving]

    def random_state(self, random):
        """Sets qpos within the limits, or a turn or metre around 0, and qvel."""
        m, d = self.model, self.data
        d.qvel[:] = random.normal(size=m.nv)
        for j in range(m.njnt):
            at, kind = int(m.jnt_qposadr[j]), int(m.jnt_type[j])
            if kind in WIDTH_Q:
                quaternion = random.normal(size=4)
                d.qpos[at + WIDTH_Q[kind] - 4:at + WIDTH_Q[kind]] = quaternion / np.linalg.norm(quaternion)
            if kind == FREE:
                d.qpos[at:at + 3] = random.uniform(-1, 1, 3)
            if kind not in WIDTH_Q:
                low, high = np.clip(m.jnt_range[j], -3, 3) if m.jnt_limited[j] else (-1.5, 1.5)
                d.qpos[at] = random.uniform(low, high)

    def compare(self, rows=10, seed=1):
        """{what: largest difference} over random states and forces, without constraints and actuators."""
        random = np.random.default_rng(seed)
        flags = self.model.opt.disableflags
        self.model.opt.disableflags = flags | CONSTRAINTS | ACTUATION
        worst = {}
        for _ in range(rows):
            self.random_state(random)
            self.data.qfrc_applied[:] = random.normal(size=self.model.nv)
            mujoco.mj_forward(self.model, self.data)
            for robot in self.robots:
                for what, difference in robot.compare(self.data, self.data.qfrc_applied).items():
                    worst[what] = max(worst.get(what, 0.0), difference)
        self.model.opt.disableflags = flags
        self.data.qfrc_applied[:] = 0
        return worst

    @property
    def columns(self):
        """How many degrees of freedom are compared, and how many MuJoCo has."""
        return sum(len(robot.v) for robot in self.robots), self.model.nv

    def step_with_actuators(self, robot, seed=1, dt=1e-6):
        """Accelerations (mine, theirs) of a robot whose actuators all act: those of one tick of `dt`, and of mj_forward.

        Motors take efforts, servos targets. Forces beyond their bounds are part of it.
        """
        random = np.random.default_rng(seed)
        m, d = self.model, self.data
        self.random_state(random)
        flags = m.opt.disableflags
        m.opt.disableflags = flags | CONSTRAINTS | int(mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL)
        text = f'<mujoco><include file="{self.path}"/><option><flag constraint="disable"/></option></mujoco>'
        sim = roboss.Simulation(load(text, dt=dt), threads=1)
        robots = sim.robots([robot.robot.name])
        robots.qpos, robots.qvel = d.qpos[robot.q], d.qvel[robot.v]
        for i in range(m.nu):
            if int(m.actuator_trntype[i]) != int(mujoco.mjtTrn.mjTRN_JOINT):
                continue
            joint, gear = m.joint(int(m.actuator_trnid[i, 0])), float(m.actuator_gear[i, 0])
            gain, bias = float(m.actuator_gainprm[i, 0]), m.actuator_biasprm[i]
            if joint.id not in robot.joints:
                continue
            if bias[1] != 0:  # a position servo: its target in the joint's own unit
                target = float(d.qpos[m.jnt_qposadr[joint.id]]) + random.uniform(-0.5, 0.5)
                d.ctrl[i] = target * gear * -bias[1] / gain
                robots.set_joint_targets(target, joint.name, mode="position")
            elif bias[2] != 0:
                target = random.uniform(-1, 1)
                d.ctrl[i] = target * gear * -bias[2] / gain
                robots.set_joint_targets(target, joint.name, mode="velocity")
            else:
                effort = random.uniform(-1, 1) * min(10.0, robots.joint_effort_limits[robots.joints.index(joint.name)])
                d.ctrl[i] = effort / gear / gain
                robots.set_joint_targets(effort, joint.name, mode="effort")
        mujoco.mj_forward(m, d)
        before = robots.qvel[0]
        sim.step(1)
        m.opt.disableflags = flags
        return (robots.qvel[0] - before) / dt, d.qacc[robot.v].copy()
