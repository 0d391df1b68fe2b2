// The box of even density that has the mass and the inertia of a link: what its mass looks like to the simulator.

/** Eigenvalues and eigenvectors (columns of `axes`) of a symmetric 3 x 3 matrix, by Jacobi rotations. */
export function principal(matrix: readonly (readonly number[])[]): { values: number[]; axes: number[][] } {
    const a = matrix.map((row) => [...row]),
        axes = [
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
        ];
    for (let sweep = 0; sweep < 30; ++sweep)
        for (const [p, q] of [
            [0, 1],
            [0, 2],
            [1, 2],
        ]) {
            if (Math.abs(a[p][q]) < 1e-15 * (Math.abs(a[p][p]) + Math.abs(a[q][q]))) continue;
            const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]),
                t = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.hypot(theta, 1)),
                c = 1 / Math.hypot(t, 1),
                s = t * c;
            for (let k = 0; k < 3; ++k) [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
            for (let k = 0; k < 3; ++k) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
            for (const row of axes) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
        }
    return { values: [a[0][0], a[1][1], a[2][2]], axes };
}

/** `inertia`: xx, yy, zz, xy, xz, yz about the centre of mass. Sizes in m along the principal axes; twelve edges. */
export function inertiaBox(
    mass: number,
    inertia: readonly number[],
): { sizes: number[]; edges: [number[], number[]][] } {
    const [xx, yy, zz, xy, xz, yz] = inertia,
        { values, axes } = principal([
            [xx, xy, xz],
            [xy, yy, yz],
            [xz, yz, zz],
        ]),
        sum = values[0] + values[1] + values[2],
        sizes = values.map((value) => Math.sqrt(Math.max(0, (6 / mass) * (sum - 2 * value))));
    const corner = (signs: number[]) =>
        axes.map((row) => row.reduce((total, part, k) => total + (part * signs[k] * sizes[k]) / 2, 0));
    const edges: [number[], number[]][] = [];
    for (let axis = 0; axis < 3; ++axis)
        for (const u of [-1, 1])
            for (const v of [-1, 1]) {
                const signs = [0, 0, 0];
                signs[(axis + 1) % 3] = u;
                signs[(axis + 2) % 3] = v;
                edges.push([
                    corner(signs.map((sign, k) => (k === axis ? -1 : sign))),
                    corner(signs.map((sign, k) => (k === axis ? 1 : sign))),
                ]);
            }
    return { sizes, edges };
}
