// Which variables of which robots are drawn over time, and their last minutes. Time that goes back (a rewind) cuts what
// lies behind it.
import type { RobotReport } from "../wire/messages";
import { readings } from "./readings";
import { Signal } from "./signal";
import type { ViewerState } from "./viewer_state";

const POINTS_MAX = 1800;
export const CURVES_MAX = 12;

export interface Curve {
    robot: number;
    robotName: string;
    key: string;
    label: string;
    unit: string;
    times: number[];
    values: (number | null)[];
}

export function append(
    curve: { times: number[]; values: (number | null)[] },
    time: number,
    value: number | null,
): void {
    const { times, values } = curve;
    while (times.length > 0 && times[times.length - 1] >= time) {
        times.pop();
        values.pop();
    }
    times.push(time);
    values.push(value);
    if (times.length > POINTS_MAX) {
        times.splice(0, times.length - POINTS_MAX);
        values.splice(0, values.length - POINTS_MAX);
    }
}

export class Plotted {
    readonly curves = new Signal<readonly Curve[]>([]);
    /** Grows with every point. */
    readonly grown = new Signal(0);

    constructor(private readonly state: ViewerState) {
        state.report.follow((report) => report !== null && this.take(report));
        state.world.follow(() => this.keepKnown());
    }

    has(robot: number, key: string): boolean {
        return this.curves.value.some((curve) => curve.robot === robot && curve.key === key);
    }

    /** Draws the variable, or no longer. */
    toggle(robot: number, key: string, label: string, unit: string): boolean {
        const others = this.curves.value.filter((curve) => curve.robot !== robot || curve.key !== key);
        if (others.length < this.curves.value.length) this.set(others);
        else if (others.length < CURVES_MAX)
            this.set([
                ...others,
                {
                    robot,
                    robotName: this.state.world.value?.fleet.name(robot) ?? "",
                    key,
                    label,
                    unit,
                    times: [],
                    values: [],
                },
            ]);
        else return false;
        return true;
    }

    clear(): void {
        this.set([]);
    }

    private set(curves: readonly Curve[]): void {
        this.curves.set(curves);
        this.state.pinned.set([...new Set(curves.map((curve) => curve.robot))]);
    }

    private take(report: RobotReport): void {
        const mine = this.curves.value.filter((curve) => curve.robot === report.robot),
            world = this.state.world.value;
        if (mine.length === 0 || world === null || report.robot >= world.fleet.count) return;
        const all = readings(world.fleet.type(report.robot), report),
            values = new Map<string, number | null>();
        for (const one of [...all.base, ...all.joints, ...all.sensors.flat()]) values.set(one.key, one.value);
        for (const curve of mine) append(curve, report.time, values.get(curve.key) ?? null);
        this.grown.set(this.grown.value + 1);
    }

    private keepKnown(): void {
        const fleet = this.state.world.value?.fleet;
        if (fleet === undefined || this.curves.value.length === 0) return;
        const kept: Curve[] = [];
        for (const curve of this.curves.value) {
            const robot = fleet.find(curve.robotName);
            if (robot !== undefined) kept.push({ ...curve, robot });
        }
        this.set(kept);
    }
}
