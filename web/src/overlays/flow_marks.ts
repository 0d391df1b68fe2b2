// Belts, tracks and turntables in motion: marks on the collision shapes of links whose surfaces move, and on scenery that
// moves or may. They go at the true speed, in the time that is drawn.
import * as THREE from "three";
import { linkPose } from "../kinematics/link_pose";
import { IDENTITY } from "../kinematics/pose";
import type { ViewerState, World } from "../model/viewer_state";
import { poseMatrix, shapeGeometry } from "../view/geometry";
import type { Stage } from "../view/stage";
import type { Triple, Visual } from "../wire/messages";
import type { SurfaceMotion } from "../wire/onboard";
import { FlowMaterial } from "./flow_material";
import { type Flow, flowOf, FlowPhase, rowsOf, shapeIn } from "./flow_pattern";

/** Surfaces that are shown at most: each is a draw call. */
const SURFACES_MAX = 400;
/** A longer step of time is a jump (a rewind, a new run): marks stay where they are. */
const JUMP_S = 2;

interface Marked {
    mesh: THREE.Mesh<THREE.BufferGeometry, FlowMaterial>;
    visual: Visual;
    flow: Flow;
    phase: FlowPhase;
    pitch: number;
    at: Triple | undefined;
}

interface Surface {
    /** null: scenery. */
    of: { robot: number; link: number } | null;
    marked: Marked[];
    used: boolean;
}

export class FlowMarks {
    private readonly group = new THREE.Group();
    private readonly surfaces = new Map<string, Surface>();
    private shown: World | null = null;
    /** What robots say of their surfaces is still to be taken: it needs to know where the robots are. */
    private stale = false;
    private time = 0;

    constructor(
        stage: Stage,
        private readonly state: ViewerState,
    ) {
        stage.overlays.add(this.group);
        state.world.follow((world) => this.begin(world));
        state.extras.follow(() => (this.stale = true));
    }

    /** Some surface moves. */
    get any(): boolean {
        return this.surfaces.size > 0;
    }

    private begin(world: World | null): void {
        for (const key of [...this.surfaces.keys()]) this.remove(key);
        this.shown = world;
        (world?.fleet.scene.flows ?? []).forEach((flow, k) => {
            if (flow.robot !== undefined || flow.linear === undefined) return;
            const motion = {
                linear: flow.linear,
                angular: flow.angular ?? [0, 0, 0],
                belt: flow.belt,
            } as SurfaceMotion;
            this.put(`scenery ${k}`, null, motion, () => [flow.shape], flow.at);
        });
        this.stale = true;
    }

    /** What robots say of their surfaces has changed. */
    private take(): void {
        const world = this.shown;
        for (const surface of this.surfaces.values()) surface.used = surface.of === null;
        for (const { robot, link, ...motion } of this.state.extras.value?.surfaces ?? [])
            if (world !== null && world.fleet.type(robot)?.links[link] !== undefined)
                this.put(`${robot} ${link}`, { robot, link }, motion, () => this.shapesOf(world, robot, link));
        for (const [key, surface] of [...this.surfaces]) if (!surface.used) this.remove(key);
    }

    /** The collision shapes of a link, those that are scenery included, in its frame. */
    private shapesOf(world: World, robot: number, link: number): Visual[] {
        const pose = linkPose(world, robot, link);
        return [
            ...world.fleet.type(robot).links[link].collisions.filter((shape) => shape.still !== true),
            ...(world.fleet.scene.flows ?? [])
                .filter((flow) => flow.robot === robot && flow.link === link)
                .map((flow) => shapeIn(pose, flow.shape)),
        ];
    }

    private put(key: string, of: Surface["of"], motion: SurfaceMotion, shapes: () => Visual[], at?: Triple): void {
        let surface = this.surfaces.get(key);
        if (surface === undefined) {
            if (this.surfaces.size >= SURFACES_MAX) return;
            surface = { of, marked: shapes().map((visual) => this.mark(visual, at)), used: true };
            this.surfaces.set(key, surface);
        }
        surface.used = true;
        for (const marked of surface.marked) marked.flow = flowOf(motion, marked.visual, marked.at);
    }

    private mark(visual: Visual, at: Triple | undefined): Marked {
        const plain = shapeGeometry(visual, this.shown?.loaded.meshes ?? new Map()),
            geometry = plain.applyMatrix4(poseMatrix(visual.frame)),
            rows = rowsOf(visual),
            mesh = new THREE.Mesh(geometry, new FlowMaterial(rows, visual.frame.slice(0, 3)));
        mesh.matrixAutoUpdate = false;
        mesh.renderOrder = 1;
        this.group.add(mesh);
        const flow = flowOf({ linear: [0, 0, 0], angular: [0, 0, 0] }, visual);
        return { mesh, visual, flow, phase: new FlowPhase(), pitch: rows.pitch, at };
    }

    private remove(key: string): void {
        for (const { mesh } of this.surfaces.get(key)?.marked ?? []) {
            this.group.remove(mesh);
            mesh.geometry.dispose();
            mesh.material.dispose();
        }
        this.surfaces.delete(key);
    }

    update(world: World | null): void {
        const passed = this.state.drawnTime.value - this.time,
            seconds = Math.abs(passed) < JUMP_S ? passed : 0;
        this.time = this.state.drawnTime.value;
        if (this.stale && world !== null && world === this.shown && world.history.latest !== null) {
            this.stale = false;
            this.take();
        }
        this.group.visible = world !== null && world === this.shown && this.any;
        if (world === null || !this.group.visible) return;
        for (const { of, marked } of this.surfaces.values()) {
            const matrix = poseMatrix(of === null ? IDENTITY : linkPose(world, of.robot, of.link));
            for (const { mesh, flow, phase, pitch } of marked) {
                phase.advance(flow, seconds, pitch);
                mesh.material.show(flow, phase);
                mesh.matrix.copy(matrix);
                mesh.matrixWorldNeedsUpdate = true;
            }
        }
    }
}
