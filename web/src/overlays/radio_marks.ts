// Radio: a bar from sender to receiver for each message that was received lately, coloured by how far it was above the
// noise floor and seen through whatever is in front. It grows thin with age; a bead shows the direction. A ring round an
// antenna: it has sent something, heard or not.
import * as THREE from "three";
import { linkPose } from "../kinematics/link_pose";
import { transform } from "../kinematics/pose";
import { LINK_SHOWN_S, PULSE_S, quality, RadioTraffic } from "../model/radio_traffic";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";
import type { Triple } from "../wire/messages";
import type { RadioLinkReport } from "../wire/radio";
import { LineField } from "./line_field";

const WEAK = new THREE.Color(0xff5d4d),
    GOOD = new THREE.Color(0x37d67a),
    SENDER = new THREE.Color(0x5aa9ff),
    CHOSEN = new THREE.Color(0xff5fd2);
/** Of the distance from the camera: about as wide on the screen everywhere. */
const RADIUS_OF_DISTANCE = 0.0032;
const RING_OF_DISTANCE = 0.05;
const BEAD = 2.2;
const RING_STEPS = 32;
const UP = new THREE.Vector3(0, 1, 0);

export class RadioMarks {
    private readonly group = new THREE.Group();
    private readonly rings = new LineField(0.9);
    private readonly traffic = new RadioTraffic();
    private world: World | null = null;
    private capacity = 64;
    private bars: THREE.InstancedMesh;
    private beads: THREE.InstancedMesh;
    private readonly material = new THREE.MeshBasicMaterial({
        toneMapped: false,
        depthTest: false,
        depthWrite: false,
        transparent: true,
        opacity: 0.85,
    });
    private readonly bar = new THREE.CylinderGeometry(1, 1, 1, 8);
    private readonly bead = new THREE.SphereGeometry(1, 12, 8);

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
    ) {
        [this.bars, this.beads] = this.make();
        stage.overlays.add(this.group, this.rings.lines);
        state.overlayReport.follow((report) => {
            if (report?.radio !== undefined) this.traffic.take(report.radio);
        });
    }

    private make(): [THREE.InstancedMesh, THREE.InstancedMesh] {
        for (const mesh of [this.bars, this.beads]) mesh?.dispose();
        this.group.clear();
        const made = [this.bar, this.bead].map((geometry) => {
            const mesh = new THREE.InstancedMesh(geometry, this.material, this.capacity);
            mesh.name = geometry === this.bar ? "radio links" : "radio messages";
            mesh.frustumCulled = false;
            mesh.renderOrder = 4;
            this.group.add(mesh);
            return mesh;
        });
        return [made[0], made[1]];
    }

    update(world: World | null, now: number): void {
        const on = this.state.overlays.value.has("radio");
        if (!on || world !== this.world) this.traffic.forget();
        this.world = world;
        this.traffic.advance(now, this.state.drawnTime.value);
        this.group.visible = this.rings.lines.visible = on && world !== null && !this.traffic.quiet;
        if (world === null || !this.group.visible) return;
        this.drawLinks(world);
        this.drawSenders(world);
    }

    private drawLinks(world: World): void {
        const links = [...this.traffic.links];
        if (links.length > this.capacity) {
            while (this.capacity < links.length) this.capacity *= 2;
            [this.bars, this.beads] = this.make();
        }
        let bars = 0,
            beads = 0;
        for (const { what, age } of links) {
            const a = this.antenna(world, what.from, what.antenna),
                b = this.antenna(world, what.to, what.sensor);
            if (a === null || b === null) continue;
            const colour = this.colourOf(what),
                radius = this.stage.camera.position.distanceTo(a.clone().lerp(b, 0.5)) * RADIUS_OF_DISTANCE;
            this.drawBar(bars++, a, b, radius * (1 - (0.7 * age) / LINK_SHOWN_S), colour);
            if (age < PULSE_S) this.drawBead(beads++, a.lerp(b, age / PULSE_S), radius * BEAD, colour);
        }
        this.bars.count = bars;
        this.beads.count = beads;
        for (const mesh of [this.bars, this.beads]) {
            mesh.instanceMatrix.needsUpdate = true;
            if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
        }
    }

    private colourOf(link: RadioLinkReport): THREE.Color {
        const chosen = [link.from, link.to].includes(this.state.selected.value ?? -1);
        return chosen ? CHOSEN : WEAK.clone().lerp(GOOD, quality(link.margin));
    }

    private drawBar(k: number, a: THREE.Vector3, b: THREE.Vector3, radius: number, colour: THREE.Color): void {
        const way = b.clone().sub(a),
            length = way.length(),
            turn = new THREE.Quaternion();
        if (length > 1e-9) turn.setFromUnitVectors(UP, way.divideScalar(length));
        const middle = a.clone().lerp(b, 0.5);
        this.bars.setMatrixAt(k, new THREE.Matrix4().compose(middle, turn, new THREE.Vector3(radius, length, radius)));
        this.bars.setColorAt(k, colour);
    }

    private drawBead(k: number, at: THREE.Vector3, radius: number, colour: THREE.Color): void {
        const size = new THREE.Vector3().setScalar(radius);
        this.beads.setMatrixAt(k, new THREE.Matrix4().compose(at, new THREE.Quaternion(), size));
        this.beads.setColorAt(k, colour);
    }

    private drawSenders(world: World): void {
        this.rings.begin();
        for (const { what, age } of this.traffic.senders) {
            const at = this.antenna(world, what.robot, what.sensor);
            if (at === null) continue;
            const radius = this.stage.camera.position.distanceTo(at) * RING_OF_DISTANCE * (0.2 + (0.8 * age) / PULSE_S);
            for (let k = 0; k < RING_STEPS; ++k) {
                const p = (k / RING_STEPS) * 2 * Math.PI,
                    q = ((k + 1) / RING_STEPS) * 2 * Math.PI;
                this.rings.add(
                    at.x + radius * Math.cos(p),
                    at.y + radius * Math.sin(p),
                    at.z,
                    at.x + radius * Math.cos(q),
                    at.y + radius * Math.sin(q),
                    at.z,
                    SENDER,
                );
            }
        }
        this.rings.end();
    }

    /** null: the scene has no such radio. */
    private antenna(world: World, robot: number, sensor: number): THREE.Vector3 | null {
        if (robot >= world.fleet.count) return null;
        const info = world.fleet.type(robot).sensors[sensor];
        if (info === undefined) return null;
        const at = info.frame.slice(0, 3) as Triple;
        return new THREE.Vector3(...transform(linkPose(world, robot, info.link), at));
    }
}
