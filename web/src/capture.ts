// Pictures and videos of the canvas, as downloads. The picture is drawn anew at the moment it is taken.
import { Signal } from "./model/signal";
import { download } from "./ui/download";
import type { Stage } from "./view/stage";

const VIDEO_RATE = 30;
const VIDEO_BITS = 12_000_000;

export class Capture {
    readonly recording = new Signal(false);
    private recorder: MediaRecorder | null = null;

    constructor(
        private readonly stage: Stage,
        private readonly name: () => string,
        private readonly say: (text: string, bad?: boolean) => void,
    ) {}

    picture(): void {
        this.stage.draw();
        this.stage.canvas.toBlob((blob) => {
            if (blob === null) return this.say("the browser could not make a picture", true);
            download(blob, `${this.name()}.png`);
        });
    }

    toggleVideo(): void {
        if (this.recorder !== null) return this.recorder.stop();
        const kind = ["video/mp4;codecs=avc1", "video/webm;codecs=vp9", "video/webm"].find((one) =>
            MediaRecorder.isTypeSupported(one),
        );
        if (kind === undefined) return this.say("this browser cannot record videos", true);
        const recorder = new MediaRecorder(this.stage.canvas.captureStream(VIDEO_RATE), {
            mimeType: kind,
            videoBitsPerSecond: VIDEO_BITS,
        });
        const parts: Blob[] = [];
        recorder.ondataavailable = (event) => parts.push(event.data);
        recorder.onstop = () => {
            this.recorder = null;
            this.recording.set(false);
            download(
                new Blob(parts, { type: kind }),
                `${this.name()}.${kind.startsWith("video/mp4") ? "mp4" : "webm"}`,
            );
        };
        recorder.start(1000);
        this.recorder = recorder;
        this.recording.set(true);
    }
}
