#!/usr/bin/env python3
"""Plans a program for an arm that somebody else made: which poses it reaches, how long a cycle takes, what it asks of
the joints; with --simulate, the arm performs it.

    arm_program.py ARM.urdf pick_and_place.txt --link tool0

A program has a command on each line; # begins a comment. Metres and degrees, in the frame of the base; the z axis of
the tool looks down.

    move X Y Z [YAW]    all joints at once, on the way that is shortest for them
    line X Y Z [YAW]    the tool on a straight line
    speed SHARE         of the joints' largest velocities, from now on; 1 at the start
    wait S

The cycle begins where the first move ends. Of several configurations there, that with the most poses is taken; of
these, those whose joints stay above the foot of the arm, and then the one with the shortest cycle. Collisions are not
planned for: --simulate shows them, the tool is then off its plan.

Exit codes: 0 all poses are reached, 1 some are not, 2 wrong usage or a file that cannot be used.
"""
import argparse
import json
import sys
import warnings
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from imports import needed  # noqa: E402

with needed():
    import numpy as np

    import roboss

KNOTS = 40          # of a line, for inverse kinematics
SAMPLES = 200       # of a motion, for velocities and torques
JUMP = 0.5          # rad between two knots: another configuration, not a motion
STARTS = 20         # configurations at the first pose that are tried


class ProgramError(Exception):
    """The program cannot be understood; the text has line and remedy."""


@dataclass(frozen=True)
class Command:
    """A line of a program: number in the file, "move", "line", "speed" or "wait", and its numbers."""

    number: int
    name: str
    values: tuple


@dataclass
class Step:
    """What became of a move, line or wait. `q`: (T, joints) at equal times, rad or m; none where it is out of reach."""

    number: int
    text: str
    reached: bool = True
    time_s: float = 0.0
    error_m: float = 0.0            # of the best configuration, where it is out of reach
    torque_share: float = 0.0       # of the joints' largest, the worst one
    worst_joint: str = ""
    below_m: float = 0.0            # how far the origin of a link goes below the foot of the arm
    q: np.ndarray = field(default=None, repr=False)
    target: np.ndarray = field(default=None, repr=False)    # world pose (7,), where it is out of reach


def read_program(text):
    """Commands of a program.

    Raises:
        ProgramError: a command that does not exist, or has the wrong numbers.
    """
    counts = {"move": (3, 4), "line": (3, 4), "speed": (1, 1), "wait": (1, 1)}
    commands = []
    for number, line in enumerate(text.splitlines(), 1):
        name, *words = line.split("#")[0].split() or [""]
        if not name:
            continue
        if name not in counts:
            raise ProgramError(f"line {number}: there is no command '{name}'\n  remedy: write {', '.join(counts)}")
        try:
            values = tuple(float(word) for word in words)
        except ValueError:
            values = ()
        low, high = counts[name]
        least = 1e-3 if name == "speed" else 0.0
        if not low <= len(values) <= high or not np.all(np.isfinite(values)) \
                or (name in ("speed", "wait") and not least <= values[0] <= (1 if name == "speed" else 1e6)):
            raise ProgramError(f"line {number}: '{line.strip()}' has the wrong numbers\n  remedy: write X Y Z [YAW] in m and "
                               "degrees for move and line, a share of 0.001 to 1 for speed, seconds for wait")
        commands.append(Command(number, name, values))
    if not any(command.name == "move" for command in commands):
        raise ProgramError("the program has no move\n  remedy: begin with move X Y Z, where the cycle begins")
    return commands


