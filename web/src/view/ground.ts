// Sky and ground: a dome whose colour runs from the horizon up, and a grid of metres that fades with the distance, its
// lines drawn by the fragment shader so that they stay thin and calm at any zoom.
import * as THREE from "three";
import type { SkyInfo } from "../wire/look";
import type { Lens } from "./lens";
import type { ScenePalette } from "./palette";

/** A sky of the day, whatever the theme. */
const DAY_TOP = 0x5f97cf,
    DAY_HORIZON = 0xdce8f2;

const SKY_VERTEX = `
varying vec3 direction;
void main() {
    direction = position;
    vec4 place = projectionMatrix * mat4(mat3(modelViewMatrix)) * vec4(position, 1.0);
    gl_Position = place.xyww;
}`;
const SKY_FRAGMENT = `
uniform vec3 top, horizon;
varying vec3 direction;
void main() {
    float up = clamp(normalize(direction).z, 0.0, 1.0);
    gl_FragColor = vec4(mix(horizon, top, pow(up, 0.55)), 1.0);
    #include <colorspace_fragment>
}`;
const GRID_VERTEX = `
varying vec2 place;
void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xy;
    gl_Position = projectionMatrix * viewMatrix * world;
}`;
const GRID_FRAGMENT = `
uniform vec3 colour;
uniform float strength, reach;
uniform vec2 centre;
varying vec2 place;
float lines(float cell, float width) {
    vec2 at = place / cell, blur = fwidth(at);
    vec2 away = abs(fract(at - 0.5) - 0.5) / max(blur, vec2(1e-6));
    vec2 line = 1.0 - smoothstep(vec2(width - 0.5), vec2(width + 0.5), away);
    vec2 dense = 1.0 - smoothstep(vec2(0.06), vec2(0.3), blur);
    return max(line.x * dense.x, line.y * dense.y);
}
void main() {
    float fade = 1.0 - smoothstep(0.1, 0.8, length(place - centre) / reach);
    float shown = max(max(lines(1.0, 0.35) * 0.5, lines(10.0, 0.4)), lines(100.0, 0.5));
    gl_FragColor = vec4(colour, shown * strength * fade);
    #include <colorspace_fragment>
}`;

export class Ground {
    readonly group = new THREE.Group();
    private readonly sky: THREE.ShaderMaterial;
    private readonly grid: THREE.ShaderMaterial;
    private readonly floor: THREE.Mesh<THREE.CircleGeometry, THREE.MeshStandardMaterial>;
    private readonly gridMesh: THREE.Mesh;
    private readonly dome: THREE.Mesh;
    private grids = true;
    private floors = true;
    /** Colour of the sky at its rim. */
    readonly horizon = new THREE.Color();

    constructor() {
        this.sky = new THREE.ShaderMaterial({
            vertexShader: SKY_VERTEX,
            fragmentShader: SKY_FRAGMENT,
            side: THREE.BackSide,
            depthWrite: false,
            depthTest: false,
            uniforms: { top: { value: new THREE.Color() }, horizon: { value: new THREE.Color() } },
        });
        this.dome = new THREE.Mesh(new THREE.SphereGeometry(1, 32, 24), this.sky);
        this.dome.frustumCulled = false;
        this.dome.renderOrder = -10;
        this.grid = new THREE.ShaderMaterial({
            vertexShader: GRID_VERTEX,
            fragmentShader: GRID_FRAGMENT,
            transparent: true,
            depthWrite: false,
            polygonOffset: true,
            polygonOffsetFactor: -2,
            polygonOffsetUnits: -2,
            uniforms: {
                colour: { value: new THREE.Color() },
                strength: { value: 0.2 },
                reach: { value: 100 },
                centre: { value: new THREE.Vector2() },
            },
        });
        this.gridMesh = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), this.grid);
        this.gridMesh.frustumCulled = false;
        this.gridMesh.renderOrder = 1;
        // Drawn first and leaving no depth: scenery that dips below zero shows through it.
        const material = new THREE.MeshStandardMaterial({ roughness: 1, depthWrite: false });
        this.floor = new THREE.Mesh(new THREE.CircleGeometry(1, 96), material);
        this.floor.renderOrder = -9;
        this.floor.receiveShadow = true;
        this.floor.frustumCulled = false;
        this.group.add(this.dome, this.floor, this.gridMesh);
    }

    /** A world with a ground plane of its own needs no floor below it, but for what lies beyond its edge. */
    follow(camera: Lens, target: THREE.Vector3): void {
        const reach = Math.max(40, camera.position.distanceTo(target) * 4, camera.position.z * 6);
        this.grid.uniforms.reach.value = reach;
        (this.grid.uniforms.centre.value as THREE.Vector2).set(target.x, target.y);
        this.gridMesh.scale.setScalar(reach);
        this.gridMesh.position.set(target.x, target.y, 0.001);
        this.gridMesh.visible = this.grids && camera.position.z > 0;
        this.floor.scale.setScalar(Math.max(2000, reach * 4));
        this.floor.position.set(target.x, target.y, -0.005);
        this.floor.visible = this.floors && camera.position.z > 0;
        // Without perspective every pixel looks the same way: the dome fills the picture.
        const flat = camera instanceof THREE.OrthographicCamera;
        if (flat) this.dome.scale.setScalar((camera.right + camera.top) * 2);
        else this.dome.scale.setScalar(1);
    }

    /** `scene`: the file's own sky; it has no floor below it, as the file says what is there. */
    paint(palette: ScenePalette, scene?: SkyInfo): void {
        const top = this.sky.uniforms.top.value as THREE.Color,
            horizon = this.sky.uniforms.horizon.value as THREE.Color,
            own = scene?.background !== undefined && !scene.sky;
        top.setHex(scene?.sky === true ? DAY_TOP : palette.skyTop);
        horizon.setHex(scene?.sky === true ? DAY_HORIZON : palette.skyHorizon);
        if (own)
            for (const colour of [top, horizon])
                colour.setRGB(...(scene.background ?? [0, 0, 0]), THREE.SRGBColorSpace);
        this.horizon.copy(horizon);
        this.floors = !own && scene?.sky !== true;
        this.grids = scene?.grid !== false;
        (this.grid.uniforms.colour.value as THREE.Color).setHex(palette.grid);
        this.grid.uniforms.strength.value = palette.gridStrength;
        this.floor.material.color.setHex(palette.ground);
    }
}
