// What the app does when the connection opens, and opens again.
import { effect } from "@preact/signals";
import { link, onEvent } from "../net/connection";
import { readAbout } from "../state/about";
import { followDocument, readDocument } from "../state/document";
import { entries, followEntries, readEntries, type EntryKind } from "../ui/entries";
import { followJobs, forgetJobs } from "../ui/job";
import { complain, say } from "../ui/toast";
import { go } from "./routes";

const PAGE_OF: Partial<Record<EntryKind, string>> = { recording: "process", mesh: "align", scene: "feel" };

/** Follows the server. Called once, before connect(). */
export function followServer(): void {
  followDocument();
  followJobs();
  followEntries();
  onEvent("note", ({ message, hint }) => say(message, hint ?? ""));
  let first = true;
  effect(() => {
    if (link.value !== "open") return;
    forgetJobs();
    const isFirst = first;
    first = false;
    readAll(isFirst).catch(complain);
  });
}

async function readAll(isFirst: boolean): Promise<void> {
  const [server] = await Promise.all([readAbout(), readDocument(), readEntries()]);
  if (!isFirst) return;
  server.problems.forEach((problem) => say(problem));
  const kind = entries.value.find(({ name }) => name === server.opened)?.kind;
  const page = kind && PAGE_OF[kind];
  if (page && location.hash === "") go(page);
}
