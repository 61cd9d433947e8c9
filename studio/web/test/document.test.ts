import { beforeEach, expect, test, vi } from "vitest";

const server = vi.hoisted(() => ({ call: vi.fn(), listeners: new Map<string, (data: any) => void>() }));
vi.mock("../src/net/connection", () => ({
  call: server.call,
  onEvent: (name: string, listener: (data: any) => void) => server.listeners.set(name, listener),
}));

import { documentIsRead, edit, followDocument, readDocument, redoLabel, replaced, section, undoLabel, valueAt } from "../src/state/document";

const stored = { value: { align: { pose: [1, 0], name: "a" }, scan: {} }, version: 3, undo: "move the path", redo: "" };

beforeEach(async () => {
  server.call.mockReset();
  server.call.mockResolvedValue(structuredClone(stored));
  await readDocument();
  server.call.mockClear();
});

test("replaced copies what is on the way and shares the rest", () => {
  const tree = { a: { b: 1, c: [1, 2, 3] }, d: { e: 5 } };
  const next = replaced(tree, ["a", "c", "1"], 9);
  expect(next).toEqual({ a: { b: 1, c: [1, 9, 3] }, d: { e: 5 } });
  expect(next.d).toBe(tree.d);
  expect(tree.a.c).toEqual([1, 2, 3]);
});

test("replaced adds, appends and takes out", () => {
  expect(replaced({}, ["a", "b"], 1)).toEqual({ a: { b: 1 } });
  expect(replaced({ a: [1] }, ["a", "-"], 2)).toEqual({ a: [1, 2] });
  expect(replaced({ a: [1, 2, 3] }, ["a", "1"], null)).toEqual({ a: [1, 3] });
  expect(replaced({ a: 1, b: 2 }, ["a"], null)).toEqual({ b: 2 });
  expect(replaced({ a: 1 }, [], { b: 2 })).toEqual({ b: 2 });
});

test("the document is what the server has", () => {
  expect(documentIsRead.value).toBe(true);
  expect(section("align").value).toEqual({ pose: [1, 0], name: "a" });
  expect(undoLabel.value).toBe("move the path");
});

test("an edit is seen at once and told to the server", async () => {
  const told = edit("/align/name", "b", "rename", "gesture 1");
  expect(valueAt("/align/name")).toBe("b");
  await told;
  expect(server.call).toHaveBeenCalledWith("document.edit", { path: "/align/name", value: "b", label: "rename", gesture: "gesture 1" });
});

test("what the server refuses is taken back", async () => {
  server.call.mockRejectedValueOnce(new Error("no such name"));
  await expect(edit("/align/name", "b", "rename")).rejects.toThrow("no such name");
  expect(valueAt("/align/name")).toBe("a");
});

test("changes of others are followed, with escaped paths", () => {
  followDocument();
  server.listeners.get("document")!({ path: "/scan/a~1b~0c", value: 4, version: 4, undo: "set", redo: "back" });
  expect(section("scan").value).toEqual({ "a/b~c": 4 });
  expect(undoLabel.value).toBe("set");
  expect(redoLabel.value).toBe("back");
});

test("what an edit sets off calls the server after it", async () => {
  const { effect } = await import("@preact/signals");
  const end = effect(() => {
    if (valueAt("/align/name") === "b") server.call("align.open");
  });
  await edit("/align/name", "b", "choose another");
  expect(server.call.mock.calls.map(([name]) => name)).toEqual(["document.edit", "align.open"]);
  end();
});
