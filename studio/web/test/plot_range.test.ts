import { beforeEach, expect, test, vi } from "vitest";
import { rangeAfter } from "../src/plot/zoom";

/** Sets its scales in a microtask, or at the end of a batch, as uPlot does. */
class FakePlot {
  static newest: FakePlot;
  static paths = {};
  width = 400;
  scales: any = { x: { min: null, max: null } };
  cursor = {};
  over = { addEventListener: () => undefined };
  data: any;
  private pending: any = null;
  private isQueued = false;

  constructor(
    readonly options: any,
    data: any,
  ) {
    FakePlot.newest = this;
    this.data = data;
  }
  setScale(_key: string, range: object) {
    this.pending = { ...range };
    if (this.isQueued) return;
    this.isQueued = true;
    queueMicrotask(() => this.commit());
  }
  setData(data: any) {
    this.data = data;
  }
  batch(change: () => void) {
    this.isQueued = true;
    change();
    this.commit();
  }
  destroy() {}
  private commit() {
    this.isQueued = false;
    const { pending } = this;
    this.pending = null;
    if (!pending || (pending.min === this.scales.x.min && pending.max === this.scales.x.max)) return;
    this.scales.x = pending;
    for (const hear of this.options.hooks.setScale) hear(this, "x");
  }
}
vi.mock("uplot", () => ({ default: FakePlot }));
vi.mock("../src/plot/colours", () => ({ themeColour: () => "", seriesColour: () => "", faded: () => "" }));
vi.stubGlobal("ResizeObserver", class {
  observe() {}
  disconnect() {}
});

const { Drawing } = await import("../src/plot/Drawing");
const grown = (count: number) => {
  const x = Float64Array.from({ length: count }, (_, index) => index);
  return [{ label: "a", x, y: x }];
};
const shownRange = () => [FakePlot.newest.scales.x.min, FakePlot.newest.scales.x.max];
let drawing: InstanceType<typeof Drawing>;
beforeEach(() => {
  const props = () => ({ label: "", series: [], xAxis: { label: "x" }, yAxis: { label: "y" } });
  drawing = new Drawing({ clientWidth: 400, clientHeight: 200 } as HTMLElement, props, grown(11), () => undefined);
});

test("a plot that grows shows all of it, each time", async () => {
  await Promise.resolve();
  for (const count of [21, 41, 41, 81]) {
    drawing.setSeries(grown(count));
    await Promise.resolve();
    expect(shownRange()).toEqual([0, count - 1]);
    expect(drawing.zoomedInto()).toBeNull();
    expect(FakePlot.newest.data[0].at(-1)).toBe(count - 1);
  }
});

test("it grows too in the very moment that it is made", () => {
  drawing.setSeries(grown(21));
  drawing.setSeries(grown(41));
  expect(shownRange()).toEqual([0, 40]);
  expect(drawing.zoomedInto()).toBeNull();
});

test("what the user has dragged to stays while the plot grows", async () => {
  FakePlot.newest.setScale("x", { min: 2, max: 4 });
  await Promise.resolve();
  drawing.setSeries(grown(21));
  expect(shownRange()).toEqual([2, 4]);
  drawing.key("0");
  drawing.setSeries(grown(41));
  expect(shownRange()).toEqual([0, 40]);
});

test("a range is left when its data has gone", () => {
  const range = (min: number, max: number) => ({ min, max });
  expect(rangeAfter(range(2, 4), range(0, 10), range(0, 20))).toEqual(range(2, 4));
  expect(rangeAfter(range(2, 4), range(0, 10), range(5, 20))).toEqual(range(5, 20));
  expect(rangeAfter(range(0, 10), range(0, 10), range(0, 20))).toEqual(range(0, 20));
});

test("plots of a group zoom together, and one that shows all again shows all in each", async () => {
  const props = () => ({ label: "", series: [], xAxis: { label: "x" }, yAxis: { label: "y" }, syncKey: "group" });
  const place = { clientWidth: 400, clientHeight: 200 } as HTMLElement;
  const short = new Drawing(place, props, grown(11), () => undefined);
  const shortPlot = FakePlot.newest;
  const long = new Drawing(place, props, grown(21), () => undefined);
  const longPlot = FakePlot.newest;
  await Promise.resolve();
  shortPlot.setScale("x", { min: 2, max: 4 });
  await Promise.resolve();
  expect([longPlot.scales.x.min, longPlot.scales.x.max]).toEqual([2, 4]);
  long.key("0");
  expect([longPlot.scales.x.min, longPlot.scales.x.max]).toEqual([0, 20]);
  expect([shortPlot.scales.x.min, shortPlot.scales.x.max]).toEqual([0, 10]);
  expect(short.zoomedInto()).toBeNull();
  long.destroy();
  shortPlot.setScale("x", { min: 2, max: 4 });
  await Promise.resolve();
  expect([longPlot.scales.x.min, longPlot.scales.x.max]).toEqual([0, 20]);
});
