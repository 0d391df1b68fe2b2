// Arrows and rings at the selected robots: dragging one moves or turns all of them, in steps if wanted. The pointer comes
// from EditHand, since camera and robots share the picture.
import * as THREE from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import { composed, inverse } from "../kinematics/pose";
import type { Placement, Placing } from "../model/placing";
import type { Selection } from "../model/selection";
import { Signal } from "../model/signal";
import type { ViewerState, World } from "../model/viewer_state";
import type { LabelLayer } from "../overlays/labels";
import { throttled } from "../ui/throttle";
import type { Stage } from "../view/stage";
import type { PoseArray } from "../wire/messages";

const ORDER_INTERVAL_MS = 50;

export interface GizmoOptions {
    space: "world" | "local";
    snap: boolean;
    step_m: number;
    step_deg: number;
}

interface Pointer {
    x: number;
    y: number;
    button: number;
}

/** What three.js calls itself where it listens to the page; its types leave it out. */
interface PointerControls {
    pointerHover(pointer: Pointer): void;
    pointerDown(pointer: Pointer): void;
    pointerMove(pointer: Pointer): void;
    pointerUp(pointer: Pointer): void;
}

export class Gizmo {
    readonly options = new Signal<GizmoOptions>({ space: "world", snap: false, step_m: 0.1, step_deg: 15 });
    private readonly controls: TransformControls;
    private readonly proxy = new THREE.Object3D();
    private starts: Placement[] = [];
    private from: PoseArray = [0, 0, 0, 1, 0, 0, 0];
    private dragged = false;
    private readonly send: () => void;

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly selection: Selection,
        private readonly placing: Placing,
        private readonly labels: LabelLayer,
        /** A drag is over. */
        private readonly onMoved: (before: Placement[], after: Placement[]) => void,
    ) {
        this.controls = new TransformControls(stage.camera);
        this.controls.attach(this.proxy);
        const helper = this.controls.getHelper();
        helper.visible = false;
        stage.scene.add(this.proxy, helper);
        this.send = throttled(ORDER_INTERVAL_MS, () => this.dragging && this.placing.place(this.targets()));
        stage.canvas.addEventListener("pointermove", (event) => {
            if (this.shown && !this.dragging && event.buttons === 0)
                this.pointer.pointerHover(this.at(event.offsetX, event.offsetY));
        });
    }

    private get pointer(): PointerControls {
        return this.controls as unknown as PointerControls;
    }

    private get shown(): boolean {
        return this.controls.getHelper().visible;
    }

    private get dragging(): boolean {
        return this.starts.length > 0;
    }

    private at(x: number, y: number): Pointer {
        const { left, top, width, height } = this.stage.viewport;
        return { x: ((x - left) / width) * 2 - 1, y: 1 - ((y - top) / height) * 2, button: 0 };
    }

    /** The arrow or ring there: "X", "XY" ...; null: none. */
    axisAt(x: number, y: number): string | null {
        if (!this.shown) return null;
        this.pointer.pointerHover(this.at(x, y));
        return this.controls.axis;
    }

    /** True: an arrow or a ring was met, and the drag is its own. */
    press(x: number, y: number): boolean {
        if (this.axisAt(x, y) === null) return false;
        this.pointer.pointerDown(this.at(x, y));
        if (!this.controls.dragging) return false;
        this.starts = this.selection.robots
            .filter((robot) => this.placing.refusal(robot) === "")
            .map((robot) => ({ robot, pose: this.placing.frame(robot) }));
        this.from = this.proxyPose();
        this.dragged = false;
        return true;
    }

    /** `stepped`: the key for steps is held, which turns the switch around. */
    move(x: number, y: number, stepped: boolean): boolean {
        if (!this.dragging) return false;
        const { snap, step_m, step_deg } = this.options.value,
            on = snap !== stepped;
        this.controls.translationSnap = on ? step_m : null;
        this.controls.rotationSnap = on ? (step_deg * Math.PI) / 180 : null;
        this.pointer.pointerMove({ ...this.at(x, y), button: -1 }); // no button changes
        this.dragged = true;
        this.labels.put("gizmo", this.proxy.position, this.words());
        this.send();
        return true;
    }

    release(cancelled: boolean): boolean {
        if (!this.dragging) return false;
        this.pointer.pointerUp({ x: 0, y: 0, button: 0 });
        const before = this.starts,
            after = this.targets();
        this.starts = [];
        this.labels.put("gizmo", null, "");
        if (cancelled) this.placing.place(before);
        else if (this.dragged) this.onMoved(before, after);
        return true;
    }

    private proxyPose(): PoseArray {
        const { position: p, quaternion: q } = this.proxy;
        return [p.x, p.y, p.z, q.w, q.x, q.y, q.z];
    }

    /** Each robot keeps its place to the primary one. */
    private targets(): Placement[] {
        const change = composed(this.proxyPose(), inverse(this.from));
        return this.starts.map(({ robot, pose }) => ({ robot, pose: composed(change, pose) as PoseArray }));
    }

    private words(): string {
        const [x, y, z] = this.proxyPose();
        if (this.state.tool.value === "place")
            return `${Math.hypot(x - this.from[0], y - this.from[1], z - this.from[2]).toFixed(3)} m`;
        const turn = composed(this.proxyPose(), inverse(this.from)),
            angle = 2 * Math.atan2(Math.hypot(turn[4], turn[5], turn[6]), Math.abs(turn[3]));
        return `${((angle * 180) / Math.PI).toFixed(1)}°`;
    }

    update(world: World | null): void {
        const tool = this.state.tool.value,
            leader = this.selection.robots.find((robot) => this.placing.refusal(robot) === ""),
            shown = world !== null && leader !== undefined && (tool === "place" || tool === "turn");
        this.controls.getHelper().visible = shown;
        this.controls.camera = this.stage.camera; // of the active view
        if (!shown || this.dragging) return;
        this.controls.setMode(tool === "turn" ? "rotate" : "translate");
        this.controls.setSpace(this.options.value.space);
        const [x, y, z, qw, qx, qy, qz] = this.placing.frame(leader);
        this.proxy.position.set(x, y, z);
        this.proxy.quaternion.set(qx, qy, qz, qw);
        this.proxy.updateMatrixWorld();
    }
}
