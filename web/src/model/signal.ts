// A value that others follow: the page's parts know each other only through these.

export class Signal<T> {
    private readonly followers = new Set<(value: T, before: T) => void>();

    constructor(private current: T) {}

    get value(): T {
        return this.current;
    }

    set(value: T): void {
        const before = this.current;
        if (Object.is(before, value)) return;
        this.current = value;
        for (const follow of [...this.followers]) follow(value, before);
    }

    /** Calls `follow` now and at every change; the result ends that. */
    follow(follow: (value: T, before: T) => void): () => void {
        this.followers.add(follow);
        follow(this.current, this.current);
        return () => this.followers.delete(follow);
    }
}
