// What the run tells of itself: contact forces as arrows, swept boxes, bounding spheres, and islands as hulls on the
// ground round robots that may touch.
import * as THREE from "three";
import type { ViewerState, World } from "../model/viewer_state";
import type { ContactReport, OverlayReport } from "../wire/overlay";
import { groupColour } from "../view/palette";
import type { Stage } from "../view/stage";
import { ArrowField } from "./arrow_field";
import { hullAround } from "./hull";
import { LineField } from "./line_field";

const METRES_A_NEWTON = 0.01;
const ARROW_MAX_M = 3;
const FORCE = new THREE.Color(0xff9f43),
    BOX = new THREE.Color(0x46c8e8),
    SPHERE = new THREE.Color(0xa78bfa);
const CORNERS = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];
const SPHERE_STEPS = 24;
const HULL_HEIGHT_M = 0.02;
const HULL_SPARE_M = 0.12;

export class RunOverlays {
    private readonly arrows = new ArrowField(64, 0.03);
    private readonly boxes = new LineField(0.85);
    private readonly spheres = new LineField(0.55);
    private readonly hullLines = new LineField(0.95);
    private readonly hullFill: THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>;
    private lastHulls = 0;
    private readonly holder = new THREE.Group();

    constructor(
        stage: Stage,
        private readonly state: ViewerState,
    ) {
        this.hullFill = new THREE.Mesh(
            new THREE.BufferGeometry(),
            new THREE.MeshBasicMaterial({
                vertexColors: true,
                transparent: true,
                opacity: 0.3,
                depthWrite: false,
                side: THREE.DoubleSide,
                toneMapped: false,
            }),
        );
        this.hullFill.frustumCulled = false;
        this.hullFill.renderOrder = 2;
        this.holder.add(this.arrows.mesh);
        stage.overlays.add(this.holder, this.boxes.lines, this.spheres.lines, this.hullLines.lines, this.hullFill);
        state.overlayReport.follow((report) => report !== null && this.take(report));
    }

    private take(report: OverlayReport): void {
        if (report.contacts !== undefined) this.drawContacts(report.contacts);
        if (report.bounds === undefined) return;
        this.boxes.begin();
        for (const { box } of report.bounds) this.drawBox(box.flat());
        this.boxes.end();
    }

    private drawContacts(contacts: readonly ContactReport[]): void {
        this.arrows.begin();
        for (const contact of contacts) {
            const way = new THREE.Vector3(...contact.force).multiplyScalar(METRES_A_NEWTON);
            this.arrows.add(new THREE.Vector3(...contact.point), way.clampLength(0, ARROW_MAX_M), FORCE);
        }
        this.arrows.end();
    }

    private drawBox(box: readonly number[]): void {
        const corner = (k: number) => [box[k & 1 ? 3 : 0], box[k & 2 ? 4 : 1], box[k & 4 ? 5 : 2]];
        for (const [a, b] of CORNERS) {
            const p = corner(a),
                q = corner(b);
            this.boxes.add(p[0], p[1], p[2], q[0], q[1], q[2], BOX);
        }
    }

    /** The sphere of a robot's whole reach: the first thing that the search for contacts looks at. */
    private drawSpheres(world: World): void {
        const base = world.history.drawn.base;
        this.spheres.begin();
        for (let r = 0; r < world.fleet.count; ++r)
            this.drawSphere(base[r * 7], base[r * 7 + 1], base[r * 7 + 2], world.fleet.type(r).reach);
        this.spheres.end();
    }

    private drawSphere(x: number, y: number, z: number, radius: number): void {
        const steps = SPHERE_STEPS;
        for (let k = 0; k < steps; ++k) {
            const a = (k / steps) * 2 * Math.PI,
                b = ((k + 1) / steps) * 2 * Math.PI;
            const [ca, sa, cb, sb] = [
                Math.cos(a) * radius,
                Math.sin(a) * radius,
                Math.cos(b) * radius,
                Math.sin(b) * radius,
            ];
            this.spheres.add(x + ca, y + sa, z, x + cb, y + sb, z, SPHERE);
            this.spheres.add(x + ca, y, z + sa, x + cb, y, z + sb, SPHERE);
            this.spheres.add(x, y + ca, z + sa, x, y + cb, z + sb, SPHERE);
        }
    }

    update(world: World | null, now: number): void {
        const on = this.state.overlays.value;
        this.holder.visible = on.has("contacts");
        this.boxes.lines.visible = on.has("bounds");
        this.spheres.lines.visible = on.has("spheres");
        if (world !== null && this.spheres.lines.visible) this.drawSpheres(world);
        this.hullLines.lines.visible = this.hullFill.visible = on.has("islands") && this.state.groups.value !== null;
        if (world === null || !this.hullFill.visible || now - this.lastHulls < 0.05) return;
        this.lastHulls = now;
        this.drawHulls(world);
    }

    private drawHulls(world: World): void {
        const island = this.state.groups.value?.island ?? [],
            members = new Map<number, number[]>();
        island.forEach(
            (of, robot) => robot < world.fleet.count && members.set(of, [...(members.get(of) ?? []), robot]),
        );
        const base = world.history.drawn.base,
            corners: number[] = [],
            colours: number[] = [],
            colour = new THREE.Color();
        this.hullLines.begin();
        for (const [of, robots] of members) {
            groupColour(of, colour);
            const hull = hullAround(
                robots.map((robot) => ({
                    x: base[robot * 7],
                    y: base[robot * 7 + 1],
                    radius: world.fleet.type(robot).reach + HULL_SPARE_M,
                })),
            );
            const z = HULL_HEIGHT_M;
            hull.forEach((p, k) => {
                const q = hull[(k + 1) % hull.length];
                this.hullLines.add(p.x, p.y, z, q.x, q.y, z, colour);
                if (k < 1 || k + 1 >= hull.length) return;
                corners.push(hull[0].x, hull[0].y, z, p.x, p.y, z, q.x, q.y, z);
                for (let n = 0; n < 3; ++n) colours.push(colour.r, colour.g, colour.b);
            });
        }
        this.hullLines.end();
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
        geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
        this.hullFill.geometry.dispose();
        this.hullFill.geometry = geometry;
    }
}
