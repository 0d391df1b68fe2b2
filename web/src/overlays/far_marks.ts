// Marks of constant size for robots that are too small to be seen: 50 cars in a city are dust from afar. One of each place
// of the screen is marked, so that thousands do not cover the picture. A click near a mark selects its robot.
import * as THREE from "three";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";

/** Smaller robots are marked; diameter on the screen. */
const SEEN_PX = 6;
const MARK_PX = 7;
/** At most one mark in a square of this side. */
const CELL_PX = 9;
const CLICK_PX = 12;
const REACH_SEEN_M = 3;

/** Whether a robot of this reach is too small to be seen from so far. */
export function tooSmall(reach: number, distance: number, pixelsPerTangent: number): boolean {
    return (2 * Math.min(REACH_SEEN_M, reach) * pixelsPerTangent) / Math.max(1e-6, distance) < SEEN_PX;
}

export class FarMarks {
    private readonly geometry = new THREE.BufferGeometry();
    private readonly points: THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial>;
    private positions = new Float32Array(0);
    private colours = new Float32Array(0);
    private readonly place = new THREE.Vector3();
    private readonly colour = new THREE.Color();
    /** What is marked, in CSS pixels of the canvas. */
    private shown: { robot: number; x: number; y: number }[] = [];

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly colourOf: (world: World, robot: number, out: THREE.Color) => void,
    ) {
        const material = new THREE.PointsMaterial({ sizeAttenuation: false, vertexColors: true, fog: false });
        material.toneMapped = false;
        this.points = new THREE.Points(this.geometry, material);
        this.points.frustumCulled = false;
        this.points.renderOrder = 5;
        stage.overlays.add(this.points);
        stage.markAt = (x, y) => this.at(x, y);
    }

    get count(): number {
        return this.shown.length;
    }

    update(world: World | null): void {
        this.shown = [];
        // Several views share the overlays: what is small in one is large in another.
        if (world !== null && this.stage.ports.length === 1) this.collect(world);
        this.geometry.setDrawRange(0, this.shown.length);
        this.points.visible = this.shown.length > 0;
    }

    private collect(world: World): void {
        const { camera, canvas } = this.stage,
            width = canvas.clientWidth,
            height = canvas.clientHeight;
        if (this.positions.length !== world.fleet.count * 3) this.reserve(world.fleet.count);
        this.points.material.size = MARK_PX;
        const scale = (height / 2) * camera.projectionMatrix.elements[5],
            flat = camera.type === "OrthographicCamera",
            base = world.history.drawn.base,
            taken = new Set<number>(),
            selected = this.state.selected.value;
        for (let robot = 0; robot < world.fleet.count; ++robot) {
            const at = robot * 7;
            this.place.set(base[at], base[at + 1], base[at + 2]);
            const distance = flat ? 1 : camera.position.distanceTo(this.place);
            if (!tooSmall(world.fleet.type(robot).reach, distance, scale)) continue;
            const { x, y, z } = this.place.project(camera);
            if (z > 1 || Math.abs(x) > 1 || Math.abs(y) > 1) continue;
            const left = ((x + 1) / 2) * width,
                top = ((1 - y) / 2) * height,
                cell = Math.floor(left / CELL_PX) * 65536 + Math.floor(top / CELL_PX);
            if (taken.has(cell) && robot !== selected) continue;
            taken.add(cell);
            const k = this.shown.length * 3;
            this.positions.set([base[at], base[at + 1], base[at + 2]], k);
            this.colourOf(world, robot, this.colour);
            this.colours.set([this.colour.r, this.colour.g, this.colour.b], k);
            this.shown.push({ robot, x: left, y: top });
        }
        for (const name of ["position", "color"]) this.geometry.getAttribute(name).needsUpdate = true;
    }

    private reserve(count: number): void {
        this.positions = new Float32Array(count * 3);
        this.colours = new Float32Array(count * 3);
        this.geometry.setAttribute("position", new THREE.BufferAttribute(this.positions, 3));
        this.geometry.setAttribute("color", new THREE.BufferAttribute(this.colours, 3));
    }

    private at(x: number, y: number): number | null {
        let best: number | null = null,
            least = CLICK_PX;
        for (const mark of this.shown) {
            const away = Math.hypot(mark.x - x, mark.y - y);
            if (away < least) [best, least] = [mark.robot, away];
        }
        return best;
    }
}
