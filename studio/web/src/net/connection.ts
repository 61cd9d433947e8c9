// The one connection to the server: calls and their answers, events, topics. It reconnects by itself.
import { signal } from "@preact/signals";
import { decodeBlock, type Block } from "./block";

export type Link = "connecting" | "open" | "lost" | "refused";

/** The state of the connection; the shell shows it. */
export const link = signal<Link>("connecting");

/** What the server refused, in words, and what to do next. */
export class Refusal extends Error {
  constructor(
    message: string,
    readonly hint: string,
  ) {
    super(message);
  }
}

interface Waiting {
  resolve(value: any): void;
  reject(reason: Error): void;
}

const kFirstRetry_ms = 250;

const waiting = new Map<number, Waiting>();
const topics = new Map<string, Set<(block: Block) => void>>();
const events = new Map<string, Set<(data: any) => void>>();
let socket: WebSocket | null = null;
let nextId = 1;
let retry_ms = kFirstRetry_ms;
let retry: ReturnType<typeof setTimeout> | undefined;
let attempt = 0;
let token = "";
let pointerSequence = 0;

/** Calls the server; the answer is JSON or a Block. Rejects with a Refusal. */
export function call<T = any>(name: string, args: Record<string, unknown> = {}): Promise<T> {
  return new Promise((resolve, reject) => {
    if (!socket || socket.readyState !== WebSocket.OPEN) {
      reject(new Refusal("The studio's server does not answer.", "Check that `asperity studio` still runs. The page continues when the server answers again."));
      return;
    }
    const id = nextId++;
    waiting.set(id, { resolve, reject });
    socket.send(JSON.stringify({ id, call: name, args }));
  });
}

/** Frames of a topic, until the function that it returns is called. */
export function subscribe(topic: string, listener: (block: Block) => void): () => void {
  let listeners = topics.get(topic);
  if (!listeners) {
    listeners = new Set();
    topics.set(topic, listeners);
    if (link.value === "open") ask("subscribe", topic);
  }
  listeners.add(listener);
  return () => {
    listeners.delete(listener);
    if (listeners.size > 0 || topics.get(topic) !== listeners) return;
    topics.delete(topic);
    if (link.value === "open") ask("unsubscribe", topic);
  };
}

/** A request that a lost connection takes away is made again when it is back. */
function ask(name: "subscribe" | "unsubscribe", topic: string): void {
  call(name, { topic }).catch((error) => {
    if (link.value === "open") throw error;
  });
}

/** Events of a name, until the function that it returns is called. */
export function onEvent(name: string, listener: (data: any) => void): () => void {
  const listeners = events.get(name) ?? new Set();
  events.set(name, listeners);
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** Where the pointer pulls the device point; heard only from the owner of the force. */
export function sendPointer(x_m: number, y_m: number, z_m: number): void {
  if (!socket || socket.readyState !== WebSocket.OPEN || socket.bufferedAmount > 4096) return;
  const frame = new DataView(new ArrayBuffer(32));
  frame.setUint32(0, 0x31505341, true); // "ASP1"
  frame.setUint32(4, pointerSequence++, true);
  frame.setFloat64(8, x_m, true);
  frame.setFloat64(16, y_m, true);
  frame.setFloat64(24, z_m, true);
  socket.send(frame.buffer);
}

/** The token of a fragment like "#token=…"; empty where there is none. */
export const tokenOf = (fragment: string): string => new URLSearchParams(fragment.replace(/^#/, "")).get("token") ?? "";

/**
 * Changes the token of the address for a cookie, and connects; again where a new address of the server is opened in
 * the same window, of which the browser changes the fragment alone. Called once.
 */
export async function connect(): Promise<void> {
  addEventListener("hashchange", (event) => {
    if (!takeToken(new URL((event as HashChangeEvent).oldURL).hash)) return;
    retry_ms = kFirstRetry_ms;
    void (link.value === "open" ? admit() : reach());
  });
  takeToken("");
  await reach();
}

/** Removes the token from the address and restores the fragment that was there before it. */
function takeToken(before: string): boolean {
  const found = tokenOf(location.hash);
  if (!found) return false;
  token = found;
  history.replaceState(null, "", location.pathname + (tokenOf(before) ? "" : before));
  return true;
}

/** Shows the token to the server, which gives a cookie for it; kept for later where no server answers. */
async function admit(): Promise<void> {
  const shown = token;
  try {
    await fetch("/session", { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ token: shown }) });
  } catch {
    return;
  }
  if (token === shown) token = "";
}

/** Connects now, in the place of a connection that is there or is waited for. */
async function reach(): Promise<void> {
  const mine = ++attempt;
  clearTimeout(retry);
  if (token) await admit();
  if (mine === attempt) open();
}

function open(): void {
  const opened = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/ws`);
  opened.binaryType = "arraybuffer";
  const before = socket;
  socket = opened;
  giveUp();
  before?.close();
  // A server that does not know this browser opens the socket and closes it with a reason: open is what has answered.
  opened.onopen = () => opened.send(JSON.stringify({ id: nextId++, call: "studio.ping", args: {} }));
  opened.onmessage = (message) => {
    if (socket !== opened) return;
    if (link.value !== "open") begin();
    if (typeof message.data === "string") hearText(JSON.parse(message.data));
    else hearBlock(decodeBlock(message.data));
  };
  opened.onclose = (closed) => {
    if (socket !== opened) return;
    giveUp();
    link.value = closed.code === 4401 ? "refused" : "lost";
    clearTimeout(retry);
    retry = setTimeout(() => void reach(), retry_ms);
    retry_ms = Math.min(4000, 2 * retry_ms);
  };
}

/** Rejects all calls that wait for an answer. */
function giveUp(): void {
  for (const { reject } of waiting.values()) reject(new Refusal("The connection to the studio's server was lost.", "The page continues when the server answers again."));
  waiting.clear();
}

function begin(): void {
  retry_ms = kFirstRetry_ms;
  link.value = "open";
  for (const topic of topics.keys()) ask("subscribe", topic);
}

function hearText(message: any): void {
  if (message.event) {
    events.get(message.event)?.forEach((listener) => listener(message.data));
    return;
  }
  const call = waiting.get(message.id);
  if (!call) return;
  waiting.delete(message.id);
  if (message.error) call.reject(new Refusal(message.error.message, message.error.hint ?? ""));
  else call.resolve(message.result);
}

function hearBlock(block: Block): void {
  if (block.head.topic) {
    topics.get(block.head.topic)?.forEach((listener) => listener(block));
    return;
  }
  const call = waiting.get(block.head.id);
  if (!call) return;
  waiting.delete(block.head.id);
  call.resolve(block);
}
