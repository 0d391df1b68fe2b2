// The light of the sky as an environment: what faces the sky is lit by it, what shines mirrors it a little. Made anew
// when the theme changes; costs a few milliseconds then and nothing in a frame.
import * as THREE from "three";
import type { ScenePalette } from "./palette";

const VERTEX = `
varying vec3 direction;
void main() {
    direction = position;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = `
uniform vec3 sky, horizon, ground;
varying vec3 direction;
void main() {
    float up = normalize(direction).z;
    vec3 colour = up > 0.0 ? mix(horizon, sky, smoothstep(0.0, 0.6, up)) : mix(horizon * 0.8, ground, smoothstep(0.0, 0.25, -up));
    gl_FragColor = vec4(colour, 1.0);
}`;

export function skyLight(renderer: THREE.WebGLRenderer, palette: ScenePalette): THREE.Texture {
    const colour = (hex: number) => ({ value: new THREE.Color().setHex(hex) });
    const material = new THREE.ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        side: THREE.BackSide,
        depthWrite: false,
        uniforms: {
            sky: colour(palette.lightSky),
            horizon: colour(palette.lightHorizon),
            ground: colour(palette.lightGround),
        },
    });
    const scene = new THREE.Scene(),
        dome = new THREE.Mesh(new THREE.SphereGeometry(10, 24, 16), material),
        maker = new THREE.PMREMGenerator(renderer);
    scene.add(dome);
    const target = maker.fromScene(scene, 0, 0.1, 100, { size: 64 });
    dome.geometry.dispose();
    material.dispose();
    maker.dispose();
    return target.texture;
}
