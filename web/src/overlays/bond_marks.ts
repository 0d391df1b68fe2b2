// Bonds between robots: a bar from the link that holds to the link that is held, with a knob at either end, seen through
// whatever is in front. A bond of the selected robot stands out.
import * as THREE from "three";
import { linkMiddle, linkPose } from "../kinematics/link_pose";
import { transform } from "../kinematics/pose";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";
import type { BondInfo } from "../wire/onboard";
import { BarField } from "./bar_field";

const COLOUR = new THREE.Color(0x2fd6c3),
    CHOSEN = new THREE.Color(0xff5fd2);
/** Of the distance from the camera: about as wide on the screen everywhere. */
const RADIUS_OF_DISTANCE = 0.0022;
const RADIUS_MAX_M = 0.03;

export class BondMarks {
    private readonly bars = new BarField("bonds", 0.9);

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
    ) {
        stage.overlays.add(this.bars.group);
    }

    update(world: World | null): void {
        const bonds = this.state.extras.value?.bonds ?? [];
        this.bars.group.visible = world !== null && bonds.length > 0;
        if (world === null || !this.bars.group.visible) return;
        this.bars.begin();
        for (const bond of bonds) if (Math.max(bond.robot, bond.other) < world.fleet.count) this.draw(world, bond);
        this.bars.end();
    }

    private end(world: World, robot: number, link: number): THREE.Vector3 {
        const middle = linkMiddle(world.fleet.type(robot), link);
        return new THREE.Vector3(...transform(linkPose(world, robot, link), middle));
    }

    /** Where the holder takes hold of the scenery. */
    private grip(world: World, bond: BondInfo): THREE.Vector3 {
        return new THREE.Vector3(...transform(linkPose(world, bond.robot, bond.link), bond.point ?? [0, 0, 0]));
    }

    private draw(world: World, bond: BondInfo): void {
        const a = this.end(world, bond.robot, bond.link),
            b = bond.other < 0 ? this.grip(world, bond) : this.end(world, bond.other, bond.other_link),
            chosen = [bond.robot, bond.other].includes(this.state.selected.value ?? -1),
            colour = chosen ? CHOSEN : COLOUR,
            away = this.stage.camera.position.distanceTo(a),
            radius = Math.min(RADIUS_MAX_M, away * RADIUS_OF_DISTANCE);
        this.bars.bar(a, b, radius, colour);
        for (const at of [a, b]) this.bars.ball(at, 2.4 * radius, colour);
    }
}
