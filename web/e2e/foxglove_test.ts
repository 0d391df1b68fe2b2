// A run with --foxglove beside Foxglove's own client and decoder of ROS 2 messages: what they list, read and send.
import assert from "node:assert/strict";
import { type ChildProcess, spawn } from "node:child_process";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import { type Channel, FoxgloveClient, type IWebSocket, type ServerInfo, type Service } from "@foxglove/ws-protocol";
import WebSocket from "ws";
import { end, PROGRAM } from "./processes";

const WORLD = join(dirname(process.env.ROBOSS_WORLD ?? ""), "../web/e2e/foxglove.sdf");
const SKIP = { skip: PROGRAM === "" ? "it needs the program" : false, timeout: 120_000 };
const TWIST = `Vector3 linear
Vector3 angular
===
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z`;

interface Transform {
    header: { frame_id: string };
    child_frame_id: string;
    transform: { translation: { x: number; y: number; z: number } };
}
interface Image {
    width: number;
    height: number;
    encoding: string;
    data: Uint8Array;
}
interface Scan {
    header: { frame_id: string; stamp: { sec: number } };
    range_max: number;
    ranges: Float32Array;
}

let child: ChildProcess | undefined,
    url = "";

/** A viewer: what the server said, and the channels by topic. */
class Viewer {
    readonly channels = new Map<string, Channel>();
    readonly services = new Map<string, Service>();
    readonly problems: string[] = [];
    info: ServerInfo | undefined;
    time = 0n;
    readonly client: FoxgloveClient;
    readonly socket: WebSocket;
    private calls = 0;
    private readonly hear = new Map<number, (data: ArrayBufferView) => void>();

    constructor(subprotocol: string) {
        this.socket = new WebSocket(url, [subprotocol]);
        this.client = new FoxgloveClient({ ws: this.socket as unknown as IWebSocket });
        this.client.on("serverInfo", (info) => (this.info = info));
        this.client.on("advertise", (channels) => {
            for (const channel of channels) this.channels.set(channel.topic, channel);
        });
        this.client.on("advertiseServices", (services) => {
            for (const service of services) this.services.set(service.name, service);
        });
        this.client.on("serviceCallFailure", ({ message }) => this.problems.push(message));
        this.client.on("status", (status) => this.problems.push(status.message));
        this.client.on("error", (error) => this.problems.push(error.message));
        this.client.on("time", ({ timestamp }) => (this.time = timestamp));
        this.client.on("message", ({ subscriptionId, data }) => this.hear.get(subscriptionId)?.(data));
    }

    channel(topic: string): Promise<Channel> {
        return until(`the channel ${topic}`, () => this.channels.get(topic));
    }

    /** Calls `take` with each message of a topic. */
    async read<T>(topic: string, take: (message: T) => void): Promise<void> {
        const channel = await this.channel(topic);
        const reader = new MessageReader(parse(channel.schema, { ros2: true }));
        this.hear.set(this.client.subscribe(channel.id), (data) => take(reader.readMessage<T>(data)));
    }

    /** Calls a service; the reply. */
    async call<T>(name: string, request: object): Promise<T> {
        const service = await until(`the service ${name}`, () => this.services.get(name));
        const definitions = (schema?: string) => parse(schema ?? "", { ros2: true }),
            writer = new MessageWriter(definitions(service.request?.schema)),
            reader = new MessageReader(definitions(service.response?.schema));
        const id = ++this.calls;
        let reply: T | undefined;
        this.client.on("serviceCallResponse", ({ callId, data }) => {
            if (callId === id) reply = reader.readMessage<T>(data);
        });
        const data = new DataView(writer.writeMessage(request).slice().buffer);
        this.client.sendServiceCallRequest({ serviceId: service.id, callId: id, encoding: "cdr", data });
        return until(`the reply of ${name}`, () => reply);
    }

    close(): void {
        assert.deepEqual(this.problems, []);
        this.client.close();
    }
}

async function until<T>(what: string, ready: () => T | undefined): Promise<T> {
    for (let i = 0; i < 3000; ++i) {
        const value = ready();
        if (value !== undefined) return value;
        await new Promise((resolve) => setTimeout(resolve, 20));
    }
    throw new Error(`${what}: it does not come`);
}

before(async () => {
    if (PROGRAM === "") return;
    let said = "";
    child = spawn(PROGRAM, ["run", WORLD, "--headless", "--foxglove=0"]);
    for (const stream of [child.stdout, child.stderr]) stream?.on("data", (text: Buffer) => (said += text.toString()));
    url = await until("the address of the server", () => {
        assert.equal(child?.exitCode, null, said);
        return /ws:\/\/localhost:\d+/.exec(said)?.[0];
    });
});
after(async () => {
    if (child) await end(child, "SIGINT");
});

