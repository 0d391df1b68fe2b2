// Visuals as triangles. All visuals of one body become one geometry, with their colours at its vertices, so that a body
// costs one instance. `tint` is the colour's lightness alone, for colouring by group.
import * as THREE from "three";
import { mergeGeometries, toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import type { Visual } from "../wire/messages";
import type { MeshData } from "../wire/scene_source";

const PLANE_DEFAULT_M = 200;
const CREASE_RAD = 0.7;
const SMOOTH_TRIANGLES_MAX = 200_000;

function segments(radius: number): number {
    return radius < 0.2 ? 20 : radius < 1 ? 32 : 48;
}

function meshGeometry(data: MeshData | undefined): THREE.BufferGeometry {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(data?.positions ?? new Float32Array(0), 3));
    if (data?.uv !== undefined) geometry.setAttribute("uv", new THREE.BufferAttribute(data.uv, 2));
    geometry.setIndex(new THREE.BufferAttribute(data?.corners ?? new Uint32Array(0), 1));
    if ((data?.corners.length ?? 0) / 3 < SMOOTH_TRIANGLES_MAX) return toCreasedNormals(geometry, CREASE_RAD);
    geometry.computeVertexNormals();
    return geometry;
}

function ellipsoid(radii: readonly number[]): THREE.BufferGeometry {
    return new THREE.SphereGeometry(1, 32, 20).rotateX(Math.PI / 2).scale(radii[0], radii[1], radii[2]);
}

/** The shape in its own frame, cylinders and capsules along z. */
export function shapeGeometry(visual: Visual, meshes: ReadonlyMap<number, MeshData>): THREE.BufferGeometry {
    const radius = visual.radius ?? 1,
        length = visual.length ?? 1,
        size = visual.size ?? [1, 1, 1];
    switch (visual.shape) {
        case "box":
            return new THREE.BoxGeometry(size[0], size[1], size[2]);
        case "sphere":
            return new THREE.SphereGeometry(radius, 32, 20).rotateX(Math.PI / 2);
        case "cylinder":
            return new THREE.CylinderGeometry(radius, radius, length, segments(radius)).rotateX(Math.PI / 2);
        case "capsule":
            return new THREE.CapsuleGeometry(radius, length, 8, 24).rotateX(Math.PI / 2);
        case "cone":
            return new THREE.ConeGeometry(radius, length, segments(radius)).rotateX(Math.PI / 2);
        case "ellipsoid":
            return ellipsoid(visual.radii ?? [1, 1, 1]);
        case "plane":
            return new THREE.PlaneGeometry(size[0] || PLANE_DEFAULT_M, size[1] || PLANE_DEFAULT_M);
        case "mesh":
            return meshGeometry(meshes.get(visual.mesh ?? -1));
    }
}

export function poseMatrix(pose: ArrayLike<number>): THREE.Matrix4 {
    return new THREE.Matrix4().compose(
        new THREE.Vector3(pose[0], pose[1], pose[2]),
        new THREE.Quaternion(pose[4], pose[5], pose[6], pose[3]),
        new THREE.Vector3(1, 1, 1),
    );
}

export interface PlacedVisual {
    visual: Visual;
    pose: ArrayLike<number>;
}

function paint(geometry: THREE.BufferGeometry, name: string, colour: THREE.Color): void {
    const count = geometry.getAttribute("position").count,
        data = new Float32Array(count * 3);
    for (let k = 0; k < count; ++k) colour.toArray(data, k * 3);
    geometry.setAttribute(name, new THREE.BufferAttribute(data, 3));
}

export function visualColour(visual: Visual): THREE.Color {
    const [r, g, b] = visual.rgb ?? [0.7, 0.7, 0.7];
    return new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
}

export function lightness(colour: THREE.Color): number {
    return 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b;
}

/** Which vertices of a merged geometry are of which visual: those before `end` and behind the piece before. */
interface Piece {
    visual: Visual;
    end: number;
}

/** The visual that a triangle of a merged geometry is of. */
export function visualAt(geometry: THREE.BufferGeometry, triangle: number): Visual | null {
    const pieces = (geometry.userData.pieces ?? []) as Piece[];
    return pieces.find(({ end }) => triangle * 3 < end)?.visual ?? null;
}

/** One geometry of several visuals; null where none has a triangle. */
export function mergedGeometry(
    parts: readonly PlacedVisual[],
    meshes: ReadonlyMap<number, MeshData>,
): THREE.BufferGeometry | null {
    const geometries: THREE.BufferGeometry[] = [],
        pieces: Piece[] = [];
    let vertices = 0;
    const pictured = parts.some((part) => part.visual.finish !== undefined);
    const lightest = Math.max(0.02, ...parts.map((part) => lightness(visualColour(part.visual))));
    for (const part of parts) {
        let geometry = shapeGeometry(part.visual, meshes);
        if (geometry.getAttribute("position").count === 0) continue;
        if (geometry.index !== null) geometry = geometry.toNonIndexed();
        if (!pictured) geometry.deleteAttribute("uv");
        else if (!geometry.hasAttribute("uv"))
            geometry.setAttribute(
                "uv",
                new THREE.Float32BufferAttribute(geometry.getAttribute("position").count * 2, 2),
            );
        geometry.applyMatrix4(poseMatrix(part.pose));
        const colour = visualColour(part.visual),
            tint = Math.max(0.12, lightness(colour) / lightest);
        paint(geometry, "own", colour);
        paint(geometry, "tint", new THREE.Color(tint, tint, tint));
        geometries.push(geometry);
        vertices += geometry.getAttribute("position").count;
        pieces.push({ visual: part.visual, end: vertices });
    }
    if (geometries.length === 0) return null;
    const merged = geometries.length === 1 ? geometries[0] : mergeGeometries(geometries);
    merged.setAttribute("color", merged.getAttribute("own"));
    merged.userData.pieces = pieces;
    merged.computeBoundingSphere();
    return merged;
}
