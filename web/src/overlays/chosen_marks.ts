// Shows what else is selected: a box about each further robot, and the edges of the scenery.
import * as THREE from "three";
import { sceneryModels } from "../model/scene_tree";
import type { ViewerState, World } from "../model/viewer_state";
import { poseMatrix, shapeGeometry } from "../view/geometry";
import type { Stage } from "../view/stage";
import { LineField } from "./line_field";

const EDGE_DEG = 30;
const SHAPES_MAX = 200;
const SIDE_MIN_M = 0.1;

export class ChosenMarks {
    private readonly boxes = new LineField(0.9);
    private readonly scenery = new THREE.LineSegments(
        new THREE.BufferGeometry(),
        new THREE.LineBasicMaterial({ toneMapped: false, depthTest: false }),
    );
    private stale = true;

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
    ) {
        this.scenery.frustumCulled = false;
        this.scenery.renderOrder = 4;
        stage.overlays.add(this.boxes.lines, this.scenery);
        state.scenery.follow(() => (this.stale = true));
        state.world.follow(() => (this.stale = true));
    }

    update(world: World | null): void {
        const others = this.state.others.value;
        this.boxes.lines.visible = world !== null && others.length > 0;
        if (world !== null && others.length > 0) this.drawBoxes(world, others);
        this.scenery.visible = world !== null && this.state.scenery.value !== null;
        if (world !== null && this.stale && this.scenery.visible) this.drawScenery(world);
        this.stale = false;
        this.scenery.material.color.setHex(this.stage.palette.accent);
    }

    private drawBoxes(world: World, others: readonly number[]): void {
        const colour = new THREE.Color(this.stage.palette.accent),
            { base } = world.history.drawn;
        this.boxes.begin();
        for (const robot of others) {
            const at = robot * 7,
                side = Math.max(SIDE_MIN_M, Math.min(5, world.fleet.type(robot).reach)) * 0.8;
            const corner = (k: number) => [0, 1, 2].map((axis) => base[at + axis] + ((k >> axis) & 1 ? side : -side));
            for (let k = 0; k < 8; ++k)
                for (const bit of [1, 2, 4])
                    if ((k & bit) === 0) {
                        const [a, b] = [corner(k), corner(k | bit)];
                        this.boxes.add(a[0], a[1], a[2], b[0], b[1], b[2], colour);
                    }
        }
        this.boxes.end();
    }

    private drawScenery(world: World): void {
        const { scene, meshes } = world.loaded,
            shapes = sceneryModels(scene).get(this.state.scenery.value ?? "") ?? [],
            points: number[] = [],
            point = new THREE.Vector3();
        for (const k of shapes.slice(0, SHAPES_MAX)) {
            const visual = scene.statics[k],
                shape = shapeGeometry(visual, meshes),
                matrix = poseMatrix(visual.frame),
                edges = new THREE.EdgesGeometry(shape, EDGE_DEG).getAttribute("position");
            for (let n = 0; n < edges.count; ++n)
                point.fromBufferAttribute(edges, n).applyMatrix4(matrix).toArray(points, points.length);
            shape.dispose();
        }
        this.scenery.geometry.dispose();
        this.scenery.geometry = new THREE.BufferGeometry();
        this.scenery.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    }
}
