// Mouse, touch and keys for the camera. Left drag turns, right or middle drag (or Shift) pans, the wheel zooms, two
// fingers do both; W A S D Q E and the arrows move. A hand (hands/) may take a drag before the camera sees it.
import type { CameraMode } from "../model/viewer_state";
import type { CameraRig } from "./rig";
import type { Views } from "./views";

export interface PointerHand {
    /** True: this hand has the drag. */
    press(x: number, y: number, event: PointerEvent): boolean;
    move(x: number, y: number, event: PointerEvent): void;
    release(cancelled: boolean): void;
    /** A press and release without a drag between. */
    click(x: number, y: number, event: PointerEvent): void;
    doubleClick(x: number, y: number): void;
    /** A finger that rests. */
    longPress(x: number, y: number): void;
}

const CLICK_SLOP_PX = 4;
/** Of a finger. */
const TAP_SLOP_PX = 12;
const LONG_PRESS_MS = 500;
const DOUBLE_TAP_MS = 350;
const RADIANS_A_PIXEL = 0.0052;
const MOVING = new Map([
    ["KeyW", [0, 1, 0]],
    ["ArrowUp", [0, 1, 0]],
    ["KeyS", [0, -1, 0]],
    ["ArrowDown", [0, -1, 0]],
    ["KeyA", [-1, 0, 0]],
    ["ArrowLeft", [-1, 0, 0]],
    ["KeyD", [1, 0, 0]],
    ["ArrowRight", [1, 0, 0]],
    ["KeyE", [0, 0, 1]],
    ["KeyQ", [0, 0, -1]],
]);

export class CameraPointer {
    private readonly down = new Map<number, { x: number; y: number }>();
    private readonly keys = new Set<string>();
    private taken = false;
    private travelled = 0;
    private button = 0;
    private resting = 0;
    private lastTap = { at: -Infinity, x: 0, y: 0 };

