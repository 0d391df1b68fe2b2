// What can be taken back and done again. Each step says how; a step that fails is dropped.
import { Signal } from "./signal";

export interface Step {
    /** For people: "delete car_1". */
    name: string;
    /** False: it was refused. */
    undo(): Promise<boolean>;
    redo(): Promise<boolean>;
}

const STEPS_MAX = 100;

export class UndoStack {
    /** Names of the next step back and the next step forth; empty: there is none. */
    readonly next = new Signal<{ undo: string; redo: string }>({ undo: "", redo: "" });
    private done: Step[] = [];
    private undone: Step[] = [];
    private busy = false;

    /** A step that was just done. */
    push(step: Step): void {
        this.done.push(step);
        if (this.done.length > STEPS_MAX) this.done.shift();
        this.undone = [];
        this.show();
    }

    /** The name of the step that was taken back; null: there was none, or it was refused. */
    undo(): Promise<string | null> {
        return this.go("undo");
    }

    redo(): Promise<string | null> {
        return this.go("redo");
    }

    clear(): void {
        this.done = [];
        this.undone = [];
        this.show();
    }

    private async go(way: "undo" | "redo"): Promise<string | null> {
        const [from, to] = way === "undo" ? [this.done, this.undone] : [this.undone, this.done],
            step = from.at(-1);
        if (step === undefined || this.busy) return null;
        this.busy = true;
        const went = await step[way]().catch(() => false);
        this.busy = false;
        from.splice(from.indexOf(step), 1);
        if (went) to.push(step);
        this.show();
        return went ? step.name : null;
    }

    private show(): void {
        this.next.set({ undo: this.done.at(-1)?.name ?? "", redo: this.undone.at(-1)?.name ?? "" });
    }
}
