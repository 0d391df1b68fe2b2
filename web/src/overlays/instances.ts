// Many copies of one shape in one draw call, that change each time: begin, add them, end. The buffer grows and is never
// given back.
import * as THREE from "three";

export class Instances {
    /** Add it to a group; where the buffer grows, another one takes its place there, with its name and its order. */
    mesh: THREE.InstancedMesh;
    private used = 0;

    constructor(
        private readonly geometry: THREE.BufferGeometry,
        private readonly material: THREE.Material,
        private capacity = 64,
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

    add(matrix: THREE.Matrix4, colour: THREE.Color): void {
        if (this.used === this.capacity) this.grow();
        this.mesh.setMatrixAt(this.used, matrix);
        this.mesh.setColorAt(this.used, colour);
        ++this.used;
    }

    private grow(): void {
        const before = this.mesh,
            matrix = new THREE.Matrix4(),
            colour = new THREE.Color();
        this.capacity *= 2;
        this.mesh = this.make();
        this.mesh.name = before.name;
        this.mesh.renderOrder = before.renderOrder;
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
