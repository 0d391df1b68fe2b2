// The sun, whose shadows cover what the camera looks at. The shadow's box moves in whole
// texels, so that its edges do not crawl while the camera does.
import * as THREE from "three";
import type { ScenePalette } from "./palette";

const TOWARDS_SUN = new THREE.Vector3(-0.52, -0.42, 0.9).normalize();

export class Sunlight {
    readonly group = new THREE.Group();
    private readonly sun = new THREE.DirectionalLight(0xffffff, 2);

    constructor(private readonly resolution: number) {
        this.sun.castShadow = resolution > 0;
        this.sun.shadow.mapSize.set(resolution || 512, resolution || 512);
        this.sun.shadow.radius = 2.5;
        this.sun.shadow.intensity = 0.9;
        this.sun.shadow.bias = -0.0004;
        this.group.add(this.sun, this.sun.target);
    }

    follow(target: THREE.Vector3, distance: number): void {
        const half = Math.min(160, Math.max(3, distance * 0.95)),
            texel = (2 * half) / (this.resolution || 1024);
        const camera = this.sun.shadow.camera;
        const side = new THREE.Vector3(0, 0, 1).cross(TOWARDS_SUN).normalize(),
            up = TOWARDS_SUN.clone().cross(side);
        const snap = (axis: THREE.Vector3) => axis.clone().multiplyScalar(Math.round(target.dot(axis) / texel) * texel);
        const centre = snap(side)
            .add(snap(up))
            .add(TOWARDS_SUN.clone().multiplyScalar(target.dot(TOWARDS_SUN)));
        this.sun.target.position.copy(centre);
        this.sun.position.copy(centre).addScaledVector(TOWARDS_SUN, half * 2 + 20);
        if (Math.abs(camera.right - half) / half > 0.001) {
            camera.left = camera.bottom = -half;
            camera.right = camera.top = half;
            camera.near = 1;
            camera.far = half * 4 + 60;
            this.sun.shadow.normalBias = texel * 1.6;
            camera.updateProjectionMatrix();
        }
    }

    endShadows(): void {
        this.sun.castShadow = false;
    }

    paint(palette: ScenePalette): void {
        this.sun.color.setHex(palette.sun);
        this.sun.intensity = palette.sunStrength;
    }
}
