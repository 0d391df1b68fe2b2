// The convex outline round some discs in the plane (Andrew's monotone chain over points of their rims).

export interface Point {
    x: number;
    y: number;
}

const RIM_POINTS = 14;

export function convexHull(points: readonly Point[]): Point[] {
    const sorted = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
    if (sorted.length < 3) return sorted;
    const half = (list: readonly Point[]): Point[] => {
        const chain: Point[] = [];
        for (const p of list) {
            while (chain.length >= 2 && turn(chain[chain.length - 2], chain[chain.length - 1], p) <= 0) chain.pop();
            chain.push(p);
        }
        chain.pop();
        return chain;
    };
    return [...half(sorted), ...half(sorted.slice().reverse())];
}

function turn(a: Point, b: Point, c: Point): number {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

export function hullAround(discs: readonly (Point & { radius: number })[]): Point[] {
    const rim: Point[] = [];
    for (const { x, y, radius } of discs)
        for (let k = 0; k < RIM_POINTS; ++k) {
            const angle = (k / RIM_POINTS) * 2 * Math.PI;
            rim.push({ x: x + radius * Math.cos(angle), y: y + radius * Math.sin(angle) });
        }
    return convexHull(rim);
}
