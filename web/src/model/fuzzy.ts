// Finds by a few letters: all of them in order, better where they stand together or at the beginning of words.

/** The greater, the better; null: the letters are not in it. Words may come in any order. */
export function fuzzyScore(query: string, text: string): number | null {
    let sum = 0;
    for (const word of query.toLowerCase().split(/\s+/)) {
        if (word === "") continue;
        const score = wordScore(word, text.toLowerCase());
        if (score === null) return null;
        sum += score;
    }
    return sum - 0.01 * text.length;
}

function wordScore(word: string, text: string): number | null {
    const whole = text.indexOf(word);
    if (whole >= 0) return 4 * word.length + (whole === 0 ? 6 : isStart(text, whole) ? 4 : 0);
    const byStarts = scattered(word, text, true),
        plain = scattered(word, text, false);
    return byStarts === null ? plain : Math.max(byStarts, plain ?? byStarts);
}

/** Letters one by one; `starts`: the next beginning of a word, where there is one, before the next letter. */
function scattered(word: string, text: string, starts: boolean): number | null {
    let score = 0,
        at = -1;
    for (const letter of word) {
        let next = text.indexOf(letter, at + 1),
            start = next;
        while (starts && start >= 0 && !isStart(text, start)) start = text.indexOf(letter, start + 1);
        if (starts && start >= 0) next = start;
        if (next < 0) return null;
        score += (next === at + 1 ? 2 : 0) + (isStart(text, next) ? 2 : 0) - 0.05 * (next - at);
        at = next;
    }
    return score;
}

function isStart(text: string, at: number): boolean {
    return at === 0 || /[\s_\-./:]/.test(text[at - 1]);
}

/** The best first, `most` of them; without a query those that come first. */
export function fuzzyBest<T>(query: string, things: readonly T[], text: (thing: T) => string, most: number): T[] {
    if (query.trim() === "") return things.slice(0, most);
    return things
        .map((thing, place) => ({ thing, place, score: fuzzyScore(query, text(thing)) }))
        .filter((one) => one.score !== null)
        .sort((a, b) => (b.score ?? 0) - (a.score ?? 0) || a.place - b.place)
        .slice(0, most)
        .map((one) => one.thing);
}
