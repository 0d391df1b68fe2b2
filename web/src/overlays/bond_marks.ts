// Bonds between robots: a bar from the link that holds to the link that is held, with a knob at either end, seen through
// whatever is in front. A bond of the selected robot stands out.
import * as THREE from "three";
import { linkMiddle, linkPose } from "../kinematics/link_pose";
import { transform } from "../kinematics/pose";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";
import type { BondInfo } from "../wire/onboard";

const COLOUR = new THREE.Color(0x2fd6c3),
    CHOSEN = new THREE.Color(0xff5fd2);
/** Of the distance from the camera: about as wide on the screen everywhere. */
const RADIUS_OF_DISTANCE = 0.0022;
const RADIUS_MAX_M = 0.03;
const UP = new THREE.Vector3(0, 1, 0);

export class BondMarks {
    private readonly group = new THREE.Group();
    private bars: THREE.InstancedMesh;
    private knobs: THREE.InstancedMesh;
    private capacity = 16;
    private readonly material = new THREE.MeshBasicMaterial({
        toneMapped: false,
        depthTest: false,
        depthWrite: false,
        transparent: true,
        opacity: 0.9,
    });
    private readonly bar = new THREE.CylinderGeometry(1, 1, 1, 10);
    private readonly knob = new THREE.SphereGeometry(1, 14, 10);

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
    ) {
        [this.bars, this.knobs] = this.make();
        stage.overlays.add(this.group);
    }

    private make(): [THREE.InstancedMesh, THREE.InstancedMesh] {
        for (const mesh of [this.bars, this.knobs]) mesh?.dispose();
        this.group.clear();
        const made = [this.bar, this.knob].map((geometry, k) => {
            const mesh = new THREE.InstancedMesh(geometry, this.material, this.capacity * (k + 1));
            mesh.frustumCulled = false;
            mesh.renderOrder = 4;
            this.group.add(mesh);
            return mesh;
        });
        return [made[0], made[1]];
    }

    update(world: World | null): void {
        const bonds = this.state.extras.value?.bonds ?? [];
        this.group.visible = world !== null && bonds.length > 0;
        if (world === null || !this.group.visible) return;
        if (bonds.length > this.capacity) {
            while (this.capacity < bonds.length) this.capacity *= 2;
            [this.bars, this.knobs] = this.make();
        }
        let drawn = 0;
        for (const bond of bonds)
            if (Math.max(bond.robot, bond.other) < world.fleet.count) this.draw(world, bond, drawn++);
        this.bars.count = drawn;
        this.knobs.count = 2 * drawn;
        for (const mesh of [this.bars, this.knobs]) {
            mesh.instanceMatrix.needsUpdate = true;
            if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
        }
    }

    private end(world: World, robot: number, link: number): THREE.Vector3 {
        const middle = linkMiddle(world.fleet.type(robot), link);
        return new THREE.Vector3(...transform(linkPose(world, robot, link), middle));
    }

    /** Where the holder takes hold of the scenery. */
    private grip(world: World, bond: BondInfo): THREE.Vector3 {
        return new THREE.Vector3(...transform(linkPose(world, bond.robot, bond.link), bond.point ?? [0, 0, 0]));
    }

    private draw(world: World, bond: BondInfo, k: number): void {
        const a = this.end(world, bond.robot, bond.link),
            b = bond.other < 0 ? this.grip(world, bond) : this.end(world, bond.other, bond.other_link),
            way = b.clone().sub(a),
            length = way.length(),
            chosen = [bond.robot, bond.other].includes(this.state.selected.value ?? -1),
            away = this.stage.camera.position.distanceTo(a);
        const radius = Math.min(RADIUS_MAX_M, away * RADIUS_OF_DISTANCE),
            turn = new THREE.Quaternion();
        if (length > 1e-9) turn.setFromUnitVectors(UP, way.divideScalar(length));
        const matrix = new THREE.Matrix4(),
            middle = a.clone().add(b).multiplyScalar(0.5);
        this.bars.setMatrixAt(k, matrix.compose(middle, turn, new THREE.Vector3(radius, length, radius)));
        this.bars.setColorAt(k, chosen ? CHOSEN : COLOUR);
        const knob = new THREE.Vector3().setScalar(2.4 * radius);
        [a, b].forEach((at, end) => {
            this.knobs.setMatrixAt(2 * k + end, matrix.compose(at, turn, knob));
            this.knobs.setColorAt(2 * k + end, chosen ? CHOSEN : COLOUR);
        });
    }
}
