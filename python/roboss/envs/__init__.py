"""Environments for learning: worlds of many agents for Gymnasium and PettingZoo. They need `roboss[envs]`.

One world with N agents is one vectorised environment: each sub-environment is one agent, and all of them drive in the
same world, see each other and can collide.

    >>> import gymnasium, roboss.envs
    >>> cars = gymnasium.make_vec("roboss/City-v0", num_envs=16)
    >>> observations, _ = cars.reset(seed=1)
    >>> observations.shape
    (16, 29)
    >>> observations, rewards, terminated, truncated, infos = cars.step(cars.action_space.sample())
    >>> rewards.shape, infos["collided"].shape
    ((16,), (16,))

| class | interface | agents |
|---|---|---|
| CityVectorEnv | gymnasium.vector.VectorEnv, "roboss/City-v0" | all cars of one world, or of several equal ones |
| CityEnv | gymnasium.Env, "roboss/City-v0" | one car; `follow_the_gap` drives the others |
| CityParallelEnv | pettingzoo.ParallelEnv | all cars of one world, by name |
| SoccerVectorEnv | gymnasium.vector.VectorEnv, "roboss/Soccer-v0" | all cars of some matches |
| SoccerEnv | gymnasium.Env, "roboss/Soccer-v0" | one car; `chase_the_ball` drives the others |
| SoccerParallelEnv | pettingzoo.ParallelEnv | all cars of a match, by name |
| WarehouseVectorEnv | gymnasium.vector.VectorEnv, "roboss/Warehouse-v0" | all carriers of one hall, or of several |
| WarehouseEnv | gymnasium.Env, "roboss/Warehouse-v0" | one carrier; `fetch_and_carry` drives the others |
| WarehouseParallelEnv | pettingzoo.ParallelEnv | all carriers of a hall, by name |

An environment of your own is a Task: what agents see, do and get. TaskVectorEnv, TaskEnv and TaskParallelEnv make the
three interfaces of it.
"""
try:
    import gymnasium
except ImportError as missing:
    raise ImportError("roboss.envs needs the package 'gymnasium', which is not installed\n"
                      "  remedy: pip install 'roboss[envs]'", name="gymnasium") from missing

from typing import TYPE_CHECKING, Any

from .city import CityEnv, CityTask, CityVectorEnv
from .city_driver import follow_the_gap
from .single import TaskEnv
from .soccer import SoccerEnv, SoccerTask, SoccerVectorEnv
from .soccer_driver import chase_the_ball
from .task import Mask, Outcome, Task, Results
from .vector import TaskVectorEnv
from .warehouse import WarehouseEnv, WarehouseTask, WarehouseVectorEnv
from .warehouse_driver import fetch_and_carry
from .warehouse_traffic import CarrierTraffic

if TYPE_CHECKING:
    from .parallel import CityParallelEnv, SoccerParallelEnv, TaskParallelEnv, WarehouseParallelEnv

__all__ = ["CarrierTraffic", "CityEnv", "CityParallelEnv", "CityTask", "CityVectorEnv", "Mask", "Outcome", "SoccerEnv",
           "SoccerParallelEnv", "SoccerTask", "SoccerVectorEnv", "Task", "TaskEnv", "TaskParallelEnv",
           "TaskVectorEnv", "Results", "WarehouseEnv", "WarehouseParallelEnv", "WarehouseTask", "WarehouseVectorEnv",
           "chase_the_ball", "fetch_and_carry", "follow_the_gap"]

for _name in ("City", "Soccer", "Warehouse"):
    gymnasium.register(f"roboss/{_name}-v0", entry_point=f"roboss.envs:{_name}Env",
                       vector_entry_point=f"roboss.envs:{_name}VectorEnv")


def __getattr__(name: str) -> Any:
    """The classes that need PettingZoo, which only they need."""
    if name not in ("CityParallelEnv", "SoccerParallelEnv", "TaskParallelEnv", "WarehouseParallelEnv"):
        raise AttributeError(f"module 'roboss.envs' has no attribute '{name}'")
    try:
        from . import parallel
    except ImportError as missing:
        raise ImportError(f"roboss.envs.{name} needs the package 'pettingzoo', which is not installed\n"
                          "  remedy: pip install 'roboss[envs]'", name="pettingzoo") from missing
    return getattr(parallel, name)
