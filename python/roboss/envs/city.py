"""Cars that drive through a city by laser: the task, and its environments for Gymnasium."""
from __future__ import annotations

from typing import Any, Iterable, Optional, Union

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from ..errors import ArgumentError
from ..randomize import Term
from ..world import World, load
from . import city_view
from .car import drive, heading, poses_of
from .city_driver import follow_the_gap
from .city_map import CityMap, city_world
from .single import TaskEnv
from .task import Mask, Results, Task
from .vector import TaskVectorEnv

ARRIVED_M = 1.5      # from the middle of a crossing
CLEARANCE_M = 3.0    # between a car that starts and all others
NEAREST_M = 0.45     # that a car at a free place sees


class CityTask(Task):
    """Cars that drive from crossing to crossing, and leave the city when they touch something.

    A car starts at rest in a lane. Its goal is the crossing ahead; when it comes within 1.5 m, the next one is drawn: a
    neighbour of that crossing, but not the one that the car came from. Observations and actions: help(roboss.envs.city_view).

    The reward of a step is the way towards the goal in m, and -`collision_cost` for touching a car, a wall, a tree ...
    (Robots.touching, at the end of the step); that terminates the car's episode. Infos: "progress", the way towards the
    goal in m; "arrived" at a crossing; "collided".

    Args:
        cars: how many in each world.
        worlds: equal worlds, each with its own cars.
        world: a city of `roboss-world city`: a World, or what `load` takes; None: that of the package. Its robots
            "car_*" are the cars, of which there must be `cars`.
        collision_cost: m.
        episode_s: an episode is truncated after this time, s.
        step_s: simulated time of a step, s; a multiple of the world's tick.
        dt: length of a tick in s; None: the world's.
        threads: that step.
        randomize: terms of roboss.randomize for the cars, as Task.
    """

    def __init__(self, cars: int = 64, *, worlds: int = 1, world: Union[World, str, None] = None,
                 collision_cost: float = 5.0, episode_s: float = 60.0, step_s: float = 0.05, dt: Optional[float] = None,
                 threads: Optional[int] = None, randomize: Iterable[Term] = ()):
        if world is None:
            world = city_world(cars, dt)
        elif not isinstance(world, World):
            world = load(world, dt=dt)
        names = [name for name in world.robots if name.startswith("car_")]
        if len(names) != cars:
            raise ArgumentError(f"{cars} cars, but the world has {len(names)}", f"give cars={len(names)}", "wrong-count")
        one = np.ones(city_view.COLUMNS, dtype=np.float32)
        super().__init__(world, tuple(names), gymnasium.spaces.Box(-one, one), gymnasium.spaces.Box(-one[:2], one[:2]),
                         worlds=worlds, threads=threads, ticks=round(step_s / world.dt),
                         episode_steps=round(episode_s / step_s), randomize=randomize)
        self.collision_cost = collision_cost
        self.map = CityMap(world.scenery)
        self._outside = self.map.outside(cars)
        self.map.keep(self._free_places())
        self._ends = np.zeros((self.count, 2), dtype=int)  # crossings: that each car came from, that it goes to
        self._actions = np.zeros((self.count, 2))
        self._distance = np.zeros(self.count)

    def observe(self) -> NDArray[np.float32]:
        """Observations of all cars, (count, 29): help(roboss.envs.city_view)."""
        pose, twist = self.robots.pose.reshape(-1, 7), self.robots.twist.reshape(-1, 6)
        cos, sin = heading(pose)
        away = self._away(pose)
        goal_angle = np.arctan2(cos * away[:, 1] - sin * away[:, 0], cos * away[:, 0] + sin * away[:, 1])
        ranges = self.robots["laser"].read().reshape(self.count, -1)
        return city_view.pack(city_view.View(
            ranges, cos * twist[:, 0] + sin * twist[:, 1], twist[:, 5], goal_angle, np.hypot(*away.T), self._actions,
            self.present))

    def act(self, actions: NDArray[np.float64]) -> None:
        self._actions = np.clip(actions, -1, 1) * self.present[:, None]
        drive(self.robots, self._actions)

    def outcome(self, rng: np.random.Generator) -> Results:
        pose = self.robots.pose.reshape(-1, 7)
        distance = np.hypot(*self._away(pose).T)
        progress = np.where(self.present, self._distance - distance, 0.0)
        collided = self.present & self.robots.touching.ravel()
        arrived = self.present & (distance < ARRIVED_M)
        for car in np.flatnonzero(arrived):
            self._go_on(car, rng)
        self._distance = np.hypot(*self._away(pose).T)
        infos = {"progress": progress, "arrived": arrived, "collided": collided}
        return progress - self.collision_cost * collided, collided, infos

    def _go_on(self, car: int, rng: np.random.Generator) -> None:
        """Draws the next goal of a car that has arrived."""
        behind, here = self._ends[car]
        ways = [crossing for crossing in self.map.neighbours[here] if crossing != behind] or [behind]
        self._ends[car] = here, ways[rng.integers(len(ways))]

    def place(self, agents: Mask, rng: np.random.Generator) -> None:
        chosen = self._choose_places(agents, rng)
        self._ends[agents] = self.map.ends[chosen]
        self._actions[agents] = 0
        self.put(agents, poses_of(self.map.places[chosen]))
        self._distance = np.hypot(*self._away(self.robots.pose.reshape(-1, 7)).T)

    def _choose_places(self, agents: Mask, rng: np.random.Generator) -> list[int]:
        """Places for these cars, one by one: drawn among those that are far from all other cars of the world."""
        places, chosen = self.map.places[:, :2], []
        positions = self.robots.pose.reshape(self.worlds, -1, 7)[:, :, :2]
        staying = (self.present & ~agents).reshape(self.worlds, -1)
        for world, mask in enumerate(agents.reshape(self.worlds, -1)):
            others = positions[world, staying[world]]
            nearest = np.full(len(places), np.inf)
            if len(others) and mask.any():
                nearest = _nearest(places, others)
            for _ in range(np.count_nonzero(mask)):
                free = np.flatnonzero(nearest > CLEARANCE_M)
                place = int(free[rng.integers(len(free))] if len(free) else nearest.argmax())
                nearest = np.minimum(nearest, np.linalg.norm(places - places[place], axis=1))
                chosen.append(place)
        return chosen

    def remove(self, agents: Mask) -> None:
        self.put(agents, np.tile(self._outside, (self.worlds, 1))[agents])

    def _away(self, pose: NDArray[np.float64]) -> NDArray[np.float64]:
        """From each car to its goal, (count, 2), m."""
        return self.map.crossings[self._ends[:, 1]] - pose[:, :2]

    def _free_places(self) -> NDArray[np.bool_]:
        """Which places of the map are free: cars of the first world look around at all of them, ahead and back."""
        cars, places = self._robots_of[0], self.map.places
        free = np.ones(len(places), dtype=bool)
        for turn in (0, np.pi):
            poses = poses_of(places + [0, 0, turn])
            for first in range(0, len(poses), len(cars)):
                some = poses[first:first + len(cars)]
                cars.pose = np.concatenate([some, self._outside[len(some):]])
                nearest = cars["laser"].read().min(axis=1)
                free[first:first + len(some)] &= nearest[:len(some)] > NEAREST_M
        self.simulations[0].reset()
        return free


