import { useEffect, useRef, useState } from "preact/hooks";
import { subscribe } from "../../net/connection";
import { LiveBuffer } from "../../plot/LiveBuffer";
import { LivePlot } from "../../plot/LivePlot";
import { Plot } from "../../plot/Plot";
import { Panel } from "../../ui/Panel";
import { Button } from "../../ui/Button";
import { FORCES } from "./ForceMarks";
import { WayTrace } from "./wayTrace";

const kWindow_s = 5;
const kRedraw_ms = 200;

/** Every tick's forces and texture height, over time and over the path length. */
export function FeelPlots() {
  const [forces] = useState(() => new LiveBuffer(FORCES.length, 1 << 15));
  const [heights] = useState(() => new LiveBuffer(1, 1 << 15));
  const [trace] = useState(() => new WayTrace(6000));
  const [byWay, setByWay] = useState(false);
  const run = useRef(-1);
  useEffect(
    () =>
      subscribe("feel.ticks", ({ arrays, head }) => {
        if (head.run !== run.current) {
          forces.clear();
          heights.clear();
          trace.clear();
          run.current = head.run;
        }
        const { t_s, contact_N, texture_N, friction_N, out_N, height_m, way_mm } = arrays;
        forces.append(t_s!, [contact_N!, texture_N!, friction_N!, out_N!]);
        const height_um = Float32Array.from(height_m!, (value) => 1e6 * value);
        heights.append(t_s!, [height_um]);
        trace.append(way_mm!, height_um);
      }),
    [],
  );
  return (
    <>
      <Panel title="Forces" grow testId="feel-forces-plot">
        <LivePlot label="Forces by component" buffer={forces} series={FORCES.map(({ label, colour }) => ({ label, colour, dashed: label === "on the hand" }))} yAxis={{ label: "force", unit: "N" }} window_s={kWindow_s} leastHeight={0.5} />
      </Panel>
      <Panel
        title="Texture"
        grow
        testId="feel-height-plot"
        actions={
          <>
            <Button kind="quiet" pressed={!byWay} onClick={() => setByWay(false)}>
              by time
            </Button>
            <Button kind="quiet" pressed={byWay} onClick={() => setByWay(true)}>
              by path
            </Button>
          </>
        }
      >
        {byWay ? <WayPlot trace={trace} /> : <LivePlot label="Height of the texture" buffer={heights} series={[{ label: "height", colour: 2 }]} yAxis={{ label: "height", unit: "µm" }} window_s={kWindow_s} leastHeight={5} />}
      </Panel>
    </>
  );
}

function WayPlot({ trace }: { trace: WayTrace }) {
  const [shown, show] = useState(() => trace.rows());
  useEffect(() => {
    let version = -1;
    const timer = window.setInterval(() => {
      if (trace.version === version) return;
      version = trace.version;
      show(trace.rows());
    }, kRedraw_ms);
    return () => window.clearInterval(timer);
  }, [trace]);
  return (
    <Plot
      label="Height of the texture over the path length of the tip"
      x={shown.way_mm}
      series={[{ label: "height", colour: 2, y: shown.height_um }]}
      xAxis={{ label: "path length", unit: "mm" }}
      yAxis={{ label: "height", unit: "µm" }}
      legend={false}
      empty="Stroke the surface."
    />
  );
}
