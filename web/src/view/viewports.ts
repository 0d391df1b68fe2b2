// Where the views of a split picture lie on the canvas.

/** CSS pixels from the canvas's upper left corner. */
export interface Viewport {
    left: number;
    top: number;
    width: number;
    height: number;
}

export const VIEW_COUNTS = [1, 2, 4] as const;
export type ViewCount = (typeof VIEW_COUNTS)[number];

/** Two lie beside each other, or one above the other on a tall screen; four in two rows. */
export function viewports(count: ViewCount, width: number, height: number): Viewport[] {
    const columns = count === 4 || (count === 2 && width >= height) ? 2 : 1,
        rows = count / columns,
        wide = width / columns,
        high = height / rows;
    return Array.from({ length: count }, (_, k) => ({
        left: (k % columns) * wide,
        top: Math.floor(k / columns) * high,
        width: wide,
        height: high,
    }));
}

/** The number of the view at a point of the canvas. */
export function viewAt(views: readonly Viewport[], x: number, y: number): number {
    const found = views.findIndex(
        ({ left, top, width, height }) => x >= left && x < left + width && y >= top && y < top + height,
    );
    return Math.max(0, found);
}
