"""Two teams of cars and a ball: the task, and its environment for Gymnasium."""
from __future__ import annotations

from typing import Any, Iterable, Optional, Union

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from ..errors import ArgumentError
from ..randomize import Term
from .car import drive, heading, poses_of
from .single import TaskEnv
from .soccer_driver import chase_the_ball
from .soccer_field import BALL_RADIUS_M, HALF_LENGTH_M, HALF_WIDTH_M, outside, soccer_world
from .task import Mask, Results, Task
from .vector import TaskVectorEnv

APART_M = 0.8  # between cars at kick-off


class SoccerTask(Task):
    """Cars "red_0" ... play towards +x, "blue_0" ... towards -x. A match ends with a goal, or when time is up.

    Observation, float32 from -1 to 1; both teams see the field as if they played towards +x. Places and directions are
    seen from the car, x ahead and y to the left:

    | columns | meaning | scale |
    |---|---|---|
    | 0 to 3 | the car on the field: x, y; cosine and sine of its yaw | 6 m |
    | 4, 5 | speed along the car, yaw rate | 2.5 m/s, 5 rad/s |
    | 6 to 9 | ball: place, velocity | 6 m, 4 m/s |
    | 10, 11 | middle of the other team's goal | 12 m |
    | 12 ... | x, y of each team-mate, then of each opponent | 6 m |

    Action: speed and turn, see help(roboss.envs.car). The reward of a car is that of its team: how far the ball moved
    towards the other team's goal, m, and 10 for a goal, -10 for one of the others. Infos: "goals", 1, -1 or 0.

    Args:
        cars: of each team.
        worlds: matches.
        match_s: a match is truncated after this time, s.
        step_s: simulated time of a step, s.
        threads: that step.
        randomize: terms of roboss.randomize for the cars, as Task.
    """

    def __init__(self, cars: int = 3, *, worlds: int = 1, match_s: float = 60.0, step_s: float = 0.05,
                 threads: Optional[int] = None, randomize: Iterable[Term] = ()):
        if not 1 <= cars <= 8:
            raise ArgumentError(f"teams of {cars} cars", "give 1 to 8")
        names = tuple(f"{team}_{number}" for team in ("red", "blue") for number in range(cars))
        world = soccer_world(names)
        one = np.ones(12 + 2 * (2 * cars - 1), dtype=np.float32)
        super().__init__(world, names, gymnasium.spaces.Box(-one, one), gymnasium.spaces.Box(-one[:2], one[:2]),
                         worlds=worlds, threads=threads, ticks=round(step_s / world.dt),
                         episode_steps=round(match_s / step_s), randomize=randomize)
        self._team = cars
        self._side = np.tile(np.repeat([1.0, -1.0], cars), worlds)  # towards +x or -x
        self._others_of = _others_of_each(cars)
        self._outside = outside(2 * cars)
        self._ball = self.simulation.robots("ball")
        self._balls = [simulation.robots("ball") for simulation in self.simulations]
        self._ball_x = np.zeros(worlds)

    def observe(self) -> NDArray[np.float32]:
        """Observations of all cars, (count, 12 + 2 * (2 * cars - 1))."""
        pose, twist = self.robots.pose.reshape(-1, 7), self.robots.twist.reshape(-1, 6)
        cos, sin = heading(pose)

        def seen(world_xy):
            """Vectors of the world from the cars, ahead and to the left, (count, ..., 2)."""
            c, s = (angle.reshape(-1, *[1] * (world_xy.ndim - 2)) for angle in (cos, sin))
            return np.stack([c * world_xy[..., 0] + s * world_xy[..., 1], c * world_xy[..., 1] - s * world_xy[..., 0]], axis=-1)

        place = pose[:, :2]
        ball, ball_velocity = (np.repeat(array.reshape(self.worlds, -1)[:, :2], 2 * self._team, axis=0)
                               for array in (self._ball.pose, self._ball.twist))
        goal = np.stack([self._side * HALF_LENGTH_M, np.zeros(self.count)], axis=1)
        turned = self._side[:, None]
        columns = [turned * place / 6, turned * np.stack([cos, sin], axis=1), seen(twist[:, :2])[:, :1] / 2.5,
                   twist[:, 5:6] / 5, seen(ball - place) / 6, seen(ball_velocity) / 4, seen(goal - place) / 12,
                   seen(self._others(place)).reshape(self.count, -1) / 6]
        return np.concatenate(columns, axis=1).clip(-1, 1).astype(np.float32)

    def _others(self, place: NDArray[np.float64]) -> NDArray[np.float64]:
        """From each car to its team-mates and opponents, (count, 2 * cars - 1, 2), m."""
        every = 2 * self._team
        of_world = place.reshape(self.worlds, 1, every, 2) - place.reshape(self.worlds, every, 1, 2)
        return np.take_along_axis(of_world, self._others_of[None, :, :, None], axis=2).reshape(self.count, every - 1, 2)

    def act(self, actions: NDArray[np.float64]) -> None:
        drive(self.robots, np.clip(actions, -1, 1) * self.present[:, None])

    def outcome(self, rng: np.random.Generator) -> Results:
        x = self._ball.pose.reshape(self.worlds, 7)[:, 0]
        scored = np.where(np.abs(x) > HALF_LENGTH_M + BALL_RADIUS_M, np.sign(x), 0.0)
        moved, self._ball_x = x - self._ball_x, x.copy()
        for_red = np.repeat(np.stack([moved + 10 * scored, scored], axis=1), 2 * self._team, axis=0)
        mine = self._side * self.present
        return mine * for_red[:, 0], self.present & (for_red[:, 1] != 0), {"goals": (mine * for_red[:, 1]).astype(int)}

    def place(self, agents: Mask, rng: np.random.Generator) -> None:
        positions = self.robots.pose.reshape(self.worlds, -1, 7)[:, :, :2]
        playing, places = (self.present & ~agents).reshape(self.worlds, -1), []
        for world, mask in enumerate(agents.reshape(self.worlds, -1)):
            if mask.all():
                self._kick_off(world, rng)
            taken = list(positions[world, playing[world]])
            for car in np.flatnonzero(mask):
                places.append(_free_place(self._side[car], taken, rng))
                taken.append(places[-1][:2])
        self.put(agents, poses_of(np.array(places)))

    def _kick_off(self, world: int, rng: np.random.Generator) -> None:
        ball = self._balls[world]
        ball.pose = [0, rng.uniform(-1, 1), BALL_RADIUS_M, 0, 0, 0, 1]
        ball.twist = 0
        self._ball_x[world] = 0

    def remove(self, agents: Mask) -> None:
        self.put(agents, np.tile(self._outside, (self.worlds, 1))[agents])


