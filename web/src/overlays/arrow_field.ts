// Many arrows in two draw calls' worth of instances: a shaft and a head in one mesh, stretched along z to its length.
import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

const UP = new THREE.Vector3(0, 0, 1);
const LENGTH_MIN_M = 1e-3;

function arrowGeometry(): THREE.BufferGeometry {
    const shaft = new THREE.CylinderGeometry(0.28, 0.28, 0.78, 10).rotateX(Math.PI / 2).translate(0, 0, 0.39);
    const head = new THREE.ConeGeometry(0.75, 0.24, 14).rotateX(Math.PI / 2).translate(0, 0, 0.88);
    return mergeGeometries([shaft, head]);
}

export class ArrowField {
    mesh: THREE.InstancedMesh;
    private readonly geometry = arrowGeometry();
    private readonly material = new THREE.MeshBasicMaterial({ toneMapped: false });
    private used = 0;
    private readonly matrix = new THREE.Matrix4();
    private readonly turn = new THREE.Quaternion();

    /** `thickness`: radius of the head's foot, m. */
    constructor(
        private capacity: number,
        private readonly thickness: number,
    ) {
        this.mesh = this.make();
    }

    private make(): THREE.InstancedMesh {
        const mesh = new THREE.InstancedMesh(this.geometry, this.material, this.capacity);
        mesh.frustumCulled = false;
        mesh.count = 0;
        return mesh;
    }

    begin(): void {
        this.used = 0;
    }

    add(from: THREE.Vector3, way: THREE.Vector3, colour: THREE.Color): void {
        const length = way.length();
        if (length < LENGTH_MIN_M) return;
        if (this.used === this.capacity) this.grow();
        this.turn.setFromUnitVectors(UP, way.clone().divideScalar(length));
        const width = Math.min(this.thickness, length * 0.3);
        this.matrix.compose(from, this.turn, new THREE.Vector3(width, width, length));
        this.mesh.setMatrixAt(this.used, this.matrix);
        this.mesh.setColorAt(this.used, colour);
        ++this.used;
    }

    private grow(): void {
        const before = this.mesh;
        this.capacity *= 2;
        this.mesh = this.make();
        const matrix = new THREE.Matrix4(),
            colour = new THREE.Color();
        for (let k = 0; k < this.used; ++k) {
            before.getMatrixAt(k, matrix);
            before.getColorAt(k, colour);
            this.mesh.setMatrixAt(k, matrix);
            this.mesh.setColorAt(k, colour);
        }
        before.parent?.add(this.mesh);
        before.removeFromParent();
        before.dispose();
    }

    end(): void {
        this.mesh.count = this.used;
        this.mesh.instanceMatrix.needsUpdate = true;
        if (this.mesh.instanceColor !== null) this.mesh.instanceColor.needsUpdate = true;
    }
}
