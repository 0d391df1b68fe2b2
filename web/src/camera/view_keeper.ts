// Writes a split picture into the page's address, so that a reload and a copied address show the same views.
import type { ViewerState } from "../model/viewer_state";
import { viewLink } from "../model/view_link";
import type { Views } from "./views";

const INTERVAL_MS = 1000;

export class ViewKeeper {
    private wrote = false;

    constructor(
        private readonly views: Views,
        private readonly state: ViewerState,
        private readonly plots: () => string,
    ) {}

    start(): void {
        setInterval(() => this.keep(), INTERVAL_MS);
        this.views.count.follow(() => this.keep());
    }

    /** A picture of one view is written only to take a split one away. */
    private keep(): void {
        if (this.state.world.value === null || document.body.dataset.ready !== "true") return;
        if (this.views.count.value === 1 && !this.wrote) return;
        this.wrote = this.views.count.value > 1;
        const link = viewLink(this.state, this.views, this.plots());
        if (link !== location.href) history.replaceState(null, "", link);
    }
}
