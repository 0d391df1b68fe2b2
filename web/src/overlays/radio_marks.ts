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
import { BarField } from "./bar_field";
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

export class RadioMarks {
    private readonly bars = new BarField("radio", 0.85);
    private readonly rings = new LineField(0.9);
    private readonly traffic = new RadioTraffic();
    private world: World | null = null;

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
    ) {
        stage.overlays.add(this.bars.group, this.rings.lines);
        state.overlayReport.follow((report) => {
            if (report?.radio !== undefined) this.traffic.take(report.radio);
        });
    }

    update(world: World | null, now: number): void {
        const on = this.state.overlays.value.has("radio");
        if (!on || world !== this.world) this.traffic.forget();
        this.world = world;
        this.traffic.advance(now, this.state.drawnTime.value);
        this.bars.group.visible = this.rings.lines.visible = on && world !== null && !this.traffic.quiet;
        if (world === null || !this.bars.group.visible) return;
        this.drawLinks(world);
        this.drawSenders(world);
    }

    private drawLinks(world: World): void {
        this.bars.begin();
        for (const { what, age } of this.traffic.links) {
            const a = this.antenna(world, what.from, what.antenna),
                b = this.antenna(world, what.to, what.sensor);
            if (a === null || b === null) continue;
            const colour = this.colourOf(what),
                radius = this.stage.camera.position.distanceTo(a.clone().lerp(b, 0.5)) * RADIUS_OF_DISTANCE;
            this.bars.bar(a, b, radius * (1 - (0.7 * age) / LINK_SHOWN_S), colour);
            if (age < PULSE_S) this.bars.ball(a.lerp(b, age / PULSE_S), radius * BEAD, colour);
        }
        this.bars.end();
    }

    private colourOf(link: RadioLinkReport): THREE.Color {
        const chosen = [link.from, link.to].includes(this.state.selected.value ?? -1);
        return chosen ? CHOSEN : WEAK.clone().lerp(GOOD, quality(link.margin));
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
