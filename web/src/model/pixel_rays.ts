// Which way a pixel of a camera looks. Camera frame: x ahead, y left, z up; the lens is that of src/render/lens.cpp:
// pinhole, with the distortion of Brown and Conrady, which is undone by Newton's method.

/** For each pixel y and z at x = 1, in the camera's frame; NaN where the lens shows nothing. */
export function pixelRays(
    columns: number,
    rows: number,
    [fx, fy, cx, cy]: readonly number[],
    distortion: readonly number[],
): Float32Array {
    const rays = new Float32Array(2 * columns * rows);
    for (let row = 0; row < rows; ++row)
        for (let column = 0; column < columns; ++column) {
            const [a, b] = undistorted((column + 0.5 - cx) / fx, (row + 0.5 - cy) / fy, distortion);
            rays.set([-a, -b], 2 * (row * columns + column));
        }
    return rays;
}

const STEPS = 20;

export function undistorted(a: number, b: number, distortion: readonly number[]): [number, number] {
    const [k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0] = distortion;
    if (k1 === 0 && k2 === 0 && p1 === 0 && p2 === 0 && k3 === 0) return [a, b];
    let x = a,
        y = b;
    for (let i = 0; i < STEPS; ++i) {
        const rr = x * x + y * y,
            radial = 1 + rr * (k1 + rr * (k2 + rr * k3)),
            slope = 2 * (k1 + rr * (2 * k2 + rr * 3 * k3)),
            ex = x * radial + 2 * p1 * x * y + p2 * (rr + 2 * x * x) - a,
            ey = y * radial + p1 * (rr + 2 * y * y) + 2 * p2 * x * y - b;
        if (Math.abs(ex) + Math.abs(ey) < 1e-12) return [x, y];
        const xx = radial + x * x * slope + 2 * p1 * y + 6 * p2 * x,
            xy = x * y * slope + 2 * p1 * x + 2 * p2 * y,
            yy = radial + y * y * slope + 6 * p1 * y + 2 * p2 * x,
            det = xx * yy - xy * xy;
        if (Math.abs(det) < 1e-12) return [NaN, NaN];
        x -= (yy * ex - xy * ey) / det;
        y -= (xx * ey - xy * ex) / det;
    }
    return [NaN, NaN];
}

/** Points of a depth picture in the camera's frame, and which pixel each is. */
export function cloudOf(depths: Float32Array, rays: Float32Array): { points: Float32Array; pixels: Uint32Array } {
    const points = new Float32Array(3 * depths.length),
        pixels = new Uint32Array(depths.length);
    let used = 0;
    for (let i = 0; i < depths.length; ++i) {
        const x = depths[i],
            y = rays[2 * i] * x,
            z = rays[2 * i + 1] * x;
        if (!Number.isFinite(x) || !Number.isFinite(y) || !Number.isFinite(z)) continue;
        points.set([x, y, z], 3 * used);
        pixels[used++] = i;
    }
    return { points: points.subarray(0, 3 * used), pixels: pixels.subarray(0, used) };
}
