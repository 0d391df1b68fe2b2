// Colours robots by what was chosen: their model, Simulator, island or speed.
import * as THREE from "three";
import type { ViewerState, World } from "../model/viewer_state";
import { ownColour } from "./own_colour";
import { groupColour, rampColour } from "./palette";
import type { Stage } from "./stage";

/** Of no group yet. */
const NOBODY = 0x8a929c;
/** m/s: the end of the ramp. */
export const SPEED_FULL = 3;
const SPEED_EVERY_S = 0.1;

export class Colouring {
    private before: Float32Array | null = null;
    private beforeTime = 0;
    private speeds = new Float32Array(0);
    private stale = true;
    private chosen: ((robot: number, out: THREE.Color) => void) | null = null;

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
    ) {
        state.colourBy.follow(() => (this.stale = true));
        state.groups.follow(() => (this.stale = true));
        state.world.follow(() => {
            this.stale = true;
            this.before = null;
        });
    }

    /** There are new layers. */
    refresh(): void {
        this.stale = true;
    }

    update(world: World): void {
        if (this.state.colourBy.value === "speed") this.measure(world);
        if (!this.stale) return;
        this.stale = false;
        this.chosen = this.choose();
        this.stage.robots?.recolour(this.chosen);
        for (const layer of this.stage.partly) layer.recolour(this.chosen);
        const chosen = this.chosen,
            colour = new THREE.Color();
        this.state.dots.set(
            chosen === null
                ? null
                : (robot) => {
                      chosen(robot, colour);
                      return `#${colour.getHexString(THREE.SRGBColorSpace)}`;
                  },
        );
    }

    /** The colour of a robot as it is shown now. */
    colourOf(world: World, robot: number, out: THREE.Color): void {
        if (this.chosen !== null) this.chosen(robot, out);
        else out.setRGB(...ownColour(world, robot), THREE.SRGBColorSpace);
    }

    private choose(): ((robot: number, out: THREE.Color) => void) | null {
        const by = this.state.colourBy.value,
            groups = this.state.groups.value;
        if (by === "speed") return (robot, out) => void rampColour((this.speeds[robot] ?? 0) / SPEED_FULL, out);
        if (by === "model" || groups === null) return null;
        const of = by === "simulator" ? groups.simulator : groups.island;
        return (robot, out) => void ((of[robot] ?? -1) < 0 ? out.set(NOBODY) : groupColour(of[robot], out));
    }

    /** Speeds from what is drawn, over a tenth of a second. */
    private measure(world: World): void {
        const { base, time } = world.history.drawn,
            passed = time - this.beforeTime;
        if (this.before === null || this.before.length !== base.length || passed < 0) {
            this.before = base.slice();
            this.beforeTime = time;
            this.speeds = new Float32Array(world.fleet.count);
            return;
        }
        if (passed < SPEED_EVERY_S) return;
        for (let r = 0; r < world.fleet.count; ++r)
            this.speeds[r] =
                Math.hypot(
                    base[r * 7] - this.before[r * 7],
                    base[r * 7 + 1] - this.before[r * 7 + 1],
                    base[r * 7 + 2] - this.before[r * 7 + 2],
                ) / passed;
        this.before.set(base);
        this.beforeTime = time;
        this.stale = true;
    }
}
