// The camera of three.js for one view: with perspective or without, aimed as a rig says.
import * as THREE from "three";
import { FIELD_DEG, HALF_HEIGHT } from "../camera/fit";
import type { CameraRig } from "../camera/rig";

export type Lens = THREE.PerspectiveCamera | THREE.OrthographicCamera;

export class Lenses {
    private readonly perspective = new THREE.PerspectiveCamera(FIELD_DEG, 1, 0.1, 1000);
    private readonly flat = new THREE.OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
    lens: Lens = this.perspective;

    aim(rig: CameraRig, aspect: number): Lens {
        this.lens = rig.orthographic ? this.flat : this.perspective;
        const eye = rig.eye(),
            distance = rig.now.distance;
        this.lens.position.set(eye[0], eye[1], eye[2]);
        this.lens.up.set(0, 0, 1);
        this.lens.lookAt(rig.now.target[0], rig.now.target[1], rig.now.target[2]);
        if (this.lens === this.flat) {
            const high = HALF_HEIGHT * distance;
            [this.flat.top, this.flat.bottom] = [high, -high];
            [this.flat.left, this.flat.right] = [-high * aspect, high * aspect];
            [this.flat.near, this.flat.far] = [-Math.max(200, distance * 20), Math.max(400, distance * 40)];
        } else {
            this.perspective.aspect = aspect;
            this.perspective.near = Math.max(0.02, distance / 400);
            this.perspective.far = Math.max(400, distance * 60);
        }
        this.lens.updateProjectionMatrix();
        this.lens.updateMatrixWorld();
        return this.lens;
    }
}
