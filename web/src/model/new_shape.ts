// A shape as an SDF model: what `Add a shape` sends to the run.

export type ShapeKind = "box" | "sphere" | "cylinder";

export interface NewShape {
    kind: ShapeKind;
    /** m; of a box: along x, y, z; of a sphere: the radius; of a cylinder: radius and length. */
    sizes: readonly number[];
    /** kg */
    mass: number;
    /** "#rrggbb" */
    colour: string;
}

export const SIZES: Record<ShapeKind, readonly [string, number][]> = {
    box: [
        ["Length (x)", 0.4],
        ["Width (y)", 0.4],
        ["Height (z)", 0.4],
    ],
    sphere: [["Radius", 0.2]],
    cylinder: [
        ["Radius", 0.2],
        ["Length (z)", 0.4],
    ],
};

/** What is wrong with it; empty: nothing. */
export function shapeFault({ kind, sizes, mass, colour }: NewShape): string {
    const within = (value: number, most: number) => Number.isFinite(value) && value > 0 && value <= most;
    if (sizes.length !== SIZES[kind].length || !sizes.every((size) => within(size, 1000)))
        return "Sizes are numbers above 0 and up to 1000 m.";
    if (!within(mass, 1e6)) return "The mass is a number above 0 and up to 1000000 kg.";
    return /^#[0-9a-f]{6}$/i.test(colour) ? "" : "The colour is no colour.";
}

/** m, from its origin down to what it stands on. */
export function halfHeight({ kind, sizes }: NewShape): number {
    return kind === "box" ? sizes[2] / 2 : kind === "sphere" ? sizes[0] : sizes[1] / 2;
}

/** Principal moments about the centre, kg m^2. */
export function moments({ kind, sizes, mass }: NewShape): [number, number, number] {
    if (kind === "sphere") {
        const moment = 0.4 * mass * sizes[0] ** 2;
        return [moment, moment, moment];
    }
    if (kind === "cylinder") {
        const [radius, length] = sizes,
            across = (mass * (3 * radius ** 2 + length ** 2)) / 12;
        return [across, across, 0.5 * mass * radius ** 2];
    }
    const [x, y, z] = sizes.map((size) => size ** 2);
    return [(mass * (y + z)) / 12, (mass * (x + z)) / 12, (mass * (x + y)) / 12];
}

function geometry({ kind, sizes }: NewShape): string {
    if (kind === "box") return `<box><size>${sizes.join(" ")}</size></box>`;
    if (kind === "sphere") return `<sphere><radius>${sizes[0]}</radius></sphere>`;
    return `<cylinder><radius>${sizes[0]}</radius><length>${sizes[1]}</length></cylinder>`;
}

function escaped(text: string): string {
    return text.replace(/[&<>"']/g, (letter) => `&#${letter.charCodeAt(0)};`);
}

export function shapeSdf(shape: NewShape, name: string): string {
    const [xx, yy, zz] = moments(shape),
        rgb = [1, 3, 5].map((at) => (Number.parseInt(shape.colour.slice(at, at + 2), 16) / 255).toFixed(4)),
        colour = `${rgb.join(" ")} 1`;
    return `<?xml version="1.0"?>
<sdf version="1.9">
  <model name="${escaped(name)}">
    <link name="link">
      <inertial>
        <mass>${shape.mass}</mass>
        <inertia><ixx>${xx}</ixx><iyy>${yy}</iyy><izz>${zz}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
      </inertial>
      <collision name="collision"><geometry>${geometry(shape)}</geometry></collision>
      <visual name="visual">
        <geometry>${geometry(shape)}</geometry>
        <material><ambient>${colour}</ambient><diffuse>${colour}</diffuse></material>
      </visual>
    </link>
  </model>
</sdf>
`;
}
