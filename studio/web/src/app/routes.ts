// The pages and their addresses: "#/scan" and so on.
import { signal, type ReadonlySignal } from "@preact/signals";
import type { ComponentType } from "preact";
import { tokenOf } from "../net/connection";

export interface Route {
  id: string;
  title: string;
  /** What one does there. */
  purpose: string;
  /** The key that opens it, after "g". */
  key: string;
  /** Its page of the documents; without it that of the studio. */
  help?: string;
  /** Its code, loaded when it is first shown. */
  load(): Promise<{ default: ComponentType }>;
}

export const routes: readonly Route[] = [
  {
    id: "home",
    title: "Home",
    purpose: "Begin: the virtual bench, the sample project, your files, and recent projects.",
    key: "h",
    help: "studio.html",
    load: () => import("../pages/home/HomePage"),
  },
  {
    id: "scan",
    title: "Scan",
    purpose: "Record a surface with the probe and see its profile grow.",
    key: "s",
    help: "studio-scan.html",
    load: () => import("../pages/scan/ScanPage"),
  },
  {
    id: "process",
    title: "Process",
    purpose: "From recordings to profile, spectrum, roughness and compliance.",
    key: "p",
    help: "studio-process.html",
    load: () => import("../pages/process/ProcessPage"),
  },
  {
    id: "align",
    title: "Align",
    purpose: "Register a scan path to a mesh.",
    key: "a",
    help: "studio-align.html",
    load: () => import("../pages/align/AlignPage"),
  },
  {
    id: "paint",
    title: "Paint",
    purpose: "Draw textures onto a mesh.",
    key: "t",
    help: "studio-paint.html",
    load: () => import("../pages/paint/PaintPage"),
  },
  {
    id: "feel",
    title: "Feel",
    purpose: "Touch the scene with a device or with the mouse.",
    key: "f",
    help: "studio-feel.html",
    load: () => import("../pages/feel/FeelPage"),
  },
  {
    id: "study",
    title: "Study",
    purpose: "Let people compare and rate textures, blind and in random order, and log their answers.",
    key: "u",
    help: "studio-study.html",
    load: () => import("../pages/study/StudyPage"),
  },
];

const current = signal<Route>(routeOf(typeof location === "undefined" ? "" : location.hash));
export const route: ReadonlySignal<Route> = current;

/** The route of an address's fragment; the first route for any other fragment. */
export function routeOf(hash: string): Route {
  const id = /^#\/([a-z]+)/.exec(hash)?.[1];
  return routes.find((candidate) => candidate.id === id) ?? routes[0]!;
}

if (typeof window !== "undefined") {
  window.addEventListener("hashchange", () => {
    // A token is not a page: the one that is shown stays.
    if (!tokenOf(location.hash)) current.value = routeOf(location.hash);
  });
}
