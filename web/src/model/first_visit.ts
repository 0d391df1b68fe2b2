// The card of first steps is shown at the first visit of this browser until it is dismissed, or when the page's address
// asks for it (`?hints`).
import type { Address } from "./address";
import { keep, kept } from "./kept";

const KEPT = "roboss.hints";

export function hintsWanted(address: Address): boolean {
    if (address.get("hints") !== null) return true;
    // Pictures and tests ask for a quality or for less around the picture.
    if (["hide", "quality", "panel"].some((name) => address.get(name) !== null)) return false;
    const before = kept(KEPT);
    // Where nothing can be kept, they would come each time.
    return before !== "dismissed" && keep(KEPT, before ?? "shown");
}

export function dismissHints(): void {
    keep(KEPT, "dismissed");
}
