// Fetches the scene, its meshes and its pictures.
import type { SceneInfo, Visual } from "./messages";
import { withToken } from "./connection";

export interface MeshData {
    positions: Float32Array;
    corners: Uint32Array;
    /** Two a vertex. */
    uv?: Float32Array;
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
    const end = 8 + 12 * vertices + 12 * triangles;
    if (buffer.byteLength !== end && buffer.byteLength !== end + 8 * vertices)
        throw new Error(
            `a mesh of ${vertices} vertices and ${triangles} triangles cannot have ${buffer.byteLength} bytes`,
        );
    return {
        positions: new Float32Array(buffer, 8, 3 * vertices),
        corners: new Uint32Array(buffer, 8 + 12 * vertices, 3 * triangles),
        uv: buffer.byteLength > end ? new Float32Array(buffer, end, 2 * vertices) : undefined,
    };
}

function visualsOf(scene: SceneInfo): Visual[] {
    return [...scene.statics, ...scene.types.flatMap((type) => type.links.flatMap((link) => link.visuals))];
}

function picturesOf({ finish }: Visual): string[] {
    return [finish?.colour, finish?.normal, finish?.roughness_map, finish?.metalness_map].filter(
        (hash) => hash !== undefined,
    );
}

async function fetchedPicture(hash: string): Promise<HTMLImageElement> {
    const image = new Image();
    image.src = withToken(`texture/${hash}`);
    await image.decode();
    return image;
}

export interface LoadedScene {
    scene: SceneInfo;
    meshes: Map<number, MeshData>;
    pictures: Map<string, HTMLImageElement>;
    /** Pictures that this browser cannot show. */
    unreadable: number;
}

export async function loadScene(): Promise<LoadedScene> {
    const scene = (await (await fetched("scene")).json()) as SceneInfo;
    const loaded: LoadedScene = { scene, meshes: new Map(), pictures: new Map(), unreadable: 0 };
    const visuals = visualsOf(scene),
        collisions = scene.types.flatMap((type) => type.links.flatMap((link) => link.collisions)),
        meshes = new Set([...visuals, ...collisions].map((visual) => visual.mesh).filter((n) => n !== undefined));
    await Promise.all([
        ...[...meshes].map(async (n) => {
            loaded.meshes.set(n, readMesh(await (await fetched(`mesh/${n}`)).arrayBuffer()));
        }),
        ...[...new Set(visuals.flatMap(picturesOf))].map(async (hash) => {
            try {
                loaded.pictures.set(hash, await fetchedPicture(hash));
            } catch {
                ++loaded.unreadable;
            }
        }),
    ]);
    return loaded;
}