def _others_of_each(cars: int) -> NDArray[np.int64]:
    """Rows of the team-mates, then of the opponents, of each car of a match, (2 * cars, 2 * cars - 1)."""
    rows = np.arange(2 * cars)
    return np.array([[other for other in (*rows[rows // cars == car // cars], *rows[rows // cars != car // cars])
                      if other != car] for car in rows])


def _free_place(side: float, taken: list[NDArray], rng: np.random.Generator) -> NDArray[np.float64]:
    """x, y and yaw in the half of the team that plays towards `side`, away from the places that are taken if it can be."""
    for _ in range(100):
        spot = np.array([-side * rng.uniform(1, HALF_LENGTH_M - 0.6), rng.uniform(-1, 1) * (HALF_WIDTH_M - 0.6)])
        if all(np.linalg.norm(other - spot) > APART_M for other in taken):
            break
    return np.array([*spot, (0.0 if side > 0 else np.pi) + rng.uniform(-0.3, 0.3)])


class SoccerVectorEnv(TaskVectorEnv):
    """All cars of some matches as sub-environments: "roboss/Soccer-v0" of gymnasium.make_vec.

    Rows of a match are its red cars, then its blue ones. All of them finish at the same time.

    Args:
        num_envs: cars of all matches together.
        cars: of each team.
        autoreset_mode: "NextStep", "SameStep" or "Disabled".
        render_mode: None or "rgb_array", as TaskVectorEnv.
        options: more options of SoccerTask, but for `worlds`.

    >>> cars = roboss.envs.SoccerVectorEnv(num_envs=12)             # two matches, three against three
    >>> observations, _ = cars.reset(seed=1)
    >>> observations.shape
    (12, 22)
    """

    task: SoccerTask

    def __init__(self, num_envs: int = 6, *, cars: int = 3, autoreset_mode: Union[AutoresetMode, str] = "NextStep",
                 render_mode: Optional[str] = None, **options: Any):
        if num_envs < 1 or cars < 1 or num_envs % (2 * cars):
            raise ArgumentError(f"{num_envs} cars in teams of {cars}", f"give a multiple of {2 * max(1, cars)}")
        super().__init__(SoccerTask(cars, worlds=num_envs // (2 * cars), **options), autoreset_mode,
                         render_mode)


class SoccerEnv(TaskEnv):
    """The car "red_0": "roboss/Soccer-v0" of gymnasium.make. `chase_the_ball` drives its team-mates and opponents.

    Args:
        cars: of each team.
        render_mode: None, "rgb_array" or "human", as TaskEnv.
        options: more options of SoccerTask, but for `worlds`.

    >>> env = gymnasium.make("roboss/Soccer-v0", cars=2)
    >>> observation, _ = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
    >>> observation.shape, info
    ((18,), {'goals': 0})
    """

    def __init__(self, cars: int = 1, render_mode: Optional[str] = None, **options: Any):
        super().__init__(SoccerTask(cars, **options), chase_the_ball, render_mode)
