// What the app does when the connection opens, and opens again.
import { effect } from "@preact/signals";
import { link, onEvent } from "../net/connection";
import { readAbout } from "../state/about";
import { edit, followDocument, readDocument, valueAt } from "../state/document";
import { entries, followEntries, readEntries } from "../ui/entries";
import { followJobs, readJobs } from "../ui/job";
import { complain, say } from "../ui/toast";
import { editToOpen, pageOf } from "./opened";
import { go } from "./go";

const kFirstClient = 1;

/** Follows the server. Called once, before connect(). */
export function followServer(): void {
  followDocument();
  followJobs();
  followEntries();
  onEvent("note", ({ message, hint }) => say(message, hint ?? ""));
  let first = true;
  effect(() => {
    if (link.value !== "open") return;
    const isFirst = first;
    first = false;
    readAll(isFirst).catch(complain);
  });
}

async function readAll(isFirst: boolean): Promise<void> {
  const [server] = await Promise.all([readAbout(), readDocument(), readEntries(), readJobs()]);
  // The first browser of a server's run: what it was started with is opened once.
  const isNewServer = server.client === kFirstClient;
  if (isFirst || isNewServer) server.problems.forEach((problem) => say(problem));
  const kind = entries.value.find(({ name }) => name === server.opened)?.kind;
  const page = kind && pageOf(kind);
  if (!page) return;
  const change = isNewServer ? editToOpen(kind, server.opened!, valueAt(`/${page}`)) : null;
  if (change) await edit(change.path, change.value, change.label);
  if (isFirst && location.hash === "") go(page);
}
