// How much the picture may cost: where frames come slowly for a while, it is drawn with fewer pixels, then without
// shadows. It only goes down: going up again would make it swing.

export const LEVELS = ["full", "plain pixels", "no shadows"] as const;
const SLOW_MS = 45;
const FRAMES = 24;
/** So much time in slow frames is enough, however few they were. */
const SLOW_SUM_MS = 2000;
/** The first frames compile shaders and fill buffers: they say nothing. */
const WARM_UP = 4;

export class Effort {
    level = 0;
    private count = -WARM_UP;
    private sum = 0;

    constructor(private readonly onLevel: (level: number) => void) {}

    /** Time between two frames that were both drawn. */
    take(interval_ms: number): void {
        if (this.level >= LEVELS.length - 1 || ++this.count <= 0) return;
        // A tab in the background is no slow machine.
        this.sum += Math.min(interval_ms, 500);
        if (this.count < FRAMES && this.sum < SLOW_SUM_MS) return;
        const slow = this.sum / this.count > SLOW_MS;
        this.count = slow ? -WARM_UP : 0;
        this.sum = 0;
        if (slow) this.onLevel(++this.level);
    }
}
