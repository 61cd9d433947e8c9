// The pages and their addresses: "#/scan" and so on.
import { signal, type ReadonlySignal } from "@preact/signals";
import type { ComponentType } from "preact";

export interface Route {
  id: string;
  title: string;
  /** What one does there. */
  purpose: string;
  /** The key that opens it, after "g". */
  key: string;
}

export const routes: readonly Route[] = [
  { id: "scan", title: "Scan", purpose: "Record a surface with the probe and watch its profile grow.", key: "s" },
  { id: "process", title: "Process", purpose: "From recordings to profile, spectrum, roughness and compliance.", key: "p" },
  { id: "align", title: "Align", purpose: "Lay a scan path onto a mesh.", key: "a" },
  { id: "paint", title: "Paint", purpose: "Draw textures onto a mesh.", key: "t" },
  { id: "feel", title: "Feel", purpose: "Touch the scene with a device or with the mouse.", key: "f" },
];

const current = signal<Route>(routeOf(typeof location === "undefined" ? "" : location.hash));
export const route: ReadonlySignal<Route> = current;

/** The route of an address's fragment; the first one for what is none. */
export function routeOf(hash: string): Route {
  const id = /^#\/([a-z]+)/.exec(hash)?.[1];
  return routes.find((candidate) => candidate.id === id) ?? routes[0]!;
}

export const go = (id: string): void => void (location.hash = `#/${id}`);

if (typeof window !== "undefined") window.addEventListener("hashchange", () => (current.value = routeOf(location.hash)));

const files = import.meta.glob<{ default: ComponentType }>("../pages/*/*Page.tsx");

/** Loads a page's code when it is first shown; undefined where there is none. */
export function pageLoader(id: string): (() => Promise<{ default: ComponentType }>) | undefined {
  return files[`../pages/${id}/${id[0]!.toUpperCase()}${id.slice(1)}Page.tsx`];
}
