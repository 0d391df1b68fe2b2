// The way of a robot as its own sensors tell it: where each GPS receiver says it is, and what each odometer's way amounts
// to along the compass (along the robot's true heading where it has none), from where one began to look.
import { composed, inverse, toRollPitchYaw } from "../kinematics/pose";
import type { RobotReport, TypeInfo } from "../wire/messages";

const POINTS = 600;

export interface SensorWay {
    name: string;
    kind: "gps" | "odometer";
    /** x y z after each other, m. */
    points: number[];
}

interface Followed extends SensorWay {
    sensor: number;
    taken: number;
    /** Of the odometer at the last point. */
    distance: number;
    yaw: number;
}

export class SensorWays {
    private followed: Followed[] = [];
    private robot = -1;
    private time = 0;

    forget(): void {
        this.robot = -1;
        this.followed = [];
    }

    /** Empty where the robot has neither sensor. */
    get ways(): readonly SensorWay[] {
        return this.followed;
    }

    /** True: some way has grown. `height`: where an odometer's way is drawn. */
    take(type: TypeInfo, report: RobotReport, height: number): boolean {
        if (report.robot !== this.robot || report.time < this.time - 1e-9) this.begin(type, report.robot);
        this.time = report.time;
        let grown = false;
        for (const way of this.followed) {
            const told = report.sensors[way.sensor],
                taken = told?.taken ?? report.time;
            if (told === null || told === undefined || taken === way.taken) continue;
            const point = way.kind === "gps" ? told.world : this.reckoned(way, type, report, height);
            if (point === undefined || point.some((value) => typeof value !== "number")) continue;
            way.taken = taken;
            way.points.push(...point);
            if (way.points.length > 3 * POINTS) way.points.splice(0, way.points.length - 3 * POINTS);
            grown = true;
        }
        return grown;
    }

    private begin(type: TypeInfo, robot: number): void {
        this.robot = robot;
        this.followed = type.sensors.flatMap(({ name, kind }, sensor) =>
            kind === "gps" || kind === "odometer"
                ? [{ name, kind, points: [], sensor, taken: NaN, distance: 0, yaw: 0 } satisfies Followed]
                : [],
        );
    }

    /** The next point of an odometer's way: straight on in the mean direction since the last one. */
    private reckoned(way: Followed, type: TypeInfo, report: RobotReport, height: number): number[] | undefined {
        const distance = report.sensors[way.sensor]?.distance;
        if (typeof distance !== "number") return undefined;
        const yaw = headingOf(type, report),
            n = way.points.length,
            gone = n === 0 ? 0 : distance - way.distance,
            turned = Math.atan2(Math.sin(yaw - way.yaw), Math.cos(yaw - way.yaw)),
            along = n === 0 ? yaw : way.yaw + turned / 2,
            from = n === 0 ? report.pose : way.points.slice(n - 3);
        way.distance = distance;
        way.yaw = yaw;
        return [from[0] + gone * Math.cos(along), from[1] + gone * Math.sin(along), height];
    }
}

/** Of the link that carries the compass, or of the robot. */
function headingOf(type: TypeInfo, report: RobotReport): number {
    const compass = type.sensors.findIndex((sensor, k) => sensor.kind === "compass" && report.sensors[k]?.orientation),
        told = report.sensors[compass]?.orientation;
    if (told === undefined) return toRollPitchYaw(report.pose)[2];
    return toRollPitchYaw(composed([0, 0, 0, ...told], inverse(type.sensors[compass].frame)))[2];
}
