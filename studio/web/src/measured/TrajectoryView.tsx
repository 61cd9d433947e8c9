import { useEffect, useRef, useState } from "preact/hooks";
import type { Object3D } from "three";
import { Select } from "../ui/Select";
import { number } from "../ui/format";
import { dotsFromPoints, lineFromPoints } from "../view3d/helpers";
import type { View } from "../view3d/View";
import { Viewport } from "../view3d/Viewport";
import type { Measured } from "./measured";
import { thinnedWords } from "./measured";
import { colourRange, cssColour, pathColours } from "./pathColours";
import "./measured.css";

const QUANTITIES = {
  trajectory_height_m: { label: "Height", unit: "µm", factor: 1e6 },
  trajectory_speed_mps: { label: "Speed", unit: "mm/s", factor: 1e3 },
  trajectory_force_N: { label: "Force", unit: "N", factor: 1 },
  trajectory_contact: { label: "Contact", unit: "", factor: 1 },
  trajectory_sigma_m: { label: "Uncertainty, 1σ", unit: "µm", factor: 1e6 },
} as const;
type Quantity = keyof typeof QUANTITIES;

/** The tip's path, coloured by a quantity, and the base path under it. */
export function TrajectoryView({ measured }: { measured: Measured }) {
  const [quantity, setQuantity] = useState<Quantity>("trajectory_height_m");
  const [view, setView] = useState<View | null>(null);
  const framed = useRef("");
  const { label, unit, factor } = QUANTITIES[quantity];
  const values = measured.array(quantity);
  const range = quantity === "trajectory_contact" ? { low: 0, high: 1 } : colourRange(values);

  useEffect(() => {
    if (!view) return;
    const shown: Object3D[] = [];
    const base = measured.array("base_p_m");
    if (base.length > 0) shown.push(view.add(lineFromPoints(base, 0x8a949b)));
    const path = measured.array("trajectory_p_m");
    if (path.length > 0) {
      const colours = range && values.length > 0 ? pathColours(values, range) : 0x8a949b;
      shown.push(view.add(lineFromPoints(path, colours)), view.add(dotsFromPoints(path, colours, 3)));
    }
    // A new setting leaves the viewer at the same position.
    if (framed.current !== measured.name) view.fit();
    framed.current = measured.name;
    return () => shown.forEach((object) => view.remove(object));
  }, [view, measured, quantity]);

  return (
    <div class="measured-path">
      <div class="measured-bar">
        <Select
          label="Colour"
          value={quantity}
          options={Object.entries(QUANTITIES).map(([value, words]) => ({ value, label: words.label }))}
          onChange={(value) => setQuantity(value as Quantity)}
          testId="path-colour"
        />
        <ColourKey
          low={range && range.low * factor}
          high={range && range.high * factor}
          unit={unit}
          words={quantity === "trajectory_contact" ? ["off", "touching"] : undefined}
        />
        <p class="measured-note">{thinnedWords(measured.trajectory, "samples")}</p>
      </div>
      <Viewport
        key={measured.world}
        label={`The tip's path of ${measured.name}, ${number(measured.trajectory.duration_s, 3)} s, coloured by ${label.toLowerCase()}, with the base path in grey`}
        up={measured.world === "z_up" ? "z" : "-y"}
        onReady={(made) => {
          framed.current = "";
          setView(made);
          return () => setView(null);
        }}
        testId="path-view"
      />
    </div>
  );
}

interface ColourKeyProps {
  low: number | null;
  high: number | null;
  unit: string;
  words?: [string, string];
}

/** What the colours mean. */
function ColourKey({ low, high, unit, words }: ColourKeyProps) {
  if (low === null || high === null) return <p class="measured-note">The recording does not have these values.</p>;
  const stops = [0, 0.25, 0.5, 0.75, 1].map(cssColour).join(",");
  return (
    <div class="measured-key">
      <span>{words ? words[0] : number(low, 3)}</span>
      <span class="measured-key-bar" style={{ backgroundImage: `linear-gradient(to right, ${stops})` }} />
      <span>{words ? words[1] : `${number(high, 3)}\u202f${unit}`}</span>
    </div>
  );
}
