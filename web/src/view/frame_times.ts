// How long JavaScript works for a frame, kept for the last few hundred frames: what `document.body.dataset` cannot say
// and a test wants to know. Times are milliseconds.

const KEPT = 600;

export class FrameTimes {
    private readonly update: number[] = [];
    private readonly draw: number[] = [];
    frames = 0;

    take(update_ms: number, draw_ms: number): void {
        ++this.frames;
        for (const [list, value] of [
            [this.update, update_ms],
            [this.draw, draw_ms],
        ] as const) {
            list.push(value);
            if (list.length > KEPT) list.shift();
        }
    }

    forget(): void {
        this.frames = this.update.length = this.draw.length = 0;
    }

    summary(): Record<string, number> {
        return {
            frames: this.frames,
            update_ms: mean(this.update),
            update_quick_ms: quantile(this.update, 0.1),
            update_median_ms: quantile(this.update, 0.5),
            update_p95_ms: quantile(this.update, 0.95),
            draw_ms: mean(this.draw),
            draw_quick_ms: quantile(this.draw, 0.1),
            draw_median_ms: quantile(this.draw, 0.5),
            draw_p95_ms: quantile(this.draw, 0.95),
        };
    }
}

function mean(list: readonly number[]): number {
    return list.reduce((sum, value) => sum + value, 0) / Math.max(1, list.length);
}

function quantile(list: readonly number[], q: number): number {
    const sorted = [...list].sort((a, b) => a - b);
    return sorted[Math.min(sorted.length - 1, Math.floor(q * sorted.length))] ?? 0;
}
