// The page of test/adding, reached by an entry as those of src/app/routes.ts are, against a server that answers as
// tests/adding/page_example.cc does.
import type { VNode } from "preact";
import { expect, test, vi } from "vitest";
import type { Route } from "../src/app/routes";
import { readDocument, valueAt } from "../src/state/document";

const server = vi.hoisted(() => ({ text: "", calls: [] as string[] }));
vi.mock("../src/net/connection", async (original) => ({
  ...(await original<typeof import("../src/net/connection")>()),
  call: async (name: string, args: any = {}) => {
    server.calls.push(name);
    if (name === "document.edit") server.text = args.value;
    if (name === "notes.count") return { words: server.text.split(/\s+/).filter(Boolean).length };
    return { value: { notes: { text: server.text } }, undo: "", redo: "" };
  },
}));

/** All that the app needs to know of a page. */
const route: Route = {
  id: "notes",
  title: "Notes",
  purpose: "Write down what was scanned.",
  key: "n",
  load: () => import("./adding/NotesPage"),
};

/** What a component draws, as a list of its elements and their texts. */
function drawn(node: any): (VNode<any> | string)[] {
  if (Array.isArray(node)) return node.flatMap(drawn);
  if (typeof node === "string" || typeof node === "number") return [String(node)];
  if (!node?.props) return [];
  return [node, ...drawn(node.props.actions), ...drawn(node.props.children)];
}

test("an entry of the routes leads to the page, which edits the document and calls the server", async () => {
  await readDocument();
  const Page = (await route.load()).default as () => VNode;
  const named = (name: string) => drawn(Page()).find((each): each is VNode<any> => typeof each !== "string" && (each.type as any).name === name)!;

  await named("TextField").props.onChange("wood, sanded");
  expect(valueAt("/notes/text")).toBe("wood, sanded");
  expect(named("TextField").props.value).toBe("wood, sanded");

  await named("Button").props.onClick();
  expect(server.calls).toEqual(["document.read", "document.edit", "notes.count"]);
  expect(drawn(Page()).filter((each) => typeof each === "string").join("")).toContain("2 words");
});