class Planner:
    """Motions of one arm. `ramp_s`: in which a joint reaches its largest velocity: data sheets have it, a URDF does not."""

    def __init__(self, world, robot=None, link=None, tool=(0, 0, 0), ramp_s=0.3, velocity=1.0):
        self.arm = roboss.RobotModel(world, robot)
        self.robot = robot or world.robots[0]
        self.link = link or self.arm.links[-1]
        self.tool = np.array([*tool, 0, 0, 0, 1.0])
        robots = roboss.Simulation(world).robots(self.robot)
        velocities, efforts = robots.joint_velocity_limits, robots.joint_effort_limits
        self.velocity = np.where(np.isfinite(velocities) & (velocities > 0), velocities, velocity)
        self.effort = np.where(efforts > 0, efforts, np.inf)
        self.acceleration = self.velocity / ramp_s
        self.base = self.arm.link_pose(self.arm.start, self.arm.links[0])

    def pose(self, values):
        """World pose (7,) of a command's numbers: the tool looks down, turned by YAW."""
        half = np.radians(values[3]) / 2 if len(values) > 3 else 0.0
        return np.array([*(self.base[:3] + values[:3]), np.cos(half), np.sin(half), 0, 0])

    def solve(self, poses, start, **options):
        return self.arm.inverse_kinematics(poses, self.link, start=start, tool=self.tool, **options)

    def timed(self, knots, speed):
        """(s, (SAMPLES, joints)): a motion along configurations, by a quintic polynomial of the path, as fast as the joints
        may go times `speed`."""
        time = np.linspace(0, 1, SAMPLES)
        at = roboss.jtraj([0.0], [1.0], time).q[:, 0]
        q = _between(knots, at)
        v = np.gradient(q, time, axis=0)
        a = np.gradient(v, time, axis=0)
        least = max((np.abs(v) / self.velocity).max(), np.sqrt((np.abs(a) / self.acceleration).max()))
        return least / speed, q

    def plan(self, commands, start):
        """Steps of the program, from the configuration `start`."""
        steps, q, speed = [], start, 1.0
        pose = self.arm.link_pose(q, self.link, tool=self.tool)
        for command in commands:
            if command.name == "speed":
                speed = command.values[0]
                continue
            step = Step(command.number, f"{command.name} {' '.join(f'{x:g}' for x in command.values)}")
            steps.append(step)
            if command.name == "wait":
                step.time_s, step.q = command.values[0], np.repeat(q[None], 2, axis=0)
                continue
            target = self.pose(command.values)
            knots = self._move(q, target) if command.name == "move" else self._line(q, pose, target)
            if knots is None:
                step.reached, step.target = False, target
                continue
            step.time_s, step.q = self.timed(knots, speed)
            step.below_m = max(0.0, float(self.base[2] - self.arm.link_poses(step.q)[..., 2].min()))
            self._load(step)
            q, pose = knots[-1], target
        return steps

    def best(self, commands):
        """The plan with the most poses and then the shortest cycle, over configurations at the first move."""
        first = self.pose(next(command.values for command in commands if command.name == "move"))
        low, high = np.clip(self.arm.joint_limits, -np.pi, np.pi).T
        starts = np.vstack([self.arm.start, np.random.default_rng(0).uniform(low, high, (STARTS, len(low)))])
        found = self.solve(np.tile(first, (len(starts), 1)), starts)
        candidates = found.q[found.success] if found.success.any() else found.q[:1]
        plans = [self.plan(commands, q) for q in candidates]
        best = min(plans, key=lambda steps: (sum(not step.reached for step in steps),
                                             max(step.below_m for step in steps) > 0.01, sum(step.time_s for step in steps)))
        for step in best:
            if not step.reached:
                step.error_m = float(self.solve(step.target, candidates[0]).position_error)
        return best

    def _move(self, q, target):
        """Of the configurations that are found from `q`, near it and anywhere, the one that is reached soonest."""
        low, high = np.clip(self.arm.joint_limits, -np.pi, np.pi).T
        random = np.random.default_rng(0)
        near, far = random.normal(q, 0.7, (STARTS, len(q))), random.uniform(low, high, (STARTS, len(q)))
        found = self.solve(np.tile(target, (1 + 2 * STARTS, 1)), np.vstack([q, near, far]), attempts=1)
        if not found.success.any():
            return None
        ends = found.q[found.success]
        return np.linspace(q, ends[(np.abs(ends - q) / self.velocity).max(axis=1).argmin()], KNOTS)

    def _line(self, q, pose, target):
        poses = roboss.ctraj(pose, target, np.linspace(0, 1, KNOTS), ramp=0).pose
        found = self.solve(poses, q, path=True, attempts=1)
        steady = np.abs(np.diff(np.vstack([q, found.q]), axis=0)).max() < JUMP
        return found.q if found.success.all() and steady else None

    def _load(self, step):
        """Torques of the motion, as shares of the largest."""
        if step.time_s <= 0:
            return
        dt = step.time_s / (SAMPLES - 1)
        v = np.gradient(step.q, dt, axis=0)
        torque = self.arm.inverse_dynamics(step.q, v, np.gradient(v, dt, axis=0))
        shares = np.abs(torque).max(axis=0) / self.effort
        step.torque_share, step.worst_joint = float(shares.max()), self.arm.joints[int(shares.argmax())]


def _between(knots, at):
    """Configurations at shares `at` of a path, by cubic Hermite polynomials (Catmull-Rom): accelerations have no steps."""
    u = at * (len(knots) - 1)
    k = np.clip(u.astype(int), 0, len(knots) - 2)
    s, slopes = (u - k)[:, None], np.gradient(knots, axis=0, edge_order=2)
    return ((2 * s**3 - 3 * s**2 + 1) * knots[k] + (s**3 - 2 * s**2 + s) * slopes[k] + (3 * s**2 - 2 * s**3) * knots[k + 1]
            + (s**3 - s**2) * slopes[k + 1])


