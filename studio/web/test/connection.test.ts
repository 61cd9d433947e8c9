import { beforeEach, expect, test, vi } from "vitest";

/** A socket that the test plays the server for. */
class FakeSocket {
  static readonly OPEN = 1;
  static all: FakeSocket[] = [];
  readyState = 0;
  binaryType = "";
  bufferedAmount = 0;
  sent: any[] = [];
  onopen = () => undefined as unknown;
  onmessage = (_message: { data: any }) => undefined as unknown;
  onclose = (_closed: { code: number }) => undefined as unknown;

  constructor(readonly address: string) {
    FakeSocket.all.push(this);
  }
  send(data: any) {
    this.sent.push(typeof data === "string" ? JSON.parse(data) : data);
  }
  open() {
    this.readyState = 1;
    this.onopen();
  }
  answerPing() {
    this.tell({ id: this.sent[0].id, result: { t_ns: 1 } });
  }
  tell(message: object) {
    this.onmessage({ data: JSON.stringify(message) });
  }
  close(code: number) {
    this.readyState = 3;
    this.onclose({ code });
  }
  called(name: string) {
    return this.sent.filter((message) => message.call === name);
  }
}
const newest = () => FakeSocket.all.at(-1)!;

let changeHash: (event: { oldURL: string }) => void;
let net: typeof import("../src/net/connection");
beforeEach(async () => {
  vi.resetModules();
  vi.useFakeTimers();
  vi.clearAllTimers();
  FakeSocket.all = [];
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.stubGlobal("addEventListener", (_name: string, listener: typeof changeHash) => (changeHash = listener));
  vi.stubGlobal("location", { protocol: "http:", host: "127.0.0.1:1234", hash: "", pathname: "/" });
  net = await import("../src/net/connection");
  await net.connect();
});

test("what has answered is open", () => {
  expect(newest().address).toBe("ws://127.0.0.1:1234/ws");
  newest().open();
  expect(net.link.value).toBe("connecting");
  newest().answerPing();
  expect(net.link.value).toBe("open");
});

test("a call is answered, or refused with what to do", async () => {
  newest().open();
  newest().answerPing();
  const good = net.call("a.b", { x: 1 });
  const bad = net.call("a.c");
  const [first, second] = newest().sent.slice(1);
  expect(first).toMatchObject({ call: "a.b", args: { x: 1 } });
  newest().tell({ id: second.id, error: { message: "no such file", hint: "Choose another." } });
  newest().tell({ id: first.id, result: 7 });
  await expect(good).resolves.toBe(7);
  await expect(bad).rejects.toMatchObject({ message: "no such file", hint: "Choose another." });
});

test("a lost connection refuses what waits, comes back and subscribes again", async () => {
  net.subscribe("scan.probe", () => undefined);
  newest().open();
  newest().answerPing();
  expect(newest().called("subscribe")).toHaveLength(1);
  const waiting = net.call("slow.call");
  newest().close(1006);
  await expect(waiting).rejects.toThrow("was lost");
  expect(net.link.value).toBe("lost");
  vi.advanceTimersByTime(300);
  expect(FakeSocket.all).toHaveLength(2);
  newest().open();
  newest().answerPing();
  expect(net.link.value).toBe("open");
  expect(newest().called("subscribe").map((message) => message.args.topic)).toEqual(["scan.probe"]);
});

test("a server that does not know the browser is told apart, and asked ever more rarely", () => {
  newest().open();
  newest().close(4401);
  expect(net.link.value).toBe("refused");
  for (let second = 0; second < 60; ++second) {
    vi.advanceTimersByTime(1000);
    if (newest().readyState === 0) {
      newest().open();
      newest().close(4401);
    }
  }
  expect(net.link.value).toBe("refused");
  expect(FakeSocket.all.length).toBeLessThan(25);
});

test("events reach who listens, as long as he does", () => {
  newest().open();
  newest().answerPing();
  const heard: number[] = [];
  const stop = net.onEvent("entries", (data) => heard.push(data));
  newest().tell({ event: "entries", data: 1 });
  stop();
  newest().tell({ event: "entries", data: 2 });
  expect(heard).toEqual([1]);
});

test("a token of the address is changed for a cookie and taken out of it", async () => {
  vi.resetModules();
  const fetched = vi.fn().mockResolvedValue({});
  const replaceState = vi.fn();
  vi.stubGlobal("fetch", fetched);
  vi.stubGlobal("history", { replaceState });
  vi.stubGlobal("location", { protocol: "http:", host: "h", hash: "#token=abc", pathname: "/" });
  await (await import("../src/net/connection")).connect();
  expect(replaceState).toHaveBeenCalledWith(null, "", "/");
  expect(fetched.mock.calls[0]).toMatchObject(["/session", { method: "POST", body: '{"token":"abc"}' }]);
});

/** Opens another address of the server in the window: the browser changes the fragment alone. */
async function openHere(before: string, token: string, answer: () => Promise<object>) {
  const fetched = vi.fn(answer);
  const replaceState = vi.fn((_state: unknown, _title: string, address: string) => (location.hash = new URL(address, "http://h").hash));
  vi.stubGlobal("fetch", fetched);
  vi.stubGlobal("history", { replaceState });
  location.hash = `#token=${token}`;
  changeHash({ oldURL: `http://127.0.0.1:1234/${before}` });
  await vi.advanceTimersByTimeAsync(0);
  return { fetched, replaceState };
}

test("a new token in the same window is changed for a cookie, the page stays, and the connection is back at once", async () => {
  newest().open();
  newest().answerPing();
  newest().close(4401);
  expect(net.link.value).toBe("refused");
  const { fetched, replaceState } = await openHere("#/align", "new", async () => ({}));
  expect(fetched.mock.calls).toMatchObject([["/session", { method: "POST", body: '{"token":"new"}' }]]);
  expect(replaceState).toHaveBeenCalledWith(null, "", "/#/align");
  expect(FakeSocket.all).toHaveLength(2);
  newest().open();
  newest().answerPing();
  expect(net.link.value).toBe("open");
  vi.advanceTimersByTime(60_000);
  expect(FakeSocket.all).toHaveLength(2);
});

test("a token that no server has seen yet is shown again", async () => {
  newest().close(1006);
  let isThere = false;
  const { fetched } = await openHere("", "new", () => (isThere ? Promise.resolve({}) : Promise.reject(new TypeError("no server"))));
  expect(fetched).toHaveBeenCalledTimes(1);
  newest().close(1006);
  isThere = true;
  await vi.advanceTimersByTimeAsync(1000);
  expect(fetched).toHaveBeenCalledTimes(2);
  newest().close(1006);
  await vi.advanceTimersByTimeAsync(1000);
  expect(fetched).toHaveBeenCalledTimes(2);
});

test("going to another page is no token", () => {
  const sockets = FakeSocket.all.length;
  location.hash = "#/paint";
  changeHash({ oldURL: "http://127.0.0.1:1234/#/scan" });
  expect(FakeSocket.all).toHaveLength(sockets);
  expect(net.tokenOf("#token=ab")).toBe("ab");
  expect(net.tokenOf("#/align")).toBe("");
});
