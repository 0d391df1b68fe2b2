"""Random robots as URDF texts, for the tests of kinematics and for tools/check_kinematics."""
import numpy as np

_KINDS = ["revolute", "continuous", "prismatic", "fixed"]


def _numbers(values):
    return " ".join(repr(float(value)) for value in values)


def _link(name, random):
    turned, _ = np.linalg.qr(random.normal(size=(3, 3)))
    moments = random.uniform(0.01, 0.05, 3) + 0.05  # so alike that they are those of a real body
    inertia = turned @ np.diag(moments) @ turned.T
    entries = {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1), "ixz": (0, 2), "iyz": (1, 2)}
    moments = " ".join(f'{name}="{inertia[at]!r}"' for name, at in entries.items())
    return (f'<link name="{name}"><inertial><origin xyz="{_numbers(random.uniform(-0.2, 0.2, 3))}" '
            f'rpy="{_numbers(random.uniform(-1, 1, 3))}"/><mass value="{random.uniform(0.3, 3)!r}"/>'
            f"<inertia {moments}/></inertial></link>").replace("np.float64(", "").replace(")", "")


def random_urdf(seed, links=12, kinds=_KINDS):
    """A tree of `links` links with random joints, frames and inertias, named "random_SEED"."""
    random = np.random.default_rng(seed)
    parts = [f'<robot name="random_{seed}">', _link("link_0", random)]
    for number in range(1, links):
        kind = kinds[random.integers(len(kinds))]
        parent = random.integers(max(0, number - 4), number)
        axis = random.normal(size=3)
        limit = '<limit lower="-1.5" upper="1.5" effort="100" velocity="10"/>'
        parts.append(_link(f"link_{number}", random))
        parts.append(f'<joint name="joint_{number}" type="{kind}"><parent link="link_{parent}"/>'
                     f'<child link="link_{number}"/><origin xyz="{_numbers(random.uniform(-0.5, 0.5, 3))}" '
                     f'rpy="{_numbers(random.uniform(-3, 3, 3))}"/><axis xyz="{_numbers(axis / np.linalg.norm(axis))}"/>'
                     f"{'' if kind == 'fixed' else limit}</joint>")
    return "\n".join([*parts, "</robot>"])
