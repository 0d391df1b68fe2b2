// Where robots drove: the last stretch of each as a line on the ground that fades towards its old end. Taken from what is
// drawn, a point each few centimetres; a jump (an order, a rewind) breaks the line. Of the selected robot it is what its
// GPS and odometer say, where it has them.
import * as THREE from "three";
import type { ViewerState, World } from "../model/viewer_state";
import { groupColour } from "../view/palette";
import type { Stage } from "../view/stage";
import type { LabelLayer } from "./labels";
import { LineField } from "./line_field";
import { SensorWays } from "./sensor_ways";

const STEP_M = 0.12;
const JUMP_M = 3;
const POINTS = 240;
const TRACKED_MAX = 400;
const WAY_COLOURS = { gps: new THREE.Color(0x2f9bff), odometer: new THREE.Color(0xff9a1f) };
const OLD = new THREE.Color(0x6d7076);

class Track {
    readonly points: number[] = [];

    take(x: number, y: number, z: number): boolean {
        const n = this.points.length;
        if (n >= 3) {
            const way = Math.hypot(x - this.points[n - 3], y - this.points[n - 2], z - this.points[n - 1]);
            if (way < STEP_M) return false;
            if (way > JUMP_M) this.points.length = 0;
        }
        this.points.push(x, y, z);
        if (this.points.length > POINTS * 3) this.points.splice(0, this.points.length - POINTS * 3);
        return true;
    }
}

export class Tracks {
    private readonly field = new LineField();
    private readonly tracks = new Map<number, Track>();
    private readonly ways = new SensorWays();
    private world: World | null = null;
    private time = 0;

    constructor(
        stage: Stage,
        private readonly state: ViewerState,
        private readonly labels: LabelLayer,
    ) {
        stage.overlays.add(this.field.lines);
        state.report.follow(() => this.hear());
        state.selected.follow(() => {
            this.ways.forget();
            this.draw();
        });
    }

    private get shown(): boolean {
        return this.state.overlays.value.has("tracks");
    }

    /** What the selected robot's sensors read. */
    private hear(): void {
        const report = this.state.report.value,
            { world } = this;
        if (!this.shown || world === null || report === null || report.robot !== this.state.selected.value) return;
        const type = world.fleet.type(report.robot);
        if (this.ways.take(type, report, this.heightOf(world, report.robot))) this.draw();
    }

    /** A little above the ground on which it stands. */
    private heightOf(world: World, robot: number): number {
        return Math.max(0.01, world.history.drawn.base[robot * 7 + 2] - world.fleet.type(robot).reach * 0.3);
    }

    update(world: World | null): void {
        this.field.lines.visible = this.shown;
        if (world !== this.world || (world !== null && world.history.drawn.time < this.time - 0.05)) {
            this.tracks.clear();
            this.ways.forget();
        }
        this.world = world;
        this.name();
        if (world === null || !this.shown) return;
        this.time = world.history.drawn.time;
        const base = world.history.drawn.base,
            count = Math.min(world.fleet.count, TRACKED_MAX),
            selected = this.state.selected.value;
        let grown = false;
        const take = (robot: number) => {
            const track = this.tracks.get(robot) ?? new Track();
            this.tracks.set(robot, track);
            grown = track.take(base[robot * 7], base[robot * 7 + 1], this.heightOf(world, robot)) || grown;
        };
        for (let r = 0; r < count; ++r) take(r);
        if (selected !== null && selected >= count) take(selected);
        if (grown) this.draw();
    }

    private draw(): void {
        const colour = new THREE.Color(),
            selected = this.state.selected.value;
        this.field.begin();
        const told = this.ways.ways.filter((way) => way.points.length > 3);
        for (const [robot, { points }] of this.tracks)
            if (robot !== selected || told.length === 0) this.add(points, groupColour(robot, colour));
        for (const { kind, points } of told) this.add(points, WAY_COLOURS[kind]);
        this.field.end();
    }

    private add(points: readonly number[], colour: THREE.Color): void {
        const faded = new THREE.Color(),
            n = points.length / 3;
        for (let k = 0; k + 1 < n; ++k) {
            faded.copy(OLD).lerp(colour, Math.min(1, ((k + 1) / n) * 1.4));
            const p = 3 * k;
            this.field.add(points[p], points[p + 1], points[p + 2], points[p + 3], points[p + 4], points[p + 5], faded);
        }
    }

    /** Each way of a sensor bears its name at its new end. */
    private name(): void {
        const wanted = new Set<string>(),
            end = new THREE.Vector3();
        if (this.shown)
            for (const { name, kind, points } of this.ways.ways) {
                if (points.length < 6) continue;
                const key = `way ${name}`;
                wanted.add(key);
                this.labels.put(key, end.fromArray(points, points.length - 3), name, `way ${kind}`);
            }
        for (const key of this.labels.keysStarting("way ")) if (!wanted.has(key)) this.labels.put(key, null, "");
    }
}
