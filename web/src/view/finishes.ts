// Materials of visuals: what lies over their colours. Each picture is one texture for all that show it the same way.
import * as THREE from "three";
import type { Finish, Visual } from "../wire/messages";

const ANISOTROPY = 8;

/** Visuals with equal keys can be drawn as one. */
export function finishKey(visual: Visual): string {
    const shadow = visual.casts === false ? "no shadow" : "";
    return visual.finish === undefined ? shadow : JSON.stringify(visual.finish) + shadow;
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

const means = new WeakMap<HTMLImageElement, [number, number, number]>();

/** The mean colour of a picture, 0 to 1. */
export function meanColour(image: HTMLImageElement): [number, number, number] {
    const known = means.get(image);
    if (known !== undefined) return known;
    const canvas = document.createElement("canvas"),
        draw = canvas.getContext("2d");
    canvas.width = canvas.height = 8;
    draw?.drawImage(image, 0, 0, 8, 8);
    const data = draw?.getImageData(0, 0, 8, 8).data ?? new Uint8ClampedArray(256).fill(255),
        part = (k: number) => data.filter((_, i) => i % 4 === k).reduce((sum, value) => sum + value, 0) / 64 / 255,
        mean: [number, number, number] = [part(0), part(1), part(2)];
    means.set(image, mean);
    return mean;
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
            emissive: new THREE.Color().setRGB(...(finish.emissive ?? [0, 0, 0]), THREE.SRGBColorSpace),
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
