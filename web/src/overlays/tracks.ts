// Where robots drove: the last stretch of each as a line on the ground that fades towards its old end. Taken from what is
// drawn, a point each few centimetres; a jump (an order, a rewind) breaks the line.
import * as THREE from "three";
import type { ViewerState, World } from "../model/viewer_state";
import { groupColour } from "../view/palette";
import type { Stage } from "../view/stage";
import { LineField } from "./line_field";

const STEP_M = 0.12;
const JUMP_M = 3;
const POINTS = 240;
const TRACKED_MAX = 400;

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
    private tracks = new Map<number, Track>();
    private world: World | null = null;
    private time = 0;

    constructor(
        stage: Stage,
        private readonly state: ViewerState,
    ) {
        stage.overlays.add(this.field.lines);
    }

    /** The selected robot's way is kept whether it is shown or not. */
    update(world: World | null): void {
        const all = this.state.overlays.value.has("tracks");
        this.field.lines.visible = all;
        if (world !== this.world || (world !== null && world.history.drawn.time < this.time - 0.05))
            this.tracks.clear();
        this.world = world;
        if (world === null || !all) return;
        this.time = world.history.drawn.time;
        const base = world.history.drawn.base,
            count = Math.min(world.fleet.count, TRACKED_MAX),
            selected = this.state.selected.value;
        let grown = false;
        const take = (robot: number) => {
            const track = this.tracks.get(robot) ?? new Track();
            this.tracks.set(robot, track);
            grown =
                track.take(
                    base[robot * 7],
                    base[robot * 7 + 1],
                    Math.max(0.01, base[robot * 7 + 2] - world.fleet.type(robot).reach * 0.3),
                ) || grown;
        };
        for (let r = 0; r < count; ++r) take(r);
        if (selected !== null && selected >= count) take(selected);
        if (grown) this.draw();
    }

    private draw(): void {
        const colour = new THREE.Color(),
            faded = new THREE.Color(),
            ground = new THREE.Color(0x6d7076);
        this.field.begin();
        for (const [robot, { points }] of this.tracks) {
            groupColour(robot, colour);
            const n = points.length / 3;
            for (let k = 0; k + 1 < n; ++k) {
                faded.copy(ground).lerp(colour, Math.min(1, ((k + 1) / n) * 1.4));
                const p = 3 * k;
                this.field.add(
                    points[p],
                    points[p + 1],
                    points[p + 2],
                    points[p + 3],
                    points[p + 4],
                    points[p + 5],
                    faded,
                );
            }
        }
        this.field.end();
    }
}
