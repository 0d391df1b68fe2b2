"""Domain randomisation: what is drawn for each robot, from which distribution, and when: docs/randomization.md.

    >>> from roboss import randomize
    >>> terms = [
    ...     randomize.joint("damping", randomize.uniform(0.5, 2), "scale"),
    ...     randomize.joint("friction", randomize.uniform(0, 0.02), joints="front_*"),
    ...     randomize.kick(randomize.normal(0, [0.3, 0.3, 0, 0, 0, 0.5]), when=(5, 15)),
    ...     randomize.latency(randomize.choice([0, 1, 2])),
    ... ]
    >>> batch = roboss.Batch(roboss.example("crossroads.sdf"), 4)
    >>> randomizer = randomize.Randomizer(batch.robots("car_*"), terms, seed=1)
    >>> randomizer.reset()
    >>> randomizer.drawn["joint_friction"].shape, randomizer.columns("joint_friction")
    ((4, 16, 2), ('front_left', 'front_right'))

| term | draws |
|---|---|
| joint | a number of joints: damping, friction, gains, bounds of motors ... |
| link | a number of links: mass, centre of mass, inertia, friction, restitution ... |
| surroundings | gravity or wind |
| kick | a change of the base's velocity |
| push | a wrench on a link |
| noise | what is added to observations |
| latency | steps between an action and its effect |

Environments of roboss.envs take the terms as `randomize=`.
"""
from .distributions import Distribution, choice, log_uniform, normal, uniform
from .randomizer import Randomizer, RandomizerSave
from .streams import pick, stream
from .terms import Term, joint, kick, latency, link, noise, push, surroundings

__all__ = ["Distribution", "Randomizer", "RandomizerSave", "Term", "choice", "joint", "kick", "latency", "link",
           "log_uniform", "noise", "normal", "pick", "push", "stream", "surroundings", "uniform"]
