// Bars between points, and balls, that change each time: begin, add them, end. Seen through whatever is in front; the
// buffers grow and are never given back.
import * as THREE from "three";

const UP = new THREE.Vector3(0, 1, 0);

/** Instances of one shape, of size 1. */
class Instances {
    mesh: THREE.InstancedMesh;
    private used = 0;
    private capacity = 64;

    constructor(
        private readonly group: THREE.Group,
        private readonly name: string,
        private readonly geometry: THREE.BufferGeometry,
        private readonly material: THREE.Material,
    ) {
        this.mesh = this.make();
    }

    private make(): THREE.InstancedMesh {
        const mesh = new THREE.InstancedMesh(this.geometry, this.material, this.capacity);
        mesh.name = this.name;
        mesh.frustumCulled = false;
        mesh.renderOrder = 4;
        mesh.count = 0;
        this.group.add(mesh);
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
        for (let k = 0; k < this.used; ++k) {
            before.getMatrixAt(k, matrix);
            before.getColorAt(k, colour);
            this.mesh.setMatrixAt(k, matrix);
            this.mesh.setColorAt(k, colour);
        }
        before.removeFromParent();
        before.dispose();
    }

    end(): void {
        this.mesh.count = this.used;
        this.mesh.instanceMatrix.needsUpdate = true;
        if (this.mesh.instanceColor !== null) this.mesh.instanceColor.needsUpdate = true;
    }
}

export class BarField {
    readonly group = new THREE.Group();
    private readonly bars: Instances;
    private readonly balls: Instances;
    private readonly matrix = new THREE.Matrix4();

    /** `name` is that of the meshes: "NAME bars", "NAME balls". */
    constructor(name: string, opacity: number) {
        const material = new THREE.MeshBasicMaterial({
            toneMapped: false,
            depthTest: false,
            depthWrite: false,
            transparent: true,
            opacity,
        });
        this.bars = new Instances(this.group, `${name} bars`, new THREE.CylinderGeometry(1, 1, 1, 10), material);
        this.balls = new Instances(this.group, `${name} balls`, new THREE.SphereGeometry(1, 14, 10), material);
    }

    begin(): void {
        this.bars.begin();
        this.balls.begin();
    }

    bar(from: THREE.Vector3, to: THREE.Vector3, radius: number, colour: THREE.Color): void {
        const way = to.clone().sub(from),
            length = way.length(),
            turn = new THREE.Quaternion();
        if (length > 1e-9) turn.setFromUnitVectors(UP, way.divideScalar(length));
        const middle = from.clone().lerp(to, 0.5);
        this.bars.add(this.matrix.compose(middle, turn, new THREE.Vector3(radius, length, radius)), colour);
    }

    ball(at: THREE.Vector3, radius: number, colour: THREE.Color): void {
        const size = new THREE.Vector3().setScalar(radius);
        this.balls.add(this.matrix.compose(at, new THREE.Quaternion(), size), colour);
    }

    end(): void {
        this.bars.end();
        this.balls.end();
    }
}
