// Shows which robot is selected: a ring on the ground below it, and its name above.
import * as THREE from "three";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";
import type { LabelLayer } from "./labels";

const RING_VERTEX = `
varying vec2 place;
void main() {
    place = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const RING_FRAGMENT = `
uniform vec3 colour; varying vec2 place;
void main() {
    float r = length(place), blur = fwidth(r) * 1.2;
    float ring = smoothstep(0.84 - blur, 0.84, r) * (1.0 - smoothstep(0.88 - blur, 0.88, r));
    float glow = smoothstep(0.35, 0.84, r) * (1.0 - smoothstep(0.84, 0.86, r)) * 0.16;
    float alpha = max(ring, glow);
    if (alpha < 0.01) discard;
    gl_FragColor = vec4(colour, alpha);
    #include <colorspace_fragment>
}`;
const REACH_MIN_M = 0.15;
/** Robots that reach far get a ring of this part of their distance from the camera. */
const RING_OF_DISTANCE = 0.15;
const RING_MIN_M = 0.2;

export class SelectionMark {
    private readonly material = new THREE.ShaderMaterial({
        vertexShader: RING_VERTEX,
        fragmentShader: RING_FRAGMENT,
        transparent: true,
        depthWrite: false,
        uniforms: { colour: { value: new THREE.Color() } },
        polygonOffset: true,
        polygonOffsetFactor: -4,
        polygonOffsetUnits: -4,
    });
    private readonly ring = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), this.material);

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly labels: LabelLayer,
    ) {
        this.ring.renderOrder = 2;
        this.ring.visible = false;
        stage.overlays.add(this.ring);
    }

    update(world: World | null): void {
        const robot = this.state.selected.value;
        this.ring.visible = world !== null && robot !== null;
        if (world === null || robot === null) return this.labels.put("selected", null, "");
        const base = world.history.drawn.base,
            at = robot * 7,
            reach = Math.max(REACH_MIN_M, world.fleet.type(robot).reach);
        (this.material.uniforms.colour.value as THREE.Color).setHex(this.stage.palette.accent);
        this.ring.position.set(base[at], base[at + 1], Math.max(0.004, base[at + 2] - reach));
        const away = this.stage.camera.position.distanceTo(this.ring.position);
        this.ring.scale.setScalar(Math.min(reach * 1.55, Math.max(RING_MIN_M, away * RING_OF_DISTANCE)));
        this.labels.put(
            "selected",
            new THREE.Vector3(base[at], base[at + 1], base[at + 2] + reach * 1.1),
            world.fleet.name(robot),
            "selected",
        );
    }
}
