// Lines that change each time: begin, add pieces, end. A piece may begin fainter than it ends, where the field is not opaque.
// The buffer grows and is never given back.
import * as THREE from "three";

export class LineField {
    readonly lines: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
    private data = new Float32Array(3 * 2 * 256);
    private colours = new Float32Array(4 * 2 * 256);
    private used = 0;

    constructor(opacity = 1) {
        const material = new THREE.LineBasicMaterial({
            vertexColors: true,
            transparent: opacity < 1,
            opacity,
            toneMapped: false,
            depthWrite: false,
        });
        this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), material);
        this.lines.frustumCulled = false;
        this.lines.renderOrder = 3;
        this.attach();
    }

    private attach(): void {
        const geometry = this.lines.geometry;
        geometry.setAttribute("position", new THREE.BufferAttribute(this.data, 3).setUsage(THREE.DynamicDrawUsage));
        geometry.setAttribute("color", new THREE.BufferAttribute(this.colours, 4).setUsage(THREE.DynamicDrawUsage));
    }

    begin(): void {
        this.used = 0;
    }

    add(ax: number, ay: number, az: number, bx: number, by: number, bz: number, colour: THREE.Color, begin = 1): void {
        if (this.used + 6 > this.data.length) this.grow();
        this.data.set([ax, ay, az, bx, by, bz], this.used);
        const { r, g, b } = colour;
        this.colours.set([r, g, b, begin, r, g, b, 1], (this.used / 3) * 4);
        this.used += 6;
    }

    private grow(): void {
        const data = new Float32Array(this.data.length * 2),
            colours = new Float32Array(this.colours.length * 2);
        data.set(this.data);
        colours.set(this.colours);
        this.data = data;
        this.colours = colours;
        this.lines.geometry.dispose();
        this.attach();
    }

    end(): void {
        const geometry = this.lines.geometry;
        geometry.setDrawRange(0, this.used / 3);
        geometry.getAttribute("position").needsUpdate = true;
        geometry.getAttribute("color").needsUpdate = true;
    }
}
