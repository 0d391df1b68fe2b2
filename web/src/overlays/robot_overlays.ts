// What the selected robot's report adds to the picture: laser rays, its compass on the ground, its contact forces.
import * as THREE from "three";
import { composed, rotate, transform } from "../kinematics/pose";
import { bodyAt, placeBodies } from "../kinematics/tree";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";
import { beamDirection, beginOpacity, HITS_MAX, RAYS_MAX, thinned } from "./beams";
import { LineField } from "./line_field";

const RAY = new THREE.Color(0xff5d73),
    RAY_FREE = new THREE.Color(0x8a4a58),
    HIT = new THREE.Color(0xffd166);
/** More of them are drawn small: they lie close together. */
const MANY_HITS = 200;
const NORTH = new THREE.Color(0xff5d5d),
    HEADING = new THREE.Color(0x5aa9ff),
    DIAL = new THREE.Color(0x8fa3bd);

export class RobotOverlays {
    private readonly rays = new LineField(0.75);
    private readonly dial = new LineField(0.9);
    private readonly hits: THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial>;
    private bodies = new Float64Array(0);

    constructor(
        stage: Stage,
        private readonly state: ViewerState,
    ) {
        this.hits = new THREE.Points(
            new THREE.BufferGeometry(),
            new THREE.PointsMaterial({ color: HIT, size: 5, sizeAttenuation: false, toneMapped: false }),
        );
        this.hits.frustumCulled = false;
        stage.overlays.add(this.rays.lines, this.dial.lines, this.hits);
    }

    update(world: World | null): void {
        const robot = this.state.selected.value,
            report = this.state.report.value,
            on = this.state.overlays.value;
        const ready = world !== null && robot !== null && report !== null && report.robot === robot;
        this.rays.lines.visible = ready && on.has("rays");
        this.hits.visible = ready && (on.has("rays") || on.has("points"));
        this.dial.lines.visible = world !== null && robot !== null && on.has("compass");
        if (this.hits.visible && world !== null && robot !== null) this.drawRays(world, robot);
        if (world !== null && robot !== null && on.has("compass")) this.drawDial(world, robot);
    }

    private drawRays(world: World, robot: number): void {
        const type = world.fleet.type(robot),
            report = this.state.report.value,
            { drawn } = world.history,
            points: number[] = [];
        if (this.bodies.length < (type.bodies.length + 1) * 7)
            this.bodies = new Float64Array((type.bodies.length + 1) * 7);
        placeBodies(type, drawn.base, robot * 7, drawn.joints, world.fleet.firstCoordinate[robot], this.bodies);
        this.rays.begin();
        type.sensors.forEach((sensor, k) => {
            const ranges = report?.sensors[k]?.ranges,
                link = type.links[sensor.link];
            if (ranges === undefined || link === undefined) return;
            const at = bodyAt(link.body),
                frame = composed(composed(this.bodies.subarray(at, at + 7), link.frame), sensor.frame);
            const hits = thinned(sensor, ranges.length, HITS_MAX),
                rays = thinned(sensor, ranges.length, RAYS_MAX),
                begin = beginOpacity(Math.min(RAYS_MAX, ranges.length)),
                most = sensor.range_max ?? 10;
            ranges.forEach((told, beam) => {
                if (!hits(beam) && !rays(beam)) return;
                const met = typeof told === "number" && Number.isFinite(told) && told < most,
                    range = met ? told : most;
                const way = beamDirection(sensor, beam),
                    end = transform(frame, [way[0] * range, way[1] * range, way[2] * range]);
                if (rays(beam))
                    this.rays.add(frame[0], frame[1], frame[2], end[0], end[1], end[2], met ? RAY : RAY_FREE, begin);
                if (met && hits(beam)) points.push(end[0], end[1], end[2]);
            });
        });
        this.rays.end();
        this.hits.material.size = points.length > 3 * MANY_HITS ? 3 : 5;
        this.hits.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    }

    private drawDial(world: World, robot: number): void {
        const base = world.history.drawn.base,
            at = robot * 7,
            reach = Math.max(0.3, world.fleet.type(robot).reach) * 2.2;
        const [x, y, z] = [base[at], base[at + 1], Math.max(0.01, base[at + 2] - world.fleet.type(robot).reach)];
        const ahead = rotate(base.subarray(at, at + 7), [1, 0, 0]),
            flat = Math.hypot(ahead[0], ahead[1]) || 1;
        this.dial.begin();
        for (let k = 0; k < 72; ++k) {
            const a = (k / 72) * 2 * Math.PI,
                b = ((k + 1) / 72) * 2 * Math.PI;
            this.dial.add(
                x + reach * Math.cos(a),
                y + reach * Math.sin(a),
                z,
                x + reach * Math.cos(b),
                y + reach * Math.sin(b),
                z,
                DIAL,
            );
            if (k % 6 === 0)
                this.dial.add(
                    x + reach * 0.9 * Math.cos(a),
                    y + reach * 0.9 * Math.sin(a),
                    z,
                    x + reach * Math.cos(a),
                    y + reach * Math.sin(a),
                    z,
                    DIAL,
                );
        }
        this.needle(x, y, z, 0, 1, reach, NORTH);
        this.needle(x, y, z, ahead[0] / flat, ahead[1] / flat, reach * 1.1, HEADING);
        this.dial.end();
    }

    private needle(x: number, y: number, z: number, dx: number, dy: number, length: number, colour: THREE.Color): void {
        const tx = x + dx * length,
            ty = y + dy * length,
            back = length * 0.14,
            side = length * 0.07;
        this.dial.add(x, y, z, tx, ty, z, colour);
        for (const s of [1, -1])
            this.dial.add(tx, ty, z, tx - dx * back - s * dy * side, ty - dy * back + s * dx * side, z, colour);
    }
}