test("both subprotocols are spoken, and channels have definitions of ROS 2", SKIP, async () => {
    for (const subprotocol of ["foxglove.sdk.v1", "foxglove.websocket.v1"]) {
        const viewer = new Viewer(subprotocol);
        const scan = await viewer.channel("/rover/scan");
        assert.equal(viewer.socket.protocol, subprotocol);
        assert.deepEqual(viewer.info?.supportedEncodings, ["cdr"]);
        assert.equal(scan.encoding, "cdr");
        assert.equal(scan.schemaEncoding, "ros2msg");
        assert.equal(scan.schemaName, "sensor_msgs/msg/LaserScan");
        for (const channel of viewer.channels.values())
            assert.ok(parse(channel.schema, { ros2: true }).length > 0, channel.topic);
        viewer.close();
    }
});

test("scans, transforms and what is sent once are read by the decoder of Foxglove", SKIP, async () => {
    const viewer = new Viewer("foxglove.sdk.v1");
    let image: Image | undefined,
        scan: Scan | undefined,
        description: { data: string } | undefined,
        fixed: { transforms: Transform[] } | undefined;
    await viewer.read<Scan>("/rover/scan", (message) => (scan = message));
    await viewer.read<{ data: string }>("/rover/robot_description", (message) => (description = message));
    await viewer.read<{ transforms: Transform[] }>("/tf_static", (message) => (fixed = message));
    await viewer.read<Image>("/rover/eye/image_raw", (message) => (image = message));
    const picture = await until("a picture", () => image);
    assert.equal(picture.data.length, 160 * 120 * 3);
    assert.ok(new Set(picture.data).size > 10, "it shows something");
    const seen = await until("a scan", () => scan);
    assert.equal(seen.ranges.length, 91);
    assert.ok(Math.abs(seen.ranges[45] - 7.9) < 0.1, `the wall ahead is ${seen.ranges[45]} m away`);
    assert.match(seen.header.frame_id, /^rover\//);
    assert.match((await until("a description", () => description)).data, /<robot name="rover"/);
    assert.ok((await until("fixed frames", () => fixed)).transforms.length > 0);
    await until("the time", () => (viewer.time > 0n ? viewer.time : undefined));
    viewer.close();
});

test("a published Twist drives a robot", SKIP, async () => {
    const viewer = new Viewer("foxglove.websocket.v1");
    const places = new Map<string, number[]>();
    await viewer.read<{ transforms: Transform[] }>("/tf", ({ transforms }) => {
        for (const { header, child_frame_id, transform } of transforms) {
            const { x, y } = transform.translation;
            if (header.frame_id === "world") places.set(child_frame_id, [x, y]);
        }
    });
    const base = await until("the robot", () => [...places.keys()].find((frame) => frame.startsWith("rover/")));
    const start = places.get(base) ?? [];
    const writer = new MessageWriter(parse(TWIST, { ros2: true }));
    const channel = viewer.client.advertise({
        topic: "/rover/cmd_vel",
        encoding: "cdr",
        schemaName: "geometry_msgs/msg/Twist",
    });
    const zero = { x: 0, y: 0, z: 0 };
    const send = () =>
        viewer.client.sendMessage(channel, writer.writeMessage({ linear: { ...zero, x: 0.4 }, angular: zero }));
    const distance = await until("it has moved", () => {
        send();
        const [x, y] = places.get(base) ?? [];
        const moved = Math.hypot(x - start[0], y - start[1]);
        return moved > 0.2 ? moved : undefined;
    });
    assert.ok(distance < 5);
    viewer.close();
});

test("services pause the run, and let it go on", SKIP, async () => {
    const PLAYING = 1,
        PAUSED = 2,
        viewer = new Viewer("foxglove.sdk.v1");
    const set = (state: number) =>
        viewer.call<{ result: { result: number } }>("/set_simulation_state", { state: { state } });
    assert.equal((await set(PAUSED)).result.result, 1);
    const shown = await viewer.call<{ state: { state: number } }>("/get_simulation_state", {});
    assert.equal(shown.state.state, PAUSED);
    const paused = viewer.time;
    assert.equal((await set(PLAYING)).result.result, 1);
    await until("it goes on", () => (viewer.time > paused ? viewer.time : undefined));
    viewer.close();
});

test("wrong input is answered by a status, and other clients do not suffer", SKIP, async () => {
    const other = new Viewer("foxglove.sdk.v1"),
        viewer = new Viewer("foxglove.sdk.v1");
    await viewer.channel("/tf");
    viewer.socket.send("{");
    viewer.client.advertise({ topic: "/rover/cmd_vel", encoding: "protobuf", schemaName: "x" });
    viewer.client.subscribe(1_000_000);
    await until("three answers", () => (viewer.problems.length >= 3 ? true : undefined));
    viewer.client.close();
    await other.channel("/tf");
    other.close();
});
