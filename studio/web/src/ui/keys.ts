// Keys of the page that is shown, and of the whole app; the help dialog lists them.
import { signal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { complain } from "./toast";

export interface Key {
  /** As KeyboardEvent.key, small, with modifiers before: "s", "ctrl+z", "shift+arrowup"; "g s": one after the other. */
  key: string;
  /** What it does, for the help dialog. */
  label: string;
  run(): unknown;
  /** Also while a field has the focus. */
  always?: boolean;
}

export interface KeyGroup {
  title: string;
  keys: Key[];
}

/** All keys that work now, the newest group first. */
export const keyGroups = signal<KeyGroup[]>([]);

/** The first key of two that was pressed; "" while none waits for its second. */
export const leader = signal("");

const kRepeating = /arrow|page|^[+−-]$|^ctrl\+(shift\+)?z$/;

/** Makes keys work as long as the component is shown. */
export function useKeys(keys: Key[], title = "This page"): void {
  const newest = useRef(keys);
  newest.current = keys;
  const names = keys.map(({ key, label }) => `${key} ${label}`).join("\n");
  // Before the next picture: a key that is pressed as soon as something is seen is not lost.
  useLayoutEffect(() => {
    const group: KeyGroup = {
      title,
      keys: newest.current.map((key, index) => ({ ...key, run: () => newest.current[index]?.run() })),
    };
    keyGroups.value = [group, ...keyGroups.value];
    return () => (keyGroups.value = keyGroups.value.filter((other) => other !== group));
  }, [names, title]);
}

/** Begins to listen. Called once; the function that it returns ends it. */
export function followKeys(target: EventTarget): () => void {
  const listener = (event: Event) => hear(event as KeyboardEvent);
  const leave = () => (leader.value = "");
  target.addEventListener("keydown", listener);
  target.addEventListener("pointerdown", leave);
  target.addEventListener("blur", leave);
  return () => {
    target.removeEventListener("keydown", listener);
    target.removeEventListener("pointerdown", leave);
    target.removeEventListener("blur", leave);
  };
}

/** The name of a pressed key, as in Key.key. Shift is left out where it only makes the sign, as in "?". */
export function keyName(event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">): string {
  const key = event.key === " " ? "space" : event.key.toLowerCase();
  const isSign = event.key.length === 1 && event.key.toLowerCase() === event.key.toUpperCase() && key !== "space";
  return [
    (event.ctrlKey || event.metaKey) && "ctrl",
    event.altKey && "alt",
    event.shiftKey && !isSign && "shift",
    key,
  ]
    .filter(Boolean)
    .join("+");
}

/** The key of the groups that is meant by `name` after `previous`. */
export function findKey(groups: KeyGroup[], name: string, previous: string, typing: boolean): Key | undefined {
  const keys = groups.flatMap((group) => group.keys).filter((key) => !typing || key.always);
  return keys.find(({ key }) => previous !== "" && key === `${previous} ${name}`) ?? keys.find(({ key }) => key === name);
}

/**
 * What the key `name` does after the key `first`: runs a key, begins two in a row, or nothing. A second key that continues
 * with nothing does not do what it does alone: one who is late or slips starts, discards and switches nothing.
 */
export function meaningOf(groups: KeyGroup[], name: string, first: string, typing: boolean): { key?: Key; leader: string; taken: boolean } {
  if (first !== "" && (name === "space" || name === "enter")) return { leader: "", taken: true };
  const key = findKey(groups, name, first, typing);
  const slipped = first !== "" && key?.key === name && !key.always && !/^(ctrl|alt)\+/.test(name);
  if (slipped) return { leader: "", taken: true };
  if (key) return { key, leader: "", taken: true };
  const begins = !typing && groups.some((group) => group.keys.some((other) => other.key.startsWith(`${name} `)));
  return { leader: begins ? name : "", taken: begins };
}

function hear(event: KeyboardEvent): void {
  if (event.defaultPrevented || ["Shift", "Control", "Alt", "Meta"].includes(event.key)) return;
  const name = keyName(event);
  if (event.repeat && name === leader.value) return;
  const first = leader.value;
  leader.value = "";
  if (document.querySelector("dialog[open]")) return;
  const { key, leader: next, taken } = meaningOf(keyGroups.value, name, first, isTyping(event, name));
  leader.value = next;
  if (taken) event.preventDefault();
  if (!key) return;
  // A key that is held down starts, stops and answers once; what moves or undoes continues.
  if (event.repeat && !kRepeating.test(name)) return;
  try {
    const result = key.run();
    if (result instanceof Promise) result.catch(complain);
  } catch (error) {
    complain(error);
  }
}

/** True where a control uses the key itself. */
function isTyping(event: KeyboardEvent, name: string): boolean {
  const target = event.target;
  if (!(target instanceof HTMLElement)) return false;
  if (target.isContentEditable || target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement) return true;
  if (target instanceof HTMLInputElement) {
    if (target.type === "checkbox") return name === "space";
    return target.type !== "range" || name.includes("arrow") || ["home", "end", "pageup", "pagedown"].includes(name);
  }
  if (target instanceof HTMLButtonElement) return name === "space" || name === "enter";
  if (target instanceof HTMLAnchorElement) return name === "enter";
  return target.getAttribute("role") === "slider" && name.includes("arrow");
}
