// What is drawn into the picture beside robots and scenery, in the order in which it is brought up to date.
import type { ViewerState, World } from "./model/viewer_state";
import { BondMarks } from "./overlays/bond_marks";
import { FarMarks } from "./overlays/far_marks";
import { FlowMarks } from "./overlays/flow_marks";
import type { LabelLayer } from "./overlays/labels";
import { Names } from "./overlays/names";
import { PointClouds } from "./overlays/point_clouds";
import { RadioMarks } from "./overlays/radio_marks";
import { RobotOverlays } from "./overlays/robot_overlays";
import { RunOverlays } from "./overlays/run_overlays";
import { SelectionMark } from "./overlays/selection_mark";
import { Tracks } from "./overlays/tracks";
import type { SceneEditing } from "./scene_editing";
import type { Colouring } from "./view/colouring";
import type { Stage } from "./view/stage";

interface Parts {
    stage: Stage;
    state: ViewerState;
    labels: LabelLayer;
    colouring: Colouring;
    scene: SceneEditing;
}

export function pictureLayers({ stage, state, labels, colouring, scene }: Parts): {
    flows: FlowMarks;
    far: FarMarks;
    layers: ((world: World | null, now: number) => void)[];
} {
    const ring = new SelectionMark(stage, state, labels),
        names = new Names(stage, state, labels),
        sensors = new RobotOverlays(stage, state),
        clouds = new PointClouds(stage, state, state.cameras),
        told = new RunOverlays(stage, state),
        tracks = new Tracks(stage, state, labels),
        flows = new FlowMarks(stage, state),
        bonds = new BondMarks(stage, state),
        radio = new RadioMarks(stage, state),
        far = new FarMarks(stage, state, (world, robot, out) => colouring.colourOf(world, robot, out));
    /** What is known of the present alone is not drawn into an earlier moment. */
    const present = (world: World | null) => (state.shown.value === null ? world : null);
    const layers: ((world: World | null, now: number) => void)[] = [
        scene.sight,
        (world) => world !== null && colouring.update(world),
        (world) => ring.update(world),
        ...scene.marks,
        (world) => flows.update(present(world)),
        (world) => bonds.update(present(world)),
        (world, now) => radio.update(present(world), now),
        (world) => sensors.update(present(world)),
        (world) => clouds.update(present(world)),
        (world, now) => told.update(present(world), now),
        (world) => state.shown.value === null && tracks.update(world),
        (world) => names.update(world),
        (world) => far.update(world),
    ];
    return { flows, far, layers };
}
