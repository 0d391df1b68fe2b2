// The lights that the file describes: those of the world stand still, those of links move with them. The first directional
// light is the sun, whose shadows follow the camera (view/sunlight.ts). SDF's attenuation 1 / (c + l d + q d^2) becomes the
// nearest power of the distance, which is what three.js has.
import * as THREE from "three";
import { composed, rotate, transform } from "../kinematics/pose";
import { bodyAt, placeBodies } from "../kinematics/tree";
import type { World } from "../model/viewer_state";
import type { LightInfo } from "../wire/look";
import type { PoseArray, Triple } from "../wire/messages";

/** Every light costs each pixel. */
export const LIGHTS_MAX = 16;
/** Lights beside the sun that throw shadows: each draws the world once more. */
export const SHADOWS_MAX = 2;
const SHADOW_SIZE = 1024;
/** An SDF light of 1 lights a white surface that faces it white. */
export const UNIT = Math.PI;

export function colourOf(rgb: Triple): THREE.Color {
    return new THREE.Color().setRGB(...rgb, THREE.SRGBColorSpace);
}

/** `strength` and `power` of strength / d^power, equal to the file's attenuation at 1 m and at half of the range. */
export function powerLaw(attenuation: Triple, range: number): { strength: number; power: number } {
    const at = (d: number) => 1 / Math.max(1e-6, attenuation[0] + attenuation[1] * d + attenuation[2] * d * d),
        far = Math.max(2, Math.min(range, 100) / 2);
    return { strength: at(1), power: Math.max(0, Math.log(at(1) / at(far)) / Math.log(far)) };
}

interface Shining {
    info: LightInfo;
    light: THREE.PointLight | THREE.SpotLight | THREE.DirectionalLight;
    /** Of the link that carries it; null: it stands still. */
    robot: number | null;
    body: number;
    linkFrame: PoseArray;
}

function make(info: LightInfo): Shining["light"] {
    const colour = colourOf(info.rgb);
    if (info.kind === "directional") return new THREE.DirectionalLight(colour, UNIT * info.intensity);
    const range = info.range ?? 10,
        { strength, power } = powerLaw(info.attenuation ?? [1, 0, 0], range),
        intensity = UNIT * info.intensity * strength;
    if (info.kind === "point") return new THREE.PointLight(colour, intensity, range, power);
    const [inner, outer] = info.spot ?? [0, Math.PI / 2];
    const angle = Math.min(Math.PI / 2 - 0.01, Math.max(0.01, outer / 2));
    return new THREE.SpotLight(colour, intensity, range, angle, Math.max(0, 1 - inner / Math.max(outer, 1e-6)), power);
}

export class WorldLights {
    readonly group = new THREE.Group();
    /** The directional light that the sun becomes; null: none. */
    readonly sun: LightInfo | null;
    private readonly shining: Shining[] = [];
    private bodies = new Float64Array(0);
    private placed = false;

    constructor(world: World, shadows: boolean, shown: (name: string) => boolean) {
        const still = (world.loaded.scene.look?.lights ?? []).filter(({ name }) => shown(name));
        this.sun = still.find(({ kind }) => kind === "directional") ?? null;
        for (const info of still) if (info !== this.sun) this.add(info, null, -1, [0, 0, 0, 1, 0, 0, 0]);
        for (let r = 0; r < world.fleet.count; ++r)
            for (const link of world.fleet.type(r).links)
                for (const info of link.lights ?? []) this.add(info, r, link.body, link.frame);
        if (shadows) this.castSome();
    }

    /** Whether the file lights the world at all; lights of robots alone leave the page's own light. */
    get any(): boolean {
        return this.sun !== null || this.shining.some(({ robot }) => robot === null);
    }

    private add(info: LightInfo, robot: number | null, body: number, linkFrame: PoseArray): void {
        if (this.shining.length >= LIGHTS_MAX) return;
        const light = make(info);
        this.shining.push({ info, light, robot, body, linkFrame });
        this.group.add(light);
        if (!(light instanceof THREE.PointLight)) this.group.add(light.target);
    }

    private castSome(): void {
        const casters = this.shining.filter(({ info }) => info.shadows && info.kind === "spot").slice(0, SHADOWS_MAX);
        for (const { light } of casters) {
            light.castShadow = true;
            light.shadow?.mapSize.set(SHADOW_SIZE, SHADOW_SIZE);
            if (light.shadow !== undefined) light.shadow.bias = -0.0006;
        }
    }

    /** Where the lights are now. */
    place(world: World): void {
        let robot = -1;
        for (const one of this.shining) {
            if (one.robot === null && this.placed) continue;
            if (one.robot !== null && one.robot !== robot) this.placeRobot(world, (robot = one.robot));
            this.put(one);
        }
        this.placed = true;
    }

    private placeRobot(world: World, robot: number): void {
        const type = world.fleet.type(robot),
            { drawn } = world.history,
            wanted = (type.bodies.length + 1) * 7;
        if (this.bodies.length < wanted) this.bodies = new Float64Array(wanted);
        placeBodies(type, drawn.base, robot * 7, drawn.joints, world.fleet.firstCoordinate[robot], this.bodies);
    }

    private put({ info, light, robot, body, linkFrame }: Shining): void {
        const at = bodyAt(body),
            frame =
                robot === null
                    ? info.frame
                    : composed(composed(this.bodies.subarray(at, at + 7), linkFrame), info.frame);
        const place = transform(frame, [0, 0, 0]);
        light.position.set(...place);
        if (light instanceof THREE.PointLight) return;
        const way = rotate(frame, info.direction ?? [0, 0, -1]);
        light.target.position.set(place[0] + way[0], place[1] + way[1], place[2] + way[2]);
        light.target.updateMatrixWorld();
    }

    endShadows(): void {
        for (const { light } of this.shining) light.castShadow = false;
    }

    dispose(): void {
        for (const { light } of this.shining) light.dispose();
    }
}
