// The robots of one scene as flat arrays: of which type each is and where its joint coordinates lie. Made once a scene.
import type { SceneInfo, TypeInfo } from "../wire/messages";

/** How a joint coordinate is interpolated: along a line, around a circle, or as part of a quaternion. */
export const enum Course {
    Line,
    Circle,
    QuaternionStart,
    QuaternionRest,
}

function courses(type: TypeInfo, count: number): Uint8Array {
    const found = new Uint8Array(count).fill(Course.Circle);
    for (const body of type.bodies) {
        if (body.course === "line") found[body.q] = Course.Line;
        if (body.course !== "quaternion") continue;
        found[body.q] = Course.QuaternionStart;
        for (let k = 1; k < 4; ++k) found[body.q + k] = Course.QuaternionRest;
    }
    return found;
}

/** Joint coordinates of a type, as its bodies count them. */
export function coordinateCount(type: TypeInfo): number {
    let count = 0;
    for (const body of type.bodies) count = Math.max(count, body.width > 0 ? body.q + body.width : 0);
    return count;
}

export class Fleet {
    readonly count: number;
    readonly typeOf: Uint16Array;
    /** Where a robot's joint coordinates start; one more entry than robots. */
    readonly firstCoordinate: Uint32Array;
    readonly courses: Uint8Array[];
    readonly ranges: Float64Array[];
    private readonly byName = new Map<string, number>();

    constructor(readonly scene: SceneInfo) {
        this.count = scene.robots.length;
        this.typeOf = new Uint16Array(this.count);
        this.firstCoordinate = new Uint32Array(this.count + 1);
        const widths = scene.types.map(coordinateCount);
        this.courses = scene.types.map((type, k) => courses(type, widths[k]));
        this.ranges = scene.types.map((type, k) =>
            Float64Array.from({ length: widths[k] }, (_, q) => type.ranges?.[q] ?? Math.PI),
        );
        scene.robots.forEach((robot, r) => {
            this.typeOf[r] = robot.type;
            this.firstCoordinate[r + 1] = this.firstCoordinate[r] + widths[robot.type];
            this.byName.set(robot.name, r);
        });
    }

    get coordinates(): number {
        return this.firstCoordinate[this.count];
    }

    type(robot: number): TypeInfo {
        return this.scene.types[this.typeOf[robot]];
    }

    name(robot: number): string {
        return this.scene.robots[robot]?.name ?? "";
    }

    find(name: string): number | undefined {
        return this.byName.get(name);
    }
}
