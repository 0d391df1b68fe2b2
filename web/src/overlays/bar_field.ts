// Bars between points, and balls, that change each time: begin, add them, end. Seen through whatever is in front.
import * as THREE from "three";
import { Instances } from "./instances";

const UP = new THREE.Vector3(0, 1, 0);

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
        this.bars = new Instances(new THREE.CylinderGeometry(1, 1, 1, 10), material);
        this.balls = new Instances(new THREE.SphereGeometry(1, 14, 10), material);
        this.bars.mesh.name = `${name} bars`;
        this.balls.mesh.name = `${name} balls`;
        for (const { mesh } of [this.bars, this.balls]) {
            mesh.renderOrder = 4;
            this.group.add(mesh);
        }
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
