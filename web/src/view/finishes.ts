// Materials of visuals: what lies over their colours. Each picture is one texture for all that show it the same way.
import * as THREE from "three";
import type { Finish, Visual } from "../wire/messages";

const ANISOTROPY = 8;

/** Visuals with equal keys can be drawn as one. */
export function finishKey(visual: Visual): string {
    return visual.finish === undefined ? "" : JSON.stringify(visual.finish);
}

/** The visuals by what lies over them. */
export function byFinish<T>(items: readonly T[], visualOf: (item: T) => Visual): T[][] {
    const groups = new Map<string, T[]>();
    for (const item of items) {
        const key = finishKey(visualOf(item));
        groups.set(key, [...(groups.get(key) ?? []), item]);
    }
    return [...groups.values()];
}

export class Finishes {
    private readonly textures = new Map<string, THREE.Texture>();

    constructor(private readonly pictures: ReadonlyMap<string, HTMLImageElement>) {}

    /** `plain`: the material where nothing is said. */
    material(finish: Finish | undefined, plain: THREE.MeshStandardMaterialParameters): THREE.MeshStandardMaterial {
        if (finish === undefined) return new THREE.MeshStandardMaterial(plain);
        const roughnessMap = this.texture(finish.roughness_map, THREE.NoColorSpace),
            metalnessMap = this.texture(finish.metalness_map, THREE.NoColorSpace);
        // A map is a factor; where it is there, SDFormat wants it alone.
        return new THREE.MeshStandardMaterial({
            ...plain,
            map: this.texture(finish.colour, THREE.SRGBColorSpace),
            normalMap: this.texture(finish.normal, THREE.NoColorSpace),
            roughnessMap,
            metalnessMap,
            roughness: roughnessMap !== null ? 1 : (finish.roughness ?? plain.roughness),
            metalness: metalnessMap !== null ? 1 : (finish.metalness ?? plain.metalness),
        });
    }

    private texture(hash: string | undefined, colours: THREE.ColorSpace): THREE.Texture | null {
        const image = this.pictures.get(hash ?? "");
        if (image === undefined) return null;
        const key = `${hash} ${colours}`,
            known = this.textures.get(key);
        if (known !== undefined) return known;
        const texture = new THREE.Texture(image);
        texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
        texture.anisotropy = ANISOTROPY;
        texture.colorSpace = colours;
        texture.needsUpdate = true;
        this.textures.set(key, texture);
        return texture;
    }

    dispose(): void {
        for (const texture of this.textures.values()) texture.dispose();
    }
}
