// What moving surfaces look like: chevrons that point where the surface goes, and move with it.
import * as THREE from "three";
import type { Flow, FlowPhase, Rows } from "./flow_pattern";

const VERTEX = `
varying vec3 place;
varying vec3 outward;
void main() {
    place = position;
    outward = normal;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// along, across: in rows of chevrons; both grow by 1 from one chevron to the next.
const FRAGMENT = `
uniform vec3 linear, belt, angular, at, middle, moved, belted, mark, bed;
uniform float angle, pitch, rows, side, sides, seen;
varying vec3 place, outward;
const float TURN = 6.283185307;
void main() {
    vec3 n = normalize(outward);
    float along, across, turn = length(angular);
    float wide = pitch;
    if (turn > 0.0) {
        vec3 axis = angular / turn, from = place - at, flat_ = from - axis * dot(from, axis);
        float r = length(flat_), ring = r;
        if (r < 1e-4) discard;
        if (length(cross(axis, n)) < 0.7) { // a disc: rings
            across = r / pitch;
            ring = (floor(across) + 0.5) * pitch;
        } else { // what runs around the axis
            wide = side;
            across = dot(place - middle, axis) / side + 0.5 * sides;
        }
        float count = max(1.0, floor(TURN * ring / wide + 0.5));
        vec3 zero = abs(axis.z) < 0.9 ? cross(axis, vec3(0.0, 0.0, 1.0)) : vec3(1.0, 0.0, 0.0);
        zero = normalize(zero - axis * dot(zero, axis));
        along = (atan(dot(flat_, cross(axis, zero)), dot(flat_, zero)) - angle) / TURN * count;
    } else {
        vec3 velocity = linear + cross(belt, n), tangent = velocity - n * dot(n, velocity);
        float speed = length(velocity);
        if (speed < 1e-7 || length(tangent) < 0.3 * speed) discard;
        vec3 way = velocity / speed;
        along = dot(place - middle - moved - cross(belted, n), way) / pitch;
        across = dot(place - middle, cross(n, way)) / pitch + 0.5 * rows;
    }
    float bent = abs(fract(across) - 0.5), x = fract(along + 0.8 * bent);
    float blur = length(fwidth(place)) / wide + 1e-4, far = smoothstep(0.35, 0.8, blur);
    float edge = min(blur, 0.3);
    float chevron = smoothstep(0.0, edge, x) * (1.0 - smoothstep(0.34, 0.34 + edge, x));
    chevron *= 1.0 - smoothstep(0.40 - 0.5 * edge, 0.40 + 0.5 * edge, bent);
    chevron = mix(chevron, 0.27, far);
    gl_FragColor = vec4(mix(bed, mark, chevron), mix(0.45, 0.95, chevron) * seen);
    #include <colorspace_fragment>
}`;

export class FlowMaterial extends THREE.ShaderMaterial {
    constructor({ pitch, rows, side, sides }: Rows, middle: readonly number[]) {
        const vector = () => ({ value: new THREE.Vector3() });
        super({
            vertexShader: VERTEX,
            fragmentShader: FRAGMENT,
            transparent: true,
            depthWrite: false,
            polygonOffset: true,
            polygonOffsetFactor: -2,
            polygonOffsetUnits: -8,
            toneMapped: false,
            uniforms: {
                linear: vector(),
                belt: vector(),
                angular: vector(),
                at: vector(),
                middle: { value: new THREE.Vector3(...(middle as [number, number, number])) },
                moved: vector(),
                belted: vector(),
                mark: { value: new THREE.Color(0xffc53d) },
                bed: { value: new THREE.Color(0x20262e) },
                angle: { value: 0 },
                pitch: { value: pitch },
                rows: { value: rows },
                side: { value: side },
                sides: { value: sides },
                seen: { value: 1 },
            },
        });
    }

    show(flow: Flow, phase: FlowPhase): void {
        const set = (name: string, value: readonly number[]) =>
            (this.uniforms[name].value as THREE.Vector3).fromArray(value as number[]);
        set("linear", flow.linear);
        set("belt", flow.belt);
        set("angular", flow.angular);
        set("at", flow.at);
        set("moved", phase.moved);
        set("belted", phase.belted);
        this.uniforms.angle.value = phase.angle;
    }
}
