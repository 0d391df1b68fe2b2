// Which variables of which robots are drawn over time, in which plot, and their last minutes. Time that goes back (a
// rewind) cuts what lies behind it. The choice is kept for each world in the browser, and is part of the page's link.
import { WATCHED_ROBOTS_MAX } from "../protocol";
import type { RobotReport } from "../wire/messages";
import { type CurveData, type CurveName, formatPlots, parsePlots } from "./plot_data";
import { keep, kept } from "./kept";
import { allReadings } from "./readings";
import { Signal } from "./signal";
import type { ViewerState } from "./viewer_state";

/** Ten minutes at ten reports a second. */
const POINTS_MAX = 6000;
export const CURVES_MAX = 48;
/** One of the robots that the gateway reports is the selected one. */
export const ROBOTS_MAX = WATCHED_ROBOTS_MAX - 1;

export interface Curve extends CurveData {
    robot: number;
    plot: number;
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
    /** The plot that takes the next curve; null: the one of its unit. */
    readonly active = new Signal<number | null>(null);
    /** Grows with every point. */
    readonly grown = new Signal(0);
    private nextPlot = 1;
    private world = "";

    constructor(
        private readonly state: ViewerState,
        private readonly say: (text: string) => void,
        /** Plots of the page's address; they go before those that were kept. */
        private readonly asked: string | null = null,
    ) {
        state.report.follow((report) => report !== null && this.take(report));
        state.world.follow(() => this.onWorld());
    }

    has(robot: number, key: string): boolean {
        return this.curves.value.some((curve) => curve.robot === robot && curve.key === key);
    }

    /** Draws the variable, or no longer. False: there is no room. */
    toggle(robot: number, key: string, label: string, unit: string): boolean {
        const others = this.curves.value.filter((curve) => curve.robot !== robot || curve.key !== key);
        if (others.length < this.curves.value.length) this.set(others);
        else return this.add(robot, { robotName: this.name(robot), key, label, unit });
        return true;
    }

    remove(curve: Curve): void {
        this.set(this.curves.value.filter((one) => one !== curve));
    }

    clear(): void {
        this.active.set(null);
        this.set([]);
    }

    /** The next curve begins a plot of its own. */
    begin(): void {
        this.active.set(this.nextPlot++);
    }

    /** As a link has it; empty: nothing is plotted. */
    words(): string {
        const plots = [...new Set(this.curves.value.map((curve) => curve.plot))];
        return formatPlots(plots.map((plot) => this.curves.value.filter((curve) => curve.plot === plot)));
    }

    private name(robot: number): string {
        return this.state.world.value?.fleet.name(robot) ?? "";
    }

    private add(robot: number, name: CurveName): boolean {
        const before = this.curves.value,
            robots = new Set(before.map((curve) => curve.robot)).add(robot);
        if (robots.size > ROBOTS_MAX) {
            this.say(
                `Plots show at most ${ROBOTS_MAX} robots: the run reports ${WATCHED_ROBOTS_MAX} at a time, one of them ` +
                    "the selected robot. Remove the curves of another robot first.",
            );
            return false;
        }
        if (before.length >= CURVES_MAX) {
            this.say(`Plots show at most ${CURVES_MAX} curves. Remove one first.`);
            return false;
        }
        const plot = this.active.value ?? before.find((curve) => curve.unit === name.unit)?.plot ?? this.nextPlot++;
        this.set([...before, { ...name, robot, plot, times: [], values: [] }]);
        return true;
    }

    private set(curves: readonly Curve[]): void {
        this.curves.set(curves);
        this.state.pinned.set([...new Set(curves.map((curve) => curve.robot))]);
        if (this.world !== "") keep(this.place(), this.words());
    }

    private place(): string {
        return `roboss.plots.${this.world}`;
    }

    private take(report: RobotReport): void {
        const mine = this.curves.value.filter((curve) => curve.robot === report.robot),
            world = this.state.world.value;
        if (mine.length === 0 || world === null || report.robot >= world.fleet.count) return;
        const values = new Map<string, number | null>();
        for (const one of allReadings(world.fleet.type(report.robot), report)) values.set(one.key, one.value);
        for (const curve of mine) append(curve, report.time, values.get(curve.key) ?? null);
        this.grown.set(this.grown.value + 1);
    }

    /** Another world: its own plots come back. The same one with other robots: curves stay with their names. */
    private onWorld(): void {
        const fleet = this.state.world.value?.fleet;
        if (fleet === undefined) return;
        const again = this.world === fleet.scene.world,
            wanted: CurveName[][] = again
                ? []
                : parsePlots((this.world === "" ? this.asked : null) ?? this.kept(fleet.scene.world) ?? "");
        const kept: Curve[] = [];
        for (const curve of again ? this.curves.value : []) {
            const robot = fleet.find(curve.robotName);
            if (robot !== undefined) kept.push({ ...curve, robot });
        }
        for (const plot of wanted) {
            const id = this.nextPlot++;
            for (const name of plot) {
                const robot = fleet.find(name.robotName);
                if (robot !== undefined) kept.push({ ...name, robot, plot: id, times: [], values: [] });
            }
        }
        this.world = fleet.scene.world;
        const robots = [...new Set(kept.map((curve) => curve.robot))].slice(0, ROBOTS_MAX);
        this.set(kept.filter((curve) => robots.includes(curve.robot)).slice(0, CURVES_MAX));
    }

    private kept(world: string): string | null {
        return kept(`roboss.plots.${world}`);
    }
}
