"""The reports of `roboss analyse`: figures as tables and pictures, with the names of their formulas."""
from __future__ import annotations

from typing import Optional, Sequence

import numpy as np

from ..robots import Floats
from . import pictures, vehicle, walker
from .arm import Condition
from .recording import Recording
from .report import Report

_MM, _DEG = 1e3, 180 / np.pi


def arm_report(title: str, conditions: Sequence[Condition], facts: Sequence[tuple[str, str]] = (),
               stiffness: Optional[tuple[Floats, Floats, Floats]] = None,
               exchange: Sequence[tuple[str, float]] = ()) -> Report:
    """Figures by ISO 9283 of one or more conditions."""
    report = Report(title, "Performance criteria by ISO 9283:1998. Formulas and their sources: docs/analysis.md.")
    if facts:
        report.table("Conditions of the test", ["What", "Value"], facts)
    if len(conditions) > 1:
        report.heading("Summary")
        report.table("Worst values of each condition", ["Condition", "AP [mm]", "RP [mm]", "AT [mm]", "RT [mm]", "AD [mm]",
                                                        "RD [mm]", "Settling [s]", "Overshoot [mm]"],
                     [_worst(condition) for condition in conditions])
        report.picture(pictures.on_page(lambda one, two: _bars(one, two, conditions), 7.5, 2.8, 2),
                       "Accuracy (AP) and repeatability (RP) at the test poses, by condition.")
    for condition in conditions:
        if condition.name:
            report.heading(condition.name)
        _condition(report, condition)
    if exchange:
        report.heading("Exchangeability")
        report.table("Exchangeability (E)", ["Pose", "E [mm]"], [[name, _MM * value] for name, value in exchange],
                     "Largest distance between the mean positions of the arms.")
    if stiffness is not None:
        _stiffness(report, *stiffness)
    return report


def _worst(condition: Condition) -> list:
    paths, distances = condition.paths, condition.distances
    nothing = float("nan")
    return [condition.name, _MM * max(p.score.accuracy for p in condition.poses),
            _MM * max(p.score.repeatability for p in condition.poses),
            _MM * max((p.accuracy for p in paths), default=nothing), _MM * max((p.repeatability for p in paths), default=nothing),
            _MM * distances[0][1] if distances else nothing, _MM * distances[0][2] if distances else nothing,
            max(p.settling_time for p in condition.poses), _MM * max(p.overshoot for p in condition.poses)]


def _condition(report: Report, condition: Condition) -> None:
    mark = f" – {condition.name}" if condition.name else ""
    report.table("Pose accuracy (AP) and repeatability (RP)" + mark,
                 ["Pose", "Visits", "AP [mm]", "AP x [mm]", "AP y [mm]", "AP z [mm]", "RP [mm]", "AP abc [deg]", "RP abc [deg]",
                  "Settling [s]", "Overshoot [mm]"],
                 [[p.name, len(p.attained), _MM * p.score.accuracy, *(_MM * p.score.accuracy_xyz), _MM * p.score.repeatability,
                   _DEG * float(np.abs(p.score.accuracy_abc).max()), _DEG * float(p.score.repeatability_abc.max()),
                   p.settling_time, _MM * p.overshoot] for p in condition.poses],
                 "AP abc and RP abc: the largest of the three angles. Settling: pose stabilisation time; – : not at rest at the end.")
    report.picture(pictures.on_page(lambda one, two: _clouds(one, two, condition), 7.5, 3.4, 2),
                   "Attained less commanded positions at the test poses, and the circle of repeatability about their mean.")
    if condition.distances:
        report.table("Distance accuracy (AD) and repeatability (RD)" + mark, ["Poses", "AD [mm]", "RD [mm]"],
                     [[name, _MM * accuracy, _MM * spread] for name, accuracy, spread in condition.distances])
    if condition.paths:
        report.table("Path accuracy (AT) and repeatability (RT)" + mark, ["Path", "Runs", "AT [mm]", "RT [mm]",
                                                                        "Largest speed [m/s]"],
                     [[p.name, p.runs, _MM * p.accuracy, _MM * p.repeatability, p.speed] for p in condition.paths])
    _drift_and_corners(report, condition, mark)
    if condition.arrivals:
        report.picture(pictures.on_page(lambda axes: _arrivals(axes, condition), 7.5, 2.6),
                       "The last arrival at each pose: distance from where it comes to rest, from the end of the command.")


def _drift_and_corners(report: Report, condition: Condition, mark: str) -> None:
    drifts = [(pose.name, pose.drift) for pose in condition.poses if pose.drift]
    if drifts:
        report.table("Drift (dAP, dRP)" + mark, ["Pose", "dAP [mm]", "dRP [mm]", "dAP abc [deg]", "dRP abc [deg]", "Moved [mm]"],
                     [[name, _MM * d.accuracy, _MM * d.repeatability, _DEG * float(d.accuracy_abc.max()),
                       _DEG * float(d.repeatability_abc.max()), _MM * d.moved] for name, d in drifts],
                     "From the first visits to the last ones. Moved: distance between their mean positions.")
    if condition.corners:
        report.table("Cornering round-off error (CR) and overshoot (CO)" + mark, ["Corner [m]", "Runs", "CR [mm]", "CO [mm]"],
                     [[" ".join(f"{x:.3f}" for x in c.place), c.runs, _MM * c.round_off, _MM * c.overshoot]
                      for c in condition.corners])


