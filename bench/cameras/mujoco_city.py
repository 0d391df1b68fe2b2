"""The visuals of worlds/city.sdf in MuJoCo, for its renderer: boxes, cylinders and spheres in their colours, one sun, and the
camera of bench/cameras/cameras.cpp, 0.4 m above the first car.
"""
import math
import xml.etree.ElementTree as ElementTree

HEAD = """<mujoco><compiler angle="radian" eulerseq="XYZ"/>
<visual><global offwidth="{width}" offheight="{height}"/><quality shadowsize="2048" offsamples="0"/>
<map znear="0.0002" zfar="0.4"/></visual>
<asset><texture type="skybox" builtin="gradient" rgb1="0.5 0.7 0.9" rgb2="0.9 0.9 0.95" width="256" height="256"/></asset>
<worldbody><light type="directional" pos="12 -34 30" dir="-0.4 0.3 -1" castshadow="true"/>
<camera name="eye" pos="{position}" xyaxes="{axes}" fovy="{fovy}"/>
"""


def numbers(element, path, default):
    text = element.findtext(path)
    return [float(word) for word in text.split()] if text else default


def matrix(pose):
    """Rows of a rotation, and a position: fixed axes x, y, z as in SDFormat."""
    x, y, z, roll, pitch, yaw = pose
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a), math.cos(a)) for a in (roll, pitch, yaw))
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr], [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr]], [x, y, z]


def product(a, b):
    (A, p), (B, q) = a, b
    return ([[sum(A[r][k] * B[k][c] for k in range(3)) for c in range(3)] for r in range(3)],
            [p[r] + sum(A[r][k] * q[k] for k in range(3)) for r in range(3)])


def geom(visual, place):
    R, p = place
    axes = " ".join(f"{R[r][c]:.9f}" for c in (0, 1) for r in range(3))
    rgb = numbers(visual, "material/diffuse", [0.7, 0.7, 0.7, 1])
    shape = visual.find("geometry")[0]
    if shape.tag == "plane":
        kind, size = "plane", [half / 2 for half in numbers(shape, "size", [200, 200])] + [1]
    elif shape.tag == "box":
        kind, size = "box", [side / 2 for side in numbers(shape, "size", [1, 1, 1])]
    elif shape.tag == "sphere":
        kind, size = "sphere", numbers(shape, "radius", [1])
    else:
        kind, size = "cylinder", [*numbers(shape, "radius", [1]), numbers(shape, "length", [1])[0] / 2]
    return (f'<geom type="{kind}" size="{" ".join(map(str, size))}" pos="{" ".join(map(str, p))}" xyaxes="{axes}" '
            f'rgba="{" ".join(map(str, rgb))}"/>\n')


def mjcf_of(file, width, height):
    """All of the world at its start, for an image of this size."""
    geoms, first = [], None
    for model in ElementTree.parse(file).getroot().find("world").findall("model"):
        X_WM = matrix(numbers(model, "pose", [0] * 6))
        if first is None and model.findtext("name", model.get("name")) == "car_0":
            first = product(X_WM, matrix(numbers(model.find("link"), "pose", [0] * 6)))
        for link in model.findall("link"):
            X_WL = product(X_WM, matrix(numbers(link, "pose", [0] * 6)))
            geoms += [geom(visual, product(X_WL, matrix(numbers(visual, "pose", [0] * 6)))) for visual in link.findall("visual")]
    R, p = first
    right, up = [-R[r][1] for r in range(3)], [R[r][2] for r in range(3)]
    fovy = math.degrees(2 * math.atan(math.tan(0.6) * height / width))  # 1.2 rad across; degrees whatever <compiler> says
    return HEAD.format(width=width, height=height, position=f"{p[0]} {p[1]} {p[2] + 0.4}",
                       axes=" ".join(map(str, right + up)), fovy=fovy) + "".join(geoms) + "</worldbody></mujoco>"
