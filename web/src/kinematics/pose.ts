// Poses as seven numbers in a row (x y z qw qx qy qz) inside larger arrays, so that thousands are composed in a frame
// without an object each. q and -q are the same rotation.

export type Numbers = Float32Array | Float64Array | number[];

export const POSE_WIDTH = 7;
export const IDENTITY: readonly number[] = [0, 0, 0, 1, 0, 0, 0];

/** out = a * b: frame b, given in frame a. `out` may be a or b. */
export function compose(out: Numbers, o: number, a: Numbers, i: number, b: Numbers, j: number): void {
    const aw = a[i + 3],
        ax = a[i + 4],
        ay = a[i + 5],
        az = a[i + 6];
    const bw = b[j + 3],
        bx = b[j + 4],
        by = b[j + 5],
        bz = b[j + 6];
    const px = b[j],
        py = b[j + 1],
        pz = b[j + 2];
    const tx = 2 * (ay * pz - az * py),
        ty = 2 * (az * px - ax * pz),
        tz = 2 * (ax * py - ay * px);
    out[o] = a[i] + px + aw * tx + ay * tz - az * ty;
    out[o + 1] = a[i + 1] + py + aw * ty + az * tx - ax * tz;
    out[o + 2] = a[i + 2] + pz + aw * tz + ax * ty - ay * tx;
    out[o + 3] = aw * bw - ax * bx - ay * by - az * bz;
    out[o + 4] = aw * bx + ax * bw + ay * bz - az * by;
    out[o + 5] = aw * by - ax * bz + ay * bw + az * bx;
    out[o + 6] = aw * bz + ax * by - ay * bx + az * bw;
}

export function composed(a: Numbers | readonly number[], b: Numbers | readonly number[]): number[] {
    const out = new Array<number>(POSE_WIDTH).fill(0);
    compose(out, 0, a as number[], 0, b as number[], 0);
    return out;
}

export function inverse(a: readonly number[] | Numbers): number[] {
    const back = [0, 0, 0, a[3], -a[4], -a[5], -a[6]];
    const p = rotate(back, [-a[0], -a[1], -a[2]]);
    return [p[0], p[1], p[2], back[3], back[4], back[5], back[6]];
}

/** The vector turned by the pose's rotation. */
export function rotate(a: readonly number[] | Numbers, v: readonly number[]): [number, number, number] {
    const w = a[3],
        x = a[4],
        y = a[5],
        z = a[6];
    const tx = 2 * (y * v[2] - z * v[1]),
        ty = 2 * (z * v[0] - x * v[2]),
        tz = 2 * (x * v[1] - y * v[0]);
    return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx];
}

export function transform(a: readonly number[] | Numbers, p: readonly number[]): [number, number, number] {
    const r = rotate(a, p);
    return [r[0] + a[0], r[1] + a[1], r[2] + a[2]];
}

/** A column-major 4x4 matrix, as WebGL reads it. */
export function writeMatrix(out: Float32Array, o: number, a: Numbers, i: number): void {
    const w = a[i + 3],
        x = a[i + 4],
        y = a[i + 5],
        z = a[i + 6];
    const x2 = x + x,
        y2 = y + y,
        z2 = z + z;
    const xx = x * x2,
        xy = x * y2,
        xz = x * z2,
        yy = y * y2,
        yz = y * z2,
        zz = z * z2;
    const wx = w * x2,
        wy = w * y2,
        wz = w * z2;
    out[o] = 1 - yy - zz;
    out[o + 1] = xy + wz;
    out[o + 2] = xz - wy;
    out[o + 3] = 0;
    out[o + 4] = xy - wz;
    out[o + 5] = 1 - xx - zz;
    out[o + 6] = yz + wx;
    out[o + 7] = 0;
    out[o + 8] = xz + wy;
    out[o + 9] = yz - wx;
    out[o + 10] = 1 - xx - yy;
    out[o + 11] = 0;
    out[o + 12] = a[i];
    out[o + 13] = a[i + 1];
    out[o + 14] = a[i + 2];
    out[o + 15] = 1;
}

export function fromAxisAngle(axis: readonly number[], angle: number): number[] {
    const s = Math.sin(angle / 2);
    return [0, 0, 0, Math.cos(angle / 2), axis[0] * s, axis[1] * s, axis[2] * s];
}

/** Roll, pitch and yaw about fixed axes, as SDFormat writes them. */
export function toRollPitchYaw(a: readonly number[] | Numbers): [number, number, number] {
    const w = a[3],
        x = a[4],
        y = a[5],
        z = a[6];
    const sine = Math.max(-1, Math.min(1, 2 * (w * y - z * x)));
    return [
        Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        Math.asin(sine),
        Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    ];
}

/** Shortest way from the rotation at a[i..] to that at b[j..], f in 0..1; normalised linear where they are close. */
export function slerp(out: Numbers, o: number, a: Numbers, i: number, b: Numbers, j: number, f: number): void {
    let dot = a[i] * b[j] + a[i + 1] * b[j + 1] + a[i + 2] * b[j + 2] + a[i + 3] * b[j + 3];
    const sign = dot < 0 ? -1 : 1;
    dot *= sign;
    let s = 1 - f,
        t = f * sign;
    if (dot < 0.9995) {
        const angle = Math.acos(dot),
            whole = Math.sin(angle);
        s = Math.sin((1 - f) * angle) / whole;
        t = (sign * Math.sin(f * angle)) / whole;
    }
    const w = s * a[i] + t * b[j],
        x = s * a[i + 1] + t * b[j + 1];
    const y = s * a[i + 2] + t * b[j + 2],
        z = s * a[i + 3] + t * b[j + 3];
    const scale = 1 / (Math.sqrt(w * w + x * x + y * y + z * z) || 1);
    out[o] = w * scale;
    out[o + 1] = x * scale;
    out[o + 2] = y * scale;
    out[o + 3] = z * scale;
}

/** The quaternion w x y z of roll, pitch and yaw about fixed axes. */
export function quaternionOf(roll: number, pitch: number, yaw: number): [number, number, number, number] {
    const turned = composed(
        fromAxisAngle([0, 0, 1], yaw),
        composed(fromAxisAngle([0, 1, 0], pitch), fromAxisAngle([1, 0, 0], roll)),
    );
    return [turned[3], turned[4], turned[5], turned[6]];
}
