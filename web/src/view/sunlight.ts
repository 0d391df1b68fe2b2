// The sun, whose shadows cover what the camera looks at. The shadow's box moves in whole
// texels, so that its edges do not crawl while the camera does.
import * as THREE from "three";
import { rotate } from "../kinematics/pose";
import type { LightInfo } from "../wire/look";
import type { ScenePalette } from "./palette";

export const TOWARDS_SUN = new THREE.Vector3(-0.52, -0.42, 0.9).normalize();

export class Sunlight {
    readonly group = new THREE.Group();
    private readonly sun = new THREE.DirectionalLight(0xffffff, 2);
    private towards = TOWARDS_SUN;
    private ended = false;

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
        const side = this.side(),
            up = this.towards.clone().cross(side);
        const snap = (axis: THREE.Vector3) => axis.clone().multiplyScalar(Math.round(target.dot(axis) / texel) * texel);
        const centre = snap(side)
            .add(snap(up))
            .add(this.towards.clone().multiplyScalar(target.dot(this.towards)));
        this.sun.target.position.copy(centre);
        this.sun.position.copy(centre).addScaledVector(this.towards, half * 2 + 20);
        if (Math.abs(camera.right - half) / half > 0.001) {
            camera.left = camera.bottom = -half;
            camera.right = camera.top = half;
            camera.near = 1;
            camera.far = half * 4 + 60;
            this.sun.shadow.normalBias = texel * 1.6;
            camera.updateProjectionMatrix();
        }
    }

    /** A horizontal direction across the light. */
    private side(): THREE.Vector3 {
        const side = new THREE.Vector3(0, 0, 1).cross(this.towards);
        return side.lengthSq() > 1e-8 ? side.normalize() : new THREE.Vector3(1, 0, 0);
    }

    direct(towards: THREE.Vector3): void {
        this.towards = towards;
    }

    /** Shines as this directional light does. */
    become(light: LightInfo): void {
        const way = rotate(light.frame, light.direction ?? [0, 0, -1]);
        this.towards = new THREE.Vector3(-way[0], -way[1], -way[2]).normalize();
        this.sun.color.setRGB(...light.rgb, THREE.SRGBColorSpace);
        this.sun.intensity = Math.PI * light.intensity;
    }

    shine(on: boolean, shadows: boolean): void {
        this.sun.visible = on;
        this.sun.castShadow = shadows && this.resolution > 0 && !this.ended;
    }

    endShadows(): void {
        this.ended = true;
        this.sun.castShadow = false;
    }

    paint(palette: ScenePalette): void {
        this.sun.color.setHex(palette.sun);
        this.sun.intensity = palette.sunStrength;
    }
}
