// Calls a function at most so often, and always with what was asked last.

export function throttled<A extends unknown[]>(interval_ms: number, call: (...args: A) => void): (...args: A) => void {
    let last = -Infinity,
        timer = 0,
        waiting: A | null = null;
    const go = () => {
        timer = 0;
        last = performance.now();
        const args = waiting;
        waiting = null;
        if (args !== null) call(...args);
    };
    return (...args: A) => {
        waiting = args;
        const left = interval_ms - (performance.now() - last);
        if (left <= 0) go();
        else if (timer === 0) timer = window.setTimeout(go, left);
    };
}
