// Every number that a robot's report holds, under a key that stays the same: what the inspector shows and plots draw.
import { toRollPitchYaw } from "../kinematics/pose";
import type { JointInfo, RobotReport, SensorInfo, SensorReport, TypeInfo } from "../wire/messages";

export interface Reading {
    key: string;
    label: string;
    unit: string;
    value: number | null;
}

const AXES = ["x", "y", "z"];
const DEGREES = 180 / Math.PI;

function baseReadings(report: RobotReport): Reading[] {
    const angles = toRollPitchYaw(report.pose),
        found: Reading[] = [];
    AXES.forEach((axis, k) => found.push({ key: `position.${axis}`, label: axis, unit: "m", value: report.pose[k] }));
    ["roll", "pitch", "yaw"].forEach((name, k) =>
        found.push({ key: `angle.${name}`, label: name, unit: "°", value: angles[k] * DEGREES }),
    );
    found.push({ key: "speed", label: "speed", unit: "m/s", value: Math.hypot(...report.linear) });
    AXES.forEach((axis, k) =>
        found.push({ key: `linear.${axis}`, label: `v ${axis}`, unit: "m/s", value: report.linear[k] }),
    );
    AXES.forEach((axis, k) =>
        found.push({ key: `angular.${axis}`, label: `ω ${axis}`, unit: "rad/s", value: report.angular[k] }),
    );
    return found;
}

/** Length or angle: the unit of an axis. */
export function axisUnit(joint: JointInfo, axis: number): string {
    return joint.units[axis] ?? "rad";
}

function jointReadings(type: TypeInfo, report: RobotReport): Reading[] {
    const found: Reading[] = [];
    type.joints.forEach((joint, j) => {
        const told = report.joints[j];
        for (let axis = 0; axis < joint.axes; ++axis) {
            const name = joint.axes > 1 ? `${joint.name} ${axis + 1}` : joint.name,
                key = `joint.${joint.name}.${axis}`,
                unit = axisUnit(joint, axis);
            found.push({
                key: `${key}.position`,
                label: `${name} position`,
                unit,
                value: told?.position[axis] ?? null,
            });
            found.push({
                key: `${key}.velocity`,
                label: `${name} velocity`,
                unit: `${unit}/s`,
                value: told?.velocity[axis] ?? null,
            });
            found.push({
                key: `${key}.effort`,
                label: `${name} effort`,
                unit: unit === "m" ? "N" : "N m",
                value: told?.motors?.[axis]?.effort ?? null,
            });
        }
    });
    return found;
}

const SENSOR_UNITS: Record<string, string> = {
    yaw: "rad",
    heading: "rad",
    distance: "m",
    speed: "m/s",
    roll: "rad",
    pitch: "rad",
};
const PLACE_NAMES = ["latitude", "longitude", "altitude"];
const COURSE_NAMES = ["east", "north", "up"];

/** What is not shown as it comes: parts of it are shown under other names. */
const SHOWN_OTHERWISE = ["ranges", "position", "velocity", "world", "taken"];

/** What a logical camera sees, with its distance, or a microphone hears, with its volume; null: another sensor. */
export function perceived(told: SensorReport): { name: string; value: number | null; unit: string }[] | null {
    const { names, positions, sources, volumes } = told,
        number = (value: unknown) => (typeof value === "number" ? value : null);
    if (Array.isArray(names) && Array.isArray(positions))
        return names.map((name, k) => {
            const place = positions.slice(3 * k, 3 * k + 3).map(number);
            return {
                name: String(name),
                value: place.includes(null) ? null : Math.hypot(...(place as number[])),
                unit: "m",
            };
        });
    if (Array.isArray(sources) && Array.isArray(volumes))
        return sources.map((name, k) => ({ name: String(name), value: number(volumes[k]), unit: "" }));
    return null;
}

function sensorReadings({ name, kind, units }: SensorInfo, told: SensorReport): Reading[] {
    const found: Reading[] = [],
        add = (field: string, unit: string, value: unknown) =>
            found.push({
                key: `sensor.${name}.${field}`,
                label: `${name} ${field}`,
                unit,
                value: typeof value === "number" ? value : null,
            });
    if (perceived(told) !== null) return found;
    if (kind === "contact") {
        const forces = Array.isArray(told.forces) ? told.forces.map(Number) : null,
            sum = AXES.map((_, k) => forces?.reduce((all, value, at) => (at % 3 === k ? all + value : all), 0) ?? null);
        add("force", "N", forces === null ? null : Math.hypot(...sum.map(Number)));
        AXES.forEach((axis, k) => add(`force ${axis}`, "N", sum[k]));
        add("points", "", forces === null ? null : forces.length / 3);
        return found;
    }
    if (Array.isArray(told.ranges)) {
        const met = told.ranges.filter((range): range is number => typeof range === "number" && Number.isFinite(range));
        add("nearest", "m", met.length > 0 ? Math.min(...met) : null);
    }
    if (Array.isArray(told.position)) {
        const names = told.geodetic === false ? AXES : PLACE_NAMES;
        told.position.forEach((value, k) =>
            add(names[k] ?? String(k), k < 2 && names === PLACE_NAMES ? "°" : "m", value),
        );
    }
    if (Array.isArray(told.velocity))
        told.velocity.forEach((value, k) => add(COURSE_NAMES[k] ?? String(k), "m/s", value));
    for (const [field, value] of Object.entries(told)) {
        const unit = units?.[field] ?? SENSOR_UNITS[field] ?? "";
        if (SHOWN_OTHERWISE.includes(field)) continue;
        if (typeof value === "number") add(field, unit, value);
        else if (Array.isArray(value) && value.length === 3)
            AXES.forEach((axis, k) => add(`${field} ${axis}`, unit, value[k]));
    }
    return found;
}

export function readings(
    type: TypeInfo,
    report: RobotReport,
): { base: Reading[]; joints: Reading[]; sensors: Reading[][] } {
    return {
        base: baseReadings(report),
        joints: jointReadings(type, report),
        sensors: type.sensors.map((sensor, k) => {
            const told = report.sensors[k];
            return told === null || told === undefined ? [] : sensorReadings(sensor, told);
        }),
    };
}

/** Values of the last commands; lists have no fixed values. */
export function channelReadings(type: TypeInfo, report: RobotReport): Reading[] {
    return (type.channels ?? []).flatMap((channel, k) =>
        channel.list
            ? []
            : channel.values.map((value, v) => ({
                  key: `channel.${channel.name}.${value.name}`,
                  label: `${channel.name} ${value.name}`,
                  unit: value.unit,
                  value: report.channels?.[k]?.values[v] ?? null,
              })),
    );
}

/** Everything that can be plotted. */
export function allReadings(type: TypeInfo, report: RobotReport): Reading[] {
    const { base, joints, sensors } = readings(type, report);
    return [...base, ...joints, ...sensors.flat(), ...channelReadings(type, report)];
}

/** The value of one key; null where the report has it not. */
export function readingOf(type: TypeInfo, report: RobotReport, key: string): number | null {
    const all = readings(type, report);
    return [...all.base, ...all.joints, ...all.sensors.flat()].find((one) => one.key === key)?.value ?? null;
}
