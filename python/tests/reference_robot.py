"""A second, plain implementation of the mechanics of a URDF tree, to test roboss.RobotModel against.

Sums over links with Jacobians and Christoffel symbols by finite differences: slow and short.
"""
import xml.etree.ElementTree as xml

import numpy as np


def _numbers(element, name, default):
    return np.array([float(word) for word in (element.get(name) if element is not None else default).split()])


def _rotation(rpy):
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def _turned(axis, angle):
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


class ReferenceRobot:
    """On a fixed base at the world's origin. Columns are the moving joints in the order of the file."""

    def __init__(self, urdf, gravity):
        robot = xml.fromstring(urdf)
        self.gravity = np.array(gravity)
        self.joints = [joint for joint in robot.findall("joint")]
        self.moving = [joint.get("name") for joint in self.joints if joint.get("type") != "fixed"]
        self.inertials = {link.get("name"): link.find("inertial") for link in robot.findall("link")}

    def place(self, q):
        """{link: (R, p)} and {link: [(column, axis, point or None for a slide)]}, world."""
        places, paths = {"link_0": (np.eye(3), np.zeros(3))}, {"link_0": []}
        for joint in self.joints:  # parents come first in these files
            parent, child = joint.find("parent").get("link"), joint.find("child").get("link")
            R, p = places[parent]
            origin = joint.find("origin")
            p = p + R @ _numbers(origin, "xyz", "0 0 0")
            R = R @ _rotation(_numbers(origin, "rpy", "0 0 0"))
            path = list(paths[parent])
            if joint.get("type") != "fixed":
                column, axis = self.moving.index(joint.get("name")), _numbers(joint.find("axis"), "xyz", "1 0 0")
                slides = joint.get("type") == "prismatic"
                path.append((column, R @ axis, None if slides else p))
                p = p + R @ axis * q[column] if slides else p
                R = R if slides else R @ _turned(axis, q[column])
            places[child], paths[child] = (R, p), path
        return places, paths

    def jacobian(self, path, point):
        """(6, columns): linear velocity of the point, angular velocity."""
        J = np.zeros((6, len(self.moving)))
        for column, axis, at in path:
            J[:3, column] = axis if at is None else np.cross(axis, point - at)
            J[3:, column] = 0 if at is None else axis
        return J

    def mass_and_gravity(self, q):
        """M(q), g(q)."""
        n = len(self.moving)
        M, g = np.zeros((n, n)), np.zeros(n)
        places, paths = self.place(q)
        for link, inertial in self.inertials.items():
            R, p = places[link]
            mass, origin = float(inertial.find("mass").get("value")), inertial.find("origin")
            entries = inertial.find("inertia")
            ixx, iyy, izz, ixy, ixz, iyz = (float(entries.get(name)) for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
            turned = R @ _rotation(_numbers(origin, "rpy", "0 0 0"))
            inertia = turned @ np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]]) @ turned.T
            J = self.jacobian(paths[link], p + R @ _numbers(origin, "xyz", "0 0 0"))
            M += mass * J[:3].T @ J[:3] + J[3:].T @ inertia @ J[3:]
            g -= mass * J[:3].T @ self.gravity
        return M, g

    def coriolis_matrix(self, q, v, step=1e-5):
        """C_ij = sum over k of (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i) v_k / 2."""
        units = np.eye(len(q)) * step
        slopes = np.array([(self.mass_and_gravity(q + d)[0] - self.mass_and_gravity(q - d)[0]) / (2 * step) for d in units])
        return 0.5 * (np.einsum("kij,k->ij", slopes, v) + np.einsum("jik,k->ij", slopes, v) -
                      np.einsum("ijk,k->ij", slopes, v))
