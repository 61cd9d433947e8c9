import uPlot from "uplot";
import { themeColour } from "./colours";
import { joinGroup, zoomGroup, type Linked } from "./linked";
import { axis, uBands, uSeries } from "./options";
import type { PlotProps } from "./props";
import { readout } from "./readout";
import { columnsBetween, extent, type Series } from "./series";
import { isAllOf, rangeAfter, zoomed, type Range } from "./zoom";

const kDotsEdge = 0.02;

/** The uPlot of a <Plot>: it draws again from all the data whenever the range of x changes. */
export class Drawing implements Linked {
  private readonly plot: uPlot;
  private readonly leaveGroup: () => void;
  private readonly observer: ResizeObserver;
  private all: Range;
  private shown: Range;
  private drawnRange = "";

  constructor(
    private readonly place: HTMLElement,
    private readonly props: () => PlotProps,
    private series: readonly Series[],
    private readonly tell: (words: string) => void,
    kept: Range | null = null,
  ) {
    const { logX = false, logY = false, xAxis, yAxis, yAxisRoom_px, syncKey } = props();
    this.all = this.range();
    const isInside = kept && kept.min >= this.all.min && kept.max <= this.all.max;
    const first = (this.shown = isInside ? kept : this.all);
    const columns = this.columns(first);
    const options: uPlot.Options = {
      ...this.size(),
      padding: [8, 12, 0, 0],
      legend: { show: false },
      scales: {
        x: { time: false, distr: logX ? 3 : 1, range: (_plot, low, high) => [low, high] },
        y: { distr: logY ? 3 : 1, range: (_plot, low, high) => this.yRange(low, high) },
      },
      axes: [axis(xAxis, logX, "x"), axis(yAxis, logY, "y", yAxisRoom_px)],
      series: [{}, ...series.flatMap(uSeries)],
      bands: uBands(series, columns.at),
      cursor: {
        drag: { x: true, y: false, setScale: true },
        bind: { dblclick: () => null },
        points: { size: 6 },
        ...(syncKey ? { sync: { key: syncKey, setSeries: false } } : {}),
      },
      hooks: {
        setScale: [(_plot, key) => key === "x" && this.rangeChanged()],
        setCursor: [() => this.cursorMoved()],
        draw: [(plot) => this.drawMarks(plot)],
      },
    };
    this.plot = new uPlot(options, columns.data as uPlot.AlignedData, place);
    this.show(first);
    this.leaveGroup = syncKey ? joinGroup(syncKey, this) : () => undefined;
    this.plot.over.addEventListener("dblclick", () => this.zoom(this.all));
    this.plot.over.addEventListener("click", () => this.picked());
    this.observer = new ResizeObserver(() => this.plot.setSize(this.size()));
    this.observer.observe(place);
  }

  destroy(): void {
    this.leaveGroup();
    this.observer.disconnect();
    this.plot.destroy();
  }

  /** New data, with the same looks. What is zoomed into stays so while it is there. */
  setSeries(series: readonly Series[]): void {
    const before = this.all;
    this.series = series;
    this.all = this.range();
    this.drawnRange = "";
    this.show(rangeAfter(this.shown, before, this.all));
  }

  key(key: string): boolean {
    const next = zoomed(this.shown, this.all, key, this.props().logX ?? false);
    if (next) this.zoom(next);
    return next !== null;
  }

  followZoom(range: Range | null): void {
    const isOut = range !== null && (range.min >= this.all.max || range.max <= this.all.min);
    this.show(range === null || isOut ? this.all : range);
  }

  /** Draws marks and cursors again. */
  redraw(): void {
    this.plot.redraw(false);
  }

  /** The range of x that is shown. */
  shownRange(): Range {
    return this.shown;
  }

  /** The range of x that is zoomed into; null if all is shown. */
  zoomedInto(): Range | null {
    return isAllOf(this.shown, this.all) ? null : this.shown;
  }

  /** What the user zooms to, in all plots of the group. */
  private zoom(range: Range): void {
    this.show(range);
    const { syncKey } = this.props();
    if (syncKey) zoomGroup(syncKey, this, this.zoomedInto());
  }

  /** uPlot's own scale follows later where it is set outside of a batch: what is shown is kept here. */
  private show(range: Range): void {
    this.shown = range;
    const name = `${range.min} ${range.max} ${this.plot.width}`;
    if (name === this.drawnRange) return;
    this.drawnRange = name;
    this.plot.batch(() => {
      this.plot.setData(this.columns(range).data as uPlot.AlignedData, false);
      this.plot.setScale("x", range);
    });
    this.props().onRange?.(range.min, range.max);
  }

  /** After a drag of the user, or what show() has set itself. */
  private rangeChanged(): void {
    const { min, max } = this.plot.scales.x!;
    if (min == null || max == null) return;
    if (min !== this.shown.min || max !== this.shown.max) this.zoom({ min, max });
    else this.show(this.shown);
  }

  private cursorMoved(): void {
    const { left } = this.plot.cursor;
    const x = left == null || left < 0 ? null : this.plot.posToVal(left, "x");
    this.tell(x === null ? "" : readout(this.props(), this.series, x));
    this.props().onCursor?.(x);
  }

  private picked(): void {
    const { left } = this.plot.cursor;
    if (left != null && left >= 0 && this.plot.select.width < 2) this.props().onPick?.(this.plot.posToVal(left, "x"));
  }

  private drawMarks(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = themeColour("--text-2");
    ctx.font = `${11 * devicePixelRatio}px ${themeColour("--font")}`;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
    const cursors = this.props().cursors;
    const measuring = cursors ? [{ x: cursors.a, label: "A" }, { x: cursors.b, label: "B" }] : [];
    for (const mark of [...(this.props().marks ?? []), ...measuring]) {
      const left = plot.valToPos(mark.x, "x", true);
      if (left < bbox.left || left > bbox.left + bbox.width) continue;
      ctx.beginPath();
      ctx.moveTo(left, bbox.top);
      ctx.lineTo(left, bbox.top + bbox.height);
      ctx.stroke();
      ctx.fillText(mark.label, left + 4 * devicePixelRatio, bbox.top + 12 * devicePixelRatio);
    }
    ctx.restore();
  }

  private columns(range: Range) {
    return columnsBetween(this.props().x, this.series, range.min, range.max, Math.max(200, this.place.clientWidth));
  }

  private range(): Range {
    const found = extent(this.props().x, this.series) ?? [0, 1];
    const [low, high] = found;
    if (this.props().logX) return { min: low > 0 ? low : high / 1e4, max: high };
    if (low === high) return { min: low - 0.5, max: high + 0.5 };
    // Dots are seen whole.
    const edge = this.series.some((one) => one.kind === "points") ? kDotsEdge * (high - low) : 0;
    return { min: low - edge, max: high + edge };
  }

  private yRange(low: number | null, high: number | null): [number, number] {
    const { yRange, logY } = this.props();
    if (yRange) return yRange;
    if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return logY ? [0.1, 1] : [0, 1];
    if (logY) return uPlot.rangeLog(Math.max(low, high / 1e8), high, 10, false) as [number, number];
    const gap = high > low ? 0.06 * (high - low) : Math.abs(high) || 1;
    return [low - gap, high + gap];
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(120, this.place.clientWidth), height: Math.max(80, this.place.clientHeight) };
  }
}
