// Fetches the scene and its meshes.
import type { SceneInfo, Visual } from "./messages";
import { withToken } from "./connection";

export interface MeshData {
    positions: Float32Array;
    corners: Uint32Array;
}

async function fetched(path: string): Promise<Response> {
    const response = await fetch(withToken(path), { cache: "no-store" });
    if (!response.ok) throw new Error(`${path}: the gateway answered ${response.status} ${response.statusText}`);
    return response;
}

export function readMesh(buffer: ArrayBuffer): MeshData {
    const data = new DataView(buffer);
    const vertices = data.getUint32(0, true),
        triangles = data.getUint32(4, true);
    if (buffer.byteLength !== 8 + 12 * vertices + 12 * triangles)
        throw new Error(
            `a mesh of ${vertices} vertices and ${triangles} triangles cannot have ${buffer.byteLength} bytes`,
        );
    return {
        positions: new Float32Array(buffer, 8, 3 * vertices),
        corners: new Uint32Array(buffer, 8 + 12 * vertices, 3 * triangles),
    };
}

function meshNumbers(scene: SceneInfo): Set<number> {
    const found = new Set<number>();
    const look = (visual: Visual) => visual.mesh !== undefined && found.add(visual.mesh);
    scene.statics.forEach(look);
    for (const type of scene.types) for (const link of type.links) link.visuals.forEach(look);
    return found;
}

export interface LoadedScene {
    scene: SceneInfo;
    meshes: Map<number, MeshData>;
}

export async function loadScene(): Promise<LoadedScene> {
    const scene = (await (await fetched("scene")).json()) as SceneInfo;
    const meshes = new Map<number, MeshData>();
    await Promise.all(
        [...meshNumbers(scene)].map(async (n) => {
            meshes.set(n, readMesh(await (await fetched(`mesh/${n}`)).arrayBuffer()));
        }),
    );
    return { scene, meshes };
}
