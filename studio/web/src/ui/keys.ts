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

const kSequence_ms = 1500;
const kRepeating = /arrow|page|^[+−-]$|^ctrl\+(shift\+)?z$/;
let before = { key: "", at_ms: -Infinity };

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
  target.addEventListener("keydown", listener);
  return () => target.removeEventListener("keydown", listener);
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

function hear(event: KeyboardEvent): void {
  if (event.defaultPrevented || ["Shift", "Control", "Alt", "Meta"].includes(event.key)) return;
  const name = keyName(event);
  const previous = event.timeStamp - before.at_ms < kSequence_ms ? before.key : "";
  before = { key: name, at_ms: event.timeStamp };
  if (document.querySelector("dialog[open]")) return;
  const key = findKey(keyGroups.value, name, previous, isTyping(event, name));
  if (!key) return;
  before.key = "";
  event.preventDefault();
  // A key that is held down starts, stops and answers once; what moves or undoes goes on.
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
