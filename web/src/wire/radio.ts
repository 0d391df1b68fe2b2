// Who hears whom by radio, as the gateway tells it (docs/viewer-protocol.md, "overlay").
/** Messages that one radio heard of another since the last report. */
export interface RadioLinkReport {
    from: number;
    /** Radios, by their number among the sensors of a robot: of the sender, and of the receiver. */
    antenna: number;
    to: number;
    sensor: number;
    messages: number;
    /** dBm of the last one at the receiver; dB of that above its noise floor; s, when it arrived. */
    strength: number | null;
    margin: number | null;
    time: number;
}

export interface RadioSenderReport {
    robot: number;
    sensor: number;
    messages: number;
}

export interface RadioReport {
    links: RadioLinkReport[];
    senders: RadioSenderReport[];
    /** false: some radios had no turn. */
    all: boolean;
}
