// Which simulated time is drawn at which moment: about one and a half States behind the newest, running at the run's own
// pace, so that neither a late State nor a burst shows. It never runs past the newest State.

const PULL_PER_S = 4;
const PACE_MEMORY = 0.1;
const DELAY_MAX_S = 0.25;

export class PlayClock {
    private latest = 0;
    private arrived = 0;
    private interval = 1 / 30;
    private pace = 0;
    private shown = 0;
    private at = 0;
    private started = false;

    /** A State of simulated time `time` came at wall time `now` (both s). */
    heard(time: number, now: number): void {
        if (!this.started || time < this.latest) {
            this.started = true;
            this.shown = time;
            this.pace = 0;
            this.interval = 1 / 30;
        } else {
            const passed = now - this.arrived;
            if (passed > 1e-4 && passed < 1) {
                this.interval += PACE_MEMORY * (passed - this.interval);
                const pace = (time - this.latest) / passed;
                this.pace = this.pace === 0 ? pace : this.pace + PACE_MEMORY * (pace - this.pace);
            } else if (passed >= 1) {
                this.pace = 0;
            }
        }
        this.latest = time;
        this.arrived = now;
    }

    /** The simulated time to draw at wall time `now`. */
    read(now: number): number {
        const passed = Math.max(0, Math.min(0.25, now - this.at));
        this.at = now;
        const quiet = now - this.arrived > 3 * this.interval + 0.05;
        const delay = Math.min(DELAY_MAX_S, 1.5 * this.interval);
        const wanted = quiet ? this.latest : Math.min(this.latest, this.latest + this.pace * (now - this.arrived - delay));
        const behind = wanted - this.shown;
        const far = Math.abs(behind) > Math.max(0.5 * this.pace, 0.05);
        const before = this.shown;
        if (quiet || far || this.pace === 0) this.shown += behind * Math.min(1, (far ? 20 : 12) * passed);
        else this.shown += this.pace * passed + behind * Math.min(1, PULL_PER_S * passed);
        if (Math.abs(this.latest - this.shown) < 1e-9) this.shown = this.latest;
        this.shown = Math.max(Math.min(before, this.latest), Math.min(this.shown, this.latest));
        return this.shown;
    }
}
