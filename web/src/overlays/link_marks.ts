// Marks at links and joints: frames, centres of mass, boxes of equal inertia, joint axes with their limits, names. Of the
// robots that are selected, or of all if none is; at most so many links as LINKS_MAX says, the nearest robots first.
import * as THREE from "three";
import { composed, rotate, transform } from "../kinematics/pose";
import { bodyAt, placeBodies } from "../kinematics/tree";
import type { Selection } from "../model/selection";
import { robotKey } from "../model/sight";
import type { Overlay, ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";
import type { JointInfo, LinkInfo, TypeInfo } from "../wire/messages";
import { inertiaBox } from "./inertia_box";
import type { LabelLayer } from "./labels";
import { LineField } from "./line_field";

export const LINKS_MAX = 2000;
const LABELS_MAX = 60;
const MARKS: readonly Overlay[] = ["frames", "masses", "inertia", "axes", "labels"];
const RGB = [new THREE.Color(0xff5d5d), new THREE.Color(0x3fcf7f), new THREE.Color(0x5aa9ff)];
const INERTIA = new THREE.Color(0xc58bff),
    AXIS = new THREE.Color(0xffd166),
    LIMIT = new THREE.Color(0xff9f43),
    MASS = new THREE.Color(0xf6f6f6),
    MASS_EDGE = new THREE.Color(0x16181d);
const ARC_STEPS = 24;

export class LinkMarks {
    private readonly lines = new LineField(1);
    private readonly masses: THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial>;
    private readonly rims: THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial>;
    private bodies = new Float64Array(0);
    private on: ReadonlySet<Overlay> = new Set<Overlay>();

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly selection: Selection,
        private readonly labels: LabelLayer,
    ) {
        const points = (color: THREE.Color, size: number) =>
            new THREE.Points(
                new THREE.BufferGeometry(),
                new THREE.PointsMaterial({ color, size, sizeAttenuation: false, toneMapped: false, depthTest: false }),
            );
        this.rims = points(MASS_EDGE, 9);
        this.masses = points(MASS, 6);
        this.masses.frustumCulled = this.rims.frustumCulled = false;
        this.rims.renderOrder = 4;
        this.masses.renderOrder = 5;
        this.lines.lines.material.depthTest = false;
        stage.overlays.add(this.lines.lines, this.rims, this.masses);
    }

    update(world: World | null): void {
        this.on = this.state.overlays.value;
        const shown = world !== null && MARKS.some((mark) => this.on.has(mark));
        this.lines.lines.visible = shown;
        this.masses.visible = this.rims.visible = shown && this.on.has("masses");
        const named = new Set<string>();
        if (shown) {
            const centres: number[] = [];
            this.lines.begin();
            for (const robot of this.marked(world)) this.robot(world, robot, centres, named);
            this.lines.end();
            const attribute = new THREE.Float32BufferAttribute(centres, 3);
            this.masses.geometry.setAttribute("position", attribute);
            this.rims.geometry.setAttribute("position", attribute);
        }
        for (const key of this.labels.keysStarting("link ")) if (!named.has(key)) this.labels.put(key, null, "");
    }

    /** Robots to mark: few enough links. */
    private marked(world: World): number[] {
        const { fleet, history } = world,
            hidden = this.state.sight.hidden.value,
            chosen = this.selection.robots,
            eye = this.stage.camera.position,
            away = (robot: number) =>
                Math.hypot(...[0, 1, 2].map((k) => history.drawn.base[robot * 7 + k] - eye.getComponent(k)));
        let left = LINKS_MAX;
        return (chosen.length > 0 ? chosen : Array.from({ length: fleet.count }, (_, robot) => robot))
            .filter((robot) => !hidden.has(robotKey(fleet.name(robot))))
            .map((robot) => ({ robot, away: away(robot) }))
            .sort((a, b) => a.away - b.away)
            .filter(({ robot }) => (left -= fleet.type(robot).links.length) >= 0)
            .map(({ robot }) => robot);
    }

    private robot(world: World, robot: number, centres: number[], named: Set<string>): void {
        const type = world.fleet.type(robot),
            { drawn } = world.history,
            size = Math.max(0.05, Math.min(0.5, type.reach * 0.35));
        if (this.bodies.length < (type.bodies.length + 1) * 7)
            this.bodies = new Float64Array((type.bodies.length + 1) * 7);
        placeBodies(type, drawn.base, robot * 7, drawn.joints, world.fleet.firstCoordinate[robot], this.bodies);
        type.links.forEach((link, k) => {
            const at = bodyAt(link.body),
                frame = composed(this.bodies.subarray(at, at + 7), link.frame);
            this.link(link, frame, size, centres);
            if (!this.on.has("labels") || named.size >= LABELS_MAX) return;
            named.add(`link ${robot} ${k}`);
            this.labels.put(`link ${robot} ${k}`, new THREE.Vector3(...frame.slice(0, 3)), link.name);
        });
        if (this.on.has("axes"))
            for (const joint of type.joints) this.joint(type, joint, size, world.fleet.firstCoordinate[robot], world);
    }

    private link(link: LinkInfo, frame: number[], size: number, centres: number[]): void {
        if (this.on.has("frames"))
            RGB.forEach((colour, k) => {
                const tip = transform(
                    frame,
                    [0, 1, 2].map((axis) => (axis === k ? size : 0)),
                );
                this.line(frame, tip, colour);
            });
        if (link.mass === undefined || link.centre === undefined || link.inertia === undefined) return;
        if (this.on.has("masses")) centres.push(...transform(frame, link.centre));
        if (!this.on.has("inertia")) return;
        const { edges } = inertiaBox(link.mass, link.inertia),
            [x, y, z] = link.centre;
        for (const [a, b] of edges)
            this.line(
                transform(frame, [a[0] + x, a[1] + y, a[2] + z]),
                transform(frame, [b[0] + x, b[1] + y, b[2] + z]),
                INERTIA,
            );
    }

    private line(a: readonly number[], b: readonly number[], colour: THREE.Color): void {
        this.lines.add(a[0], a[1], a[2], b[0], b[1], b[2], colour);
    }

    /** The axis of each of the joint's bodies, with a head; the limits as an arc, or as the length of the slide. */
    private joint(type: TypeInfo, joint: JointInfo, size: number, first: number, world: World): void {
        const body = type.bodies[joint.body];
        if (body === undefined || body.course === "none" || body.course === "quaternion") return;
        const parent = bodyAt(body.parent),
            at = composed(this.bodies.subarray(parent, parent + 7), body.frame),
            axis = rotate(at, body.axis),
            from = [0, 1, 2].map((k) => at[k] - axis[k] * size * 0.6),
            to = [0, 1, 2].map((k) => at[k] + axis[k] * size);
        this.line(from, to, AXIS);
        const across = perpendicular(axis);
        for (const side of [-1, 1])
            this.line(
                to,
                [0, 1, 2].map((k) => to[k] + size * 0.12 * (side * across[k] - 1.6 * axis[k])),
                AXIS,
            );
        const lower = joint.lower[0] ?? null,
            upper = joint.upper[0] ?? null;
        if (lower === null || upper === null || joint.axes !== 1) return;
        if (body.turn === 0) {
            const end = (q: number) => [0, 1, 2].map((k) => at[k] + axis[k] * q * body.slide);
            return this.line(end(lower), end(upper), LIMIT);
        }
        this.arc(at, axis, size * 0.7, lower, Math.min(upper, lower + 2 * Math.PI));
        const now = world.history.drawn.joints[first + body.q];
        this.line(at, onArc(at, axis, size * 0.7, now), AXIS);
    }

    private arc(at: number[], axis: readonly number[], radius: number, lower: number, upper: number): void {
        let before = onArc(at, axis, radius, lower);
        this.line(at, before, LIMIT);
        for (let k = 1; k <= ARC_STEPS; ++k) {
            const next = onArc(at, axis, radius, lower + ((upper - lower) * k) / ARC_STEPS);
            this.line(before, next, LIMIT);
            before = next;
        }
        this.line(at, before, LIMIT);
    }
}

function perpendicular(axis: readonly number[]): number[] {
    const a = new THREE.Vector3(axis[0], axis[1], axis[2]),
        other = Math.abs(a.x) < 0.8 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
    return a.cross(other).normalize().toArray();
}

function onArc(at: number[], axis: readonly number[], radius: number, angle: number): number[] {
    const a = new THREE.Vector3(axis[0], axis[1], axis[2]),
        arm = new THREE.Vector3(...perpendicular(axis)).applyAxisAngle(a, angle).multiplyScalar(radius);
    return [at[0] + arm.x, at[1] + arm.y, at[2] + arm.z];
}