def _nearest(places: NDArray[np.float64], others: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far the nearest of the others is from each place, m: |p - o|^2 = |p|^2 - 2 p o + |o|^2."""
    squares = np.sum(others**2, axis=1) - 2 * places @ others.T
    return np.sqrt(np.maximum(0, squares.min(axis=1) + np.sum(places**2, axis=1)))


class CityVectorEnv(TaskVectorEnv):
    """Cars of a city as sub-environments: "roboss/City-v0" of gymnasium.make_vec.

    Args:
        num_envs: cars of all worlds together.
        worlds: equal worlds, each with num_envs / worlds cars.
        autoreset_mode: "NextStep", "SameStep" or "Disabled".
        render_mode: None or "rgb_array", as TaskVectorEnv.
        options: more options of CityTask.

    >>> cars = roboss.envs.CityVectorEnv(num_envs=12, worlds=3)
    >>> observations, _ = cars.reset(seed=5)
    >>> first = cars.state_hashes
    >>> _ = cars.reset(seed=5)
    >>> cars.state_hashes == first
    True
    """

    task: CityTask

    def __init__(self, num_envs: int = 64, *, worlds: int = 1, autoreset_mode: Union[AutoresetMode, str] = "NextStep",
                 render_mode: Optional[str] = None, **options: Any):
        each = self._agents_of_each(worlds, num_envs, "cars", "world")
        super().__init__(CityTask(each, worlds=worlds, **options), autoreset_mode, render_mode)


class CityEnv(TaskEnv):
    """One car in a city: "roboss/City-v0" of gymnasium.make. `follow_the_gap` drives the other cars.

    Args:
        traffic: how many other cars.
        render_mode: None, "rgb_array" or "human", as TaskEnv.
        options: more options of CityTask, but for `worlds`.

    >>> env = gymnasium.make("roboss/City-v0", traffic=7)
    >>> observation, _ = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step(np.array([1.0, 0.0], dtype=np.float32))
    >>> sorted(info)
    ['arrived', 'collided', 'progress']
    """

    def __init__(self, traffic: int = 15, render_mode: Optional[str] = None, **options: Any):
        if traffic < 0:
            raise ArgumentError(f"{traffic} other cars", "give 0 or more")
        super().__init__(CityTask(1 + traffic, **options), follow_the_gap if traffic else None, render_mode)