def _bars(one, two, conditions: Sequence[Condition]) -> None:
    width = 0.8 / len(conditions)
    for number, condition in enumerate(conditions):
        places = np.arange(len(condition.poses)) + (number - (len(conditions) - 1) / 2) * width
        for axes, values in ((one, [p.score.accuracy for p in condition.poses]),
                             (two, [p.score.repeatability for p in condition.poses])):
            axes.bar(places, _MM * np.array(values), width * 0.9, label=condition.name)
    for axes, what in ((one, "AP [mm]"), (two, "RP [mm]")):
        axes.set_xticks(range(len(conditions[0].poses)), [p.name for p in conditions[0].poses])
        axes.set_ylabel(what)
        axes.grid(axis="x", visible=False)
    one.figure.legend(*one.get_legend_handles_labels(), loc="outside lower center", ncols=min(4, len(conditions)), fontsize=8)


def _clouds(one, two, condition: Condition) -> None:
    for number, pose in enumerate(condition.poses):
        errors = _MM * (pose.attained[:, :3] - pose.commanded[:3])
        for axes, columns, names in ((one, [0, 1], ("x [mm]", "y [mm]")), (two, [0, 2], ("x [mm]", "z [mm]"))):
            pictures.scatter(axes, errors[:, columns], _MM * pose.score.repeatability, names, number, pose.name)
    for axes in (one, two):
        axes.plot(0, 0, "+", color=pictures._INK, markersize=9)
    one.figure.legend(*one.get_legend_handles_labels(), loc="outside lower center", ncols=8, fontsize=8, markerscale=2)


def _arrivals(axes, condition: Condition) -> None:
    for name, (time, distance) in condition.arrivals.items():
        axes.semilogy(time, _MM * np.maximum(distance, 1e-9), label=name)
    axes.set_xlabel("time after the command's arrival [s]")
    axes.set_ylabel("distance [mm]")
    axes.legend(ncols=5, fontsize=8)


def _stiffness(report: Report, forces: Floats, moved: Floats, values: Floats) -> None:
    report.heading("Static compliance")
    report.table("Static compliance at P1 with the rated load", ["Direction", "Compliance [mm/N]",
                                                                f"Displacement [mm at {forces[-1]:g} N]"],
                 [[axis, _MM * value, _MM * row[-1]] for axis, value, row in zip("xyz", values, moved)])

    def draw(axes):
        for axis, row in zip("xyz", moved):
            axes.plot(forces, _MM * row, "o-", markersize=3, label=axis)
        axes.set_xlabel("force [N]")
        axes.set_ylabel("displacement [mm]")
        axes.legend(ncols=3)
    report.picture(pictures.on_page(draw, 5, 2.4), "Displacement of the tool along the force.")


def vehicle_report(title: str, facts: Sequence[tuple[str, str]], circle: tuple[Recording, vehicle.CircleScore],
                   stop: tuple[Recording, vehicle.StopScore], weave: tuple[Recording, vehicle.WeaveScore],
                   squares: tuple[list[Recording], vehicle.UmbmarkScore]) -> Report:
    """Figures of the test drives."""
    report = Report(title, "Circle, stop and weave in the manner of ISO 4138, ISO 21994 and ISO 13674-1; odometry by UMBmark "
                           "(Borenstein and Feng, 1996). Formulas and their sources: docs/analysis.md.")
    report.table("Vehicle", ["What", "Value"], facts)
    report.heading("Circle")
    c = circle[1]
    report.table("Steady circle", ["Radius [m]", "Speed [m/s]", "Yaw rate [rad/s]", "Lateral acceleration [m/s²]",
                                   "Spread of the radius [mm]"],
                 [[c.radius, c.speed, c.yaw_rate, c.lateral_acceleration, _MM * c.radius_spread]])
    report.heading("Stop")
    s = stop[1]
    report.table("Stop on a straight line", ["Speed [m/s]", "Distance [m]", "Time [s]", "Mean deceleration [m/s²]",
                                             "Deviation [mm]"],
                 [[s.speed, s.distance, s.time, s.mean_deceleration, _MM * s.deviation]])
    report.heading("Weave")
    w = weave[1]
    report.table("Weave (slalom)", ["Yaw rate gain", "Lag [s]", "Peak yaw rate [rad/s]", "Peak lateral acceleration [m/s²]"],
                 [[w.gain, w.lag, w.yaw_rate, w.lateral_acceleration]])
    report.picture(pictures.on_page(lambda *axes: _drives(axes, circle[0], stop[0], weave[0]), 8, 2.8, 3),
                   "Path of the circle, speed of the stop, yaw rate of the weave.")
    report.heading("Odometry: UMBmark")
    u = squares[1]
    report.table("UMBmark", ["E max,syst [mm]", "x cw [mm]", "y cw [mm]", "x ccw [mm]", "y ccw [mm]", "alpha [deg]",
                             "beta [deg]", "E_d", "E_b"],
                 [[_MM * u.max_systematic, *(_MM * u.center_cw), *(_MM * u.center_ccw), _DEG * u.alpha, _DEG * u.beta,
                   u.wheel_ratio, u.track_ratio]],
                 "E_d: ratio of the wheels' diameters, right over left. E_b: actual over nominal track; far from 1 where wheels "
                 "slip sideways in turns.")
    report.picture(pictures.on_page(lambda axes: _squares(axes, squares[0]), 4.5, 4), "The squares as they were driven.")
    return report


