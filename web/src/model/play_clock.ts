// Which simulated time is drawn at which moment: about one and a half States behind the newest, running at the run's own
// pace, so that neither a late State nor a burst shows. It never runs past the newest State.

const PULL_PER_S = 4;
/** What of the past stays with each State, in the pace and in where the run is thought to be. */
const MEMORY = 0.93;
const DELAY_MAX_S = 0.25;
const INTERVAL_FIRST_S = 1 / 30;

export class PlayClock {
    private latest = 0;
    private arrived = 0;
    private interval = INTERVAL_FIRST_S;
    /** Simulated and wall time that passed lately; their ratio is the pace. */
    private simulated = 0;
    private waited = 0;
    /** Where the run is thought to be at wall time `arrived`: what came, without the unevenness of its coming. */
    private live = 0;
    private shown = 0;
    private at = 0;
    private started = false;

    private get pace(): number {
        return this.waited > 0 ? this.simulated / this.waited : 0;
    }

    /** A State of simulated time `time` came at wall time `now` (both s). */
    heard(time: number, now: number): void {
        const passed = now - this.arrived,
            fresh = !this.started || time < this.latest;
        if (fresh) this.shown = time;
        if (fresh || passed >= 1) this.forget(time);
        else this.learn(time, passed);
        this.started = true;
        this.latest = time;
        this.arrived = now;
    }

    private forget(time: number): void {
        this.simulated = this.waited = 0;
        this.interval = INTERVAL_FIRST_S;
        this.live = time;
    }

    private learn(time: number, passed: number): void {
        this.interval = MEMORY * this.interval + (1 - MEMORY) * passed;
        this.simulated = MEMORY * this.simulated + (time - this.latest);
        this.waited = MEMORY * this.waited + passed;
        const expected = this.live + this.pace * passed,
            off = time - expected;
        const far = Math.abs(off) > 0.25 * this.pace;
        this.live = far ? time : expected + (1 - MEMORY) * off;
    }

    /** The simulated time to draw at wall time `now`. */
    read(now: number): number {
        const passed = Math.max(0, Math.min(0.25, now - this.at)),
            pace = this.pace,
            before = this.shown;
        this.at = now;
        const since = now - this.arrived,
            quiet = since > 3 * this.interval + 0.05 || pace === 0;
        const delay = Math.min(DELAY_MAX_S, 1.5 * this.interval);
        const wanted = quiet ? this.latest : Math.min(this.latest, this.live + pace * (since - delay)),
            behind = wanted - this.shown;
        const far = Math.abs(behind) > Math.max(0.5 * pace, 0.05);
        if (quiet || far) this.shown += behind * Math.min(1, (far ? 20 : 12) * passed);
        else this.shown += pace * passed + behind * Math.min(1, PULL_PER_S * passed);
        if (Math.abs(this.latest - this.shown) < 1e-9) this.shown = this.latest;
        this.shown = Math.max(Math.min(before, this.latest), Math.min(this.shown, this.latest));
        return this.shown;
    }
}
