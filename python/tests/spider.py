"""A six-legged walker with a tripod gait, as that of bench/scenes/spiders.cpp."""
import numpy as np

import roboss

COXA, FEMUR, TIBIA = 0.03, 0.08, 0.12  # m
FEMUR_UP, TIBIA_UP = np.pi / 6, -75 * np.pi / 180  # from the horizontal, standing
STANDING, PERIOD = 0.3, 0.5  # s
SWEEP, LIFT = 0.2, 0.35  # rad


def spider_world():
    """A spider on the ground; its joints are in the order of the legs: coxa, femur, tibia."""
    world = roboss.WorldBuilder("spider")
    world.ground()
    height = TIBIA * np.sin(-TIBIA_UP) - FEMUR * np.sin(FEMUR_UP) + 0.012
    model = world.model("spider")
    model.box("trunk", [0.26, 0.16, 0.06], mass=1.2, pose=[0, 0, height])
    for leg in range(6):
        side = 1 if leg % 2 == 0 else -1
        begin, parent = np.array([0.1 - 0.1 * (leg // 2), 0.08 * side, height]), "trunk"
        for part, length, up, mass in (("coxa", COXA, 0, 0.05), ("femur", FEMUR, FEMUR_UP, 0.08), ("tibia", TIBIA, TIBIA_UP, 0.07)):
            along = np.array([0, side * np.cos(up), np.sin(up)])
            name, pose = f"{part}_{leg}", [*(begin + along * length / 2), *_turn(side * np.pi / 2, -up)]
            if part == "tibia":  # a capsule lies along its z axis
                pose[3:] = _turn(side * np.pi / 2, np.pi / 2 - up)
                model.capsule(name, 0.012, length, mass=mass, pose=pose, friction=0.9)
            else:
                model.box(name, [length, 0.01, 0.01], mass=mass, pose=pose)
            at = [0, 0, -length / 2] if part == "tibia" else [-length / 2, 0, 0]
            model.joint(f"joint_{name}", "revolute", parent, name, axis=[0, 0, 1] if part == "coxa" else [0, -1, 0], at=at,
                        lower=-1.5, upper=1.5, effort=4, velocity=8)
            begin, parent = begin + along * length, name
    return world.build()


def gait(time):
    """Targets of the 18 joints, rad: three legs carry while the other three swing forwards."""
    targets = np.zeros((6, 3))
    if time < STANDING:
        return targets.ravel()
    turns, ramp = (time - STANDING) / PERIOD, min(1.0, (time - STANDING) / PERIOD)
    for leg in range(6):
        phase = (turns + (0 if (leg // 2 + leg % 2) % 2 == 0 else 0.5)) % 1
        share = 2 * phase % 1
        ahead, lift = (-np.cos(np.pi * share), np.sin(np.pi * share)) if phase < 0.5 else (1 - 2 * share, 0)
        targets[leg, :2] = (-1 if leg % 2 == 0 else 1) * SWEEP * ramp * ahead, LIFT * ramp * lift
    return targets.ravel()


def _turn(yaw, pitch):
    """Quaternion x y z w: about y, then about z."""
    (cy, sy), (cp, sp) = ((np.cos(angle / 2), np.sin(angle / 2)) for angle in (yaw, pitch))
    return [-sy * sp, cy * sp, sy * cp, cy * cp]