    constructor(
        private readonly canvas: HTMLElement,
        private readonly views: Views,
        private readonly hand: PointerHand,
        private readonly mode: () => CameraMode,
        private readonly free: () => void,
        /** Which view is at a point, and how high the active one is, in pixels. */
        private readonly picture: { viewAt(x: number, y: number): number; viewport: { height: number } },
    ) {
        canvas.addEventListener("pointerdown", (event) => this.press(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        canvas.addEventListener("pointerup", (event) => this.release(event, false));
        canvas.addEventListener("pointercancel", (event) => this.release(event, true));
        canvas.addEventListener("dblclick", (event) => this.hand.doubleClick(event.offsetX, event.offsetY));
        canvas.addEventListener("contextmenu", (event) => event.preventDefault());
        canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
        canvas.addEventListener("keydown", (event) => {
            if (event.ctrlKey || event.metaKey || event.altKey || !MOVING.has(event.code)) return;
            this.keys.add(event.code);
            event.preventDefault();
        });
        window.addEventListener("keyup", (event) => this.keys.delete(event.code));
        window.addEventListener("blur", () => this.keys.clear());
    }

    private get rig(): CameraRig {
        return this.views.rig;
    }

    /** Moves with the keys held. */
    advance(seconds: number, hurried: boolean): void {
        if (this.keys.size === 0) return;
        const pace =
            Math.max(1, this.rig.goal.distance) * (this.mode() === "fly" ? 0.8 : 0.6) * (hurried ? 3 : 1) * seconds;
        for (const key of this.keys) {
            const [right, forwards, up] = MOVING.get(key) ?? [0, 0, 0];
            if (right !== 0 || forwards !== 0) this.free();
            this.rig.pan(right * pace, forwards * pace, up * pace * 0.6);
        }
    }

    private press(event: PointerEvent): void {
        this.canvas.focus({ preventScroll: true });
        this.canvas.setPointerCapture(event.pointerId);
        if (this.down.size === 0) this.views.activate(this.picture.viewAt(event.offsetX, event.offsetY));
        this.down.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
        clearTimeout(this.resting);
        if (this.down.size > 1) {
            if (this.taken) this.hand.release(true);
            this.taken = false;
            return;
        }
        this.travelled = 0;
        this.button = event.button;
        this.taken = event.button === 0 && this.hand.press(event.offsetX, event.offsetY, event);
        if (event.pointerType === "touch" && !this.taken) this.rest(event.offsetX, event.offsetY);
    }

    private rest(x: number, y: number): void {
        this.resting = window.setTimeout(() => {
            if (this.down.size !== 1 || this.travelled >= TAP_SLOP_PX) return;
            this.travelled = Infinity; // it is no tap any more
            this.hand.longPress(x, y);
        }, LONG_PRESS_MS);
    }

    private move(event: PointerEvent): void {
        const before = this.down.get(event.pointerId);
        if (before === undefined) return;
        const dx = event.offsetX - before.x,
            dy = event.offsetY - before.y;
        this.travelled += Math.abs(dx) + Math.abs(dy);
        if (this.down.size === 2) this.pinch(event, before, dx, dy);
        else if (this.taken) this.hand.move(event.offsetX, event.offsetY, event);
        else this.drag(dx, dy, event.shiftKey);
        before.x = event.offsetX;
        before.y = event.offsetY;
    }

    private drag(dx: number, dy: number, shift: boolean): void {
        if (this.button !== 0 || shift) return this.panPixels(dx, dy);
        if (this.mode() === "fly") this.rig.look(-dx * RADIANS_A_PIXEL * 0.6, dy * RADIANS_A_PIXEL * 0.6);
        else this.rig.turn(-dx * RADIANS_A_PIXEL, dy * RADIANS_A_PIXEL);
    }

    private panPixels(dx: number, dy: number): void {
        this.free();
        const scale = (1.15 * this.rig.goal.distance) / Math.max(1, this.picture.viewport.height);
        this.rig.pan(-dx * scale, (dy * scale) / Math.max(0.35, Math.sin(Math.abs(this.rig.goal.elevation))));
    }

    private pinch(event: PointerEvent, before: { x: number; y: number }, dx: number, dy: number): void {
        const other = [...this.down].find(([id]) => id !== event.pointerId)?.[1];
        if (other === undefined) return;
        const was = Math.hypot(before.x - other.x, before.y - other.y),
            is = Math.hypot(event.offsetX - other.x, event.offsetY - other.y);
        if (was > 10 && is > 10) this.rig.zoom(was / is);
        this.panPixels(dx / 2, dy / 2);
    }

    private release(event: PointerEvent, cancelled: boolean): void {
        const known = this.down.delete(event.pointerId);
        clearTimeout(this.resting);
        if (!known || this.down.size > 0) return;
        if (this.taken) this.hand.release(cancelled);
        const slop = event.pointerType === "touch" ? TAP_SLOP_PX : CLICK_SLOP_PX;
        if (!cancelled && event.button === 0 && this.travelled < slop) this.click(event);
        this.taken = false;
    }

    /** Not every browser makes a double click of two taps. */
    private click(event: PointerEvent): void {
        const before = this.lastTap,
            near = Math.hypot(event.offsetX - before.x, event.offsetY - before.y) < 2 * TAP_SLOP_PX;
        this.lastTap = { at: event.timeStamp, x: event.offsetX, y: event.offsetY };
        this.hand.click(event.offsetX, event.offsetY, event);
        if (event.pointerType === "touch" && near && event.timeStamp - before.at < DOUBLE_TAP_MS)
            this.hand.doubleClick(event.offsetX, event.offsetY);
    }

    private wheel(event: WheelEvent): void {
        event.preventDefault();
        this.views.activate(this.picture.viewAt(event.offsetX, event.offsetY));
        const steps = event.deltaMode === 1 ? event.deltaY * 16 : event.deltaY;
        this.rig.zoom(Math.exp(Math.max(-240, Math.min(240, steps)) * 0.0011));
    }
}
