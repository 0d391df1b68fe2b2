// The hand that also edits: the gizmo, several robots at once (Ctrl and a click, a box by Shift and a drag), scenery, and
// the place of what is added. What it does not take is for RobotHand.
import * as THREE from "three";
import { modelOf } from "../model/scene_tree";
import type { Selection } from "../model/selection";
import { sceneryKey } from "../model/sight";
import type { ViewerState, World } from "../model/viewer_state";
import { h } from "../ui/dom";
import { pick, pickPoint, pickScenery } from "../view/picking";
import type { Stage } from "../view/stage";
import type { Gizmo } from "./gizmo";
import { RobotHand } from "./robot_hand";

export interface EditParts {
    stage: Stage;
    state: ViewerState;
    selection: Selection;
    gizmo: Gizmo;
}

export class EditHand extends RobotHand {
    /** The box that is drawn; it belongs over the picture. */
    readonly frame = h("div", { class: "select-box", hidden: true, "aria-hidden": "true" });
    private box: { x: number; y: number; adds: boolean } | null = null;

    constructor(
        private readonly edit: EditParts,
        ...hand: ConstructorParameters<typeof RobotHand>
    ) {
        super(...hand);
    }

    override press(x: number, y: number, event?: PointerEvent): boolean {
        const { state, gizmo } = this.edit,
            tool = state.tool.value;
        if (state.adding.value !== null) return false;
        if (gizmo.press(x, y)) return true;
        const boxes = tool === "select" || tool === "place" || tool === "turn";
        if (!boxes) return super.press(x, y);
        if (event?.shiftKey !== true) return false;
        this.box = { x, y, adds: event.ctrlKey || event.metaKey };
        return true;
    }

    override move(x: number, y: number, event: PointerEvent): void {
        if (this.box !== null) this.draw(x, y);
        else if (!this.edit.gizmo.move(x, y, event.ctrlKey || event.metaKey)) super.move(x, y, event);
    }

    override release(cancelled: boolean): void {
        if (this.box === null && !this.edit.gizmo.release(cancelled)) return super.release(cancelled);
        if (this.box !== null && !cancelled && !this.frame.hidden) this.takeBox(this.box.adds);
        this.box = null;
        this.frame.hidden = true;
    }

    override click(x: number, y: number, event: PointerEvent): void {
        const { state, stage, selection } = this.edit,
            world = state.world.value;
        if (world === null) return;
        if (state.adding.value !== null) return this.add(world, x, y);
        const robot = pick(stage, world, x, y)?.robot ?? stage.markAt(x, y);
        if (robot === null && !event.shiftKey && state.attaching.value === null) return this.clickScenery(x, y);
        if (robot !== null && (event.ctrlKey || event.metaKey)) return selection.toggle(robot);
        const chooses = robot !== null && state.attaching.value === null && !event.shiftKey;
        super.click(x, y, event);
        if (chooses) selection.only(robot);
    }

    private add(world: World, x: number, y: number): void {
        const { state, stage } = this.edit,
            adding = state.adding.value,
            point = pickPoint(stage, world, x, y);
        if (adding === null || point === null) return;
        state.adding.set(null);
        adding.put(point.toArray() as [number, number, number]);
    }

    /** Ground planes are everywhere: a click on one selects nothing. */
    private clickScenery(x: number, y: number): void {
        const { state, stage, selection } = this.edit,
            visual = pickScenery(stage, x, y)?.visual ?? null,
            model = visual === null || visual.shape === "plane" ? null : modelOf(visual.name);
        const locked = model !== null && state.sight.locked.value.has(sceneryKey(model));
        selection.scenery(locked ? null : model);
    }

    private draw(x: number, y: number): void {
        if (this.box === null) return;
        const left = Math.min(x, this.box.x),
            top = Math.min(y, this.box.y),
            width = Math.abs(x - this.box.x),
            height = Math.abs(y - this.box.y);
        this.frame.hidden = width + height < 6;
        Object.assign(this.frame.style, {
            left: `${left}px`,
            top: `${top}px`,
            width: `${width}px`,
            height: `${height}px`,
        });
    }

    /** Robots whose base is in the box. */
    private takeBox(adds: boolean): void {
        const { state, stage, selection } = this.edit,
            world = state.world.value;
        if (world === null) return;
        const { base } = world.history.drawn,
            { clientWidth, clientHeight } = stage.canvas,
            left = Number.parseFloat(this.frame.style.left),
            top = Number.parseFloat(this.frame.style.top),
            right = left + Number.parseFloat(this.frame.style.width),
            bottom = top + Number.parseFloat(this.frame.style.height),
            place = new THREE.Vector3(),
            found: number[] = [];
        for (let r = 0; r < world.fleet.count; ++r) {
            place.set(base[r * 7], base[r * 7 + 1], base[r * 7 + 2]).project(stage.camera);
            const x = ((place.x + 1) * clientWidth) / 2,
                y = ((1 - place.y) * clientHeight) / 2;
            const within = place.z < 1 && x >= left && x <= right && y >= top && y <= bottom;
            if (within && stage.pickable(r)) found.push(r);
        }
        if (adds) selection.add(found);
        else selection.set(found);
    }
}
