// One frame: the time to draw, where robots are then, the camera, overlays, the picture. A picture in which nothing
// changed is not drawn again, so that a paused run leaves the laptop cool.
import type { Director } from "./camera/director";
import type { CameraPointer } from "./camera/pointer";
import type { CameraRig } from "./camera/rig";
import type { Views } from "./camera/views";
import type { RunLink } from "./model/run_link";
import type { Shown } from "./model/preview";
import type { ViewerState, World } from "./model/viewer_state";
import type { Effort } from "./view/effort";
import type { FrameTimes } from "./view/frame_times";
import type { Stage } from "./view/stage";

export interface FrameParts {
    stage: Stage;
    state: ViewerState;
    run: RunLink;
    views: Views;
    director: Director;
    pointer: CameraPointer;
    times: FrameTimes;
    /** Overlays and colours, in the order in which they are brought up to date. */
    layers: ((world: World | null, now: number) => void)[];
    hurried: () => boolean;
    /** A surface moves: the picture changes with time, though no robot moves. */
    flowing: () => boolean;
    effort: Effort | null;
    /** Least time between two frames. */
    interval_ms: number;
}

const IDLE_REDRAW_S = 0.5;
const AWAKE_S = 0.4;

function lookOf(rig: CameraRig): string {
    const numbers = [...rig.eye(), ...rig.now.target].map((value) => value.toFixed(4));
    return `${numbers.join()}${rig.orthographic ? "o" : ""}`;
}

export class FrameLoop {
    private last = 0;
    private drawn = 0;
    private awakeUntil = 0;
    private lastEye = "";
    private drewLast = false;
    private shownWorld: World | null = null;
    private held: Shown | null = null;

    constructor(private readonly parts: FrameParts) {}

    start(): void {
        requestAnimationFrame((now) => this.frame(now));
    }

    /** Something that shows changed: draw for a while. */
    wake(): void {
        this.awakeUntil = performance.now() / 1000 + AWAKE_S;
    }

    /** A change of any of these shows. */
    wakeAt(...signals: readonly { follow(act: () => void): unknown }[]): void {
        for (const signal of signals) signal.follow(() => this.wake());
    }

    private frame(stamp: number): void {
        requestAnimationFrame((next) => this.frame(next));
        if (stamp - this.last < this.parts.interval_ms) return;
        const began = performance.now(),
            now = began / 1000,
            interval = stamp - this.last,
            seconds = Math.min(0.1, Math.max(0, interval / 1000));
        this.last = stamp;
        const { stage, state, run, views, director, pointer, layers, times } = this.parts,
            world = state.world.value;
        let moved = false;
        if (world !== null && world.history.latest !== null) {
            const before = state.drawnTime.value,
                shown = state.shown.value?.world === world ? state.shown.value : null,
                present = run.clock.read(now);
            state.drawnTime.set(shown?.time_s ?? present);
            if (shown === null) world.history.sample(present);
            else if (shown !== this.held) world.history.hold(shown.snapshot, shown.hidden);
            else world.history.changed.fill(0);
            this.held = shown;
            stage.place(world);
            moved = world.history.changed.includes(1);
            moved ||= this.parts.flowing() && state.drawnTime.value !== before;
            if (this.shownWorld !== world) this.firstSight(world);
            director.follow(world, seconds);
        }
        pointer.advance(seconds, this.parts.hurried());
        for (const { rig } of views.shown) rig.advance(seconds);
        const eye =
            views.shown.map(({ rig }) => lookOf(rig)).join(" ") + ` ${stage.canvas.width} ${stage.canvas.height}`;
        const idle = !moved && eye === this.lastEye && now > this.awakeUntil && now - this.drawn < IDLE_REDRAW_S;
        this.lastEye = eye;
        if (idle) {
            this.drewLast = false;
            return;
        }
        if (this.drewLast && document.visibilityState === "visible") this.parts.effort?.take(interval);
        this.drewLast = true;
        stage.aim(views);
        for (const update of layers) update(world, now);
        const updated = performance.now();
        stage.draw();
        times.take(updated - began, performance.now() - updated);
        this.drawn = now;
        if (this.shownWorld !== null) document.body.dataset.ready = "true";
    }

    private firstSight(world: World): void {
        const again = this.shownWorld !== null;
        this.shownWorld = world;
        if (!again) this.parts.director.start(world);
        this.wake();
    }
}
