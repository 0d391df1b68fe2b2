// Troubles that a test asks the mock gateway for: GET /mock/trouble?refuse=403&mute=1&over=WORDS&failed=1&drop=slow&version=2&
// empty=1&foreign=1.
// Each request sets all of them anew.

export interface Trouble {
    /** Status with which WebSockets are refused; 0: they are not. */
    refuse: number;
    /** No status is sent, as by a Controller that was killed. */
    mute: boolean;
    /** Why the run is over; empty: it is not. */
    over: string;
    /** It could not go on. */
    failed: boolean;
    /** Code with which all pages are disconnected once; empty: they are not. */
    drop: string;
    version: number;
    /** No Simulators. */
    empty: boolean;
    /** Simulators that others started. */
    foreign: boolean;
}

export const NO_TROUBLE: Trouble = {
    refuse: 0,
    mute: false,
    over: "",
    failed: false,
    drop: "",
    version: 1,
    empty: false,
    foreign: false,
};

export function troubleOf(url: URL): Trouble | null {
    if (url.pathname !== "/mock/trouble") return null;
    const words = url.searchParams;
    return {
        refuse: Number(words.get("refuse") ?? 0),
        mute: words.has("mute"),
        over: words.get("over") ?? "",
        failed: words.has("failed"),
        drop: words.get("drop") ?? "",
        version: Number(words.get("version") ?? 1),
        empty: words.has("empty"),
        foreign: words.has("foreign"),
    };
}

/** What the gateway answers in words where it refuses a page. */
export function refusalText(status: number): string {
    return status === 403
        ? "refused: the token is not that of this run [wrong-token]\n"
        : "refused: too many pages are open; close one of them [too-many-pages]\n";
}
