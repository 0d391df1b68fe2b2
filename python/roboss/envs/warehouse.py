"""Carriers that fetch loads at racks and bring them to stations: the task, and its environments for Gymnasium."""
from __future__ import annotations

from typing import Any, Iterable, Optional, Union

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from ..errors import ArgumentError
from ..randomize import Term
from .car import heading, poses_of
from .single import TaskEnv
from .task import Mask, Results, Task
from .vector import TaskVectorEnv
from .warehouse_driver import fetch_and_carry
from .warehouse_hall import BEAMS, RANGE_M, Hall, on_deck, on_shelf

TOP_SPEED_M_S, TOP_TURN_RAD_S = 1.2, 2.0
COLUMNS = BEAMS + 12
ARRIVED_M, SLOW_M_S = 0.4, 0.3   # of a carrier at its goal
CLEARANCE_M = 1.5                # between a carrier that starts and all others
LOW, FETCH, DELIVER = 0.3, 2.0, 5.0
_SLOT, _STATION, _BAY = 0, 1, 2  # kinds of goals


class WarehouseTask(Task):
    """Carriers "carrier_0" ... with a differential drive fetch loads at racks, bring them to stations, and charge.

    The way to a goal leads around the racks, and keeps right at the ends of aisles (help(roboss.envs.warehouse_hall)).
    The goal of a carrier is a slot of a rack, then a station, then the next slot. It is there within 0.4 m, slower than
    0.3 m/s: then the load, 8 kg, is put on its deck and held by a bond, or taken off. The charge falls, by the speed, in
    `battery_s` at full speed. Below 0.3 and without a load, the goal is the carrier's own bay; there it docks for
    `charge_s`: out of service, it stands still whatever its action is. A carrier that touches something (another one, a
    rack, a wall), or whose charge is 0, is terminated and leaves the hall.

    Observation, float32 from -1 to 1, (33,):

    | columns | meaning | scale |
    |---|---|---|
    | 0 to 20 | ranges of the laser, from the right (-90 degrees) to the left | 8 m; 1: nothing within reach |
    | 21, 22 | speed along the carrier, yaw rate to the left | 1.5 m/s, 3 rad/s |
    | 23, 24 | direction of the way to the goal against straight ahead: cosine, sine | |
    | 25 | distance of the next point of that way | 10 m |
    | 26 | length of the way | 40 m |
    | 27, 28 | 1: it carries a load; 1: the goal is its bay | |
    | 29 | charge, from 0 to 1 | |
    | 30, 31 | action of the last step | as below |
    | 32 | 1: in service; 0: docked, or not in the hall | |

    Action, two numbers from -1 to 1: speed (1.2 m/s) and turn rate (2 rad/s, to the left), a command "cmd_vel" of the
    drive, which limits accelerations. The reward of a step is how much shorter the way became, m; 2 for a load that is
    fetched, 5 for one that is delivered; -`collision_cost` for being terminated. Infos, (count,): "progress" (m),
    "fetched", "delivered", "collided", "flat" (its charge is 0), "in_service" (its next action counts: an action mask).

    Args:
        carriers: how many in each hall; the hall grows with them.
        worlds: equal halls, each with its own carriers.
        collision_cost: m.
        battery_s, charge_s: s.
        episode_s: an episode is truncated after this time, s.
        step_s: simulated time of a step, s; a multiple of the world's tick, 2 ms.
        threads: that step.
        randomize: terms of roboss.randomize for the carriers, as Task.
    """

    def __init__(self, carriers: int = 8, *, worlds: int = 1, collision_cost: float = 5.0, battery_s: float = 180.0,
                 charge_s: float = 10.0, episode_s: float = 120.0, step_s: float = 0.05, threads: Optional[int] = None,
                 randomize: Iterable[Term] = ()):
        if not 1 <= carriers <= 200:
            raise ArgumentError(f"{carriers} carriers in a hall", "give 1 to 200; `worlds` for several halls")
        if not (battery_s > 0 and charge_s > 0):
            raise ArgumentError(f"battery_s of {battery_s} and charge_s of {charge_s}", "give more than 0 s")
        self.hall = Hall(carriers)
        world = self.hall.world(carriers)
        names = tuple(f"carrier_{number}" for number in range(carriers))
        one = np.ones(COLUMNS, dtype=np.float32)
        super().__init__(world, names, gymnasium.spaces.Box(-one, one), gymnasium.spaces.Box(-one[:2], one[:2]),
                         worlds=worlds, threads=threads, ticks=round(step_s / world.dt),
                         episode_steps=round(episode_s / step_s), randomize=randomize)
        self.collision_cost, self._battery_s, self._charge_steps = collision_cost, battery_s, round(charge_s / step_s)
        self._outside = self.hall.outside(carriers)
        self._loads_of = [simulation.robots([f"load_{number}" for number in range(carriers)])
                          for simulation in self.simulations]
        self.charge = np.ones(self.count)                 #: of each carrier, from 0 to 1
        self.loaded: Mask = np.zeros(self.count, bool)    #: who carries a load
        self._docked = np.zeros(self.count, dtype=int)    # steps that it stays in its bay
        self._kind = np.zeros(self.count, dtype=int)      # of goals
        self._place_of_goal = np.zeros((self.count, 2))   # m
        self._slot = np.zeros(self.count, dtype=int)      # of the load to fetch; -1: none
        self._length = np.zeros(self.count)               # of the way to the goal, m
        self._actions = np.zeros((self.count, 2))

    @property
    def in_service(self) -> Mask:
        """Whose action counts: those that are in the hall and not docked, (count,)."""
        return self.present & (self._docked == 0)

    def observe(self) -> NDArray[np.float32]:
        """Observations of all carriers, (count, 33); see the class."""
        pose, twist = self.robots.pose.reshape(-1, 7), self.robots.twist.reshape(-1, 6)
        cos, sin = heading(pose)
        length, point = self.hall.ways(pose[:, :2], self._place_of_goal)
        away = point - pose[:, :2]
        distance = np.hypot(*away.T)
        ahead, left = cos * away[:, 0] + sin * away[:, 1], cos * away[:, 1] - sin * away[:, 0]
        near = np.maximum(distance, 1e-9)
        ranges = self.robots["laser"].read().reshape(self.count, -1)
        columns = [(ranges / RANGE_M).clip(0, 1), (cos * twist[:, 0] + sin * twist[:, 1]) / 1.5, twist[:, 5] / 3, ahead / near,
                   left / near, distance / 10, length / 40, self.loaded, self._kind == _BAY, self.charge, self._actions,
                   self.in_service]
        return np.column_stack(columns).clip(-1, 1).astype(np.float32)

    def act(self, actions: NDArray[np.float64]) -> None:
        self._actions = np.clip(actions, -1, 1) * self.in_service[:, None]
        command = np.zeros((self.count, 6))
        command[:, 0], command[:, 5] = self._actions[:, 0] * TOP_SPEED_M_S, self._actions[:, 1] * TOP_TURN_RAD_S
        self.robots.command("cmd_vel", command.reshape(*self.robots.pose.shape[:-1], 6))

    def outcome(self, rng: np.random.Generator) -> Results:
        pose, twist = self.robots.pose.reshape(-1, 7), self.robots.twist.reshape(-1, 6)
        length, _ = self.hall.ways(pose[:, :2], self._place_of_goal)
        progress = np.where(self.in_service, self._length - length, 0.0)
        speed = np.hypot(twist[:, 0], twist[:, 1])
        self._use_charge(speed)
        flat = self.present & (self.charge <= 0)
        collided = self.present & self.robots.touching.ravel()
        there = self.in_service & ~flat & ~collided & (_far(pose, self._place_of_goal) < ARRIVED_M) & (speed < SLOW_M_S)
        fetched, delivered = there & (self._kind == _SLOT), there & (self._kind == _STATION)
        self._docked[self._docked > 0] -= 1
        for agent in np.flatnonzero(there):
            self._arrive(int(agent), rng)
        for agent in np.flatnonzero(self.present & (self._kind == _BAY) & (self.charge >= 1) & (self._docked == 0)):
            self._send_to_slot(int(agent), rng)
        self._measure_ways()
        over = collided | flat
        infos = {"progress": progress, "fetched": fetched, "delivered": delivered, "collided": collided, "flat": flat,
                 "in_service": self.in_service & ~over}
        return progress + FETCH * fetched + DELIVER * delivered - self.collision_cost * over, over, infos

    def _use_charge(self, speed: NDArray[np.float64]) -> None:
        """A step of those that drive, and of those that charge."""
        used = (0.2 + 0.8 * np.minimum(speed / TOP_SPEED_M_S, 1)) * self.step_s / self._battery_s
        self.charge = np.where(self.in_service, np.maximum(0, self.charge - used), self.charge)
        self.charge[self.present & (self._docked == 1)] = 1  # the last step in the bay

    def _arrive(self, agent: int, rng: np.random.Generator) -> None:
        """What a carrier does where it was to go."""
        world, row = divmod(agent, len(self.names))
        if self._kind[agent] == _SLOT:
            loads, carrier = self._loads_of[world][row], self._robots_of[world][row]
            loads.pose, loads.twist = on_deck(carrier.pose[0]), carrier.twist
            self.simulations[world].attach(self.names[row], f"load_{row}")
            self.loaded[agent] = True
            self._slot[agent] = -1
            self._send(agent, _STATION, self.hall.stations[rng.integers(len(self.hall.stations))])
        elif self._kind[agent] == _STATION:
            self._put_load_away(agent)
            if self.charge[agent] < LOW:
                self._send(agent, _BAY, self.hall.bays[row])
            else:
                self._send_to_slot(agent, rng)
        else:
            self._docked[agent] = self._charge_steps

    def _send_to_slot(self, agent: int, rng: np.random.Generator) -> None:
        """The next order: a load in a free slot."""
        world, row = divmod(agent, len(self.names))
        mine = slice(world * len(self.names), (world + 1) * len(self.names))
        free = np.setdiff1d(np.arange(len(self.hall.slots)), self._slot[mine])
        slot = int(rng.choice(free))
        load = self._loads_of[world][row]
        load.pose, load.twist = on_shelf(self.hall.shelves[slot]), 0
        self._slot[agent] = slot
        self._send(agent, _SLOT, self.hall.slots[slot])

    def _send(self, agent: int, kind: int, place: NDArray[np.float64]) -> None:
        self._kind[agent], self._place_of_goal[agent] = kind, place

    def _put_load_away(self, agent: int) -> None:
        """The load of this carrier is behind the wall, wherever it was."""
        world, row = divmod(agent, len(self.names))
        if self.loaded[agent]:
            self.simulations[world].detach(self.names[row], f"load_{row}")
        load = self._loads_of[world][row]
        load.pose, load.twist = self._outside[row] + [0, -0.8, 0.15, 0, 0, 0, 0], 0
        self.loaded[agent], self._slot[agent] = False, -1

    def _measure_ways(self) -> None:
        self._length = self.hall.ways(self.robots.pose.reshape(-1, 7)[:, :2], self._place_of_goal)[0]

    def place(self, agents: Mask, rng: np.random.Generator) -> None:
        whole = agents.reshape(self.worlds, -1).all(axis=1)
        self.loaded[np.repeat(whole, len(self.names)) & ~self.present] = False  # a reset let go of them
        self._slot[agents] = -1
        places = self._choose_places(agents, rng)
        self.put(agents, poses_of(places))
        self._actions[agents], self._docked[agents] = 0, 0
        self.charge[agents] = rng.uniform(0.4, 1, np.count_nonzero(agents))
        for agent in np.flatnonzero(agents):
            self._put_load_away(int(agent))
            self._send_to_slot(int(agent), rng)
        self._measure_ways()

    def _choose_places(self, agents: Mask, rng: np.random.Generator) -> NDArray[np.float64]:
        """x, y and yaw for these carriers, one by one: drawn among those that are far from all other carriers."""
        starts, chosen = self.hall.starts, []
        positions = self.robots.pose.reshape(self.worlds, -1, 7)[:, :, :2]
        staying = (self.present & ~agents).reshape(self.worlds, -1)
        for world, mask in enumerate(agents.reshape(self.worlds, -1)):
            taken = list(positions[world, staying[world]])
            for _ in range(np.count_nonzero(mask)):
                nearest = np.full(len(starts), np.inf)
                for other in taken:
                    nearest = np.minimum(nearest, np.hypot(*(starts[:, :2] - other).T))
                free = np.flatnonzero(nearest > CLEARANCE_M)
                chosen.append(starts[rng.choice(free) if len(free) else nearest.argmax()])
                taken.append(chosen[-1][:2])
        return np.array(chosen)

    def remove(self, agents: Mask) -> None:
        for agent in np.flatnonzero(agents):
            self._put_load_away(int(agent))
        self.put(agents, np.tile(self._outside, (self.worlds, 1))[agents])


