// What this browser keeps of the page's choices. A browser may refuse to keep anything: in a frame of another site (a
// notebook), or when it is full. Then nothing is kept.

/** null: nothing is kept under this name. */
export function kept(name: string): string | null {
    try {
        return window.localStorage.getItem(name);
    } catch {
        return null;
    }
}

/** Whether it is kept now. */
export function keep(name: string, value: string): boolean {
    try {
        window.localStorage.setItem(name, value);
        return true;
    } catch {
        return false;
    }
}