def simulate(world, planner, steps):
    """The arm performs the plan with velocity motors: largest distances of the tool from it, on the way and at the end of a
    step, m."""
    sim = roboss.Simulation(world)
    robots = sim.robots(planner.robot)
    done = [step for step in steps if step.reached and step.time_s > 0]
    robots.joint_position = done[0].q[0]
    gain, on_way, at_end = 0.2 / sim.dt, 0.0, 0.0
    for step in done:
        ticks = max(2, round(step.time_s / sim.dt))
        share = np.linspace(0, len(step.q) - 1, ticks + 1)
        plan = np.column_stack([np.interp(share, np.arange(len(step.q)), column) for column in step.q.T])
        wanted = planner.arm.link_pose(plan[1:], planner.link, tool=planner.tool)[:, :3]
        for now, then, place in zip(plan[:-1], plan[1:], wanted):
            robots.set_joint_targets((then - now) / sim.dt + gain * (now - robots.joint_position[0]))
            sim.step()
            tool = planner.arm.link_pose(planner.arm.configuration(robots)[0], planner.link, tool=planner.tool)[:3]
            off = float(np.linalg.norm(tool - place))
            on_way = max(on_way, off)
        at_end = max(at_end, off)
    return {"off_on_the_way_m": on_way, "off_at_the_ends_m": at_end, "simulated_s": sim.time}


def report(steps):
    """Facts of a plan, for JSON."""
    poses = [step for step in steps if not step.text.startswith("wait")]
    return {"reached": sum(step.reached for step in poses), "poses": len(poses), "cycle_s": sum(step.time_s for step in steps),
            "steps": [{name: getattr(step, name) for name in ("number", "text", "reached", "time_s", "error_m", "torque_share",
                                                              "worst_joint")} for step in steps]}


def print_table(facts):
    print(f"{'line':>4}  {'command':28} {'reached':8} {'time, s':>8}  largest torque")
    for step in facts["steps"]:
        load = f"{100 * step['torque_share']:.0f} % of {step['worst_joint']}" if step["worst_joint"] else ""
        what = "yes" if step["reached"] else "NO"
        load = load if step["reached"] else f"{1e3 * step['error_m']:.0f} mm are missing" if step["error_m"] > 1e-6 \
            else "the joints would have to jump, or the turn is out of reach"
        print(f"{step['number']:4}  {step['text']:28} {what:8} {step['time_s']:8.2f}  {load}")
    print(f"{facts['reached']} of {facts['poses']} poses are reached; a cycle takes {facts['cycle_s']:.2f} s")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("arm", type=Path, help="a URDF or SDFormat file")
    parser.add_argument("program", type=Path, help="a program, such as pick_and_place.txt")
    parser.add_argument("--robot", help="its name (default: the first of the file)")
    parser.add_argument("--link", help="whose z axis looks down (default: the last link)")
    parser.add_argument("--tool", type=float, nargs=3, default=(0, 0, 0), metavar=("X", "Y", "Z"),
                        help="place of the tool in its frame, m")
    parser.add_argument("--ramp", type=float, default=0.3, metavar="S",
                        help="time in which a joint reaches its largest velocity (default: 0.3; a URDF does not say)")
    parser.add_argument("--path", action="append", default=[], metavar="FOLDER", help="where package:// URIs are looked up")
    parser.add_argument("--simulate", action="store_true", help="the arm performs it")
    parser.add_argument("--json", action="store_true", help="print the facts as JSON")
    options = parser.parse_args(arguments)
    if not options.ramp > 0:
        parser.error("--ramp takes a time above 0")
    try:
        commands = read_program(options.program.read_text())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", roboss.WorldWarning)
            robot = options.robot or roboss.load(options.arm, search_paths=options.path).robots[0]
            world = roboss.load(options.arm, search_paths=options.path, fixed_base=[robot])
        planner = Planner(world, robot, options.link, options.tool, options.ramp)
        steps = planner.best(commands)
        facts = {"arm": robot, "link": planner.link, **report(steps)}
        if options.simulate and facts["reached"]:
            facts["simulation"] = simulate(world, planner, steps)
    except (OSError, UnicodeDecodeError, ProgramError, roboss.RobossError) as error:
        print(f"arm_program: {error}", file=sys.stderr)
        return 2
    if options.json:
        print(json.dumps(facts, indent=1))
    else:
        print_table(facts)
        if "simulation" in facts:
            print("simulated: the tool is off its plan by at most {off_on_the_way_m:.2e} m, {off_at_the_ends_m:.2e} m at the "
                  "ends".format(**facts["simulation"]))
    return 0 if facts["reached"] == facts["poses"] else 1


if __name__ == "__main__":
    sys.exit(main())
