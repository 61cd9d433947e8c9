import { beforeEach, expect, test, vi } from "vitest";

const server = vi.hoisted(() => ({ call: vi.fn() }));
vi.mock("../src/net/connection", () => ({ call: server.call, onEvent: () => {} }));

import { chooseScene, feelSection } from "../src/pages/feel/feelChoices";
import { readDocument } from "../src/state/document";

beforeEach(async () => {
  server.call.mockReset();
  server.call.mockResolvedValue({ value: { feel: { scene: "a.obj", mesh_unit: "mm" } }, undo: "", redo: "" });
  await readDocument();
});

test("another mesh does not get the unit of the one before", async () => {
  await chooseScene("b.obj");
  expect(feelSection.value).toMatchObject({ scene: "b.obj", mesh_unit: "" });
});

test("the same mesh keeps its unit", async () => {
  await chooseScene("a.obj");
  expect(feelSection.value).toMatchObject({ scene: "a.obj", mesh_unit: "mm" });
});
