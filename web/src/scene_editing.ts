// Puts the parts together that handle the scene: selection, gizmo, adding, undo, and what shows them in the picture.
import { freePart } from "./camera/free_part";
import type { Views } from "./camera/views";
import { Gizmo } from "./hands/gizmo";
import type { Action } from "./model/actions";
import { Editing } from "./model/editing";
import { Placing } from "./model/placing";
import type { RunLink } from "./model/run_link";
import { modelOf } from "./model/scene_tree";
import { Selection } from "./model/selection";
import type { Signal } from "./model/signal";
import type { ViewerState, World } from "./model/viewer_state";
import { ChosenMarks } from "./overlays/chosen_marks";
import type { LabelLayer } from "./overlays/labels";
import { LinkMarks } from "./overlays/link_marks";
import { acceptDrops, addDialog, type AddDialog } from "./panels/add_dialog";
import { editBar } from "./panels/edit_bar";
import { addingHint, gizmoBar } from "./panels/gizmo_bar";
import { sceneActions } from "./scene_actions";
import type { Colouring } from "./view/colouring";
import { pick, pickPoint, pickScenery, surfaceBelow } from "./view/picking";
import { SightLayer } from "./view/sight_layer";
import type { Stage } from "./view/stage";
import type { Triple } from "./wire/messages";

type Update = (world: World | null) => void;

/** What is seen farther from the middle than so many distances of the camera lies at the horizon. */
const FAR_FACTOR = 2;

export class SceneEditing {
    readonly selection: Selection;
    readonly placing: Placing;
    readonly editing: Editing;
    readonly gizmo: Gizmo;
    /** The buttons over the tree. */
    readonly bar: HTMLElement;
    /** Before the colours of robots, since it makes layers that are coloured. */
    readonly sight: Update;
    readonly marks: Update[];
    /** What the picture shows of it has changed. */
    readonly shows: Signal<unknown>[];
    private readonly dialog: AddDialog;
    private pointer: { x: number; y: number } | null = null;

    constructor(
        readonly stage: Stage,
        readonly state: ViewerState,
        run: RunLink,
        views: Views,
        labels: LabelLayer,
        colouring: Colouring,
    ) {
        const selection = (this.selection = new Selection(state));
        this.placing = new Placing(state, run);
        const editing = (this.editing = new Editing(state, run, selection, this.placing));
        const gizmo = (this.gizmo = new Gizmo(stage, state, selection, this.placing, labels, (from, to) =>
            editing.move(from, to),
        ));
        this.dialog = addDialog(state, editing, () => this.middle(views.rig.now.target));
        this.bar = editBar(state, selection, editing, () => this.dialog.open());
        const sight = new SightLayer(stage, state, selection, colouring),
            links = new LinkMarks(stage, state, selection, labels),
            chosen = new ChosenMarks(stage, state);
        this.sight = (world) => sight.update(world);
        this.marks = [(world) => gizmo.update(world), (world) => links.update(world), (world) => chosen.update(world)];
        this.shows = [
            state.others,
            state.scenery,
            state.sight.hidden,
            state.sight.locked,
            gizmo.options,
            state.status,
        ] as Signal<unknown>[];
        stage.canvas.addEventListener("pointermove", (event) => {
            this.pointer = { x: event.offsetX, y: event.offsetY };
        });
    }

    /** Its bars over the picture. */
    bars(): HTMLElement[] {
        const { state, selection, placing, gizmo } = this;
        return [gizmoBar(state, selection, placing, gizmo), addingHint(state)];
    }

    /** Its dialog; files may be dropped on the picture. */
    dialogOver(view: HTMLElement): HTMLElement {
        acceptDrops(view, this.dialog, (event) => {
            const box = this.stage.canvas.getBoundingClientRect();
            return this.pointed({ x: event.clientX - box.left, y: event.clientY - box.top });
        });
        return this.dialog.element;
    }

    actions(): Action[] {
        return sceneActions({ ...this, add: () => this.dialog.open(), pointed: () => this.pointed(this.pointer) });
    }

    /** The model of the scenery at a place of the window. */
    sceneryAt(left: number, top: number): string | null {
        const box = this.stage.canvas.getBoundingClientRect(),
            visual = pickScenery(this.stage, left - box.left, top - box.top)?.visual ?? null;
        return visual === null ? null : modelOf(visual.name);
    }

    robotAt(left: number, top: number): number | null {
        const box = this.stage.canvas.getBoundingClientRect(),
            world = this.state.world.value;
        return world === null ? null : (pick(this.stage, world, left - box.left, top - box.top)?.robot ?? null);
    }

    /** Where something new stands in the middle of the view: on what is seen there, else on what lies below `target`. */
    private middle(target: Triple): Triple {
        const world = this.state.world.value,
            { stage } = this,
            free = freePart(stage.canvas, stage.viewport),
            x = stage.viewport.left + (free.left + free.width - free.right) / 2,
            y = stage.viewport.top + (free.top + free.height - free.bottom) / 2,
            seen = world === null ? null : pickPoint(stage, world, x, y);
        if (world !== null && seen !== null && stage.ray(x, y).ray.direction.z < 0) {
            const away = Math.hypot(...seen.toArray().map((value, k) => value - target[k]));
            if (away < FAR_FACTOR * stage.camera.position.distanceTo(seen.clone().set(...target)))
                return seen.toArray() as Triple;
        }
        return [target[0], target[1], surfaceBelow(stage, target[0], target[1])];
    }

    private pointed(at: { x: number; y: number } | null): Triple | null {
        const world = this.state.world.value,
            point = at === null || world === null ? null : pickPoint(this.stage, world, at.x, at.y);
        return point === null ? null : [point.x, point.y, point.z];
    }
}