def _drives(axes, circle: Recording, stop: Recording, weave: Recording) -> None:
    axes[0].plot(*circle["xy"].T)
    axes[0].set_aspect("equal", adjustable="datalim")
    axes[0].set_xlabel("x [m]")
    axes[0].set_ylabel("y [m]")
    for name, label in (("command.speed", "commanded"), ("speed", "driven")):
        axes[1].plot(stop.time, stop[name], label=label)
    axes[1].set_ylabel("speed [m/s]")
    axes[2].plot(weave.time, weave["command.yaw_rate"], label="commanded")
    axes[2].plot(weave.time, np.gradient(np.unwrap(weave["yaw"]), weave.time), label="driven")
    axes[2].set_ylabel("yaw rate [rad/s]")
    for one in axes[1:]:
        one.set_xlabel("time [s]")
        one.legend(fontsize=7)


def _squares(axes, squares: Sequence[Recording]) -> None:
    for number, square in enumerate(squares):
        axes.plot(*square["xy"].T, linewidth=0.8, color=pictures.COLORS[number * 2 // len(squares)])
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")


def walker_report(title: str, facts: Sequence[tuple[str, str]], time: Floats, transport: Optional[walker.TransportScore],
                  demands: dict[str, tuple[walker.JointDemand, str]], power: Floats) -> Report:
    """Cost of transport, and the demand of each joint by name with the unit of its effort ("N m", "N", or "")."""
    report = Report(title, "Which motor does each joint need, and what does it cost to walk? Formulas and their sources: "
                           "docs/analysis.md.")
    report.table("Recording", ["What", "Value"], facts)
    if transport is not None:
        report.heading("Cost of transport")
        report.table("Mechanical cost of transport", ["Cost", "With recovery", "Distance [m]", "Speed [m/s]",
                                                      "Positive work [J]", "Mean power [W]"],
                     [[transport.cost, transport.cost_net, transport.distance, transport.speed, transport.energy,
                       transport.power]])
    report.heading("Joints")
    units = {unit for _, unit in demands.values()}  # "": not known, as in a table
    effort, speed = ("N m", "rad/s") if "N m" in units else ("N", "m/s") if "N" in units else ("N m or N", "rad/s or m/s")
    columns = ["Joint", f"rms [{effort}]", f"50 % [{effort}]", f"95 % [{effort}]", f"99 % [{effort}]", f"peak [{effort}]",
               f"speed 95 % [{speed}]", f"peak speed [{speed}]", "power rms [W]", "peak power [W]", "mean power [W]"]
    rows = []
    for joint, (d, unit) in demands.items():
        rows.append([joint + ("" if unit in ("", effort) else f" ({unit})"), d.effort_rms, *d.effort_quantiles, d.effort_peak,
                     d.speed_quantiles[1], d.speed_peak, d.power_rms, d.power_peak, d.power_mean])
    report.table("Demand of each joint", columns, rows,
                 "A motor with its gear needs a continuous torque above rms, a peak torque above the peak, a speed above the "
                 "peak speed. Quantiles are of magnitudes over time.")
    report.picture(pictures.on_page(lambda axes: _demand(axes, demands), 8, 0.9 + 0.22 * len(demands)),
                   "Torque of each joint: rms (bar), 99 % (line) and peak (dot).")
    report.picture(pictures.on_page(lambda axes: _power(axes, time, power), 8, 2.4), "Mechanical power of all joints together.")
    return report


def _demand(axes, demands: dict[str, tuple[walker.JointDemand, str]]) -> None:
    names, scores = list(demands), [d for d, _ in demands.values()]
    places = np.arange(len(names))[::-1]
    axes.barh(places, [d.effort_rms for d in scores], 0.6)
    axes.hlines(places, 0, [d.effort_quantiles[2] for d in scores], linewidth=1)
    axes.plot([d.effort_peak for d in scores], places, ".", color=pictures.COLORS[1])
    axes.set_yticks(places, names, fontsize=7)
    axes.set_ylim(-0.8, len(names) - 0.2)
    axes.set_xlabel("torque [N m]")


def _power(axes, time: Floats, power: Floats) -> None:
    axes.plot(time, power.sum(axis=1))
    axes.set_xlabel("time [s]")
    axes.set_ylabel("power [W]")
