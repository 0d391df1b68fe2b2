// Why a WebSocket could not be opened: browsers keep that from scripts, so an ordinary request asks.

export interface Probe {
    kind: "unreachable" | "refused" | "full" | "reached";
    /** The words of a refusal. */
    text: string;
}

export async function probe(path: string): Promise<Probe> {
    try {
        const answer = await fetch(path, { cache: "no-store" }),
            said = (await answer.text()).trim().replace(/^refused: /, "");
        if (answer.status === 403) return { kind: "refused", text: said.replace(/ \[[\w-]+\]$/, "") };
        return { kind: answer.status === 503 ? "full" : "reached", text: "" };
    } catch {
        return { kind: "unreachable", text: "" };
    }
}
