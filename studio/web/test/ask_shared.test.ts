import { afterEach, beforeEach, expect, test, vi } from "vitest";

const server = vi.hoisted(() => ({ call: vi.fn(), listeners: new Map<string, (data: any) => void>() }));
vi.mock("../src/net/connection", () => ({
  call: server.call,
  onEvent: (name: string, listener: (data: any) => void) => server.listeners.set(name, listener),
  Refusal: class extends Error {},
}));

import { askShared } from "../src/ui/askShared";
import { followJobs, readJobs, type JobState } from "../src/ui/job";

const cancelled = () => Promise.reject(new Error("cancelled"));
const job = (id: number, state: JobState) => server.listeners.get("job")!({ id, title: "Painting", stage: "", fraction: 0, state });

beforeEach(async () => {
  vi.useFakeTimers();
  server.call.mockReset();
  server.call.mockResolvedValueOnce([]);
  followJobs();
  await readJobs();
  server.call.mockReset();
});
afterEach(() => vi.useRealTimers());

test("a question that another window has replaced is asked again", async () => {
  server.call.mockImplementationOnce(cancelled).mockImplementationOnce(cancelled).mockResolvedValueOnce(7);
  const answer = askShared("mesh.info", { file: "a.obj" }, { wanted: () => true });
  await vi.runAllTimersAsync();
  expect(await answer).toBe(7);
  expect(server.call.mock.calls).toEqual(Array(3).fill(["mesh.info", { file: "a.obj" }]));
});

test("not for ever, not for other faults, and not where nobody wants it", async () => {
  server.call.mockImplementation(cancelled);
  const answer = expect(askShared("mesh.info", {}, { wanted: () => true })).rejects.toThrow("cancelled");
  await vi.runAllTimersAsync();
  await answer;
  expect(server.call).toHaveBeenCalledTimes(4);
  await expect(askShared("mesh.info", {}, { wanted: () => false })).rejects.toThrow("cancelled");
  expect(server.call).toHaveBeenCalledTimes(5);
  server.call.mockReset().mockRejectedValue(new Error("no such file"));
  await expect(askShared("mesh.info", {}, { wanted: () => true })).rejects.toThrow("no such file");
  expect(server.call).toHaveBeenCalledTimes(1);
});

test("a job that a person has cancelled stays cancelled", async () => {
  server.call.mockImplementation(cancelled);
  job(1, "running");
  await expect(askShared("paint.show", {}, { title: "Painting", wanted: () => true })).rejects.toThrow("cancelled");
  expect(server.call).toHaveBeenCalledTimes(1);
});

test("the other window's job is waited for, so that it is not cancelled in turn", async () => {
  server.call.mockImplementationOnce(cancelled).mockResolvedValueOnce(7);
  job(1, "running");
  job(2, "waiting");
  const answer = askShared("paint.show", {}, { title: "Painting", wanted: () => true });
  await vi.advanceTimersByTimeAsync(10_000);
  job(1, "cancelled");
  job(2, "running");
  await vi.advanceTimersByTimeAsync(10_000);
  expect(server.call).toHaveBeenCalledTimes(1);
  job(2, "done");
  expect(await answer).toBe(7);
});
