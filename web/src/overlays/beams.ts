// Directions of a laser's beams: from min_angle to max_angle about its z axis, rows of them about y.
import type { SensorInfo } from "../wire/messages";

function spread(from: number, to: number, count: number, k: number): number {
    return count <= 1 ? (from + to) / 2 : from + ((to - from) * k) / (count - 1);
}

/** Angle of column `k` about the sensor's z axis. */
export function beamAngle(sensor: SensorInfo, k: number): number {
    const columns = sensor.samples ?? 1;
    return columns <= 1 ? (sensor.min_angle ?? 0) : spread(sensor.min_angle ?? 0, sensor.max_angle ?? 0, columns, k);
}

/** Unit direction of beam `k` in the sensor's frame; beams run row by row. */
export function beamDirection(sensor: SensorInfo, k: number): [number, number, number] {
    const columns = sensor.samples ?? 1,
        rows = sensor.vertical_samples ?? 1,
        row = Math.floor(k / columns);
    const yaw = beamAngle(sensor, k % columns);
    const pitch =
        rows <= 1
            ? (sensor.vertical_min_angle ?? 0)
            : spread(sensor.vertical_min_angle ?? 0, sensor.vertical_max_angle ?? 0, rows, row);
    return [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)];
}
