import { fixed, millimetres } from "../../ui/format";
import { colouring, showOverlaps } from "./alignState";
import { colourLimit_m, colourLimitSigmas, inSigmas, rampStops, type Residuals } from "./residuals";

/** What the colours of the paths stand for, with units, and the rim of overlaps. */
export function DistanceLegend({ distances }: { distances: Residuals }) {
  const by = colouring.value;
  const overlaps = showOverlaps.value && distances.overlap.some((mark) => mark !== 0);
  if (by === "scan" && !overlaps) return null;
  return (
    <div class="align-legend" data-testid="align-legend">
      {by === "distance" && <Ramp words="distance to the mesh" limit={1e3 * colourLimit_m(distances.distance_m)} unit="mm" />}
      {by === "sigma" && <Sigmas distances={distances} />}
      {overlaps && (
        <p data-testid="align-overlap-legend">
          <span class="align-rim" />
          overlap: another scan within {millimetres(distances.overlap_m, 2)}
          {distances.overlap.some((mark) => mark >= 2) && ", or a texture of the scene"}
        </p>
      )}
    </div>
  );
}

function Sigmas({ distances }: { distances: Residuals }) {
  if (distances.median_sigma_m == null) return <span>The scans state no σ: their points are violet.</span>;
  const limit = colourLimitSigmas(inSigmas(distances.distance_m, distances.sigma_m));
  return (
    <>
      <Ramp words="distance to the mesh over its σ" limit={limit} unit="σ" />
      <p>
        1 σ is {millimetres(distances.median_sigma_m, 2)} in the median.
        {distances.sigma_m.some(Number.isNaN) && " Violet: no σ is stated."}
      </p>
    </>
  );
}

function Ramp({ words, limit, unit }: { words: string; limit: number; unit: string }) {
  const digits = limit < 0.1 ? 3 : limit < 2 ? 2 : 1;
  return (
    <>
      <span>{words}</span>
      <span class="align-ramp" style={{ background: `linear-gradient(to right, ${rampStops()})` }} />
      <span class="align-ramp-ends">
        <span>0</span>
        <span>{fixed(limit / 2, digits)}</span>
        <span>
          ≥ {fixed(limit, digits)}
          {"\u202f"}
          {unit}
        </span>
      </span>
    </>
  );
}
