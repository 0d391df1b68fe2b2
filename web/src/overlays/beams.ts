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

/** Of one sensor, in the picture: a lidar of 64 x 1024 beams stays readable, and fast. */
export const RAYS_MAX = 120;
export const HITS_MAX = 12_000;

/**
 * How opaque a ray is at the sensor, relative to its end. Many rays lie close together there: they begin faint, so that the
 * fan is as dense everywhere and what is behind it is seen.
 */
export function beginOpacity(rays: number): number {
    return Math.max(0, Math.min(0.6, 8 / Math.max(1, rays) - 0.07));
}

/**
 * Which beams of a sensor are drawn, at most `most` of them: every n-th of each row and every m-th row, so that what is
 * left is as dense in both directions.
 */
export function thinned(sensor: SensorInfo, count: number, most: number): (beam: number) => boolean {
    if (count <= most) return () => true;
    const rows = Math.max(1, Math.min(sensor.vertical_samples ?? 1, count)),
        columns = Math.max(1, Math.floor(count / rows)),
        rowStep = Math.max(1, Math.ceil(rows / Math.max(1, Math.sqrt(most / 4)))),
        rowsLeft = Math.ceil(rows / rowStep),
        columnStep = Math.max(1, Math.ceil(columns / Math.max(1, Math.floor(most / rowsLeft))));
    return (beam) => Math.floor(beam / columns) % rowStep === 0 && (beam % columns) % columnStep === 0;
}