def _far(pose: NDArray[np.float64], goals: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.hypot(*(goals - pose[:, :2]).T)


class WarehouseVectorEnv(TaskVectorEnv):
    """Carriers of a warehouse as sub-environments: "roboss/Warehouse-v0" of gymnasium.make_vec.

    Args:
        num_envs: carriers of all halls together.
        worlds: equal halls, each with num_envs / worlds carriers.
        autoreset_mode: "NextStep", "SameStep" or "Disabled".
        render_mode: None or "rgb_array", as TaskVectorEnv.
        options: more options of WarehouseTask.

    >>> carriers = roboss.envs.WarehouseVectorEnv(num_envs=6)
    >>> observations, _ = carriers.reset(seed=1)
    >>> observations.shape
    (6, 33)
    >>> for _ in range(400):
    ...     observations, _, _, _, infos = carriers.step(roboss.envs.fetch_and_carry(observations))
    >>> bool(carriers.task.loaded.any())                            # after 20 s
    True
    """

    task: WarehouseTask

    def __init__(self, num_envs: int = 8, *, worlds: int = 1, autoreset_mode: Union[AutoresetMode, str] = "NextStep",
                 render_mode: Optional[str] = None, **options: Any):
        each = self._agents_of_each(worlds, num_envs, "carriers", "hall")
        super().__init__(WarehouseTask(each, worlds=worlds, **options), autoreset_mode, render_mode)


class WarehouseEnv(TaskEnv):
    """One carrier in a warehouse: "roboss/Warehouse-v0" of gymnasium.make. `fetch_and_carry` drives the others.

    Args:
        others: how many other carriers.
        render_mode: None, "rgb_array" or "human", as TaskEnv.
        options: more options of WarehouseTask, but for `worlds`.

    >>> env = gymnasium.make("roboss/Warehouse-v0", others=3)
    >>> observation, _ = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
    >>> info["in_service"]
    True
    """

    def __init__(self, others: int = 5, render_mode: Optional[str] = None, **options: Any):
        if others < 0:
            raise ArgumentError(f"{others} other carriers", "give 0 or more")
        super().__init__(WarehouseTask(1 + others, **options), fetch_and_carry if others else None, render_mode)
