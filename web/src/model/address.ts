// What the page's address says: ?camera=...&select=... for pictures and links, the same words behind # for the link that
// the page itself writes. Later words win.

export interface CameraWords {
    target: [number, number, number];
    azimuth: number;
    elevation: number;
    distance: number;
}

const DEGREE = Math.PI / 180;

/** "x,y,z,azimuth,elevation,distance" with angles in degrees. */
export function parseCamera(text: string): CameraWords | null {
    const n = text.split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
    if (n.length !== 6 || !n.every(Number.isFinite) || n[5] <= 0) return null;
    return { target: [n[0], n[1], n[2]], azimuth: n[3] * DEGREE, elevation: n[4] * DEGREE, distance: n[5] };
}

export function formatCamera(camera: CameraWords): string {
    const round = (value: number, digits: number) => Number(value.toFixed(digits)).toString();
    return [
        ...camera.target.map((value) => round(value, 2)),
        round(camera.azimuth / DEGREE, 1),
        round(camera.elevation / DEGREE, 1),
        round(camera.distance, 2),
    ].join(",");
}

export class Address {
    private readonly words: URLSearchParams;

    constructor(search: string, hash: string) {
        this.words = new URLSearchParams(search);
        for (const [name, value] of new URLSearchParams(hash.replace(/^#/, ""))) this.words.set(name, value);
    }

    get(name: string): string | null {
        return this.words.get(name);
    }

    list(name: string): string[] {
        return (this.words.get(name) ?? "").split(",").filter((word) => word !== "");
    }
}
