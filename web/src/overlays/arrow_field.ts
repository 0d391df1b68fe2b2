// Many arrows in one draw call: a shaft and a head in one mesh, stretched along z to its length.
import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { Instances } from "./instances";

const UP = new THREE.Vector3(0, 0, 1);
const LENGTH_MIN_M = 1e-3;

function arrowGeometry(): THREE.BufferGeometry {
    const shaft = new THREE.CylinderGeometry(0.28, 0.28, 0.78, 10).rotateX(Math.PI / 2).translate(0, 0, 0.39);
    const head = new THREE.ConeGeometry(0.75, 0.24, 14).rotateX(Math.PI / 2).translate(0, 0, 0.88);
    return mergeGeometries([shaft, head]);
}

export class ArrowField {
    private readonly arrows: Instances;
    private readonly matrix = new THREE.Matrix4();
    private readonly turn = new THREE.Quaternion();

    /** `thickness`: radius of the head's foot, m. */
    constructor(
        capacity: number,
        private readonly thickness: number,
    ) {
        this.arrows = new Instances(arrowGeometry(), new THREE.MeshBasicMaterial({ toneMapped: false }), capacity);
    }

    get mesh(): THREE.InstancedMesh {
        return this.arrows.mesh;
    }

    begin(): void {
        this.arrows.begin();
    }

    add(from: THREE.Vector3, way: THREE.Vector3, colour: THREE.Color): void {
        const length = way.length();
        if (length < LENGTH_MIN_M) return;
        this.turn.setFromUnitVectors(UP, way.clone().divideScalar(length));
        const width = Math.min(this.thickness, length * 0.3);
        this.arrows.add(this.matrix.compose(from, this.turn, new THREE.Vector3(width, width, length)), colour);
    }

    end(): void {
        this.arrows.end();
    }
}
