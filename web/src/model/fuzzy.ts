// Finds by a few letters: they stand together, best at the beginning of a word, or are beginnings of words one after
// another ("lr" finds "Laser rays"). Letters that are scattered inside of words find nothing.

/** The greater, the better; null: it is not found. Words may come in any order. */
export function fuzzyScore(query: string, text: string): number | null {
    let sum = 0;
    for (const word of wordsOf(query)) {
        const score = wordScore(word, text.toLowerCase());
        if (score === null) return null;
        sum += score;
    }
    return sum - 0.01 * text.length;
}

/** Each word of the query begins a word of the text. */
export function beginsWords(query: string, text: string): boolean {
    return wordsOf(query).every((word) => startOf(word, text.toLowerCase()) >= 0);
}

function wordsOf(query: string): string[] {
    return query
        .toLowerCase()
        .split(/\s+/)
        .filter((word) => word !== "");
}

/** Where a word of the text begins with it; -1: nowhere. */
function startOf(word: string, text: string): number {
    let at = text.indexOf(word);
    while (at >= 0 && !isStart(text, at)) at = text.indexOf(word, at + 1);
    return at;
}

function wordScore(word: string, text: string): number | null {
    const start = startOf(word, text);
    if (start >= 0) return 4 * word.length + (start === 0 ? 12 : 8);
    if (text.includes(word)) return 4 * word.length;
    return beginnings(word, text, 0, false) ? 2 * word.length : null;
}

/** The letters are beginnings of words in their order; `inside`: the letter before stands just before `at`. */
function beginnings(word: string, text: string, at: number, inside: boolean): boolean {
    if (word === "") return true;
    if (inside && text[at] === word[0] && beginnings(word.slice(1), text, at + 1, true)) return true;
    for (let next = text.indexOf(word[0], at); next >= 0; next = text.indexOf(word[0], next + 1))
        if (isStart(text, next) && beginnings(word.slice(1), text, next + 1, true)) return true;
    return false;
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
